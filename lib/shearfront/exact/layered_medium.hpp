// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/travel.hpp"
#include "shearfront/exact/waiting.hpp"
#include "shearfront/scene/layer_stack.hpp"

namespace shearfront::exact {

/// The Lax-Hopf formula in a stack of layers of constant a: minimum over
///   1. fans from initial jumps and interfaces, T(H) = t (exact/travel.hpp),
///   2. the same resting at an interface (exact/waiting.hpp),
///   3. constant initial states, H = s a phi (1 - phi) known, foot point from the travel time.
/// Walls are added by the caller.
///
/// Which candidates are left out, and why the minimum stays the same:
///   * A source at x with phi_b below and phi_a above can only be the start of an optimal path if moving it
///   does
///     not pay: phi_b <= p <= phi_a for the momenta p of the path on both sides. Going up p >= 1/2, so
///     phi_a > 1/2; going down p <= 1/2, so phi_b < 1/2.
///   * Duality: cost(x -> z, t) >= H' t + sum +-p_k(H') d_k for every H' up to the capacity of the layers
///     crossed, so every Newton iterate bounds its candidate from below, and since phi is in [0, 1] also all
///     starts of a whole range of cells in one layer. What lies above the best value so far is dropped.
///   * Speeds are at most s a: starts outside the domain of dependence reach z too late.
///
/// Cost of a query: O(layers crossed) per source that survives, O(log jumps) ranges per layer when the data
/// have many jumps. Immutable after construction, safe to share between threads.
template <Real Scalar>
class LayeredMedium final : public Medium<Scalar> {
 public:
  LayeredMedium(const Scene<Scalar>& scene, LayerStack<Scalar> layers);

  [[nodiscard]] Path<Scalar> best_free(const Scalar& z, const Scalar& t,
                                            const Scalar& upper) const override;
  [[nodiscard]] Path<Scalar> best_moving(const Scalar& z, const Scalar& t) const override;
  [[nodiscard]] Scalar pure_travel_time(const Scalar& z1, const Scalar& z2) const override {
    return exact::travel_time(geometry_, z1, z2, Scalar(0));
  }
  /// In twice the digits where amounts nearly cancel; error of a few u H t, far below u (top - bottom) where
  /// little is missing.
  [[nodiscard]] Scalar shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                 FinalAmount amount) const override;
  [[nodiscard]] Scalar rate_at(const Scalar& z) const override {
    return geometry_.rate[geometry_.layers.layer_at(z)];
  }
  [[nodiscard]] const Geometry<Scalar>& geometry() const { return geometry_; }
  [[nodiscard]] const Cells<Scalar>& cells() const { return cells_; }
  [[nodiscard]] const LayerStack<Scalar>& layers() const { return geometry_.layers; }
  [[nodiscard]] const Waiting<Scalar>& waiting() const { return waiting_; }
  /// Whether a fan can leave inner point i upwards (downwards): some H satisfies phi_b <= p <= phi_a.
  [[nodiscard]] bool emits(std::size_t i, bool upward) const { return (emits_[i] & (upward ? 1U : 2U)) != 0; }

 private:
  struct Query;
  [[nodiscard]] Path<Scalar> search(const Query& query) const;
  void search_layer(const Query& query, Sweep<Scalar>& sweep, Path<Scalar>& best) const;
  void search_range(const Query& query, Sweep<Scalar>& sweep, std::size_t begin, std::size_t end,
                    Path<Scalar>& best) const;
  FanState<Scalar> try_source(const Query& query, Sweep<Scalar>& sweep, std::size_t i, bool prune,
                              Path<Scalar>& best) const;
  [[nodiscard]] Scalar loss(const Path<Scalar>& path, const Scalar& z1, const Scalar& z2) const;
  void try_cell(const Query& query, const Sweep<Scalar>& sweep, std::size_t i, Path<Scalar>& best) const;

  Geometry<Scalar> geometry_;
  Cells<Scalar> cells_;
  std::vector<Scalar> h_cell_;       ///< 4 s a phi (1 - phi) per cell
  std::vector<std::uint8_t> emits_;  ///< per point: bit 0 upwards, bit 1 downwards
  Scalar slack_;                     ///< rounding allowance of lower bounds
  Waiting<Scalar> waiting_;
};

extern template class LayeredMedium<double>;

}  // namespace shearfront::exact
