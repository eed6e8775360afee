// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/curved_start.hpp"

#include <algorithm>
#include <boost/math/tools/minima.hpp>
#include <cmath>
#include <utility>

#include "shearfront/track/curved_front.hpp"

namespace shearfront {
namespace {

/// Capacities so near to each other are one level.
constexpr double kSameLevel = 64 * 0x1p-53;

/// The flux, times 4, that the Riemann problem at the upper end of one segment sends into the next.
double sent(const CurvedProblem& problem, const StartSegment& from, const StartSegment& to) {
  const RatePiece &below = problem.pieces[from.piece], &above = problem.pieces[to.piece];
  const double r = below.rate(from.z_high), R = above.rate(to.z_low);
  const double demand = from.u_high >= below.top() ? below.carried(r, from.u_high) : r,
               supply = to.u_low <= above.top() ? above.carried(R, to.u_low) : R;
  return std::min(demand, supply);
}

/// Whether its states jump up, or touch, across the top of the flux of a piece.
bool jumps_across_top(const CurvedProblem& problem, const StartSegment& from, const StartSegment& to) {
  return from.u_high <= problem.pieces[from.piece].top() && to.u_low >= problem.pieces[to.piece].top();
}

/// Largest 4 H that the start excites: H falls with time.
double largest_capacity(const CurvedProblem& problem) {
  const std::vector<RatePiece>& pieces = problem.pieces;
  const std::vector<StartSegment>& start = problem.start;
  double most = 0;
  const double low = pieces.front().low, high = pieces.back().high;
  if (!problem.ends.states[0].empty()) most = low;
  if (!problem.ends.states[1].empty()) most = std::max(most, high);
  if (problem.ends.is_periodic) most = std::min(low, high);
  for (std::size_t i = 0; i < start.size(); ++i) {
    const StartSegment& s = start[i];
    const RatePiece& piece = pieces[s.piece];
    most = std::max(
        {most, piece.carried(piece.rate(s.z_low), s.u_low), piece.carried(piece.rate(s.z_high), s.u_high)});
    if (i + 1 < start.size()) most = std::max(most, sent(problem, s, start[i + 1]));
  }
  return most;
}

struct Spacing {
  double offset, ratio;  ///< dh = ratio (h + offset)
  double root_step;      ///< of q, where u is near to the top of the flux
};

/// How much larger steps of u are than those of the parabola: where q >= 1/2, there they are largest at q = 1/2, and next to q = 0.
struct StepStretch {
  double far, near;
};
StepStretch step_stretch_of(const std::vector<RatePiece>& pieces) {
  constexpr double kFar = 0.5, kNear = 0.02;
  StepStretch stretch{0, 0};
  const FluxBranches* last = nullptr;
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const FluxBranches* flux = pieces[p].flux.get();
    if (!flux) stretch = {std::max(stretch.far, 1.0), std::max(stretch.near, 1.0)};
    if (!flux || (p > 0 && flux == last)) continue;
    last = flux;
    for (const bool is_high : {false, true}) {
      stretch.far = std::max(stretch.far, flux->lack_slope(is_high, kFar, 1 - kFar * kFar));
      stretch.near =
          std::max(stretch.near, flux->lack_slope(is_high, kNear, 1 - kNear * kNear) * (2 * kNear));
    }
  }
  return stretch;
}

Spacing spacing_of(const CurvedProblem& problem, double most, double resolution) {
  const std::vector<RatePiece>& pieces = problem.pieces;
  const StepStretch stretch = step_stretch_of(pieces);
  double least_rate = INFINITY;
  for (const RatePiece& piece : pieces) least_rate = std::min({least_rate, piece.low, piece.high});
  const double offset = std::min(0.1 * most, least_rate);
  // u changes by dh / (4 r q), q >= 1/2 where |u - 1/2| >= 1/4: there h <= 3 r / 4.
  const double at_least_rate = 2 * least_rate / (0.75 * least_rate + offset),
               at_others = 8.0 / 3 / (1 + offset / most);
  return {offset, resolution / stretch.far * std::min(at_least_rate, at_others),
          2 * resolution / std::max(stretch.near, stretch.far)};
}

double count(const Spacing& spacing, double most) {
  return std::ceil(std::log1p(most / spacing.offset) / spacing.ratio);
}

struct Special {
  double capacity;
  std::size_t piece;
  double value;            ///< of KnownTurn
  bool is_known;           ///< whether it has one
  bool is_plateau = true;  ///< not where a rate only goes on
};

std::vector<Special> specials_of(const CurvedProblem& problem, double most) {
  const std::vector<RatePiece>& pieces = problem.pieces;
  const std::vector<StartSegment>& start = problem.start;
  std::vector<Special> all;
  const auto add = [&](double capacity, std::size_t p, double value, bool is_known, bool is_plateau = true) {
    if (capacity > 0 && capacity <= most * (1 + kSameLevel))
      all.push_back({capacity, p, value, is_known, is_plateau});
  };
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const bool is_curve = !pieces[p].is_constant();
    add(pieces[p].low, p, pieces[p].z_low, is_curve, p == 0 || !problem.continues(p));
    add(pieces[p].high, p, pieces[p].z_high, is_curve, p + 1 == pieces.size() || !problem.continues(p + 1));
  }
  for (std::size_t i = 0; i < start.size(); ++i) {
    const StartSegment& s = start[i];
    const RatePiece& piece = pieces[s.piece];
    for (const auto& [z, u] : {std::pair(s.z_low, s.u_low), std::pair(s.z_high, s.u_high)}) {
      if (piece.is_constant())
        add(piece.carried(piece.low, u), s.piece, piece.flux ? piece.flux->root_of(u) : std::abs(2 * u - 1),
            true);
      else
        add(piece.carried(piece.rate(z), u), s.piece, z, u == piece.top());
    }
    if (i + 1 < start.size() && start[i + 1].piece == s.piece && jumps_across_top(problem, s, start[i + 1]))
      add(piece.rate(s.z_high), s.piece, s.z_high, !piece.is_constant());
  }
  for (const double u : problem.ends.states[0])
    add(pieces.front().carried(pieces.front().low, u), 0, 0, false);
  for (const double u : problem.ends.states[1])
    add(pieces.back().carried(pieces.back().high, u), 0, 0, false);
  std::stable_sort(all.begin(), all.end(),
                   [](const Special& a, const Special& b) { return a.capacity < b.capacity; });
  return all;
}

