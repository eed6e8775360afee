// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/waiting.hpp"
#include "shearfront/numeric/instantiated.hpp"

#include <algorithm>

namespace shearfront::exact {

template <Real Scalar>
Waiting<Scalar>::Waiting(const Geometry<Scalar>& g, const Cells<Scalar>& cells, const Scalar& slack)
    : slack_(slack) {
  const std::size_t n = g.layers.n_layers();
  slower_above_.assign(n, kNone);
  slower_below_.assign(n, kNone);
  std::vector<std::size_t> stack;
  for (std::size_t k = 0; k < n; ++k) {
    while (!stack.empty() && g.rate[k] < g.rate[stack.back()]) {
      slower_above_[stack.back()] = k;
      stack.pop_back();
    }
    stack.push_back(k);
  }
  stack.clear();
  for (std::size_t k = n; k-- > 0;) {
    while (!stack.empty() && g.rate[k] < g.rate[stack.back()]) {
      slower_below_[stack.back()] = k;
      stack.pop_back();
    }
    stack.push_back(k);
  }
  basins_.resize(n + 1);
  for (std::size_t i = 1; i < n; ++i) build(g, cells, i, basins_[i]);
}

/// Whether an optimal path with 4 H = h can start at the point: phi_below <= p <= phi_above for the momenta p
/// on its two sides; a relative slack of 2^-20 keeps rounding from dropping a borderline source.
template <Real Scalar>
bool Waiting<Scalar>::may_start(const Geometry<Scalar>& g, const Cells<Scalar>& cells, std::size_t point,
                                bool upward, const Scalar& h) {
  const Scalar half(0.5), slack = Scalar(1) / Scalar(1 << 20);
  const auto flux = [&](std::size_t cell) {
    return Scalar(4) * g.rate[cells.layer[cell]] * cells.phi[cell] * (Scalar(1) - cells.phi[cell]);
  };
  const std::size_t from = upward ? point : point - 1, beyond = upward ? point - 1 : point;
  const Scalar& phi = cells.phi[from];
  if (upward ? phi < half : phi > half) return false;
  if (h < flux(from) * (Scalar(1) - slack)) return false;
  const Scalar& other = cells.phi[beyond];
  if (upward ? other > half : other < half) return h <= flux(beyond) * (Scalar(1) + slack);
  return true;
}

template <Real Scalar>
void Waiting<Scalar>::build(const Geometry<Scalar>& g, const Cells<Scalar>& cells, std::size_t i,
                            Basin& basin) {
  basin.h = std::min(g.rate[i - 1], g.rate[i]);
  basin.below = g.rate[i - 1] > g.rate[i];
  const std::size_t at = cells.first[i];
  const Scalar& below = cells.phi[at - 1];
  const Scalar& above = cells.phi[at];
  const bool pure = below == above && (below == Scalar(0) || below == Scalar(1));
  if (!pure) basin.entries.push_back({Scalar(0), cells.M[at], at});
  if (g.rate[i - 1] == g.rate[i]) return;
  const auto prune = [&](Entry entry) {
    if (basin.entries.empty() || entry.A < basin.entries.back().A) basin.entries.push_back(std::move(entry));
  };
  basin.offset = tau_.size();
  std::vector<Scalar> tau_sums, Q_sums;
  const bool store = tau_.size() < kMaxStored;
  Scalar tau(0), Q(0);
  const Scalar& z_i = g.layers.boundary(i);
  for (std::size_t k = basin.below ? i - 1 : i; k < g.layers.n_layers() && g.rate[k] > basin.h;
       basin.below ? --k : ++k) {
    if (store) {
      tau_.push_back(tau);
      Q_.push_back(Q);
    }
    ++basin.n_layers;
    const Scalar q = momentum_root<Scalar>(g.rate[k] - basin.h, g.inverse_rate[k]);
    const Scalar slowness = g.inverse_rate[k] / q;
    const auto add = [&](std::size_t point) {
      if (point == 0 || point + 1 == cells.x.size() || !may_start(g, cells, point, basin.below, basin.h))
        return;
      const Scalar& x = cells.x[point];
      const Scalar d = basin.below ? g.layers.boundary(k + 1) - x : x - g.layers.boundary(k);
      prune({tau + d * slowness, cells.M[point] + ((z_i - x) + (Q + d * q)) / Scalar(2), point});
    };
    if (basin.below) {
      for (std::size_t point = cells.first[k + 1]; point-- > cells.first[k];) add(point);
    } else {
      for (std::size_t point = cells.first[k] + 1; point <= cells.first[k + 1]; ++point) add(point);
    }
    tau += g.height[k] * slowness;
    Q += g.height[k] * q;
  }
  basin.stored = store;
}

template <Real Scalar>
void Waiting<Scalar>::try_interface(const Geometry<Scalar>& g, const Cells<Scalar>& cells, std::size_t i,
                                    const Scalar& z, std::size_t k, const Scalar& t, const Scalar& upper,
                                    Scalar& Q_floor, Path<Scalar>& best) const {
  const Basin& basin = basins_[i];
  if (basin.entries.empty()) return;
  const Scalar H = basin.h / Scalar(4);
  const Scalar& z_i = g.layers.boundary(i);
  const Scalar half_way = (z - z_i) / Scalar(2);
  const Scalar limit = std::min(upper, best.value);
  const Scalar base = half_way + H * t;
  if (basin.entries.back().A + base + Q_floor / Scalar(2) > limit + slack_) return;
  Scalar tau(0), Q(0);
  if (z != z_i) {
    const Scalar d = basin.below ? g.layers.boundary(k + 1) - z : z - g.layers.boundary(k);
    if (basin.stored) {
      const std::size_t n = basin.offset + (basin.below ? i - 1 - k : k - i);
      tau = tau_[n];
      Q = Q_[n];
    } else {
      for (std::size_t l = basin.below ? i - 1 : i; l != k; basin.below ? --l : ++l) {
        const Scalar q = momentum_root<Scalar>(g.rate[l] - basin.h, g.inverse_rate[l]);
        tau += g.height[l] * g.inverse_rate[l] / q;
        Q += g.height[l] * q;
        if (tau > t) return;
      }
    }
    const Scalar q = momentum_root<Scalar>(g.rate[k] - basin.h, g.inverse_rate[k]);
    tau += d * g.inverse_rate[k] / q;
    Q += d * q;
    Q_floor = Q;
  }
  const Scalar left = t - tau;
  const auto late = std::upper_bound(basin.entries.begin(), basin.entries.end(), left,
                                     [](const Scalar& time, const Entry& e) { return time < e.tau; });
  if (late == basin.entries.begin()) return;
  const Entry& entry = *(late - 1);
  Path<Scalar> path;
  path.value = entry.A + base + Q / Scalar(2);
  if (path.value > best.value) return;
  path.H = H;
  path.r_reference = basin.h;
  path.x = Scalar(0);
  path.kind = PathKind::waiting;
  path.upward = z == z_i || !basin.below;
  path.source = entry.source;
  path.interface = i;
  path.foot = cells.x[entry.source];
  const Scalar q_end = momentum_root<Scalar>(g.rate[k] - basin.h, g.inverse_rate[k]);
  path.p =
      path.upward ? (Scalar(1) + q_end) / Scalar(2) : Scalar(2) * H * g.inverse_rate[k] / (Scalar(1) + q_end);
  if (path.better_than(best)) best = path;
}

template <Real Scalar>
void Waiting<Scalar>::search(const Geometry<Scalar>& g, const Cells<Scalar>& cells, const Scalar& z,
                             std::size_t k, const Scalar& t, const Scalar& upper, Path<Scalar>& best) const {
  // Basins that contain layer k end at a layer slower than every layer on the way: a record low. Going
  // outwards H_i falls and the way gets longer, so sum q d only grows: the last one computed bounds the next
  // from below.
  Scalar above(0), below(0), here(0);
  for (std::size_t l = slower_above_[k]; l != kNone; l = slower_above_[l])
    try_interface(g, cells, l, z, k, t, upper, above, best);
  for (std::size_t l = slower_below_[k]; l != kNone; l = slower_below_[l])
    try_interface(g, cells, l + 1, z, k, t, upper, below, best);
  // On an interface whose basin is not above, the path may end where it rests.
  if (k > 0 && z == g.layers.boundary(k) && !(g.rate[k - 1] < g.rate[k]))
    try_interface(g, cells, k, z, k, t, upper, here, best);
}

template class Waiting<Instantiated>;

}  // namespace shearfront::exact
