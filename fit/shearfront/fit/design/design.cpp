// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/design/design.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <utility>

#include "shearfront/fit/design/correlated_information.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/noise_reml.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/prediction.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Relative to the largest, an eigenvalue of information below which its direction is not determined.
constexpr double kUndetermined = 1e-13;
/// Parts of an undetermined direction that are named.
constexpr double kNamed = 0.1;
/// Candidates with correlated noise: their covariance is dense, and all its eigenvalues take more than a second.
constexpr std::size_t kMostCorrelated = 2000;
/// Of the correlated part, added to its diagonal: the same measurement again says nothing new, but must not divide by 0.
constexpr double kRepeated = 1e-12;

/// Jacobians in the coordinates of a fit without shape, of observations each of which is a residual.
class Sensitivities {
 public:
  Sensitivities(const FitSpec& spec, const Estimate& estimate)
      : spec_(without_shape(spec)),
        parameters_(spec_.scene, spec_.unknown),
        coordinates_(parameters_),
        control_(1) {
    for (std::size_t i = 0; i < estimate.parameters.size(); ++i)
      if (!estimate.parameters[i].is_held()) free_.push_back(static_cast<Index>(i));
  }

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] const Coordinates& coordinates() const { return coordinates_; }
  /// The unknowns that are not held at a bound.
  [[nodiscard]] const std::vector<Index>& free() const { return free_; }

  /// Row k belongs to observation k, in units of its sigma; columns are free(). Errors: InputError without a solution.
  [[nodiscard]] MatrixXd jacobian(const Observations& observations, const VectorXd& values) {
    FitSpec spec = spec_;
    spec.observations = observations;
    ResidualRows rows = rows_of(name_of(observations.quantity), spec, parameters_);
    std::vector<std::size_t> row_of(observations.rows.size());
    for (std::size_t i = 0; i < rows.rows.size(); ++i) row_of[rows.data(i).front().index] = i;
    const Objective objective(parameters_, coordinates_, spec.forward, std::move(rows),
                              find_loss("squared", 0), control_);
    const Objective::Evaluation at = objective.inspect(coordinates_.coordinates(values), true);
    if (!at.is_valid)
      throw InputError("candidates", "", "must have a solution at the estimate: " + at.failure);
    MatrixXd all(static_cast<Index>(row_of.size()), static_cast<Index>(free_.size()));
    for (std::size_t k = 0; k < row_of.size(); ++k)
      for (std::size_t j = 0; j < free_.size(); ++j)
        all(static_cast<Index>(k), static_cast<Index>(j)) =
            at.jacobian(static_cast<Index>(row_of[k]), free_[j]);
    return all;
  }

 private:
  static FitSpec without_shape(FitSpec spec) {
    spec.unknown.shape = Shape::none;
    return spec;
  }

  FitSpec spec_;
  Parameters parameters_;
  Coordinates coordinates_;
  RunControl control_;
  std::vector<Index> free_;
};

VectorXd values_of(const Parameters& parameters, SceneSpec<double> spec) {
  const std::vector<double*> places = entry_places(spec);
  VectorXd values(static_cast<Index>(parameters.size()));
  for (std::size_t i = 0; i < parameters.size(); ++i)
    values[static_cast<Index>(i)] = *places[parameters.entries()[i]];
  return values;
}

/// The estimate, and draws around it.
std::vector<VectorXd> points_of(const Parameters& parameters, const Estimate& estimate,
                                const DesignSpec& wanted) {
  std::vector<VectorXd> points{values_of(parameters, estimate.scene->spec())};
  if (wanted.draws <= 1) return points;
  const DrawnScenes draws = draw_scenes(parameters, estimate, wanted.draws - 1, wanted.seed);
  if (!draws.why_none.empty())
    throw InputError("draws", std::to_string(wanted.draws), "must be 1: " + draws.why_none);
  for (const Scene<double>& scene : draws.scenes) points.push_back(values_of(parameters, scene.spec()));
  return points;
}

