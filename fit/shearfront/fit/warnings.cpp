// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>
#include <set>
#include <string_view>

#include "shearfront/fit/flat.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/noise.hpp"
#include "shearfront/fit/report.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::fit {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A reduced chi^2 is worth a warning when chance hardly explains it and the noise is off by > 12 %.
constexpr double kChance = 1e-3;
constexpr double kLargeChi2 = 1.25;

std::string short_text(double x) { return number_text(x, 3); }

/// "a", "a and b", "a, b and c"
std::string listed(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i)
    all += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
  return all;
}

/// Entries as a reader would list them: an array by its name if all its unknown entries are meant, otherwise
/// "shear_rate.values[1] and [2]".
std::string names_of(const Parameters& parameters, const std::vector<Index>& which) {
  std::vector<std::string> names;
  std::string last_field;
  const std::set<Index> meant(which.begin(), which.end());
  for (const Index i : which) {
    const Entry& entry = parameters[static_cast<std::size_t>(i)].entry;
    bool whole_field = entry.is_element && which.size() > 1;
    std::size_t n_in_field = 0;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      if (parameters[k].entry.field != entry.field) continue;
      ++n_in_field;
      whole_field = whole_field && meant.contains(static_cast<Index>(k));
    }
    if (whole_field && n_in_field > 1) {
      if (last_field != entry.field) names.push_back(entry.field);
    } else {
      names.push_back(entry.is_element && last_field == entry.field ? fmt::format("[{}]", entry.index)
                                                                    : entry.name());
    }
    last_field = entry.field;
  }
  return listed(names);
}

class Writer {
 public:
  Writer(const Minimum& minimum, const Estimate& estimate)
      : spec_(minimum.spec),
        parameters_(minimum.parameters),
        coordinates_(minimum.objective.coordinates()),
        minimum_(minimum),
        estimate_(estimate) {}

  std::vector<std::string> operator()() {
    values_.resize(static_cast<Index>(parameters_.size()));
    for (Index i = 0; i < values_.size(); ++i) values_[i] = of(i).estimate;
    bounds();
    null_directions();
    few_data();
    huge_errors();
    doubtful_intervals();
    derived_rows();
    structure();
    chi_squared();
    return std::move(texts_);
  }

 private:
  [[nodiscard]] const ParameterEstimate& of(Index i) const {
    return estimate_.parameters[static_cast<std::size_t>(i)];
  }

  void bounds() {
    std::set<Index> shaped;
    const VectorXd u = coordinates_.coordinates(values_);
    for (Index j = 0; j < coordinates_.size(); ++j) {
      const std::vector<Index> together = coordinates_.bound_together(j);
      const bool is_lower = u[j] - coordinates_.lower()[j] < coordinates_.upper()[j] - u[j];
      if (!minimum_.errors.held[static_cast<std::size_t>(j)] || together.size() < 2 || !is_lower) continue;
      shaped.insert(together.begin(), together.end());
      const bool is_convex = parameters_.shape() == Shape::convex;
      texts_.push_back(fmt::format(
          "{} {}: the shape {} is active there and they have no error bars", element_names(together),
          together.size() > 2 ? "lie on a straight line" : "are equal", is_convex ? "convex" : "decreasing"));
    }
    for (Index i = 0; i < values_.size(); ++i) {
      const Parameter& p = parameters_[static_cast<std::size_t>(i)];
      if (!of(i).is_held()) continue;
      const bool is_lower = std::abs(values_[i] - p.lower) <= std::abs(values_[i] - p.upper);
      const double bound = is_lower ? p.lower : p.upper;
      if (shaped.contains(i) && !(std::abs(values_[i] - bound) <= 1e-8 * std::abs(bound))) continue;
      texts_.push_back(
          fmt::format("{} is at its {} bound {}: it has no error bar, and those of the others "
                      "take it as known",
                      p.name(), is_lower ? "lower" : "upper", number_text(bound)));
    }
  }

  /// Members of an array that are told apart: "shear_rate.values[1] and [2]".
  [[nodiscard]] std::string element_names(const std::vector<Index>& which) const {
    std::vector<std::string> names;
    for (const Index i : which) {
      const Entry& entry = parameters_[static_cast<std::size_t>(i)].entry;
      names.push_back(names.empty() ? entry.name() : fmt::format("[{}]", entry.index));
    }
    return listed(names);
  }

