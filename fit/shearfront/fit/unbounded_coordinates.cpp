// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/unbounded_coordinates.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>

namespace shearfront::fit {

using Eigen::Index;
using Eigen::VectorXd;

namespace {

/// Of the room, by which what is at an end is moved inside.
constexpr double kInside = 1e-6;
/// exp of more is beyond the largest number.
constexpr double kLargest = 700;

/// 1 / (1 + exp(-x)); 0 below -745.
double logistic(double x) { return x < 0 ? std::exp(x) / (1 + std::exp(x)) : 1 / (1 + std::exp(-x)); }

/// One unknown at its coordinate.
struct Placed {
  double p = 0;
  double slope = 1;   ///< dp/dx
  double bend = 0;    ///< d log|slope| / dx
  double by_low = 0;  ///< dp / d low
};

Placed place_between(double low, double high, double x) {
  const double share = logistic(x), rest = logistic(-x), width = high - low;
  const double p = share < rest ? low + width * share : high - width * rest;
  return {p, width * share * rest, rest - share, rest};
}

Placed place_between_logs(double low, double high, double x) {
  const double share = logistic(x), rest = logistic(-x), width = std::log(high / low);
  const double p = share < rest ? low * std::exp(width * share) : high * std::exp(-width * rest);
  return {p, width * share * rest * p, rest - share + width * share * rest, 0};
}

Placed placed(double low, double high, bool is_log, double x) {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (has_low && has_high) return is_log ? place_between_logs(low, high, x) : place_between(low, high, x);
  if (!has_low && !has_high) return {x, 1, 0, 0};
  const double distance = std::exp(std::min(x, kLargest));
  return has_low ? Placed{low + distance, distance, 1, 1} : Placed{high - distance, -distance, 1, 0};
}

/// The coordinate that places p there, or as near as it may be to an end.
double coordinate_of(double p, double low, double high, bool is_log) {
  const bool has_low = std::isfinite(low), has_high = std::isfinite(high);
  if (!has_low && !has_high) return p;
  if (!has_low || !has_high) {
    const double end = has_low ? low : high, least = kInside * std::max(std::abs(end), std::abs(p));
    return std::log(std::max(has_low ? p - low : high - p, least > 0 ? least : kInside));
  }
  const double most = std::log((1 - kInside) / kInside);
  if (!(p > low)) return -most;
  if (!(p < high)) return most;
  const double x =
      is_log ? std::log(std::log(p / low) / std::log(high / p)) : std::log((p - low) / (high - p));
  return std::clamp(x, -most, most);
}

}  // namespace

UnboundedCoordinates::UnboundedCoordinates(const std::vector<Entry>& entries, VectorXd lower, VectorXd upper,
                                           Shape shape)
    : lower_(std::move(lower)), upper_(std::move(upper)), floor_(entries.size()), order_(entries.size()) {
  std::iota(order_.begin(), order_.end(), Index{0});
  order_elements(entries, shape);
}

void UnboundedCoordinates::order_elements(const std::vector<Entry>& entries, Shape shape) {
  std::map<std::string, std::map<std::size_t, Index>> arrays;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (entries[i].is_element) arrays[entries[i].field][entries[i].index] = static_cast<Index>(i);
  for (const auto& [field, elements] : arrays) {
    const bool is_shaped = field == "shear_rate.values" && shape != Shape::none;
    if (!is_shaped && !field.ends_with("breaks")) continue;
    std::vector<Index> chain;
    for (const auto& [index, i] : elements) chain.push_back(i);
    std::vector<Index> places = chain;
    std::sort(places.begin(), places.end());
    if (is_shaped) std::reverse(chain.begin(), chain.end());  // from the top, where they are smallest
    for (std::size_t k = 0; k < chain.size(); ++k) {
      order_[static_cast<std::size_t>(places[k])] = chain[k];
      std::vector<Term>& floor = floor_[static_cast<std::size_t>(chain[k])];
      if (is_shaped && shape == Shape::convex && k > 1)
        floor = {{chain[k - 1], 2}, {chain[k - 2], -1}};
      else if (k > 0)
        floor = {{chain[k - 1], 1}};
    }
  }
}

UnboundedCoordinates::Room UnboundedCoordinates::room(Index i, const VectorXd& p) const {
  Room room{lower_[i], upper_[i]};
  const std::vector<Term>& floor = floor_[static_cast<std::size_t>(i)];
  if (floor.empty()) {
    room.is_log = room.low > 0 && std::isfinite(room.high) && room.high > kWide * room.low;
    return room;
  }
  double low = 0;
  for (const Term& term : floor) low += term.coefficient * p[term.unknown];
  room.follows = low > room.low;
  if (room.follows) room.low = low;
  return room;
}

std::optional<UnboundedCoordinates::Point> UnboundedCoordinates::at(const VectorXd& x) const {
  if (!x.allFinite()) return std::nullopt;
  const Index n = size();
  Point point{VectorXd::Zero(n), Eigen::MatrixXd::Zero(n, n), 0, VectorXd::Zero(n)};
  for (const Index i : order_) {
    const Room room = this->room(i, point.p);
    if (!(room.low < room.high)) return std::nullopt;
    const Placed at = placed(room.low, room.high, room.is_log, x[i]);
    if (at.slope == 0 || !std::isfinite(at.p)) return std::nullopt;
    point.p[i] = at.p;
    point.derivative(i, i) = at.slope;
    point.log_volume += std::log(std::abs(at.slope));
    point.slope[i] += at.bend;
    if (!room.follows) continue;
    Eigen::RowVectorXd by_others = Eigen::RowVectorXd::Zero(n);  // d low / dx
    for (const Term& term : floor_[static_cast<std::size_t>(i)])
      by_others += term.coefficient * point.derivative.row(term.unknown);
    point.derivative.row(i) += at.by_low * by_others;
    if (std::isfinite(room.high)) point.slope -= by_others.transpose() / (room.high - room.low);
  }
  return point;
}

VectorXd UnboundedCoordinates::coordinates(VectorXd p) const {
  VectorXd x(p.size());
  for (const Index i : order_) {
    const Room room = this->room(i, p);
    x[i] = coordinate_of(p[i], room.low, room.high, room.is_log);
    p[i] = placed(room.low, room.high, room.is_log, x[i]).p;
  }
  return x;
}

bool UnboundedCoordinates::contains(const VectorXd& p) const {
  for (Index i = 0; i < p.size(); ++i) {
    const Room room = this->room(i, p);
    if (!(p[i] >= room.low && p[i] <= room.high)) return false;
  }
  return true;
}

}  // namespace shearfront::fit