/// Capacities below which levels are spaced in u instead of H: where u stays near the top of the flux, or begins there.
std::vector<double> refined_capacities(const CurvedProblem& problem, const Spacing& spacing, double most) {
  const std::vector<RatePiece>& pieces = problem.pieces;
  const std::vector<StartSegment>& start = problem.start;
  std::vector<double> all;
  const auto add = [&](double capacity) {
    if (capacity <= most * (1 + kSameLevel)) all.push_back(capacity);
  };
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const RatePiece& piece = pieces[p];
    constexpr double kFewLevels = 4;
    const double least = std::min(piece.low, piece.high), rise = std::abs(piece.high - piece.low);
    const bool is_flat = !problem.is_part.empty()
                             ? piece.is_constant()
                             : rise <= kFewLevels * spacing.ratio * (least + spacing.offset);
    if (is_flat) add(least);
    if (p + 1 == pieces.size()) break;
    const RatePiece& next = pieces[p + 1];
    const bool is_throat =
        (piece.high > next.low || piece.bend <= 0) && (piece.high < next.low || next.bend >= 0);
    if (is_throat) add(std::min(piece.high, next.low));
  }
  for (std::size_t i = 0; i + 1 < start.size(); ++i) {
    const StartSegment &s = start[i], &next = start[i + 1];
    const double top = pieces[s.piece].top();
    if ((s.shape && s.u_high == top) ||
        (jumps_across_top(problem, s, next) && (s.u_low < top || next.u_high > pieces[next.piece].top())))
      add(std::min(pieces[start[i].piece].rate(start[i].z_high),
                   pieces[start[i + 1].piece].rate(start[i + 1].z_low)));
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end(), [](double x, double y) { return y - x <= kSameLevel * y; }),
            all.end());
  return all;
}