/// Rows that are chosen together, in the order of their first.
std::vector<DesignChoice> units_of(const Observations& candidates, DesignUnit unit) {
  std::vector<DesignChoice> units;
  std::map<double, std::size_t> places;
  for (std::size_t k = 0; k < candidates.rows.size(); ++k) {
    const Observation& o = candidates.rows[k];
    if (unit != DesignUnit::measurement) {
      const auto [at, is_new] = places.try_emplace(unit == DesignUnit::time ? o.t : o.z, units.size());
      if (!is_new) {
        units[at->second].rows.push_back(k);
        continue;
      }
    }
    units.emplace_back().rows.push_back(k);
  }
  return units;
}

/// About n units spread evenly: a lattice of times and heights, or every so many.
std::vector<std::size_t> evenly_spread(const Observations& candidates, const std::vector<DesignChoice>& units,
                                       DesignUnit unit, std::size_t n) {
  const auto every = [](std::size_t all, std::size_t some) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < some; ++i) places.push_back((2 * i + 1) * all / (2 * some));
    return places;
  };
  if (unit != DesignUnit::measurement) return every(units.size(), n);
  std::vector<double> times, heights;
  for (const Observation& o : candidates.rows) times.push_back(o.t), heights.push_back(o.z);
  const auto sort_unique = [](std::vector<double>& x) {
    std::sort(x.begin(), x.end());
    x.erase(std::unique(x.begin(), x.end()), x.end());
  };
  sort_unique(times);
  sort_unique(heights);
  // As many times per height as the candidates have, and no more than n in all.
  const double aspect = static_cast<double>(times.size()) / static_cast<double>(heights.size());
  const auto n_times = std::clamp<std::size_t>(
      static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(n) * aspect))), 1,
      std::min(n, times.size()));
  const std::size_t n_heights = std::min(n / n_times, heights.size());
  std::map<std::pair<double, double>, std::size_t> at;
  for (std::size_t g = 0; g < units.size(); ++g) {
    const Observation& o = candidates.rows[units[g].rows.front()];
    at.emplace(std::pair(o.t, o.z), g);
  }
  std::vector<std::size_t> spread;
  for (const std::size_t i : every(times.size(), n_times))
    for (const std::size_t j : every(heights.size(), n_heights))
      if (const auto found = at.find({times[i], heights[j]}); found != at.end())
        spread.push_back(found->second);
  return spread;
}

/// Standard errors that information promises, NaN for unknowns in a direction it does not determine.
VectorXd errors_of(const MatrixXd& information, const VectorXd& slopes) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(information);
  const VectorXd& values = solver.eigenvalues();
  VectorXd errors = VectorXd::Zero(slopes.size());
  for (Index j = 0; j < slopes.size(); ++j) {
    double variance = 0;
    for (Index i = 0; i < values.size(); ++i) {
      const double part = solver.eigenvectors()(j, i) * solver.eigenvectors()(j, i);
      const bool is_determined = values[i] > kUndetermined * values[values.size() - 1];
      if (is_determined) variance += part / values[i];
      if (!is_determined && part > 1e-8) variance = kUnknown;
    }
    errors[j] = std::sqrt(variance) * slopes[j];
  }
  return errors;
}

/// The unknowns of the least determined direction of all candidates together.
std::string undetermined(const MatrixXd& information, const std::vector<std::string>& names) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(information);
  std::vector<std::string> involved;
  for (std::size_t j = 0; j < names.size(); ++j)
    if (std::abs(solver.eigenvectors()(static_cast<Index>(j), 0)) > kNamed) involved.push_back(names[j]);
  return fmt::format("{}", fmt::join(involved, ", "));
}

/// The observations of the fit with the noise it found, if they have none of their own.
Observations with_noise(Observations observations, double sigma) {
  for (Observation& o : observations.rows)
    if (!(o.sigma > 0)) o.sigma = sigma;
  return observations;
}

