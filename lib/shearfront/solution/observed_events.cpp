// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solution/observed_events.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "shearfront/numeric/contract.hpp"

namespace shearfront {
namespace {

using Quantity = std::vector<double>;  // one number per time

/// Where the line between two times passes the threshold.
double crossing(const ProfileSeries& series, const Quantity& q, std::size_t before, double threshold) {
  const double a = q[before], b = q[before + 1];
  const double part = a == b ? 0 : (threshold - a) / (b - a);
  return series.times[before] + part * (series.times[before + 1] - series.times[before]);
}

/// First time at which the quantity exceeds the threshold.
std::optional<double> first_above(const ProfileSeries& series, const Quantity& q, double threshold) {
  for (std::size_t i = 0; i < q.size(); ++i)
    if (q[i] > threshold) return i == 0 ? series.times[0] : crossing(series, q, i - 1, threshold);
  return std::nullopt;
}

/// Last time at which it does; nothing if it does at the end of the series, or never.
std::optional<double> last_above(const ProfileSeries& series, const Quantity& q, double threshold) {
  for (std::size_t i = q.size(); i-- > 0;)
    if (q[i] > threshold)
      return i + 1 == q.size() ? std::nullopt : std::optional(crossing(series, q, i, threshold));
  return std::nullopt;
}

double mean(const Profile<double>& profile, double low, double high) {
  return (profile.at(high).M - profile.at(low).M) / (high - low);
}

std::optional<double> earlier(const std::optional<double>& a, const std::optional<double>& b) {
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

}  // namespace

Timeline<double> observed_events(const Scene<double>& scene, const ProfileSeries& series) {
  SHEARFRONT_EXPECTS(!series.times.empty() && series.times.size() == series.profiles.size(),
                     "one profile per time");
  const Observer observer(scene, series);
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
    timeline.interfaces.push_back({z, earlier(observer.first(low, z), observer.first(z, high)), last});
  }
  return timeline;
}

}  // namespace shearfront
