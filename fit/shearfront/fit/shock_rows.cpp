// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/shock_rows.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/fit/forward.hpp"
#include "shearfront/fit/residual_rows.hpp"

namespace shearfront::fit {
namespace {

constexpr double kJump = 0.005;  ///< of the width of the range of states
constexpr std::size_t kParts = 16;
/// A jump changes phi within two parts by so many times what two ordinary parts do.
constexpr double kSteeper = 5;

struct Neighbourhood {
  std::size_t row = 0;
  double t = 0, low = 0, high = 0;
};

std::vector<Neighbourhood> neighbourhoods(const Observations& observations, double bottom, double top) {
  std::vector<Neighbourhood> all;
  for (const MeasuredProfile& profile : measured_profiles(observations)) {
    const std::size_t n = profile.rows.size();
    const auto z = [&](std::size_t j) { return observations.rows[profile.rows[j]].z; };
    for (std::size_t j = 0; n > 1 && j < n; ++j) {
      const double below = j > 0 ? (z(j) - z(j - 1)) / 2 : (z(1) - z(0)) / 2;
      const double above = j + 1 < n ? (z(j + 1) - z(j)) / 2 : (z(n - 1) - z(n - 2)) / 2;
      all.push_back(
          {profile.rows[j], profile.t, std::max(bottom, z(j) - below), std::min(top, z(j) + above)});
    }
  }
  return all;
}

/// Values at the ends of equal parts of an interval.
bool has_jump(const Eigen::VectorXd& phi, double least) {
  std::vector<double> changes;  // over two parts: a grid spreads a jump over an edge
  for (Eigen::Index part = 2; part < phi.size(); ++part)
    changes.push_back(std::abs(phi[part] - phi[part - 2]));
  const double most = *std::max_element(changes.begin(), changes.end());
  const auto middle = changes.begin() + static_cast<std::ptrdiff_t>(changes.size() / 2);
  std::nth_element(changes.begin(), middle, changes.end());
  return most > least && most > kSteeper * *middle;
}

}  // namespace

std::vector<bool> rows_without_jumps(const Parameters& parameters, const ForwardSpec& forward,
                                     const Observations& observations, const Eigen::VectorXd& values,
                                     const shearfront::Progress& progress) {
  std::vector<bool> keep(observations.rows.size(), true);
  const auto near = neighbourhoods(observations, parameters.scene().bottom(), parameters.scene().top());
  std::vector<Place> ends;
  for (const Neighbourhood& here : near) {
    ends.push_back({here.t, here.low});
    ends.push_back({here.t, here.high});
  }
  if (ends.empty()) return keep;
  const double jump = kJump * parameters.states();
  const Prediction at_ends =
      Forward(parameters, forward, Observable::phi, ends).predict(values, false, progress);
  if (!at_ends.is_valid()) return keep;
  std::vector<Neighbourhood> steep;
  std::vector<Place> inside;
  for (std::size_t i = 0; i < near.size(); ++i) {
    const auto k = static_cast<Eigen::Index>(2 * i);
    if (!(std::abs(at_ends.values[k + 1] - at_ends.values[k]) > jump)) continue;
    steep.push_back(near[i]);
    for (std::size_t part = 0; part <= kParts; ++part)
      inside.push_back(
          {near[i].t, near[i].low + (near[i].high - near[i].low) * static_cast<double>(part) / kParts});
  }
  if (inside.empty()) return keep;
  const Prediction at =
      Forward(parameters, forward, Observable::phi, inside).predict(values, false, progress);
  if (!at.is_valid()) return keep;
  for (std::size_t i = 0; i < steep.size(); ++i) {
    keep[steep[i].row] =
        !has_jump(at.values.segment(static_cast<Eigen::Index>(i * (kParts + 1)), kParts + 1), jump);
  }
  return keep;
}

}  // namespace shearfront::fit
