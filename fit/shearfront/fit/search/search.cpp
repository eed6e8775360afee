// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/search/search.hpp"

#include <algorithm>

#include "shearfront/fit/search/allowance.hpp"
#include "shearfront/fit/search/nlopt_algorithm.hpp"
#include "shearfront/fit/search/starts.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::VectorXd;

constexpr std::string_view kNlopt = "nlopt:";

/// "sbplx" of "nlopt:sbplx"; empty for other names.
std::string_view nlopt_name(std::string_view algorithm) {
  return algorithm.substr(0, kNlopt.size()) == kNlopt ? algorithm.substr(kNlopt.size()) : "";
}

SearchResult search_once(Objective& objective, const VectorXd& start, const SearchSpec& spec) {
  if (spec.algorithm == "ceres") return search_ceres(objective, start, spec);
  if (spec.algorithm == "global") return search_global(objective, start, spec);
  if (spec.algorithm == "pattern") return search_pattern(objective, start, spec);
  return search_nlopt(objective, start, spec, nlopt_name(spec.algorithm));
}

/// From `start`, then from points of the box, each with an equal share of what is left.
SearchResult search_many(Objective& objective, const VectorXd& start, const SearchSpec& spec) {
  const Allowance allowance(objective.control(), spec.max_evaluations);
  const double rounding = objective.rounding_misfit();
  StartPoints points(objective.coordinates(), start, spec.seed);
  SearchResult best;
  std::size_t iterations = 0, converged = 0, done = 0;
  for (; done < spec.starts && !allowance.must_stop(); ++done) {
    SearchSpec one = spec;
    one.max_evaluations = std::max<std::size_t>(1, allowance.left() / (spec.starts - done));
    SearchResult result = search_once(objective, done == 0 ? start : points.next(), one);
    iterations += result.iterations;
    converged += result.status == Status::ok ? 1 : 0;
    if (done == 0 || result.misfit < best.misfit) best = std::move(result);
    if (best.misfit <= rounding) {
      ++done;
      break;
    }
  }
  best.iterations = iterations;
  best.message = "best of " + std::to_string(done) + " starts, " + std::to_string(converged) +
                 " of them converged: " + best.message;
  if (best.status != Status::ok) allowance.report(best);
  return best;
}

}  // namespace

std::vector<std::string> algorithm_names() {
  std::vector<std::string> names{"ceres", "global", "pattern"};
  for (const NloptAlgorithm& algorithm : kNloptAlgorithms)
    names.push_back(std::string(kNlopt) + std::string(algorithm.name));
  return names;
}

bool uses_derivatives(std::string_view algorithm) {
  if (algorithm == "ceres" || algorithm == "global") return true;
  const NloptAlgorithm* found = find_nlopt_algorithm(nlopt_name(algorithm));
  return found && found->uses_derivatives;
}

InputError unknown_algorithm(std::string_view algorithm) {
  std::string all;
  for (const std::string& name : algorithm_names()) all += (all.empty() ? "" : ", ") + name;
  return {"search.algorithm", quoted_text(algorithm), "must be one of: " + all};
}

SearchResult search(Objective& objective, const VectorXd& start, const SearchSpec& spec) {
  const auto names = algorithm_names();
  if (std::find(names.begin(), names.end(), spec.algorithm) == names.end())
    throw unknown_algorithm(spec.algorithm);
  // The global search takes the number of starts as its own.
  const bool is_many = spec.starts > 1 && spec.algorithm != "global";
  SearchResult result = is_many ? search_many(objective, start, spec) : search_once(objective, start, spec);
  // A run that was broken off is no lack of a solution.
  if (result.status == Status::not_converged && objective.control().is_interrupted()) {
    result.status = Status::interrupted;
    result.message = kInterrupted;
  }
  return result;
}

}  // namespace shearfront::fit
