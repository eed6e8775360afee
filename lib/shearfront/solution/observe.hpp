// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/observation.hpp"
#include "shearfront/solver/solve.hpp"

/// Synthetic observations: what an instrument would have read where a solver has computed.
///
///     const ObservationPlan plan{{0.5, 1}, {0.25, 0.75}, Quantity::cumulative, 0};
///     auto result = solve(scene, "exact", request_of(plan, scene));
///     auto observations = observe(plan, scene, result);
///     add_noise(observations, 0.01, 1);
namespace shearfront {

/// Where and what to observe: every time with every depth. The height of the bed has no depths.
struct ObservationPlan {
  std::vector<double> times, depths;
  Quantity quantity = Quantity::point;
  double width = 0;  ///< of every bin; 0 for the other quantities
};

/// What is wrong with a plan; empty if nothing is. Keys: times[i], depths[i], width. Times must be finite
/// and >= 0, depths inside the domain, neither twice, bins inside the domain (is_bin_inside()).
/// Cost: O(n log n) in the number of times and of depths.
[[nodiscard]] Complaints find_complaints(const ObservationPlan& plan, double bottom, double top);

/// The spacing of the depths, in whatever order, if it is the same everywhere up to the rounding of the
/// depths; nothing otherwise and for fewer than two depths. Of the numbers that rounding leaves possible it
/// is the one with the fewest digits: 0.1 for 0.05, 0.15, ..., 0.95.
[[nodiscard]] std::optional<double> equal_spacing(std::vector<double> depths);

/// What a solver has to compute: the depths of the plan, for bins their edges; the integral of
/// BedHeight(scene) for heights of the bed.
/// Errors: InputError with find_complaints(). Precondition: BedHeight::refusal(scene) is empty if the quantity
/// is the height of the bed.
[[nodiscard]] SolverRequest request_of(const ObservationPlan& plan, const Scene<double>& scene);

/// The result of request_of() as observations, one row per time and depth, depths running fastest, without
/// noise and without sigma:
///
///     point        phi(z, t)
///     cumulative   M(z, t)
///     bin          (M(z + w/2, t) - M(z - w/2, t)) / w, as exact as M is up to a rounding of about eps top / w
///     bed height   H(t)
///
/// In a steady chute, where M is what passes below z, a bin takes Field::volumes in place of M.
/// Precondition: the result is a usable one of request_of(plan, scene).
[[nodiscard]] Observations observe(const ObservationPlan& plan, const Scene<double>& scene,
                                   const SolverResult& result);

/// The seed of an independent stream of random numbers: h(h(seed) + replicate), where h(x) is the output of
/// Splitmix64 in state x (Steele, Lea & Flood 2014). h is a bijection, so two replicates of one seed never
/// have the same stream.
[[nodiscard]] std::uint64_t stream_seed(std::uint64_t seed, std::uint64_t replicate);

/// Adds sigma times independent standard normal numbers to the values, in the order of the rows, and sets
/// sigma in every row. Two calls with the same arguments give the same bits. The numbers come from
/// Boost.Random (mt19937_64 seeded with stream_seed(seed, replicate), normal_distribution) and not from the
/// standard library, whose distributions differ between implementations. sigma = 0 changes nothing.
/// Precondition: sigma >= 0, finite. Cost: about 10 ns per row.
void add_noise(Observations& observations, double sigma, std::uint64_t seed, std::uint64_t replicate = 0);

/// Clips every value to what the quantity can be: phi to the range of the flux [lo, hi], usually [0, 1], and
/// M to what the bed below z can hold; heights of the bed are left alone. The noise is then no longer normal
/// where it would have led outside: it has a mean towards the inside and a standard deviation below sigma,
/// which is left as it is.
void clip(Observations& observations, const Scene<double>& scene);

}  // namespace shearfront
