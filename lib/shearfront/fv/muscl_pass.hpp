// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/fv/kernel.hpp"
#include "shearfront/fv/lanes.hpp"
#include "shearfront/fv/special_faces.hpp"

namespace shearfront::fv {

/// Reconstruction: half the rise of v across a cell, from the differences to the cells below and above.
///
/// |half rise| <= both differences, so the values at the edges lie between those of the neighbours. Nothing
/// where the cell is pure up to kPure: there the room for a rounding that the proof of the bounds needs
/// (fv/kernel.hpp) is smaller than a quantum.
template <Limiter limiter, int width>
struct Slope {
  using Vector = typename Vectors<width>::Type;
  static constexpr double kPure = 1 - 0x1p-24;

  SHEARFRONT_FV_INLINE static void half_rise(Vector& rise, const Vector& below, const Vector& above) {
    const Vector zero{};
    if constexpr (limiter == Limiter::minmod) {
      minmod(rise, below * 0.5, above * 0.5);
    } else if constexpr (limiter == Limiter::mc) {
      const Vector mean = (below + above) * 0.25;
      Vector up = below < above ? below : above, down = below > above ? below : above;
      up = up < mean ? up : mean;
      down = down > mean ? down : mean;
      rise = (up > zero ? up : zero) + (down < zero ? down : zero);
    } else {
      // below above / (below + above), in an order that cannot exceed the smaller one by rounding.
      const Vector size_below = below > -below ? below : -below;
      const Vector size_above = above > -above ? above : -above;
      const Vector least = size_below < size_above ? size_below : size_above;
      const Vector most = size_below < size_above ? size_above : size_below;
      const Vector size = least * (most / (least + most + 0x1p-200));
      rise = below > zero ? (above > zero ? size : zero) : (above < zero ? -size : zero);
    }
  }
  SHEARFRONT_FV_INLINE static void minmod(Vector& rise, const Vector& below, const Vector& above) {
    const Vector zero{};
    const Vector up = below < above ? below : above, down = below > above ? below : above;
    rise = (up > zero ? up : zero) + (down < zero ? down : zero);
  }
  SHEARFRONT_FV_INLINE static void flatten_pure(Vector& rise, const Vector& v) {
    const Vector zero{};
    const Vector size = v > -v ? v : -v;
    rise = size < kPure ? rise : zero;
  }
};

/// One step of SSP-RK2 on a run of cells, in one pass: the first stage runs ahead of the second, and the
/// second ahead of the cells that are written, by a vector or two; nothing but v goes to memory.
///
/// `Rule` is what depends on the flux (quadratic_muscl_kernel.cpp, unimodal_kernel.cpp):
///   kRest, kQuantum; flux(g, top, minus_bottom, c), G of a face from the states at it, the upper one with
///   its sign changed; flux_at_jump(g, top, minus_bottom, c_below, c_above); mapped(own, v, ratio), the state
///   whose flux in the own layer is that of v in a layer of `ratio` times the rate, on the branch of v, or
///   the extremum if the own layer cannot carry it.
/// `has_ratio`: faces.ratio is there.
///
/// Why v stays in [-1, 1] (quadratic flux, G <= 0; in quanta q; the lower bound is the mirror image). Take a
/// cell with v = 1 - d, d a whole number. Flux a through its upper face fills it, flux b through its lower
/// face empties it; a1, a2, b1, b2 are the sizes of both stages as computed, w = 1 - d' the state after the
/// first, d' = d - [a1] + [b1], [ ] rounding to whole quanta. Both edges of a cell are within 2 d of 1 (half
/// rises are no larger than the room), so a1 <= c (1 - (1 - 2 d)^2) <= d - d^2 for c <= 1/4; where the cell
/// is flat, a1 <= c 2 d <= d / 2. It is flat for d < 2^-24; otherwise d^2 >= 16 q, which is 8 q more than the
/// roundings inside a1. The same holds for a2 with d'. To show: [(a1 + a2) / 2] < d + (b1 + b2) / 2 + 1/2,
/// since then v' = 1 - d + [(a1 + a2) / 2] - [(b1 + b2) / 2] < 1 + q, and v' is a whole number of quanta.
///   d = 0: a1 = 0, d' = [b1]. Flat: a2 / 2 <= [b1] / 4, which rounds to 0 up to [b1] = 2 (ties go to even),
///     and [b1] / 4 + 1/2 <= b1 / 2 from [b1] = 3. Else (a1 + a2) / 2 + 1/2 <= [b1] / 2 - 7/2 < b1 / 2.
///   d = 1: flat. a1 <= 1/2, so [a1] = 0 and d' = 1 + [b1]. Flat in the second stage: (a1 + a2) / 2 <= 1/2 +
///     [b1] / 4, which rounds to 0 for [b1] = 0 and is less than 1 + b1 / 2 else; not flat: 8 q to spare.
///   d >= 2: a1 + a2 <= a1 + d - [a1] + [b1] <= d + b1 + 1, so the left side is at most
///     d / 2 + b1 / 2 + 1 <= d + b1 / 2.
template <class Rule, Limiter limiter, bool has_ratio, int width>
class MusclPass {
  using L = Lanes<width>;
  using S = Slope<limiter, width>;
  using Vector = typename L::Vector;

