// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nanobind/nanobind.h>

#include <memory>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/solution/observation.hpp"

namespace shearfront::python {

/// What a fit was asked and what it found. Never changed, so threads may share it.
struct Fitted {
  std::shared_ptr<const fit::FitSpec> spec;
  std::shared_ptr<const fit::Estimate> estimate;

  [[nodiscard]] fit::Parameters parameters() const { return {spec->scene, spec->unknown}; }
};

/// A fit that is ready to run.
struct FitProblem {
  std::shared_ptr<const fit::FitSpec> spec;
  std::vector<std::string> remarks;
};

/// What pickles hold (estimate_state.cpp).
void bind_state(nanobind::module_& m, nanobind::class_<Fitted>& fitted);
void bind_state(nanobind::module_& m, nanobind::class_<Observations>& observations);

/// Texts of a fit, and what is made from them (fit_state.cpp).
void bind_fit_state(nanobind::module_& m, nanobind::class_<FitProblem>& problem);

}  // namespace shearfront::python