/// Covariance of the noise of two sets of measurements, in units of the sigma of each.
MatrixXd covariance_between(const Observations& a, const Observations& b, const NoiseShape& shape,
                            bool in_unit_of_data) {
  MatrixXd all(static_cast<Index>(a.rows.size()), static_cast<Index>(b.rows.size()));
  for (Index i = 0; i < all.rows(); ++i)
    for (Index j = 0; j < all.cols(); ++j) {
      const Observation &x = a.rows[static_cast<std::size_t>(i)], &y = b.rows[static_cast<std::size_t>(j)];
      all(i, j) = shape.correlated * (in_unit_of_data ? 1 / (x.sigma * y.sigma) : 1) *
                  std::exp(-std::abs(x.z - y.z) / shape.length_z - std::abs(x.t - y.t) / shape.length_t);
    }
  return all;
}

/// What goes into the choice: Jacobians at each point, of the observations there are and of the candidates.
struct MeasuredJacobians {
  std::vector<MatrixXd> before, candidates;
};

UnitInformation independent_information(const MeasuredJacobians& jacobians,
                                        const std::vector<DesignChoice>& choices) {
  UnitInformation information;
  for (std::size_t k = 0; k < jacobians.before.size(); ++k) {
    const MatrixXd &before = jacobians.before[k], &candidates = jacobians.candidates[k];
    information.before.emplace_back(before.transpose() * before);
    auto& units = information.units.emplace_back();
    for (const DesignChoice& choice : choices) {
      MatrixXd of_unit = MatrixXd::Zero(before.cols(), before.cols());
      for (const std::size_t row : choice.rows)
        of_unit +=
            candidates.row(static_cast<Index>(row)).transpose() * candidates.row(static_cast<Index>(row));
      units.push_back(std::move(of_unit));
    }
  }
  return information;
}

/// With the noise as the fit found it. What is measured beside the data says what these do not foretell: with the covariance of
/// both, W that whitens the data, B = W C_there,candidates and Y = W J_there, that is J - B^T Y with the covariance C - B^T B.
CorrelatedInformation correlated_information(const MeasuredJacobians& jacobians,
                                             const std::vector<DesignChoice>& choices,
                                             const Observations& there, const DesignSpec& wanted,
                                             const Estimate& estimate, NoiseModel model) {
  const bool in_unit_of_data = model == NoiseModel::discrepancy;
  const NoiseShape shape = shape_of(*estimate.noise, 1);
  const NoiseCovariance noise(std::make_shared<NoisePlaces>(there.rows, in_unit_of_data), shape);
  CorrelatedInformation information;
  information.covariance = covariance_between(wanted.candidates, wanted.candidates, shape, in_unit_of_data);
  information.covariance.diagonal() *= 1 + kRepeated;
  information.covariance.diagonal().array() += shape.independent;
  MatrixXd foretold;
  if (wanted.adds) {
    foretold = noise.whitened(covariance_between(there, wanted.candidates, shape, in_unit_of_data));
    information.covariance -= foretold.transpose() * foretold;
  }
  for (std::size_t k = 0; k < jacobians.before.size(); ++k) {
    const MatrixXd before = noise.whitened(jacobians.before[k]);
    information.before.emplace_back(before.transpose() * before);
    information.jacobians.push_back(jacobians.candidates[k]);
    if (wanted.adds) information.jacobians.back() -= foretold.transpose() * before;
  }
  for (const DesignChoice& choice : choices)
    information.units.emplace_back(choice.rows.begin(), choice.rows.end());
  return information;
}

/// Noise is known of what was measured only.
void expect_covariance(const FitSpec& spec, const Estimate& estimate, const Observations& candidates) {
  const Observations& data = spec.observations;
  const double width = data.rows.front().width;
  const auto differs = [&](const Observation& o) { return o.width != width; };
  if (candidates.quantity != data.quantity ||
      std::any_of(candidates.rows.begin(), candidates.rows.end(), differs))
    throw InputError("quantity", std::string(name_of(candidates.quantity)),
                     "must be that of the data where noise is correlated: of others it is not known");
  if (candidates.rows.size() > kMostCorrelated)
    throw InputError("candidates", std::to_string(candidates.rows.size()) + " measurements",
                     fmt::format("must be at most {} where noise is correlated", kMostCorrelated));
  if (!estimate.noise) throw InputError("noise.model", "", "must have been estimated or given");
}

