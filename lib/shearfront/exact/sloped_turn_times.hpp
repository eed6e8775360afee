// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstddef>
#include <vector>

#include "shearfront/exact/sloped_crossing.hpp"
#include "shearfront/numeric/scalar.hpp"

namespace shearfront::exact {

/// Which turns cannot take the time t, told without a run: times at those h at which a path turns right at the upper end of a cell,
///
///     S_j(k) from the lower end of cell k to that of cell j, where r falls,   E_j from there to its upper end and back,
///
/// prepared once. A path from a node k to z in cell c that turns in j takes S_j(k) + S_j(z) + E_j at the least h that turns there, with
/// S_j(z) between S_j(c + 1) and S_j(c); where r falls in j - 1 and does not jump, the largest h turns at the end of j - 1. Of
/// these the runs take longer the larger h is, and the turn shorter.
///
/// And which cost too much: at the least h, H t + int p dz of the runs is X_j - H S_j for each of both ways, and less at no larger h.
///
/// For parabolas in beds of few cells; more of them are bounded by stretches (exact/sloped_stretches.hpp). Cost: O(cells^2) numbers.
template <Real Scalar>
class SlopedTurnTimes {
 public:
  static constexpr std::size_t kMost = 24;

  /// Cells by their rates at both ends, bends and widths.
  template <class View>
  void prepare(const View& view) {
    using std::sqrt;
    const std::size_t n = view.n_cells();
    if (n > kMost || view.fluxes) return;
    ways_.resize(n);
    costs_.resize(n);
    turn_.assign(n, Scalar(0));
    is_continuous_.assign(n, false);
    for (std::size_t j = 0; j < n; ++j) {
      if (!(view.bend[j] < 0)) continue;
      const Scalar& h = view.high[j];
      const auto q = [&](const Scalar& r) { return Scalar(sqrt(Scalar((r - h) / r))); };
      turn_[j] = Turn<Scalar>(view.form[j], Scalar(-view.bend[j]), view.low[j], q(view.low[j]), h).T;
      is_continuous_[j] = j > 0 && view.bend[j - 1] < 0 && view.high[j - 1] == view.low[j];
      std::vector<Scalar>&ways = ways_[j], &costs = costs_[j];
      ways.assign(j + 1, Scalar(0));
      costs.assign(j + 1, Scalar(0));
      for (std::size_t k = j; k-- > 0;) {
        const bool is_open = !(view.low[k] < h) && !(view.high[k] < h) && is_finite(ways[k + 1]);
        ways[k] = infinity<Scalar>();
        if (!is_open) continue;
        const Crossing<Scalar> c(view.upwards[k], q(view.low[k]), q(view.high[k]), h);
        ways[k] = ways[k + 1] + c.T;
        costs[k] = costs[k + 1] + c.X;
      }
    }
  }

  /// Whether a path that leaves `node` upwards (after any time, if `is_later`) and ends in cell c may take the time t if it turns in
  /// cell j, at an h no larger than `hi` and no less than its rate at its upper end. Precondition: it can pass to j.
  [[nodiscard]] bool may_take(const Scalar& t, std::size_t node, std::size_t c, std::size_t j,
                              const Scalar& hi, const Scalar& low, bool is_later) const {
    if (ways_.empty()) return true;
    const Scalar slack = Scalar(1) / Scalar(1 << 20), one(1);
    const std::vector<Scalar>& ways = ways_[j];
    if (ways[node] + (c < j ? ways[c + 1] : Scalar(0)) > t * (one + slack)) return false;
    if (is_later || !is_continuous_[j] || hi != low || node > j - 1 || c > j - 1) return true;
    const std::vector<Scalar>& before = ways_[j - 1];
    return !(before[node] + before[c] + turn_[j - 1] + turn_[j] < t * (one - slack));
  }

  /// At least what such a path costs besides M0 at its start and the height it gains: (h / 4) t + X - (h / 4) T of the runs.
  [[nodiscard]] Scalar least_cost(const Scalar& t, std::size_t node, std::size_t c, std::size_t j,
                                  const Scalar& h) const {
    if (ways_.empty()) return Scalar(0);
    const Scalar late = ways_[j][node] + (c < j ? ways_[j][c] : Scalar(turn_[j] / Scalar(2)));
    if (!is_finite(late)) return Scalar(0);
    const Scalar cost = costs_[j][node] + (c < j ? costs_[j][c + 1] : Scalar(0)) + h / Scalar(4) * (t - late);
    return cost > 0 ? cost : Scalar(0);
  }

 private:
  std::vector<std::vector<Scalar>> ways_, costs_;  ///< [j][k] = S_j(k), k <= j; empty: no bounds
  std::vector<Scalar> turn_;
  std::vector<bool> is_continuous_;
};

}  // namespace shearfront::exact