  void null_directions() {
    const MatrixXd derivative =
        coordinates_.derivative(coordinates_.coordinates(values_));  // of the parameters
    std::vector<Index> unseen;
    for (const auto direction : minimum_.errors.null_directions.colwise()) {
      VectorXd change = derivative * direction;
      for (Index i = 0; i < change.size(); ++i)
        change[i] /= is_relative(i) ? values_[i] : parameters_[static_cast<std::size_t>(i)].unit;
      change /= change.lpNorm<Eigen::Infinity>();
      std::vector<Index> involved;
      for (Index i = 0; i < change.size(); ++i)
        if (std::abs(change[i]) > kNullEntry) involved.push_back(i);
      for (const Index i : involved)
        if (!is_relative(i)) change[i] *= parameters_[static_cast<std::size_t>(i)].unit;
      if (involved.size() == 1)
        unseen.push_back(involved.front());
      else if (!are_too_few())
        confounded(involved, change / change[involved.front()]);
    }
    std::sort(unseen.begin(), unseen.end());
    std::erase_if(unseen, [&](Index i) { return is_seen_elsewhere(i); });
    if (!unseen.empty())
      texts_.push_back(fmt::format("{} {} not seen by these data: no observation depends on {}",
                                   names_of(parameters_, unseen), unseen.size() == 1 ? "is" : "are",
                                   unseen.size() == 1 ? "it" : "them"));
  }
  /// Says how far an unknown is not seen, if that is not everywhere.
  [[nodiscard]] bool is_seen_elsewhere(Index i) {
    if (parameters_.shape() != Shape::none) return false;
    const Flat flat = flat_around(minimum_.objective, minimum_.u, i);
    if (std::isinf(flat.down) && std::isinf(flat.up)) return false;
    // A rate that no observation sees within a factor of e is not seen for any that one would guess.
    if (is_relative(i) && flat.down + flat.up > 1) return false;
    const Parameter& p = parameters_[static_cast<std::size_t>(i)];
    // Steps of a method are far narrower than what data leave open.
    constexpr double kStep = 0.02;
    if (flat.down + flat.up < (minimum_.objective.has_derivatives() ? 0 : kStep) ||
        flat.down + flat.up == 0) {
      texts_.push_back(
          fmt::format("{} has no error bar: what the misfit changes with it is lost in the steps of the "
                      "method {}; ask for a finer resolution or uncertainty.profile = true",
                      p.name(), spec_.forward.method.name()));
      return true;
    }
    const auto value = [&](double distance) {
      const double u = minimum_.u[i] + distance;
      return std::clamp(coordinates_.unscaled(i, u), p.lower, p.upper);
    };
    const double low = std::isinf(flat.down) ? p.lower : value(-flat.down);
    const double high = std::isinf(flat.up) ? p.upper : value(flat.up);
    texts_.push_back(
        fmt::format("{} is not seen by these data between {} and {}: the misfit is the same there", p.name(),
                    short_text(low), short_text(high)));
    return true;
  }
  [[nodiscard]] bool is_relative(Index i) const {
    return parameters_[static_cast<std::size_t>(i)].entry.range == Range::positive;
  }

  void confounded(const std::vector<Index>& involved, const VectorXd& change) {
    std::string direction;
    for (const Index i : involved) {
      // Derivatives are good to three digits here at best, and so is this text.
      const double size = std::abs(change[i]);
      const std::string factor = std::abs(size - 1) < 5e-3 ? "e" : short_text(size) + " e";
      const std::string name = parameters_[static_cast<std::size_t>(i)].name();
      const char sign = change[i] > 0 ? '+' : '-';
      direction += direction.empty() ? "" : ", ";
      direction += is_relative(i) ? fmt::format("{} * (1 {} {})", name, sign, factor)
                                  : fmt::format("{} {} {}", name, sign, factor);
    }
    texts_.push_back(
        fmt::format("{} cannot be determined together: the data do not change along {} for small e; fix one "
                    "of them",
                    names_of(parameters_, involved), direction));
  }

  /// Observations that depend on an unknown.
  [[nodiscard]] std::size_t n_seeing() const {
    const std::vector<bool> depends = dependent_rows(minimum_.at.jacobian);
    return static_cast<std::size_t>(std::count(depends.begin(), depends.end(), true));
  }
  /// Too few to determine the unknowns, let alone their noise: few_data() says so.
  [[nodiscard]] bool are_too_few() const {
    return std::isnan(estimate_.sigma) && n_seeing() < parameters_.size();
  }