 public:
  SHEARFRONT_FV_INLINE MusclPass(const Rule& rule, double* v, const Faces& faces)
      : rule_(rule), v_(v), faces_(faces) {}

  SHEARFRONT_FV_INLINE FaceBelow advance(const FaceBelow& below, std::size_t n_cells) {
    const auto n = static_cast<std::ptrdiff_t>(n_cells);
    v0_[width - 1] = below.v;
    first_stage(0);
    h_stage_[0] = h_stage_up_[0] = below.h_stage;
    first_stage(width);
    w2_[width - 1] = below.w;
    first_stage(2 * width);
    second_stage(0, 1, width);
    h_[0] = h_up_[0] = below.h;
    for (std::ptrdiff_t i = width; i <= n; i += width) {
      const Vector h_below = h_, h_below_up = h_up_;
      first_stage(i + 2 * width);
      second_stage(i, 0, i < n ? width : 1);
      Vector h_above;
      L::higher(h_above, h_below, h_);
      const Vector v = v3_ - (h_above - (has_ratio ? h_below_up : h_below));
      L::store(v_ + i - width, v);
      if (has_ratio && is_special(faces_, i - width)) [[unlikely]]
        hold_back_excess(faces_, i - width, v_ + i - width, width);
    }
    const double h_stage = has_ratio ? h_stage_2_[0] : g2_[0] + Rule::kRest;
    return {h_up_[0], h_stage, v3_[width - 1], w3_[width - 1]};
  }

  /// Kernel::half_rises().
  static void half_rises(const Rule& rule, const double* v, const Faces& faces, double* rises,
                         std::size_t n) {
    for (std::size_t i = 0; i < n; i += width) {
      Vector below, here, above, rise;
      L::load(below, v + i - 1);
      L::load(here, v + i);
      L::load(above, v + i + 1);
      half_rise(rise, rule, faces, static_cast<std::ptrdiff_t>(i), below, here, above);
      L::store(rises + i, rise);
    }
  }

 private:
  // A number behind a name is the lag: v2_ are the states two vectors below those of the first stage.
  /// Fluxes through the faces i, i + 1, ... at the beginning of the step; states of the vector below at its
  /// end according to them.
  SHEARFRONT_FV_INLINE void first_stage(std::ptrdiff_t i) {
    v3_ = v2_, v2_ = v1_, v1_ = v0_;
    w3_ = w2_, w2_ = w1_;
    g2_ = g1_, g1_ = g0_;
    h_stage_2_ = h_stage_1_, h_stage_1_ = h_stage_up_;
    const Vector h_below = h_stage_;
    Vector below, above, h_above;
    L::load(v0_, v_ + i);
    L::load(above, v_ + i + 1);
    L::lower(below, v1_, v0_);
    fluxes(g0_, top_, i, below, v0_, above);
    h_stage_ = g0_ + Rule::kRest;
    h_stage_up_ = h_stage_;
    if (has_ratio && is_special(faces_, i)) [[unlikely]] {
      double h_up[width];
      for (int lane = 0; lane < width; ++lane)
        h_up[lane] = stage_flux(faces_, i + lane, g0_[lane], Rule::kRest).above;
      L::load(h_stage_up_, h_up);
    }
    L::higher(h_above, h_below, h_stage_);
    w1_ = v1_ - (h_above - (has_ratio ? h_stage_1_ : h_below));
  }

  /// Fluxes through the faces i, i + 1, ..., mean of both stages; in the units of the cells above for the
  /// faces of the lanes first ... last - 1.
  SHEARFRONT_FV_INLINE void second_stage(std::ptrdiff_t i, int first, int last) {
    Vector below, above, g;
    L::lower(below, w3_, w2_);
    L::higher(above, w2_, w1_);
    fluxes(g, stage_top_, i, below, w2_, above);
    g = 0.5 * (g2_ + g);
    h_ = g + Rule::kRest;
    h_up_ = h_;
    if (has_ratio && is_special(faces_, i)) [[unlikely]] {
      double h[width], h_up[width];
      L::store(h, h_);
      L::store(h_up, h_up_);
      for (int lane = first; lane < last; ++lane) {
        const FaceFlux flux = step_flux(faces_, i + lane, g[lane], lane == 0 ? v3_[width - 1] : v2_[lane - 1],
                                        v2_[lane], Rule::kRest, Rule::kQuantum);
        h[lane] = flux.below;
        h_up[lane] = flux.above;
      }
      L::load(h_, h);
      L::load(h_up_, h_up);
    }
  }