/// u = (1 - q) / 2 in steps of the resolution below a capacity, as far as that is finer.
constexpr double kRefinedRoot = 0.4;

std::vector<double> ordinary_levels(const Spacing& spacing, double most, const std::vector<double>& refined) {
  const double n = count(spacing, most);
  std::vector<double> all;
  for (double i = 1; i <= n; ++i)
    all.push_back(spacing.offset * std::expm1(i / n * std::log1p(most / spacing.offset)));
  all.back() = most;
  if (refined.empty()) return all;
  for (const double capacity : refined)
    for (double q = spacing.root_step; q < kRefinedRoot; q += spacing.root_step)
      all.push_back(capacity * (1 - q * q));
  std::sort(all.begin(), all.end());
  // None much nearer to the next than the finest spacing there.
  std::vector<double> levels;
  std::size_t first = 0;
  for (const double h : all) {
    double room = spacing.ratio * (h + spacing.offset);
    while (first < refined.size() && refined[first] < h) ++first;
    for (std::size_t k = first; k < refined.size(); ++k) {
      const double root = std::sqrt(std::max(0.0, 1 - h / refined[k]));
      if (root > kRefinedRoot) break;
      room = std::min(room, 2 * spacing.root_step * refined[k] * std::max(root, spacing.root_step / 2));
    }
    constexpr double kLeastShare = 0.6;
    if (levels.empty() || h - levels.back() > kLeastShare * room) levels.push_back(h);
  }
  return levels;
}

/// Height at which the deficits of `below` from `a` to it and of `above` from it to `b` make `wanted`.
double step_height(const LevelCurves& grid, std::size_t p, State below, State above, double a, double b,
                   double wanted) {
  const std::size_t first = grid.level(below), second = grid.level(above);
  const LevelCurves::Place at_a = grid.place(p, first, a), at_b = grid.place(p, second, b);
  const auto excess = [&](double z) -> Passage {
    const LevelCurves::Place one = grid.place(p, first, z), other = grid.place(p, second, z);
    const double slope =
        grid.flux(p) ? 2 * std::abs(grid.phi(p, below, z) - grid.phi(p, above, z)) * (first < second ? -1 : 1)
                     : other.q - one.q;
    return {grid.deficit(p, below, at_a, one) + grid.deficit(p, above, other, at_b) - wanted, slope};
  };
  const bool falls = first < second;  // then q_first > q_second
  if (!(b > a)) return a;
  return std::clamp(bracketed_root(falls ? b : a, falls ? a : b, a + (b - a) / 2, excess), a, b);
}

/// Where `value`, which rises or falls from lo to hi, is 0: by bisection and secants.
template <class Value>
double height_of_zero(double lo, double hi, bool rises, const Value& value) {
  constexpr int kMostHalvings = 200;
  double at_lo = value(lo), at_hi = value(hi);
  if ((at_lo >= 0) == rises) return lo;
  if ((at_hi <= 0) == rises) return hi;
  for (int n = 0; n < kMostHalvings; ++n) {
    const double middle = lo + (hi - lo) / 2, secant = lo - at_lo / (at_hi - at_lo) * (hi - lo);
    const double z = n % 3 < 2 && secant > lo && secant < hi ? secant : middle;
    if (!(z > lo && z < hi)) break;
    const double here = value(z);
    if (here == 0) return z;
    ((here < 0) == rises ? lo : hi) = z;
    ((here < 0) == rises ? at_lo : at_hi) = here;
  }
  return hi;
}

/// A state of a constant piece. Where rounding of its capacity makes it the top of the flux, a little of the next level at its top
/// keeps the amount.
StartSegmentLevels constant_state(const LevelCurves& grid, const StartSegment& segment, State state) {
  constexpr double kLeast = 1e-13;
  const double u = grid.phi(segment.piece, state, segment.z_low), width = segment.z_high - segment.z_low;
  const std::size_t level = grid.level(state);
  if (level == 0 || std::abs(segment.u_low - u) < kLeast) return {state, state, {}};
  const State next = segment.u_low > u ? grid.high(level - 1) : grid.low(level - 1);
  const double share = (segment.u_low - u) / (grid.phi(segment.piece, next, segment.z_low) - u);
  return {state, next, {{segment.z_high - share * width, state, next}}};
}

}  // namespace

