// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/waiting.hpp"

#include <algorithm>

#include "shearfront/numeric/instantiated.hpp"

namespace shearfront::exact {

namespace {

/// For every layer the next one in a direction of strictly smaller rate.
template <Real Scalar>
std::vector<std::size_t> next_slower(const std::vector<Scalar>& rate, bool upward, std::size_t none) {
  std::vector<std::size_t> next(rate.size(), none), stack;
  for (std::size_t n = 0; n < rate.size(); ++n) {
    const std::size_t k = upward ? n : rate.size() - 1 - n;
    while (!stack.empty() && rate[k] < rate[stack.back()]) {
      next[stack.back()] = k;
      stack.pop_back();
    }
    stack.push_back(k);
  }
  return next;
}

/// Whether an optimal path with 4 H = h can start at the point: phi_below <= p <= phi_above for the momenta p
/// on its two sides; a relative slack of 2^-20 keeps rounding from dropping a borderline source.
template <Real Scalar, class Law>
bool may_start(const Law& law, const Cells<Scalar>& cells, const CellFluxes<Scalar>& h_cell,
               std::size_t point, bool upward, const Scalar& h) {
  const Scalar slack = Scalar(1) / Scalar(1 << 20);
  const std::size_t from = upward ? point : point - 1, beyond = upward ? point - 1 : point;
  const auto over = [&](std::size_t cell, bool is_above) {
    return law.excess(cells.layer[cell], cells.beside(point, is_above), upward);
  };
  if (over(from, upward) < -Scalar(Law::kSlack)) return false;
  if (h < h_cell.beside(point, upward) * (Scalar(1) - slack)) return false;
  return !(over(beyond, !upward) > 0) || h <= h_cell.beside(point, !upward) * (Scalar(1) + slack);
}

}  // namespace

template <Real Scalar, class Law>
Waiting<Scalar, Law>::Waiting(const Law& law, const Cells<Scalar>& cells, const CellFluxes<Scalar>& h_cell,
                              const Scalar& slack)
    : basins_(law.n_layers() + 1), slack_(slack) {
  if constexpr (!Law::kMovesAtCapacity) {
    slower_above_ = next_slower(law.rate, true, kNone);
    slower_below_ = next_slower(law.rate, false, kNone);
  }
  for (std::size_t i = 1; i < law.n_layers(); ++i) build(law, cells, h_cell, i, basins_[i]);
}

template <Real Scalar, class Law>
void Waiting<Scalar, Law>::build(const Law& law, const Cells<Scalar>& cells, const CellFluxes<Scalar>& h_cell,
                                 std::size_t i, Basin& basin) {
  basin.h = std::min(law.rate[i - 1], law.rate[i]);
  const std::size_t at = cells.first[i];
  const bool is_pure = cells.beside(at, false) == cells.beside(at, true) && h_cell.beside(at, false) == 0 &&
                       h_cell.beside(at, true) == 0;
  if (!is_pure) basin.entries.push_back({Scalar(0), cells.M[at], at, cells.x[at]});
  const auto prune = [](std::vector<Entry>& kept, const Entry& entry) {
    if (kept.empty() || entry.A < kept.back().A) kept.push_back(entry);
  };
  const Scalar& z_i = law.boundary(i);
  const auto build_side = [&](bool above) {
    Side& side = above ? basin.above : basin.below;
    Leg<Scalar> in, out;  // of paths that come from this side, and that go there
    const bool store = ways_.size() < kMaxStored;
    const std::size_t offset = ways_.size();
    for (std::size_t k = above ? i : i - 1; k < law.n_layers() && !(law.rate[k] < basin.h);
         above ? ++k : --k) {
      const Scalar r_minus_h = law.rate[k] - basin.h;
      if (!Law::kMovesAtCapacity && !(r_minus_h > 0)) break;
      const Scalar q = law.q(k, !above, r_minus_h), w = law.steepness(k, !above, q);
      const Scalar slowness = law.inverse_rate[k] / w;
      if (!is_finite(slowness)) break;
      Leg<Scalar> next{out.time + law.height[k] * slowness, out.Q + law.height[k] * q};
      if constexpr (!Law::kIsSymmetric) {
        next = out;
        add_layer(law, law.height[k], k, above, r_minus_h, next);
        if (!is_finite(next.time)) break;
      }
      if (store) {
        side.offset = offset;
        ways_.push_back(out);
      }
      ++side.n_layers;
      const auto add = [&](std::size_t point) {
        if (point == 0 || point + 1 == cells.x.size() ||
            !may_start(law, cells, h_cell, point, !above, basin.h))
          return;
        const Scalar& x = cells.x[point];
        const Scalar d = above ? x - law.boundary(k) : law.boundary(k + 1) - x;
        prune(basin.entries, {in.time + d * slowness,
                              cells.M[point] + (law.peaks(x, z_i) + (in.Q + d * q) / Scalar(2)), point, x});
      };
      // The state of the path inside a curved cell: it pays to start there.
      const auto add_inside = [&](std::size_t cell) {
        if (!cells.is_curved(cell) || !(cells.phi[cell] < cells.phi_high[cell])) return;
        const Scalar p = law.momentum(k, !above, q, Scalar(basin.h / Scalar(4)));
        if (!(cells.phi[cell] < p && p < cells.phi_high[cell])) return;
        const Scalar y = cells.height_of_state(cell, p);
        const Scalar d = above ? y - law.boundary(k) : law.boundary(k + 1) - y;
        prune(basin.entries,
              {in.time + d * slowness,
               cells.M[cell] + cells.inside(cell, y) + (law.peaks(y, z_i) + (in.Q + d * q) / Scalar(2)), cell,
               y, true});
      };
      if (above) {
        for (std::size_t point = cells.first[k] + 1; point <= cells.first[k + 1]; ++point) {
          add_inside(point - 1);
          add(point);
        }
      } else {
        for (std::size_t point = cells.first[k + 1]; point-- > cells.first[k];) {
          add_inside(point);
          add(point);
        }
      }
      in.time += law.height[k] * slowness;
      in.Q += law.height[k] * q;
      out = next;
    }
  };
  build_side(true);
  if (!Law::kMovesAtCapacity || basin.above.n_layers == 0) return build_side(false);
  // Sources on both sides: two lists, merged by time.
  std::vector<Entry> all = std::move(basin.entries);
  basin.entries.clear();
  build_side(false);
  all.insert(all.end(), basin.entries.begin(), basin.entries.end());
  std::stable_sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.tau < b.tau; });
  basin.entries.clear();
  for (const Entry& entry : all) prune(basin.entries, entry);
}

