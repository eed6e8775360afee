// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/timeline_derivatives.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

namespace shearfront {
namespace {

using Numbers = TimelineDerivatives::Numbers;

/// The solution at the height of an event, which moves, on one side of it; its derivatives by time and by the entries.
struct EventSide {
  double phi = 0, M = 0, H = 0, phi_by_time = 0;
  Numbers M_by;    ///< along with the height
  Numbers phi_by;  ///< at a height that stays

  void add(double factor, const EventSide& other) {
    phi += factor * other.phi;
    M += factor * other.M;
    H += factor * other.H;
    phi_by_time += factor * other.phi_by_time;
    M_by.resize(other.M_by.size(), 0.0);
    phi_by.resize(other.phi_by.size(), 0.0);
    for (std::size_t i = 0; i < M_by.size(); ++i) M_by[i] += factor * other.M_by[i];
    for (std::size_t i = 0; i < phi_by.size(); ++i) phi_by[i] += factor * other.phi_by[i];
  }
};

/// A height and its derivatives.
struct EventHeight {
  double z;
  Numbers by;
};

class EventDerivatives {
  static constexpr double kApart = 1e-5;  ///< of the time, the three at which a side is taken

 public:
  explicit EventDerivatives(const ExactSolution<double>& solution)
      : solution_(solution), derivatives_(solution), scene_(solution.scene()) {}

  TimelineDerivatives all(const Timeline<double>& times) const {
    TimelineDerivatives all;
    all.t0 = at_wall(times.t0, false);
    all.t1 = at_wall(times.t1, true);
    all.t_star = last_change(times.t_star, {solution_.steady_height(), by_steady_height()});
    for (std::size_t i = 0; i < times.interfaces.size(); ++i) {
      const auto& at = times.interfaces[i];
      const EventHeight height{at.z, derivatives_.boundary(i + 1)};
      Numbers first = first_change(at.first, height);
      Numbers last = at.last && at.last == at.first ? first : last_change(at.last, height);
      all.interfaces.push_back({std::move(first), std::move(last)});
    }
    return all;
  }

 private:
  using Path = exact::Path<double>;
  using At = Derivatives<double>::At;

  /// The side as the limit of three times at `sign` of the event; pick(t) chooses the path. Empty if they are of several families.
  template <class Pick>
  std::optional<EventSide> limit(double t, const EventHeight& height, double sign, const Pick& pick) const {
    constexpr std::array<double, 3> kWeights{3, -3, 1};  // a parabola through 1, 2, 3 at 0
    for (double apart = kApart; apart > 1e-8; apart /= 10) {
      EventSide side;
      std::optional<Path> nearest;
      bool is_one_family = true;
      for (std::size_t k = 0; k < kWeights.size() && is_one_family; ++k) {
        const double time = t * (1 + sign * apart * static_cast<double>(k + 1));
        const Path path = pick(time);
        is_one_family = path.kind != exact::PathKind::none && (!nearest || is_same_family(path, *nearest));
        if (!is_one_family) break;
        nearest = path;
        At at;
        derivatives_.along(path, height.z, time, at);
        side.add(kWeights[k], side_of(at, time, height));
      }
      if (is_one_family) return side;
    }
    return std::nullopt;
  }
  std::optional<EventSide> limit(double t, const EventHeight& height, double sign) const {
    return limit(t, height, sign, [&](double time) { return solution_.path(height.z, time); });
  }
  [[nodiscard]] bool is_same_family(const Path& a, const Path& b) const {
    const auto& cells = solution_.medium().cells();
    const auto is_inside_curved = [&](const Path& path) {
      return (path.kind == exact::PathKind::constant || path.is_state) && cells.is_curved(path.source);
    };
    const bool is_same_source = a.source == b.source || (is_inside_curved(a) && is_inside_curved(b));
    return a.kind == b.kind && a.upward == b.upward && a.turned == b.turned && a.is_state == b.is_state &&
           a.interface == b.interface && is_same_source;
  }
  [[nodiscard]] EventSide side_of(const At& at, double t, const EventHeight& height) const {
    EventSide side{at.value.phi, at.value.M, at.value.H, 0, at.M, at.phi};
    for (std::size_t i = 0; i < side.M_by.size(); ++i) side.M_by[i] += side.phi * height.by[i];
    if (std::isfinite(t)) side.phi_by_time = at.phi[derivatives_.scale_entry()] * scene_.scale() / t;
    return side;
  }
  /// What stays for ever.
  [[nodiscard]] EventSide end_at(const EventHeight& height) const {
    At at;
    derivatives_.at(height.z, infinity<double>(), at);
    at.value.H = 0;
    at.phi.assign(at.phi.size(), 0.0);
    return side_of(at, infinity<double>(), height);
  }

