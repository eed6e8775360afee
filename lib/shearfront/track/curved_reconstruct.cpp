// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/curved_reconstruct.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/track/curved_front.hpp"

namespace shearfront {
namespace {

/// Distance of lines from a level, in squares of the resolution: less than what joining the nodes costs.
double line_tolerance(const CurvedBed& bed) {
  return std::max(1e-15, 0.05 * bed.resolution * bed.resolution);
}

/// Where the characteristic of the flux h / 4 is that turned at the time `turned`, and its u.
struct Turned {
  double z, u;
};
Turned characteristic_after_turn(const LevelCurves& grid, std::size_t p, double h, double t) {
  const RatePiece& piece = grid.piece(p);
  if (const FluxBranches* flux = grid.flux(p)) {
    const bool is_high = (t > 0) != piece.falls();  // before the turn it comes from the other side
    t = std::abs(t);
    const double bend = std::abs(piece.bend), spread = flux->spread(is_high);
    const auto u_of = [&](double root) {  // |u - top| is half of it
      return is_high ? flux->top() + root / 2 : flux->top() - root / 2;
    };
    if (piece.curve == RateCurve::exponential) {
      const double u = u_of(std::min(h * bend * t / 2, spread * (1 - 1e-15)));
      return {piece.height_of(h / flux->value(u)), u};
    }
    // As characteristic_time() from the turning height on, where q = 0.
    const auto late = [&](double q) -> Passage {
      const double x = (1 - q) * (1 + q);
      const double ways = flux->rest_integral(is_high, 0, q, q * q) -
                          flux->pure_shape(is_high) * std::log(x) + flux->shape(is_high, 0) -
                          flux->shape(is_high, q);
      return {2 * ways / bend - t, 4 * q * flux->lack_slope(is_high, q, x) / x / bend};
    };
    constexpr double kMost = 1 - 1e-12;
    const double q = !(t > 0) ? 0 : late(kMost).t < 0 ? kMost : bracketed_root(0.0, kMost, 0.5, late);
    const double x = (1 - q) * (1 + q);
    return {piece.height_of(h / x), u_of(spread - flux->lack(is_high, q, x))};
  }
  // u' = r' u (1 - u): with r'/r or r' constant it is elementary.
  const double w =
      piece.curve == RateCurve::exponential ? -h * piece.bend * t / 2 : -std::tanh(piece.bend * t / 2);
  const double lost = std::min(w * w, 1 - 1e-15);
  return {piece.height_of(h / (1 - lost)), (1 - w) / 2};
}

}  // namespace

/// The piece of a height: `p` if that has it.
std::size_t CurvedReconstruction::piece_at(double z, std::size_t p) const {
  while (p > 0 && z < bed_.grid.boundary(p)) --p;
  while (p + 1 < bed_.grid.n_layers() && z > bed_.grid.boundary(p + 1)) ++p;
  return p;
}

/// Calls each(piece, from, to) for the parts of an interval in the pieces, bottom to top.
template <class Each>
void CurvedReconstruction::in_pieces(double from, double to, const Each& each) const {
  const auto& pieces = bed_.scene.problem.pieces;
  const auto it = std::upper_bound(pieces.begin() + 1, pieces.end(), from,
                                   [](double z, const RatePiece& piece) { return z < piece.z_low; });
  for (auto p = static_cast<std::size_t>(it - pieces.begin()) - 1; from < to; ++p) {
    const bool is_last = p + 1 == pieces.size() || !(pieces[p].z_high < to);
    const double end = is_last ? to : pieces[p].z_high;
    each(p, from, end);
    from = end;
  }
}

/// When a front that turned in an earlier part of a smooth rate, or will in a later one, did or would as if its part went on to
/// there: what a turn leaves of the times of its levels is what it would leave in that, up to what parts differ by. A time that is
/// not finite if it does not, or so far away that it does not show.
double CurvedReconstruction::turn_beyond(const CurvedNode& front) const {
  constexpr double kParts = 3;
  const LevelCurves& grid = bed_.grid;
  const std::size_t p = front.layer;
  const bool was_before = front.turned == CurvedNode::kEarlier;
  const std::size_t boundary = (front.direction > 0) != was_before ? p + 1 : p;  // on the way to the turn
  if (front.direction == 0 || boundary == 0 || boundary == grid.n_layers()) return CurvedNode::kNever;
  if (!bed_.scene.problem.continues(boundary)) return CurvedNode::kNever;
  const RatePiece& piece = grid.piece(p);
  if ((boundary > p) != piece.falls()) return CurvedNode::kNever;
  const std::size_t most = std::max(grid.level(front.below), grid.level(front.above));
  if (most < 2) return CurvedNode::kNever;
  const double z = grid.turning_height(p, most - 1);
  if (!(std::abs(z - grid.boundary(boundary)) < kParts * (piece.z_high - piece.z_low)))
    return CurvedNode::kNever;
  if (!was_before) {
    const bool turns = most == grid.level(front.direction > 0 ? front.below : front.above);
    return turns ? passage(grid, front, z).t : CurvedNode::kNever;
  }
  CurvedNode turned = front;
  set_origin(grid, turned, z, 0);
  return front.t - passage(grid, turned, front.z).t;
}

/// Node i of the snapshot.
CurvedReconstruction::Node CurvedReconstruction::boundary(std::size_t i) const {
  Node node;
  if (i == 0 || i + 1 == snapshot_.z.size()) return node;
  const std::size_t p = snapshot_.piece[i];
  if (p == 0 || !bed_.scene.problem.continues(p)) return node;
  const LevelCurves& grid = bed_.grid;
  const State below = snapshot_.state[i - 1], above = snapshot_.state[i];
  const std::size_t level = grid.level(below);
  const double z = grid.boundary(p);
  const bool is_dead = !(grid.q(p - 1, level, z) > 0) && !(grid.q(p, level, z) > 0);
  node.is_nothing = below == above || (is_dead && level == grid.level(above));  // then both are 1/2
  return node;
}

CurvedReconstruction::Node CurvedReconstruction::node_of(const CurvedNode& front, double z) const {
  const LevelCurves& grid = bed_.grid;
  const std::size_t i = grid.level(front.below), j = grid.level(front.above), p = front.layer;
  if (i + 1 != j && j + 1 != i) return {};
  if (bed_.is_plateau[i] && bed_.is_plateau[j]) return {};  // a jump from one initial state to another
  const double rate = grid.piece(p).rate(z);
  const bool is_dead = !(grid.q(p, std::max(i, j), z, rate) > 0);
  if (!is_dead && grid.is_high(front.below) != grid.is_high(front.above)) return {};
  const double h = (grid.capacity(i) + grid.capacity(j)) / 2;
  Node node{true, false, z, 0, 0, h};
  const double below = grid.phi(p, front.below, z), above = grid.phi(p, front.above, z);
  double turned = front.turned;
  if (front.turns)
    turned = front.end_t;
  else if (!std::isfinite(turned))
    turned = turn_beyond(front);
  node.u = (below + above) / 2;
  const bool has_turn = std::isfinite(turned);
  const Turned middle =
      has_turn ? characteristic_after_turn(grid, p, h, snapshot_.t - turned) : Turned{z, node.u};
  // The parts of a smooth rate go on beyond their ends nearly as they are.
  const auto& problem = bed_.scene.problem;
  const double lowest = grid.boundary(p > 0 && problem.continues(p) ? p - 1 : p),
               highest = grid.boundary(p + 1 < grid.n_layers() && problem.continues(p + 1) ? p + 2 : p + 1);
  if (has_turn && middle.z >= lowest && middle.z <= highest) {
    node.z = middle.z;
    node.u = middle.u;
  } else {
    node.h = grid.piece(p).carried(rate, node.u);
  }
  node.room = std::abs(above - below) / 2;
  return node;
}

/// From a node to the shock or interface at `limit`, or to where H is that of the region, if it is a plateau: nodes without the
/// first.
std::vector<CurvedReconstruction::Node> CurvedReconstruction::end_of(std::size_t region, double limit,
                                                                     const Node& first,
                                                                     const Node& second) const {
  const LevelCurves& grid = bed_.grid;
  const State state = snapshot_.state[region];
  const std::size_t k = grid.level(state);
  const double dz = first.z - second.z;
  if (dz == 0 || first.z == limit) return {};
  const double slope = (first.h - second.h) / dz, at_level = grid.capacity(k);
  const double reach = std::abs(first.h - at_level);
  double end = limit;
  if (bed_.is_plateau[k]) {
    const double z = slope == 0 ? limit : first.z + (at_level - first.h) / slope;
    if ((z - first.z) * (limit - first.z) > 0 && std::abs(z - first.z) < std::abs(limit - first.z)) end = z;
  }
  std::vector<Node> nodes;
  constexpr int kLines = 12;
  for (int i = 1; i <= kLines; ++i) {
    const double x = 1 - static_cast<double>(i) / kLines;
    const double z = i == kLines ? end : end + (first.z - end) * x * x;  // at throats u is a square root
    const double h =
        std::clamp(first.h + slope * (z - first.z), std::max(0.0, at_level - reach), at_level + reach);
    const std::size_t p = piece_at(z, snapshot_.piece[region]);
    const double rate = grid.piece(p).rate(z);
    const double u = grid.u_of(p, grid.is_high(state), h, rate, std::sqrt(std::max(0.0, (rate - h) / rate)));
    nodes.push_back({true, false, z, u, x * x * first.room, h});
  }
  return nodes;
}

/// A monotone cubic through the nodes (slopes by harmonic means: Fritsch & Butland 1984) as lines.
std::vector<CurvedReconstruction::Node> CurvedReconstruction::joined(const std::vector<Node>& nodes) const {
  constexpr double kMostLines = 8;
  const double tolerance = line_tolerance(bed_);
  const std::size_t n = nodes.size();
  std::vector<double> rise(n, 0), slope(n, 0);
  for (std::size_t k = 0; k + 1 < n; ++k)
    if (nodes[k + 1].z > nodes[k].z) rise[k] = (nodes[k + 1].u - nodes[k].u) / (nodes[k + 1].z - nodes[k].z);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double a = rise[k - 1], b = rise[k], left = nodes[k].z - nodes[k - 1].z,
                 right = nodes[k + 1].z - nodes[k].z;
    if (!(a * b > 0) || !(left > 0) || !(right > 0)) continue;
    const double w = (left + 2 * right) / (3 * (left + right));
    slope[k] = a * b / (w * b + (1 - w) * a);
  }
  slope[0] = rise[0];
  slope[n - 1] = rise[n - 2];
  std::vector<Node> all;
  all.reserve(2 * n);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double width = nodes[k + 1].z - nodes[k].z, step = nodes[k + 1].u - nodes[k].u;
    const double d0 = slope[k] * width - step, d1 = step - slope[k + 1] * width;
    all.push_back(nodes[k]);
    if (!(width > 0)) continue;
    // The cubic leaves its chord by no more than 4 / 27 of that.
    const double bend = std::max(std::abs(d0), std::abs(d1)) * (4.0 / 27);
    const double n_lines = std::clamp(std::ceil(std::sqrt(bend / tolerance)), 1.0, kMostLines);
    for (double i = 1; i < n_lines; ++i) {
      const double x = i / n_lines, y = 1 - x;
      all.push_back({true, false, nodes[k].z + x * width, nodes[k].u + x * step + x * y * (y * d0 + x * d1),
                     y * nodes[k].room + x * nodes[k + 1].room, 0});
    }
  }
  all.push_back(nodes[n - 1]);
  return all;
}