  /// Fluxes through the faces below the cells v = v[i], v[i + 1], ... with neighbours below and above.
  /// `top`: the states at the upper edges of the cells one vector lower; becomes that of these cells.
  SHEARFRONT_FV_INLINE void fluxes(Vector& g, Vector& top, std::ptrdiff_t i, const Vector& below,
                                   const Vector& v, const Vector& above) {
    Vector rise, top_below, c_above;
    half_rise(rise, rule_, faces_, i, below, v, above);
    L::lower(top_below, top, v + rise);
    top = v + rise;
    L::load(c_above, faces_.above + i);
    if (is_special(faces_, i)) [[unlikely]] {
      Vector c_below;
      L::load(c_below, faces_.below + i);
      if constexpr (has_ratio) {
        double memory[width];
        for (int lane = 0; lane < width; ++lane) memory[lane] = coefficient_above(faces_, i + lane);
        L::load(c_above, memory);
      }
      rule_.flux_at_jump(g, top_below, rise - v, c_below, c_above);
    } else {
      rule_.flux(g, top_below, rise - v, c_above);
    }
  }

  SHEARFRONT_FV_INLINE static bool is_special(const Faces& faces, std::ptrdiff_t i) {
    return faces.is_special[i / static_cast<std::ptrdiff_t>(kLanes)] != 0;
  }

  SHEARFRONT_FV_INLINE static void half_rise(Vector& rise, const Rule& rule, const Faces& faces,
                                             std::ptrdiff_t i, const Vector& below, const Vector& v,
                                             const Vector& above) {
    Vector low = v - below, high = above - v;
    if (is_special(faces, i)) [[unlikely]] {
      // By way of memory: the vectors of the fast path stay in registers.
      double memory[4 * width];
      L::store(memory, below);
      L::store(memory + width, v);
      L::store(memory + 2 * width, above);
      see_beyond_jumps(memory, rule, faces, i);
      Vector bound;
      L::load(low, memory);
      L::load(high, memory + 2 * width);
      L::load(bound, memory + 3 * width);
      S::half_rise(rise, low, high);
      rise = rise < bound ? rise : bound;
      rise = rise > -bound ? rise : -bound;
    } else {
      S::half_rise(rise, low, high);
    }
    S::flatten_pure(rise, v);
  }

  /// Differences to the neighbours as the own layer would have them. `memory`: states below, own and above;
  /// becomes difference to below, own, difference to above, largest half rise.
  ///
  /// Beyond a jump of the rate the state of the own layer with the neighbour's flux stands for the neighbour:
  /// it would follow here if the flux went on unchanged. In time-dependent flow the flux changes with height
  /// as 1 / wave speed, so half of the distance, that in the other layer, counts with the ratio of the
  /// speeds. The half rise is no larger than the difference itself: the bounds of phi hold.
  __attribute__((noinline)) static void see_beyond_jumps(double* memory, const Rule& rule, const Faces& faces,
                                                         std::ptrdiff_t i) {
    for (int lane = 0; lane < width; ++lane) {
      const std::ptrdiff_t face = i + lane;
      const double v = memory[width + lane];
      const Seen below = seen(rule, memory[lane], faces.below[face], coefficient_above(faces, face));
      const Seen above =
          seen(rule, memory[2 * width + lane], coefficient_above(faces, face + 1), faces.below[face + 1]);
      const double low = v - below.v, high = above.v - v;
      memory[lane] = low * below.stretch;
      memory[2 * width + lane] = high * above.stretch;
      memory[3 * width + lane] = std::min(std::abs(low), std::abs(high));
    }
  }

  /// State v of a layer with coefficient `other` as one with `own` sees it.
  struct Seen {
    double v, stretch;
  };
  static Seen seen(const Rule& rule, double v, double other, double own) {
    if (own == other || !(own > 0) || !(other > 0)) return {v, 1};
    const double mapped = rule.mapped(v, other / own);
    const double speed = std::abs(other * rule.slope(v)), own_speed = std::abs(own * rule.slope(mapped));
    return {mapped, speed + own_speed > 0 ? 2 * speed / (speed + own_speed) : 1};
  }

  const Rule& rule_;
  double* v_;
  Faces faces_;
  Vector v0_{}, v1_{}, v2_{}, v3_{}, w1_{}, w2_{}, w3_{}, g0_{}, g1_{}, g2_{};
  Vector top_{}, stage_top_{}, h_stage_{}, h_stage_up_{}, h_stage_1_{}, h_stage_2_{}, h_{}, h_up_{};
};

}  // namespace shearfront::fv
