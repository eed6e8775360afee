// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/observe.hpp"

#include <algorithm>
#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <variant>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solution/bed_height.hpp"

namespace shearfront {
namespace {

/// Depths that were meant to be equally spaced are off by 4 u |z| at most, u = eps/2: one u each for both
/// ends of the range, for the step and for the sum. A difference of two is then off by 5 eps |z| at most,
/// with the rounding of the difference itself, and so is the mean spacing it is compared with.
constexpr double kSpacingRounding = 10 * std::numeric_limits<double>::epsilon();

std::string element(std::string_view key, std::size_t i) {
  return std::string(key) + "[" + std::to_string(i) + "]";
}

/// The number with the fewest digits that differs from x by at most `rounding`.
double shortest_near(double x, double rounding) {
  for (int digits = 1; digits < std::numeric_limits<double>::max_digits10; ++digits) {
    const double y = read_number(number_text(x, digits)).value;
    if (std::abs(y - x) <= rounding) return y;
  }
  return x;
}

/// Every number that has occurred before, at its later place.
void find_repeated(std::string_view key, const std::vector<double>& xs, Complaints& complaints) {
  std::vector<std::size_t> order(xs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return xs[a] < xs[b]; });
  for (std::size_t i = 1; i < order.size(); ++i)
    if (xs[order[i]] == xs[order[i - 1]])
      complaints.push_back({element(key, order[i]), number_text(xs[order[i]]), "must not be given twice"});
}

std::uint64_t splitmix64(std::uint64_t state) {
  std::uint64_t z = state + 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31);
}

}  // namespace

Complaints find_complaints(const ObservationPlan& plan, double bottom, double top) {
  Complaints complaints;
  const auto add = [&](std::string key, double x, std::string constraint) {
    complaints.push_back({std::move(key), number_text(x), std::move(constraint)});
  };
  const std::string domain = "inside the domain [" + number_text(bottom) + ", " + number_text(top) + "]";
  for (std::size_t i = 0; i < plan.times.size(); ++i)
    if (!(plan.times[i] >= 0) || !std::isfinite(plan.times[i]))
      add(element("times", i), plan.times[i], "must be a finite number >= 0");
  if (plan.quantity == Quantity::bed_height && !plan.depths.empty())
    add("depths", plan.depths[0], "must not be given: the height of the bed has no depth");
  const bool is_bin = plan.quantity == Quantity::bin;
  const bool is_width_good = is_bin ? plan.width > 0 && std::isfinite(plan.width) : plan.width == 0;
  for (std::size_t i = 0; i < plan.depths.size(); ++i) {
    const double z = plan.depths[i];
    if (!(z >= bottom && z <= top))
      add(element("depths", i), z, "must be " + domain);
    else if (is_bin && is_width_good && !is_bin_inside(z, plan.width, bottom, top))
      add(element("depths", i), z, "must leave its bin of width " + number_text(plan.width) + " " + domain);
  }
  if (!complaints.empty()) return complaints;
  const auto is_too_narrow = [&](double z) { return !is_bin_resolved(z, plan.width); };
  if (is_bin && is_width_good && std::any_of(plan.depths.begin(), plan.depths.end(), is_too_narrow))
    add("width", plan.width, "must be at least " + number_text(kLeastBinWidth) + " of every depth");
  if (!is_width_good) add("width", plan.width, is_bin ? "must be > 0" : "must be 0 unless bins are observed");
  find_repeated("times", plan.times, complaints);
  find_repeated("depths", plan.depths, complaints);
  return complaints;
}

std::optional<double> equal_spacing(std::vector<double> depths) {
  if (depths.size() < 2) return std::nullopt;
  std::sort(depths.begin(), depths.end());
  const double n = static_cast<double>(depths.size() - 1), spacing = (depths.back() - depths.front()) / n;
  const double rounding = kSpacingRounding * std::max(std::abs(depths.front()), std::abs(depths.back()));
  for (std::size_t i = 1; i < depths.size(); ++i)
    if (!(std::abs(depths[i] - depths[i - 1] - spacing) <= rounding)) return std::nullopt;
  if (!(spacing > 0)) return std::nullopt;
  return shortest_near(spacing, rounding / n);
}