  void few_data() {
    const std::size_t n = n_seeing();
    if (!std::isnan(estimate_.sigma) || n == 0) return;  // unseen unknowns are named
    const std::string data = fmt::format("{} observation{}{}", n, n == 1 ? "" : "s",
                                         n == estimate_.observations ? "" : " that depend on the unknowns");
    const std::string unknowns =
        fmt::format("{} unknown{}", parameters_.size(), parameters_.size() == 1 ? "" : "s");
    texts_.push_back(
        are_too_few()
            ? fmt::format(
                  "{} cannot determine {}: the estimates are one of many solutions, without error bars", data,
                  unknowns)
            : fmt::format(
                  "{} for {} leave nothing to estimate the noise from: there are no error bars; give sigma "
                  "with the data",
                  data, unknowns));
  }

  void huge_errors() {
    for (Index i = 0; i < values_.size(); ++i) {
      const ParameterEstimate& p = of(i);
      if (!is_barely_seen(parameters_[static_cast<std::size_t>(i)], p)) continue;
      texts_.push_back(
          fmt::format("{} is barely seen by these data: its standard error {} is {} % of the "
                      "estimate {}{}",
                      p.name, short_text(*p.std_error),
                      number_text(std::round(100 * *p.std_error / p.estimate)), short_text(p.estimate),
                      has_profiles(spec_, minimum_.objective) ? "; believe its profile interval" : ""));
    }
  }

  void doubtful_intervals() {
    for (const ParameterEstimate& p : estimate_.parameters) {
      if (!p.check || !p.check->is_doubtful() || !p.ci95) continue;
      std::vector<std::string> faults;
      const auto is_off = [](EndFault fault) {
        return fault == EndFault::too_near || fault == EndFault::too_far;
      };
      const auto say = [&](EndFault fault, std::string_view end) {
        if (fault == EndFault::none) return;
        faults.push_back(fmt::format("{} end {}", end,
                                     fault == EndFault::too_near  ? "should be farther off"
                                     : fault == EndFault::too_far ? "should be nearer"
                                                                  : "has no solution: " + p.check->failure));
      };
      say(p.check->low, "its lower");
      say(p.check->high, "its upper");
      texts_.push_back(fmt::format(
          "do not trust the 95 % interval of {}, {} to {}: {}{}; {}", p.name, short_text(p.ci95->low),
          short_text(p.ci95->high),
          is_off(p.check->low) || is_off(p.check->high) ? "the misfit is no parabola, " : "", listed(faults),
          has_profiles(spec_, minimum_.objective) ? "believe its profile interval"
                                                  : "ask for uncertainty.profile = true"));
    }
  }

  void derived_rows() {
    const std::string_view measured = name_of(spec_.observations.quantity);
    const std::string& compared = spec_.misfit.quantity;
    if (compared.empty() || compared == measured) return;
    const bool makes_rows = !minimum_.objective.rows().are_single();
    const bool from_points = spec_.observations.quantity == Quantity::point;
    texts_.push_back(fmt::format(
        "the data are {} values but are compared as {}: {}{}", measured, compared,
        from_points ? "this is wrong by up to half the spacing times the jump at each shock, which the error "
                      "bars do not contain"
        : makes_rows ? "their noise is then correlated, which the error bars account for"
                     : "the difference between the two is not in the error bars",
        makes_rows ? fmt::format("; misfit.quantity = \"{}\" uses them as they are", measured) : ""));
  }