void CurvedReconstruction::add_steps(std::size_t low, std::size_t high) {
  for (std::size_t i = low; i < high; ++i)
    lines_.add_level(bed_.grid, snapshot_.piece[i], snapshot_.state[i], snapshot_.z[i + 1],
                     line_tolerance(bed_));
}

/// Between the shocks or interfaces `low` and `high`.
void CurvedReconstruction::add_stretch(std::size_t low, std::size_t high) {
  const double bottom = snapshot_.z[low], top = snapshot_.z[high];
  std::vector<Node> nodes;
  for (std::size_t i = low + 1; i < high; ++i)
    if (nodes_[i].is_smooth) nodes.push_back(nodes_[i]);
  if (nodes.size() < 2 || !(top > bottom)) return add_steps(low, high);
  double last = bottom;
  for (Node& node : nodes) last = node.z = std::clamp(node.z, last, top);
  const std::size_t n = nodes.size();
  const std::vector<Node> down = end_of(low, bottom, nodes[0], nodes[1]),
                          up = end_of(high - 1, top, nodes[n - 1], nodes[n - 2]);
  std::vector<Node> all(down.rbegin(), down.rend());
  const std::vector<Node> inner = joined(nodes);
  all.insert(all.end(), inner.begin(), inner.end());
  all.insert(all.end(), up.begin(), up.end());
  const LevelCurves& grid = bed_.grid;
  CompensatedSum<double> excess;
  excess += snapshot_.below[low] - snapshot_.below[high];
  const auto add_amount = [&](State state) {
    return [&, state](std::size_t p, double from, double to) { excess += grid.amount(p, state, from, to); };
  };
  in_pieces(bottom, all.front().z, add_amount(snapshot_.state[low]));
  in_pieces(all.back().z, top, add_amount(snapshot_.state[high - 1]));
  double room = 0;
  for (std::size_t k = 0; k + 1 < all.size(); ++k) {
    const double width = all[k + 1].z - all[k].z;
    excess += width * ((all[k].u + all[k + 1].u) / 2);
    room += width * ((all[k].room + all[k + 1].room) / 2);
  }
  const double share = -excess.value() / room;
  if (!(std::abs(share) <= 1)) return add_steps(low, high);
  for (Node& node : all) {
    const double u = node.u + share * node.room;
    if (!(u >= 0 && u <= 1)) return add_steps(low, high);
    node.u = u;
  }
  const double tolerance = line_tolerance(bed_);
  const auto add_level = [&](State state) {
    return [&, state](std::size_t p, double, double to) { lines_.add_level(grid, p, state, to, tolerance); };
  };
  in_pieces(bottom, all.front().z, add_level(snapshot_.state[low]));
  for (std::size_t k = 0; k + 1 < all.size(); ++k) lines_.add(all[k + 1].z, all[k].u, all[k + 1].u);
  in_pieces(all.back().z, top, add_level(snapshot_.state[high - 1]));
}

}  // namespace shearfront
