// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <string_view>

namespace shearfront::fit {

/// What a search has to know about an algorithm of NLopt.
struct NloptAlgorithm {
  std::string_view name;   ///< here: search.algorithm = "nlopt:NAME"
  const char* nlopt_name;  ///< NLopt's, without NLOPT_
  bool is_global;          ///< searches a box: needs finite bounds
  bool uses_derivatives;   ///< needs a misfit without jumps
  bool takes_constraints;  ///< a shape is given to it as inequalities, not as a box
  std::size_t fewest_unknowns;
  std::string_view description;
};

/// The algorithms for least squares in a box, with or without derivatives. Left out: those without bounds
/// (NLopt's NEWUOA proper), variants of one listed, and those in NLopt's optional C++ part (StoGO, AGS).
inline constexpr std::array kNloptAlgorithms{
    NloptAlgorithm{"sbplx", "LN_SBPLX", false, false, false, 1, "Nelder-Mead on subspaces (Rowan)"},
    NloptAlgorithm{"nelder-mead", "LN_NELDERMEAD", false, false, false, 1, "simplex with bounds (Box)"},
    NloptAlgorithm{"cobyla", "LN_COBYLA", false, false, true, 1, "linear models (Powell)"},
    NloptAlgorithm{"bobyqa", "LN_BOBYQA", false, false, false, 2, "quadratic models (Powell)"},
    NloptAlgorithm{"newuoa", "LN_NEWUOA_BOUND", false, false, false, 2, "quadratic models (Powell, Johnson)"},
    NloptAlgorithm{"praxis", "LN_PRAXIS", false, false, false, 2, "principal axes (Brent)"},
    NloptAlgorithm{"slsqp", "LD_SLSQP", false, true, true, 1, "sequential quadratic programming (Kraft)"},
    NloptAlgorithm{"mma", "LD_MMA", false, true, true, 1, "moving asymptotes (Svanberg)"},
    NloptAlgorithm{"ccsa", "LD_CCSAQ", false, true, true, 1, "separable quadratic models (Svanberg)"},
    NloptAlgorithm{"lbfgs", "LD_LBFGS", false, true, false, 1, "limited-memory BFGS (Luksan)"},
    NloptAlgorithm{"tnewton", "LD_TNEWTON_PRECOND_RESTART", false, true, false, 1,
                   "truncated Newton (Luksan)"},
    NloptAlgorithm{"direct", "GN_DIRECT", true, false, false, 1, "dividing rectangles (Jones)"},
    NloptAlgorithm{"direct-l", "GN_DIRECT_L", true, false, false, 1,
                   "the same, biased to local search (Gablonsky)"},
    NloptAlgorithm{"crs2", "GN_CRS2_LM", true, false, false, 1, "controlled random search (Price)"},
    NloptAlgorithm{"isres", "GN_ISRES", true, false, true, 1,
                   "evolution with stochastic ranking (Runarsson)"},
    NloptAlgorithm{"esch", "GN_ESCH", true, false, false, 1, "evolution (da Silva Santos)"},
    NloptAlgorithm{"mlsl", "G_MLSL_LDS", true, true, false, 1,
                   "SLSQP from a Sobol set, minima told apart (Rinnooy Kan)"},
};

/// The algorithm of this name (without "nlopt:"); null if there is none.
[[nodiscard]] constexpr const NloptAlgorithm* find_nlopt_algorithm(std::string_view name) {
  for (const NloptAlgorithm& algorithm : kNloptAlgorithms)
    if (algorithm.name == name) return &algorithm;
  return nullptr;
}

}  // namespace shearfront::fit