  void structure() {
    if (!estimate_.structure || !estimate_.structure->is_structured) return;
    const ResidualStructure& s = *estimate_.structure;
    std::vector<std::string> signs;
    if (std::isfinite(s.lag1_height))
      signs.push_back(fmt::format("correlation {:.2f} from height to height", s.lag1_height));
    if (std::isfinite(s.lag1_time)) signs.push_back(fmt::format("{:.2f} from time to time", s.lag1_time));
    if (std::isfinite(s.runs_z_score))
      signs.push_back(fmt::format("{} runs of equal sign than chance gives ({:+.1f} standard deviations)",
                                  s.runs_z_score < 0 ? "fewer" : "more", s.runs_z_score));
    const bool is_smooth =
        finite(s.lag1_height) + finite(s.lag1_time) - std::min(finite(s.runs_z_score), 0.0) > 0;
    const std::string size = is_smooth ? "too small" : "wrong";
    if (estimate_.noise) {
      texts_.push_back(fmt::format(
          "{} noise does not describe these residuals: whitened, they still have {}; error bars may be {}",
          estimate_.noise->model, listed(signs), size));
      return;
    }
    const bool may_correlate = noise_refusal(spec_, minimum_.objective.rows()).empty();
    texts_.push_back(
        fmt::format("{}: residuals (rms {}) have {}; error bars, which assume independent noise, are {}{}",
                    is_smooth ? "the model does not describe these data, or their noise is not independent"
                              : "the noise of these data is not independent",
                    short_text(rms()), listed(signs), size,
                    may_correlate ? ": noise.model = \"exponential\" takes it as correlated" : ""));
  }
  static double finite(double x) { return std::isfinite(x) ? x : 0; }
  /// Of the residuals in the unit of the data.
  [[nodiscard]] double rms() const {
    return estimate_.residual_norm /
           std::sqrt(static_cast<double>(std::max<std::size_t>(1, estimate_.observations)));
  }

  /// Only for rows that are single observations: the others are correlated and follow another law.
  void chi_squared() {
    const bool is_direct = minimum_.objective.rows().are_single();
    const auto n_known = std::count(minimum_.errors.held.begin(), minimum_.errors.held.end(), true) +
                         minimum_.errors.null_directions.cols();
    const auto freedom = static_cast<double>(minimum_.at.residuals.size() - values_.size() + n_known);
    if (!estimate_.sigma_is_given || !is_direct || !(freedom > 0)) return;
    const Size size = !minimum_.objective.loss().is_robust ? size_by_squares(freedom) : size_by_median();
    if (size.chance > kChance || (size.reduced < kLargeChi2 && size.reduced > 1 / kLargeChi2)) return;
    const bool is_large = size.reduced > 1;
    texts_.push_back(fmt::format(
        "the residuals are {} times {} than their sigma ({} {}, p-value {}): {}",
        short_text(std::sqrt(is_large ? size.reduced : 1 / size.reduced)), is_large ? "larger" : "smaller",
        size.name, short_text(size.reduced), number_text(size.chance, 2),
        is_large ? "the model does not describe these data, or sigma is too small, and so are the "
                   "error bars"
                 : "sigma is too large, and so are the error bars"));
  }

  /// Mean square of the residuals in units of sigma^2, and how probable one that far from 1 is.
  struct Size {
    double reduced = 1, chance = 1;
    std::string_view name;
  };
  [[nodiscard]] Size size_by_squares(double freedom) const {
    const double chi2 = minimum_.at.residuals.squaredNorm();
    const boost::math::chi_squared law(freedom);
    const double chance =
        chi2 > freedom ? boost::math::cdf(boost::math::complement(law, chi2)) : boost::math::cdf(law, chi2);
    return {chi2 / freedom, chance, "reduced chi^2"};
  }
  /// Gross errors, for which a robust loss is chosen, say nothing about sigma.
  [[nodiscard]] Size size_by_median() const {
    constexpr double kMedian = 0.674489750196082;  // of |r|, r standard normal
    VectorXd sizes = minimum_.at.residuals.cwiseAbs();
    const auto n = static_cast<double>(sizes.size());
    const auto beyond = static_cast<double>((sizes.array() > kMedian).count());
    std::sort(sizes.begin(), sizes.end());
    const boost::math::normal law;
    const double z = std::abs(beyond - n / 2) / std::sqrt(n / 4);
    return {std::pow(sizes[sizes.size() / 2] / kMedian, 2), boost::math::cdf(boost::math::complement(law, z)),
            "square of their median over that of noise"};
  }

  const FitSpec& spec_;
  const Parameters& parameters_;
  const Coordinates& coordinates_;
  const Minimum& minimum_;
  const Estimate& estimate_;
  VectorXd values_;
  std::vector<std::string> texts_;
};

}  // namespace

std::vector<std::string> warnings(const Minimum& minimum, const Estimate& estimate) {
  return Writer(minimum, estimate)();
}

}  // namespace shearfront::fit
