// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/track/smooth_start.hpp"

namespace shearfront {

/// The entries of a scene that are a state wanted of the grid, the height of an initial jump, or the time of a change outside: hundreds
/// in some scenes, and each moves little. By their numbers among entries(); found without the names of them all.
class StartEntries {
 public:
  StartEntries(const Scene<double>& scene, const InitialPieces<double>& initial) {
    const SceneSpec<double>& spec = scene.spec();
    const auto& breaks = spec.initial_breaks;
    std::vector<Entry> states(spec.initial_values.size()), jumps(breaks.size());
    for (std::size_t i = 0; i < initial.states.size(); ++i) {
      const double bottom = i == 0 ? spec.bottom : initial.tops[i - 1];
      const auto piece = std::upper_bound(breaks.begin(), breaks.end(), bottom) - breaks.begin();
      states[static_cast<std::size_t>(piece)].wanted.push_back(i);
      const auto jump = std::lower_bound(breaks.begin(), breaks.end(), initial.tops[i]);
      if (jump != breaks.end() && *jump == initial.tops[i])
        jumps[static_cast<std::size_t>(jump - breaks.begin())].top = i;
    }
    std::size_t n_wanted = initial.states.size(), n_times = 0;
    std::vector<double> times;
    for (const auto* outside : {&spec.outside_bottom, &spec.outside_top})
      if (*outside) times.insert(times.end(), (*outside)->breaks.begin(), (*outside)->breaks.end());
    // Where each time stands among all of them.
    std::vector<std::size_t> order(times.size()), rank(times.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return times[a] < times[b]; });
    for (std::size_t i = 0; i < order.size(); ++i) rank[order[i]] = i;

    const auto is = [](const auto& outside, const auto& member, auto part) {
      return outside && static_cast<const void*>(&((*outside).*part)) == static_cast<const void*>(&member);
    };
    visit_fields(spec, [&](const std::string&, const FieldInfo&, const auto& member) {
      if constexpr (std::is_same_v<std::remove_cvref_t<decltype(member)>, double>) {
        all_.emplace_back();
      } else {
        const auto of_outside = [&](auto part) {
          return is(spec.outside_bottom, member, part) || is(spec.outside_top, member, part);
        };
        const bool is_time = of_outside(&OutsideState<double>::breaks),
                   is_state = of_outside(&OutsideState<double>::values);
        for (std::size_t i = 0; i < member.size(); ++i) {
          Entry& entry = all_.emplace_back();
          if (&member == &spec.initial_values) entry = states[i];
          if (&member == &spec.initial_breaks) entry = jumps[i];
          if (is_state) entry.wanted = {n_wanted++};
          if (is_time) entry.change = rank[n_times++];
        }
      }
    });
  }

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  struct Entry {
    std::vector<std::size_t> wanted;  ///< states of TrackingSetup::wanted that it is
    std::size_t top = kNone,
                change = kNone;  ///< the initial piece whose top it is; the change of Ends::changes
    [[nodiscard]] bool is_any() const { return !wanted.empty() || top != kNone || change != kNone; }
  };
  [[nodiscard]] const Entry& operator[](std::size_t entry) const { return all_[entry]; }

 private:
  std::vector<Entry> all_;
};

}  // namespace shearfront
