// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "shearfront/numeric/contract.hpp"
#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"
#include "shearfront/solution/timeline.hpp"

namespace shearfront::support {

/// Profiles of one solution at ascending times, for example of a grid method that knows no events.
struct ProfileSeries {
  std::vector<double> times;
  std::vector<Profile<double>> profiles;
};

namespace observed_detail {

using Quantity = std::vector<double>;  // one number per time

/// Where the line between two times passes the threshold.
inline double crossing(const ProfileSeries& series, const Quantity& q, std::size_t before, double threshold) {
  const double a = q[before], b = q[before + 1];
  const double part = a == b ? 0 : (threshold - a) / (b - a);
  return series.times[before] + part * (series.times[before + 1] - series.times[before]);
}

/// First time at which the quantity exceeds the threshold.
inline std::optional<double> first_above(const ProfileSeries& series, const Quantity& q, double threshold) {
  for (std::size_t i = 0; i < q.size(); ++i)
    if (q[i] > threshold) return i == 0 ? series.times[0] : crossing(series, q, i - 1, threshold);
  return std::nullopt;
}

/// Last time at which it does; nothing if it does at the end of the series, or never.
inline std::optional<double> last_above(const ProfileSeries& series, const Quantity& q, double threshold) {
  for (std::size_t i = q.size(); i-- > 0;)
    if (q[i] > threshold)
      return i + 1 == q.size() ? std::nullopt : std::optional(crossing(series, q, i, threshold));
  return std::nullopt;
}

inline double mean(const Profile<double>& profile, double low, double high) {
  return (profile.at(high).M - profile.at(low).M) / (high - low);
}

inline std::optional<double> earlier(const std::optional<double>& a, const std::optional<double>& b) {
  if (a && b) return std::min(*a, *b);
  return a ? a : b;
}

class Observer {
 public:
  Observer(const Scene<double>& scene, const ProfileSeries& series)
      : scene_(scene), series_(series), steady_(scene.bottom() + scene.mass()) {
    height_ = scene.top() - scene.bottom();
    width_ = height_ / static_cast<double>(series.profiles.front().n_cells());
    threshold_ = std::sqrt(width_ / height_);
  }

  [[nodiscard]] double width() const { return width_; }

  /// First time at which the mean over [low, high] leaves its initial value.
  [[nodiscard]] std::optional<double> first(double low, double high) const {
    const double start = initial_mean(low, high);
    return first_above(series_, distance(low, high, start), threshold_);
  }
  /// Last time at which it is not its final value, and whether it is still on its way at the end.
  [[nodiscard]] std::optional<double> last(double low, double high, bool& is_open) const {
    const double end = std::clamp((steady_ - low) / (high - low), 0.0, 1.0);
    const Quantity q = distance(low, high, end);
    is_open = is_open || q.back() > threshold_;
    return last_above(series_, q, threshold_);
  }

  [[nodiscard]] std::optional<double> steady_time() const {
    Quantity q;
    for (const Profile<double>& p : series_.profiles) {
      const double end = std::clamp(steady_, scene_.bottom(), scene_.top());
      const Profile<double> final({scene_.bottom(), end, scene_.top()}, {1, 0}, {1, 0});
      q.push_back(l1_distance(p, final));
    }
    if (q.front() <= width_ && *std::max_element(q.begin(), q.end()) <= width_) return 0.0;
    return last_above(series_, q, width_);
  }

 private:
  [[nodiscard]] double initial_mean(double low, double high) const {
    double sum = 0, begin = low;
    for (const double z : scene_.initial_breaks()) {
      if (z <= low || z >= high) continue;
      sum += (z - begin) * scene_.initial_phi(begin);
      begin = z;
    }
    return (sum + (high - begin) * scene_.initial_phi(begin)) / (high - low);
  }
  [[nodiscard]] Quantity distance(double low, double high, double from) const {
    Quantity q;
    for (const Profile<double>& p : series_.profiles) q.push_back(std::abs(mean(p, low, high) - from));
    return q;
  }

  const Scene<double>& scene_;
  const ProfileSeries& series_;
  double steady_, height_ = 0, width_ = 0, threshold_ = 0;
};

}  // namespace observed_detail

/// The event times of a scene as they can be seen in profiles (meaning of each: solution/timeline.hpp).
///
/// With h = (top - bottom) / cells of the profile, the width of a mean cell, and the mean of phi over the
/// width h next to a wall, or on either side of an interface, called the state there:
///
///   t0, t1, first  the state (of either side) has left its initial value by more than the threshold
///                  theta = sqrt(h / (top - bottom)) for the first time;
///   last           the state (of either side) differs from its final value by more than theta for the last
///                  time;
///   t_star         int |phi - steady phi| dz exceeds the content h of one cell for the last time.
///
/// Why this converges: behind the edge of a fan phi changes at a finite rate, so theta costs a delay of order
/// theta; a monotone scheme sends a foot ahead of the edge whose height is of order sqrt(h) as well (the
/// smoothed kink); a shock is a few h wide and passes theta within O(h) of time. Times of fans are thus of
/// order 1/2 in h, those of shocks and t_star of order 1 (up to a logarithm). 0 if the initial state at a
/// wall or interface is not at rest there (the state leaves at once), up to the same error. Between two times
/// of the series the quantity is interpolated linearly; what comes and goes between two is not seen. Empty: a
/// first that does not happen in the series; a last, or t_star, that may lie behind its end or does not
/// happen. Cost: O(times * cells).
[[nodiscard]] inline Timeline<double> observed_events(const Scene<double>& scene,
                                                      const ProfileSeries& series) {
  SHEARFRONT_EXPECTS(!series.times.empty() && series.times.size() == series.profiles.size(),
                     "one profile per time");
  const observed_detail::Observer observer(scene, series);
  const double h = observer.width();
  Timeline<double> timeline;
  timeline.mass = scene.mass();
  timeline.steady_height = scene.bottom() + timeline.mass;
  timeline.t0 = observer.first(scene.bottom(), scene.bottom() + h);
  timeline.t1 = observer.first(scene.top() - h, scene.top());
  timeline.t_star = observer.steady_time();
  if (!scene.is_layered()) return timeline;
  for (const double z : scene.knots()) {
    if (!(z > scene.bottom() && z < scene.top())) continue;
    const double low = std::max(scene.bottom(), z - h), high = std::min(scene.top(), z + h);
    bool is_open = false;
    const auto last_below = observer.last(low, z, is_open), last_above = observer.last(z, high, is_open);
    std::optional<double> last;
    if (last_below || last_above) last = std::max(last_below.value_or(0.0), last_above.value_or(0.0));
    if (is_open) last.reset();
    timeline.interfaces.push_back(
        {z, observed_detail::earlier(observer.first(low, z), observer.first(z, high)), last});
  }
  return timeline;
}

}  // namespace shearfront::support