double count_levels(const CurvedProblem& problem, double resolution) {
  const double most = largest_capacity(problem);
  return most > 0 ? count(spacing_of(problem, most, resolution), most) : 0;
}

State outside_state(const LevelCurves& grid, std::size_t end, double u) {
  const RatePiece& piece = grid.piece(end == 0 ? 0 : grid.n_layers() - 1);
  const double rate = end == 0 ? piece.low : piece.high;
  const std::size_t level = u == 0 || u == 1 ? 0 : grid.cap(piece.carried(rate, u));
  return u > piece.top() ? grid.high(level) : grid.low(level);
}

void add_smooth_segments(std::vector<StartSegment>& segments, const RatePiece& rate, std::size_t piece,
                         double low, double high, const std::shared_ptr<const StartShape>& course) {
  const double top = rate.top(), above_low = course->u(low) - top, above_high = course->u(high) - top;
  std::vector<double> cuts{low, high};
  double at_top = low;
  if (above_low * above_high < 0) {
    at_top = height_of_zero(low, high, above_low < 0, [&](double z) { return course->u(z) - top; });
    cuts.push_back(at_top);
  }
  const auto carried = [&](double z) { return rate.carried(rate.rate(z), course->u(z)); };
  // Extrema next to the ends too: what is missed at 1e-6 of the stretch holds 1e-18 of it.
  std::vector<double> parts{0, 1e-6, 1e-4, 1e-2};
  constexpr int kHeights = 32;
  for (int i = 1; i < kHeights; ++i) parts.push_back(static_cast<double>(i) / kHeights);
  parts.insert(parts.end(), {1 - 1e-2, 1 - 1e-4, 1 - 1e-6, 1});
  std::vector<double> heights;
  for (const double part : parts) heights.push_back(part == 1 ? high : low + (high - low) * part);
  for (std::size_t i = 1; i + 1 < heights.size(); ++i) {
    const double before = carried(heights[i - 1]), here = carried(heights[i]),
                 after = carried(heights[i + 1]);
    for (const double sign : {1.0, -1.0}) {
      if (!(sign * here >= sign * before && sign * here > sign * after)) continue;
      // By the part of the way: the search stops at an absolute distance, whatever the height of the bed.
      constexpr int kMostBits = 50;
      const double begin = heights[i - 1], way = heights[i + 1] - begin;
      const double part = boost::math::tools::brent_find_minima(
                              [&](double x) { return -sign * carried(begin + way * x); }, 0.0, 1.0, kMostBits)
                              .first;
      cuts.push_back(begin + way * part);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    if (!(cuts[i + 1] > cuts[i])) continue;
    StartSegment& segment = segments.emplace_back(piece, cuts[i], cuts[i + 1], course);
    if (above_low * above_high >= 0) continue;
    if (segment.z_low == at_top) segment.u_low = top;
    if (segment.z_high == at_top) segment.u_high = top;
  }
}

LevelPlan plan_levels(const CurvedProblem& problem, double resolution) {
  LevelPlan plan{{0}, {true}, {}};
  bool is_last_fixed = true;
  const double most = largest_capacity(problem);
  if (!(most > 0)) return plan;
  const std::vector<Special> specials = specials_of(problem, most);
  const Spacing spacing = spacing_of(problem, most, resolution);
  const std::vector<double> ordinary =
      ordinary_levels(spacing, most, refined_capacities(problem, spacing, most));
  constexpr double kRoom =
      0.3;  // of the distance to the next ordinary one, that a special level keeps free on each side
  const auto room = [&](double h, double gap) {
    return kRoom * std::min(std::min(spacing.ratio, 0.5) * (h + spacing.offset), gap);
  };
  auto next = ordinary.begin();
  const auto add_up_to = [&](double h) {
    for (; next != ordinary.end() && *next < h; ++next) {
      const double below = next == ordinary.begin() ? *next : *next - *std::prev(next);
      const double above = next + 1 == ordinary.end() ? INFINITY : *std::next(next) - *next;
      if (h - *next <= room(h, below)) continue;
      if (*next <= plan.capacities.back() + (is_last_fixed ? room(*next, above) : 0)) continue;
      plan.capacities.push_back(*next);
      plan.is_plateau.push_back(false);
      is_last_fixed = false;
    }
  };
  for (const Special& special : specials) {
    const double h = special.capacity;
    const bool is_known =
        is_last_fixed && plan.capacities.size() > 1 && h <= plan.capacities.back() * (1 + kSameLevel);
    if (!is_known) {
      add_up_to(h);
      plan.capacities.push_back(h);
      plan.is_plateau.push_back(false);
      is_last_fixed = true;
    }
    if (special.is_plateau) plan.is_plateau.back() = true;
    if (special.is_known) plan.known.push_back({special.piece, plan.capacities.size() - 1, special.value});
  }
  if (plan.capacities.back() < most * (1 - kSameLevel)) {
    add_up_to(most);
    plan.capacities.push_back(most);
    plan.is_plateau.push_back(true);
  }
  return plan;
}

StartSegmentLevels in_levels(const LevelCurves& grid, const StartSegment& segment) {
  const std::size_t p = segment.piece;
  const RatePiece& piece = grid.piece(p);
  const StartShape* shape = segment.shape.get();
  const double inside =
      shape ? shape->u(segment.z_low + (segment.z_high - segment.z_low) / 2) : segment.u_low;
  const bool is_top = !shape && inside == piece.top();
  const bool is_high = inside > piece.top() || (is_top && !piece.is_constant() && !piece.falls());
  const auto state = [&](std::size_t k) { return is_high ? grid.high(k) : grid.low(k); };
  const auto level_at = [&](double z, double u) {
    return u == 0 || u == 1 ? 0 : grid.cap(piece.carried(piece.rate(z), u));
  };
  const std::size_t from = level_at(segment.z_low, segment.u_low),
                    to = level_at(segment.z_high, segment.u_high);
  if (from == to && !shape && from > 0 && piece.is_constant())
    return constant_state(grid, segment, state(from));
  if (from == to) return {state(from), state(to), {}};
  StartSegmentLevels levels{state(from), state(to), {}};
  const int s = from < to ? 1 : -1;
  const auto next = [s](std::size_t k) { return s > 0 ? k + 1 : k - 1; };
  if (is_top) {
    // Between the turning heights of two levels the higher one, beyond its own: it is the top there.
    if (s > 0) levels.at_low = state(from + 1);
    if (s < 0) levels.at_high = state(to + 1);
    for (std::size_t k = next(from); k != to; k = next(k))
      levels.steps.push_back({grid.turning_height(p, k), state(s > 0 ? k : k + 1), state(s > 0 ? k + 1 : k)});
    return levels;
  }
  const double spread = piece.carried(1, segment.u_low);
  const auto height_of = [&](double h, double lo) {
    if (!shape) return piece.height_of(h / spread);
    return height_of_zero(lo, segment.z_high, s > 0,
                          [&](double z) { return piece.carried(piece.rate(z), shape->u(z)) - h; });
  };
  const auto lack = [&](double lo, double hi) {
    const double width = hi - lo;
    if (!shape) return 2 * (is_high ? 1 - segment.u_low : segment.u_low) * width;
    const double amount = shape->amount(lo, hi);
    return 2 * (is_high ? width - amount : amount);
  };
  double low_end = segment.z_low;
  for (std::size_t k = from; k != to; k = next(k)) {
    const std::size_t above = next(k);
    double high_end = above == to ? segment.z_high : height_of(grid.capacity(above), low_end);
    high_end = std::clamp(high_end, low_end, segment.z_high);
    const double z = step_height(grid, p, state(k), state(above), low_end, high_end, lack(low_end, high_end));
    levels.steps.push_back({z, state(k), state(above)});
    low_end = high_end;
  }
  return levels;
}

}  // namespace shearfront