SolverRequest request_of(const ObservationPlan& plan, const Scene<double>& scene) {
  if (Complaints complaints = find_complaints(plan, scene.bottom(), scene.top()); !complaints.empty())
    throw InputError(std::move(complaints));
  SolverRequest request;
  request.times = plan.times;
  if (plan.quantity == Quantity::bed_height) {
    request.integrand = BedHeight(scene).integrand();
    return request;
  }
  if (plan.quantity != Quantity::bin) {
    request.heights = plan.depths;
    return request;
  }
  request.volumes = scene.is_chute();
  for (const double z : plan.depths) {
    const BinEdges edges = bin_edges(z, plan.width, scene.bottom(), scene.top());
    request.heights.push_back(edges.below);
    request.heights.push_back(edges.above);
  }
  return request;
}

/// Heights of the bed, one per time.
static Observations observed_heights(const ObservationPlan& plan, const Scene<double>& scene,
                                     const std::vector<double>& integrals) {
  SHEARFRONT_EXPECTS(integrals.size() == plan.times.size(), "integrals of request_of()");
  Observations observations;
  observations.quantity = Quantity::bed_height;
  const BedHeight bed(scene);
  for (std::size_t i = 0; i < integrals.size(); ++i)
    observations.rows.push_back({plan.times[i], 0, bed.height(integrals[i])});
  return observations;
}

Observations observe(const ObservationPlan& plan, const Scene<double>& scene, const SolverResult& result) {
  if (plan.quantity == Quantity::bed_height) return observed_heights(plan, scene, result.integrals);
  const std::vector<Sample>& samples = result.samples;
  const bool is_bin = plan.quantity == Quantity::bin;
  SHEARFRONT_EXPECTS(samples.size() == plan.times.size() * plan.depths.size() * (is_bin ? 2 : 1),
                     "samples of request_of()");
  Observations observations;
  observations.quantity = plan.quantity;
  observations.units.is_chute = scene.is_chute();
  observations.rows.reserve(plan.times.size() * plan.depths.size());
  const auto volume_below = [&](std::size_t i) {
    return result.volumes.empty() ? samples[i].M : result.volumes[i];
  };
  std::size_t next = 0;
  for (const double t : plan.times) {
    for (const double z : plan.depths) {
      Observation o{t, z, 0, plan.width};
      if (is_bin) {
        o.value = (volume_below(next + 1) - volume_below(next)) /
                  bin_edges(z, plan.width, scene.bottom(), scene.top()).width();
        next += 2;
      } else {
        o.value = plan.quantity == Quantity::cumulative ? samples[next].M : samples[next].phi;
        ++next;
      }
      observations.rows.push_back(o);
    }
  }
  return observations;
}

std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t replicate) {
  return splitmix64(splitmix64(seed) + replicate);
}

void add_noise(Observations& observations, double sigma, std::uint64_t seed, std::uint64_t replicate) {
  SHEARFRONT_EXPECTS(sigma >= 0 && std::isfinite(sigma), "a standard deviation");
  if (sigma == 0) return;
  boost::random::mt19937_64 engine(stream_seed(seed, replicate));
  boost::random::normal_distribution<double> normal;
  for (Observation& o : observations.rows) {
    o.value += sigma * normal(engine);
    o.sigma = sigma;
  }
}

void clip(Observations& observations, const Scene<double>& scene) {
  if (observations.quantity == Quantity::bed_height) return;
  for (Observation& o : observations.rows) {
    const StateRange<double> range = observations.quantity == Quantity::cumulative
                                         ? StateRange<double>{scene.amount(scene.bottom(), o.z, false),
                                                              scene.amount(scene.bottom(), o.z, true)}
                                         : scene.range_at(o.z);
    o.value = std::clamp(o.value, range.lowest, range.highest);
  }
}

}  // namespace shearfront