  [[nodiscard]] Numbers not_moved() const { return Numbers(derivatives_.n_entries(), 0.0); }
  /// A little above or below.
  [[nodiscard]] EventHeight beside(const EventHeight& height, double sign) const {
    const double tiny =
        1e-14 * std::max({scene_.top() - scene_.bottom(), std::abs(scene_.top()), std::abs(scene_.bottom())});
    return {std::clamp(height.z + sign * tiny, scene_.bottom(), scene_.top()), height.by};
  }
  /// phi jumps from one pure state to the other there, and the amount below is the mass.
  [[nodiscard]] Numbers by_steady_height() const {
    const EventHeight top{scene_.top(), not_moved()}, steady{solution_.steady_height(), not_moved()};
    Numbers by = end_at(top).M_by;
    const double jump = end_at(beside(steady, 1)).phi - end_at(beside(steady, -1)).phi;
    if (!(std::abs(jump) > 0)) return not_moved();
    for (double& x : by) x /= -jump;
    return by;
  }

  [[nodiscard]] Numbers at_wall(const std::optional<double>& t, bool is_top) const {
    if (!t || !std::isfinite(*t)) return {};
    if (*t == 0) return not_moved();
    const exact::Medium<double>& medium = solution_.medium();
    const EventHeight wall{is_top ? scene_.top() : scene_.bottom(), not_moved()};
    const auto after = limit(*t, wall, 1, [&](double time) {
      return medium.best_free(is_top ? medium.top() : medium.bottom(), time, infinity<double>());
    });
    if (!after) return {};
    EventSide before = end_at(wall);
    before.phi = solution_.phi(wall.z, 0);
    return time_of(*t, before, *after, wall);
  }
  /// On both sides of an interface: there may be one on which nothing changes. A path that does not cross the interface
  /// on its way to the height does not mind how it moves.
  [[nodiscard]] Numbers first_change(const std::optional<double>& t, const EventHeight& height) const {
    if (!t || !std::isfinite(*t)) return {};
    if (*t == 0) return not_moved();
    for (const double sign : {1, -1}) {
      const EventHeight at = beside(height, sign);
      const auto before = limit(*t, at, -1), after = limit(*t, at, 1);
      if (!before || !after) return {};
      if (Numbers by = time_of(*t, *before, *after, at); !by.empty()) return by;
    }
    return {};
  }
  [[nodiscard]] Numbers last_change(const std::optional<double>& t, const EventHeight& height) const {
    if (!t || !std::isfinite(*t)) return {};
    if (*t == 0) return not_moved();
    for (const double sign : {1, -1}) {
      const EventHeight at = beside(height, sign);
      const auto before = limit(*t, at, -1);
      if (!before) return {};
      if (Numbers by = time_of(*t, *before, end_at(at), at); !by.empty()) return by;
    }
    return {};
  }

  /// None if nothing happens at the height, or not at this time.
  [[nodiscard]] Numbers time_of(double t, const EventSide& before, const EventSide& after,
                                const EventHeight& height) const {
    constexpr double kSame = 1e-8;
    Numbers by(height.by.size());
    if (std::abs(after.phi - before.phi) > kSame) {
      const double flux = after.H - before.H, size = std::max(std::abs(after.H), std::abs(before.H)),
                   bed = scene_.top() - scene_.bottom();
      if (!(std::abs(flux) > kSame * size) || !(std::abs(after.M - before.M) <= kSame * bed)) return {};
      for (std::size_t i = 0; i < by.size(); ++i) by[i] = -(after.M_by[i] - before.M_by[i]) / flux;
      return by;
    }
    const double rise = after.phi_by_time - before.phi_by_time;
    if (!(std::abs(rise) * t > kSame)) return {};
    const double solid = scene_.solid_fraction_at(height.z);
    const double speed =
        scene_.scale() * scene_.rate_at(height.z) * scene_.flux_at(height.z).derivative(after.phi / solid);
    for (std::size_t i = 0; i < by.size(); ++i) {
      by[i] = -(after.phi_by[i] - before.phi_by[i]) / rise;
      if (height.by[i] != 0) by[i] += height.by[i] / speed;
    }
    return by;
  }

  const ExactSolution<double>& solution_;
  Derivatives<double> derivatives_;
  const Scene<double>& scene_;
};

}  // namespace

TimelineDerivatives timeline_derivatives(const ExactSolution<double>& solution,
                                         const Timeline<double>& times) {
  return EventDerivatives(solution).all(times);
}

}  // namespace shearfront