template <Real Scalar, class Law>
void Waiting<Scalar, Law>::try_interface(const Law& law, std::size_t i, const Scalar& z, std::size_t k,
                                         const Scalar& t, const Scalar& upper, Scalar& Q_floor,
                                         Path<Scalar>& best) const {
  const Basin& basin = basins_[i];
  if (basin.entries.empty()) return;
  const Scalar H = basin.h / Scalar(4);
  const Scalar& z_i = law.boundary(i);
  const Scalar limit = std::min(upper, best.value);
  const Scalar base = law.peaks(z_i, z) + H * t;
  if (basin.entries.back().A + base + Q_floor / Scalar(2) > limit + slack_) return;
  const bool upward = !(z < z_i);
  Leg<Scalar> way;
  if (z != z_i) {
    const Side& side = upward ? basin.above : basin.below;
    const std::size_t n = upward ? k - i : i - 1 - k;  // layers crossed as a whole
    if (!(n < side.n_layers)) {
      // On a boundary the way may end without the layer above it.
      if (!(upward && n == side.n_layers && z == law.boundary(k) && !(law.rate[k] < basin.h))) return;
    }
    if (n < side.n_layers && side.offset != kNone) {
      way = ways_[side.offset + n];
    } else {
      for (std::size_t l = upward ? i : i - 1; l != k; upward ? ++l : --l) {
        add_layer(law, law.height[l], l, upward, Scalar(law.rate[l] - basin.h), way);
        if (way.time > t) return;
      }
    }
    const Scalar d = upward ? z - law.boundary(k) : law.boundary(k + 1) - z;
    if (d > 0) add_layer(law, d, k, upward, Scalar(law.rate[k] - basin.h), way);
    Q_floor = way.Q;
  }
  const Scalar left = t - way.time;
  const auto late = std::upper_bound(basin.entries.begin(), basin.entries.end(), left,
                                     [](const Scalar& time, const Entry& e) { return time < e.tau; });
  if (late == basin.entries.begin()) return;
  const Entry& entry = *(late - 1);
  Path<Scalar> path;
  path.value = entry.A + base + way.Q / Scalar(2);
  if (path.value > best.value) return;
  path.H = H;
  path.r_reference = basin.h;
  path.x = Scalar(0);
  path.kind = PathKind::waiting;
  path.upward = upward;
  path.source = entry.source;
  path.is_state = entry.is_state;
  path.interface = i;
  path.foot = entry.foot;
  path.p = law.momentum(k, upward, law.q(k, upward, Scalar(law.rate[k] - basin.h)), H);
  if (path.better_than(best)) best = path;
}

template <Real Scalar, class Law>
void Waiting<Scalar, Law>::search(const Law& law, const Scalar& z, std::size_t k, const Scalar& t,
                                  const Scalar& upper, Path<Scalar>& best) const {
  if constexpr (Law::kMovesAtCapacity) {
    // A way leads through layers of no less capacity than H_i.
    Scalar least = law.rate[k], none(0);
    for (std::size_t i = k + 1; i < law.n_layers(); ++i) {
      if (!(least < basins_[i].h)) try_interface(law, i, z, k, t, upper, none = Scalar(0), best);
      least = std::min(least, law.rate[i]);
    }
    least = law.rate[k];
    for (std::size_t i = k; i > 0; --i) {
      if (!(least < basins_[i].h)) try_interface(law, i, z, k, t, upper, none = Scalar(0), best);
      least = std::min(least, law.rate[i - 1]);
    }
    return;
  }
  // Basins that contain layer k end at a layer slower than every layer on the way: a record low. Going
  // outwards H_i falls and the way gets longer, so sum q d only grows: the last one computed bounds the next
  // from below.
  Scalar above(0), below(0), here(0);
  for (std::size_t l = slower_above_[k]; l != kNone; l = slower_above_[l])
    try_interface(law, l, z, k, t, upper, above, best);
  for (std::size_t l = slower_below_[k]; l != kNone; l = slower_below_[l])
    try_interface(law, l + 1, z, k, t, upper, below, best);
  // On an interface whose basin is not above, the path may end where it rests.
  if (k > 0 && z == law.boundary(k) && !(law.rate[k - 1] < law.rate[k]))
    try_interface(law, k, z, k, t, upper, here, best);
}

template class Waiting<Instantiated, ParabolaLaw<Instantiated>>;
template class Waiting<Instantiated, UnimodalLaw<Instantiated>>;

}  // namespace shearfront::exact
