// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solution/summary.hpp"

namespace shearfront::soak {

/// What the laws found on one trial or on many: counts, and the violations in words.
class Findings {
 public:
  static constexpr std::size_t kMostTexts = 4;  ///< kept of each law

  std::uint64_t n_scenes = 0, n_runs = 0, n_collisions = 0, n_cell_updates = 0, n_checked = 0,
                n_violations = 0;
  /// Runs that ended at a limit of work: their later laws were not checked.
  std::uint64_t n_cut_short = 0;

  /// `where` is called only if the law does not hold.
  template <class Where>
  void expect(bool holds, const std::string& law, Where&& where) {
    ++n_checked;
    if (!holds) complain(law, where());
  }
  /// lo - slack <= x <= hi + slack.
  template <class Where>
  void expect_between(double x, double lo, double hi, double slack, const std::string& law, Where&& where) {
    expect(x >= lo - slack && x <= hi + slack, law, [&] {
      const double excess = x < lo ? lo - x : x - hi;
      return number_text(x) + " not in [" + number_text(lo) + ", " + number_text(hi) + "], by " +
             number_text(excess) + " (slack " + number_text(slack) + "), " + where();
    });
  }
  template <class Where>
  void expect_near(double x, double y, double slack, const std::string& law, Where&& where) {
    expect_between(x, y, y, slack, law, std::forward<Where>(where));
  }

  void complain(const std::string& law, const std::string& where) {
    ++n_violations;
    std::vector<std::string>& texts = violations_[law];
    if (texts.size() < kMostTexts) texts.push_back(where);
  }

  void count(const Summary& summary) {
    ++n_runs;
    n_collisions += summary.collisions;
    n_cell_updates += summary.cell_updates;
    n_cut_short += summary.status == Status::budget_reached || summary.status == Status::interrupted ? 1 : 0;
  }

  void add(const Findings& other) {
    n_scenes += other.n_scenes;
    n_runs += other.n_runs;
    n_collisions += other.n_collisions;
    n_cell_updates += other.n_cell_updates;
    n_checked += other.n_checked;
    n_violations += other.n_violations;
    n_cut_short += other.n_cut_short;
  }

  /// By law: the first few places where it was violated.
  [[nodiscard]] const std::map<std::string, std::vector<std::string>>& violations() const {
    return violations_;
  }

 private:
  std::map<std::string, std::vector<std::string>> violations_;
};

}  // namespace shearfront::soak