/// Chooses n of the units, and says what that is worth.
template <class Information>
void choose(Information information, const DesignSpec& wanted, Index target, const VectorXd& slopes,
            Design& result) {
  result.errors.before = errors_of(information.before.front(), slopes);
  if (!wanted.adds)
    for (MatrixXd& before : information.before) before.setZero();
  const InformationCriterion criterion(wanted.criterion, target);
  const auto continuous = continuous_design(information, criterion, wanted.n);
  if (!continuous) {
    std::vector<std::size_t> all(result.choices.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    throw InputError("candidates", "",
                     "must determine the unknowns; all of them together do not determine " +
                         undetermined(information_of(information, 0, all), result.unknowns));
  }
  const auto chosen = exchanged_design(information, criterion, wanted.n, *continuous);
  for (std::size_t g = 0; g < result.choices.size(); ++g) {
    result.choices[g].weight = continuous->weights[static_cast<Index>(g)];
    result.choices[g].worth = continuous->worth[static_cast<Index>(g)];
  }
  for (const std::size_t g : chosen) result.choices[g].is_chosen = true;
  result.criterion = mean_criterion(information, criterion, chosen);
  result.bound = continuous->bound;
  const auto spread = evenly_spread(wanted.candidates, result.choices, wanted.unit, wanted.n);
  result.evenly_spread = spread.size();
  result.errors.evenly = errors_of(information_of(information, 0, spread), slopes);
  result.errors.chosen = errors_of(information_of(information, 0, chosen), slopes);
}

}  // namespace

double Design::efficiency() const { return std::min(1.0, std::exp(bound - criterion)); }

Design design(const FitSpec& spec, const Estimate& estimate, const DesignSpec& wanted) {
  const bool is_correlated = spec.noise.model != NoiseModel::independent;
  if (is_correlated) expect_covariance(spec, estimate, wanted.candidates);
  Sensitivities sensitivities(spec, estimate);
  const std::vector<Index>& free = sensitivities.free();
  if (free.empty()) throw InputError("unknown", "", "must not all be held at a bound");
  Design result;
  result.estimates.resize(static_cast<Index>(free.size()));
  VectorXd slopes(static_cast<Index>(free.size()));
  for (std::size_t j = 0; j < free.size(); ++j) {
    const ParameterEstimate& p = estimate.parameters[static_cast<std::size_t>(free[j])];
    result.unknowns.push_back(p.name);
    result.estimates[static_cast<Index>(j)] = p.estimate;
    slopes[static_cast<Index>(j)] = sensitivities.coordinates().slope(free[j], p.estimate);
  }
  Index target = 0;
  if (wanted.criterion == Criterion::target) {
    const auto at = std::find(result.unknowns.begin(), result.unknowns.end(), wanted.target);
    if (at == result.unknowns.end())
      throw InputError("criterion", wanted.target,
                       fmt::format("must be D, A, E or an unknown of the fit that is at no bound: {}",
                                   fmt::join(result.unknowns, ", ")));
    target = at - result.unknowns.begin();
  }
  result.choices = units_of(wanted.candidates, wanted.unit);
  if (wanted.n < 1 || wanted.n > result.choices.size())
    throw InputError("n", std::to_string(wanted.n),
                     fmt::format("must be from 1 to {}, all there is to choose from", result.choices.size()));

  MeasuredJacobians jacobians;
  const Observations there = with_noise(spec.observations, estimate.sigma);
  for (const VectorXd& values : points_of(sensitivities.parameters(), estimate, wanted)) {
    jacobians.before.push_back(sensitivities.jacobian(there, values));
    jacobians.candidates.push_back(sensitivities.jacobian(wanted.candidates, values));
  }
  if (is_correlated)
    choose(correlated_information(jacobians, result.choices, there, wanted, estimate, spec.noise.model),
           wanted, target, slopes, result);
  else
    choose(independent_information(jacobians, result.choices), wanted, target, slopes, result);
  return result;
}

}  // namespace shearfront::fit
