// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "shearfront/fv/kernel.hpp"
#include "shearfront/fv/lanes.hpp"

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
///   kRest; flux(g, top, minus_bottom, c), G of a face from the states at it, the upper one with its sign
///   changed; flux_at_jump(g, top, minus_bottom, c_below, c_above); mapped(own, v, ratio), the state whose
///   flux in the own layer is that of v in a layer of `ratio` times the rate, on the branch of v, or the
///   extremum if the own layer cannot carry it.
template <class Rule, Limiter limiter, int width>
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
    h_stage_[0] = below.h_stage;
    first_stage(width);
    w2_[width - 1] = below.w;
    first_stage(2 * width);
    second_stage(0);
    h_[0] = below.h;
    for (std::ptrdiff_t i = width; i <= n; i += width) {
      const Vector h_below = h_;
      first_stage(i + 2 * width);
      second_stage(i);
      Vector h_above;
      L::higher(h_above, h_below, h_);
      const Vector v = v3_ - (h_above - h_below);
      L::store(v_ + i - width, v);
    }
    return {h_[0], g2_[0] + Rule::kRest, v3_[width - 1], w3_[width - 1]};
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
    const Vector h_below = h_stage_;
    Vector below, above, h_above;
    L::load(v0_, v_ + i);
    L::load(above, v_ + i + 1);
    L::lower(below, v1_, v0_);
    fluxes(g0_, top_, i, below, v0_, above);
    h_stage_ = g0_ + Rule::kRest;
    L::higher(h_above, h_below, h_stage_);
    w1_ = v1_ - (h_above - h_below);
  }

  /// Fluxes through the faces i, i + 1, ..., mean of both stages.
  SHEARFRONT_FV_INLINE void second_stage(std::ptrdiff_t i) {
    Vector below, above, g;
    L::lower(below, w3_, w2_);
    L::higher(above, w2_, w1_);
    fluxes(g, stage_top_, i, below, w2_, above);
    h_ = 0.5 * (g2_ + g) + Rule::kRest;
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
    if (has_jump(faces_, i)) [[unlikely]] {
      Vector c_below;
      L::load(c_below, faces_.below + i);
      rule_.flux_at_jump(g, top_below, rise - v, c_below, c_above);
    } else {
      rule_.flux(g, top_below, rise - v, c_above);
    }
  }

  SHEARFRONT_FV_INLINE static bool has_jump(const Faces& faces, std::ptrdiff_t i) {
    return faces.has_jump[i / static_cast<std::ptrdiff_t>(kLanes)] != 0;
  }

  SHEARFRONT_FV_INLINE static void half_rise(Vector& rise, const Rule& rule, const Faces& faces,
                                             std::ptrdiff_t i, const Vector& below, const Vector& v,
                                             const Vector& above) {
    S::half_rise(rise, v - below, above - v);
    if (has_jump(faces, i)) [[unlikely]] {
      // By way of memory: the vectors of the fast path stay in registers.
      double rises[width], neighbours[3 * width];
      L::store(rises, rise);
      L::store(neighbours, below);
      L::store(neighbours + width, v);
      L::store(neighbours + 2 * width, above);
      bound_at_jumps(rises, rule, faces, i, neighbours);
      L::load(rise, rises);
    }
    S::flatten_pure(rise, v);
  }

  /// Next to a jump of the rate: the other layer's state seen from here is that of equal flux (it would
  /// follow here if the flux went on unchanged), but its distance in z is not that of the cells. So the slope
  /// is the one-sided one of the own layer, and the seen state only bounds it.
  __attribute__((noinline)) static void bound_at_jumps(double* rises, const Rule& rule, const Faces& faces,
                                                       std::ptrdiff_t i, const double* neighbours) {
    for (int lane = 0; lane < width; ++lane) {
      const std::ptrdiff_t face = i + lane;
      const double own = faces.above[face], own_above = faces.below[face + 1];
      const double other_below = faces.below[face], other_above = faces.above[face + 1];
      const bool jumps_below = own != other_below && own > 0 && other_below > 0;
      const bool jumps_above = own_above != other_above && own_above > 0 && other_above > 0;
      if (!jumps_below && !jumps_above) continue;
      const double below = neighbours[lane], v = neighbours[width + lane];
      const double above = neighbours[2 * width + lane];
      double low = jumps_below ? v - rule.mapped(below, other_below / own) : v - below;
      double high = jumps_above ? rule.mapped(above, other_above / own_above) - v : above - v;
      if (jumps_above) low *= 0.5;
      if (jumps_below) high *= 0.5;
      const double least = std::min(std::abs(low), std::abs(high));
      rises[lane] = low * high > 0 ? std::copysign(least, low) : 0;
    }
  }

  const Rule& rule_;
  double* v_;
  Faces faces_;
  Vector v0_{}, v1_{}, v2_{}, v3_{}, w1_{}, w2_{}, w3_{}, g0_{}, g1_{}, g2_{};
  Vector top_{}, stage_top_{}, h_stage_{}, h_{};
};

}  // namespace shearfront::fv
