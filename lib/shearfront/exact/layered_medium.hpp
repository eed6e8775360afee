// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "shearfront/exact/canonical_form.hpp"
#include "shearfront/exact/law.hpp"
#include "shearfront/exact/medium.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/waiting.hpp"

namespace shearfront::exact {

/// The Lax-Hopf formula in a stack of layers, in each of which a(z) is constant: minimum over
///   1. fans from initial jumps and interfaces, T(H) = t (exact/law.hpp),
///   2. the same resting at an interface (exact/waiting.hpp),
///   3. constant initial states, H known, foot point from the travel time,
///   4. curved ones, the foot point where moving it does not pay (exact/curved_cell.hpp).
/// Walls are added by best_path().
///
/// Which candidates are left out, and why the minimum stays the same:
///   * A source at x with phi_b below and phi_a above can only be the start of an optimal path if moving it does not
///     pay: phi_b <= p <= phi_a for the momenta p of the path on both sides. Going up p lies above the peak, so phi_a
///     does; going down p lies below it, so phi_b does.
///   * Duality: cost(x -> z, t) >= H' t + sum +-p_k(H') d_k for every H' up to the capacity of the layers
///     crossed, so every Newton iterate bounds its candidate from below, and since phi is in [0, 1] also all
///     starts of a whole range of cells in one layer. What lies above the best value so far is dropped.
///   * No state is faster than the pure ones: starts outside the domain of dependence reach z too late.
///
/// Cost of a query: O(layers crossed) per source that survives, O(log jumps) ranges per layer when the data
/// have many jumps. Few survive once the best one is known: best_beside() tries the last one first. Immutable after construction, safe to share between threads.
template <Real Scalar, class Law>
class LayeredMedium final : public Medium<Scalar> {
 public:
  LayeredMedium(Law law, Cells<Scalar> cells, Scalar mass);

  [[nodiscard]] const std::vector<Scalar>& boundaries() const override { return law_.boundaries; }
  [[nodiscard]] std::size_t numbers_per_piece() const override { return 1; }
  [[nodiscard]] Path<Scalar> best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const override;
  [[nodiscard]] Path<Scalar> best_moving(const Scalar& z, const Scalar& t) const override;
  [[nodiscard]] Path<Scalar> best_beside(const Path<Scalar>& near, const Scalar& z, const Scalar& t,
                                         bool is_moving) const override;
  [[nodiscard]] Scalar pure_travel_time(const Scalar& from, const Scalar& to) const override {
    return exact::pure_travel_time<Scalar>(law_, from, to);
  }
  /// In twice the digits where amounts nearly cancel; error of a few u H t, far below u (top - bottom) where
  /// little is missing.
  [[nodiscard]] Scalar shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                 FinalAmount amount) const override;
  [[nodiscard]] Scalar rate_at(const Scalar& z) const override { return law_.rate[law_.layer_at(z)]; }
  [[nodiscard]] Scalar flux_at(const Scalar& z, const Scalar& phi) const override {
    return law_.h_of(law_.layer_at(z), phi) / Scalar(4);
  }
  [[nodiscard]] std::optional<Scalar> first_wave(std::size_t i) const override;
  [[nodiscard]] PathGradient<Scalar> gradient(const Path<Scalar>& path, const Scalar& z,
                                              const Scalar& t) const override;

  [[nodiscard]] const Law& law() const { return law_; }
  [[nodiscard]] const Waiting<Scalar, Law>& waiting() const { return waiting_; }
  /// 4 H of the state of a cell, of a curved one at its lower end.
  [[nodiscard]] const Scalar& h_cell(std::size_t i) const { return h_.low[i]; }
  /// Whether a fan can leave inner point i upwards (downwards): some H satisfies phi_b <= p <= phi_a.
  [[nodiscard]] bool emits(std::size_t i, bool upward) const { return (emits_[i] & (upward ? 1U : 2U)) != 0; }

 private:
  using Medium<Scalar>::cells_;

  struct Query {
    Scalar z, t, upper;
    std::size_t k;             ///< layer of z
    bool moving_only = false;  ///< leave out H = 0
  };
  [[nodiscard]] bool may_emit(std::size_t i, bool upward) const;
  /// All candidates that can be better than `best`, which may be none.
  [[nodiscard]] Path<Scalar> search(const Query& query, Path<Scalar> best = {}) const;
  /// The path that starts where `near` does, if there is one.
  void try_start_of(const Path<Scalar>& near, const Query& query, Path<Scalar>& best) const;
  void search_layer(const Query& query, Sweep<Scalar>& sweep, Path<Scalar>& best) const;
  void search_range(const Query& query, Sweep<Scalar>& sweep, std::size_t begin, std::size_t end,
                    Path<Scalar>& best) const;
  FanState<Scalar> try_source(const Query& query, Sweep<Scalar>& sweep, std::size_t i, bool prune,
                              Path<Scalar>& best) const;
  void try_curved_cell(const Query& query, const Sweep<Scalar>& sweep, std::size_t i,
                       Path<Scalar>& best) const;
  void try_cell(const Query& query, const Sweep<Scalar>& sweep, std::size_t i, Path<Scalar>& best) const;

  Law law_;
  CellFluxes<Scalar> h_;             ///< 4 H of the state of each cell
  std::vector<std::uint8_t> emits_;  ///< per point: bit 0 upwards, bit 1 downwards
  Scalar slack_;                     ///< rounding allowance of lower bounds
  Waiting<Scalar, Law> waiting_;
};

/// The fluxes of a canonical form by their inverse branches.
template <Real Scalar>
[[nodiscard]] PieceFluxes<Scalar> fluxes_of(const CanonicalForm<Scalar>& form) {
  PieceFluxes<Scalar> all;
  for (const Flux<Scalar>& flux : form.layers().fluxes()) all.fluxes.emplace_back(flux);
  for (std::size_t k = 0; k < form.layers().n_layers(); ++k)
    all.of_piece.push_back(form.layers().flux_index(k));
  return all;
}
/// The law of layers with these; parabolas have it, too.
template <Real Scalar>
[[nodiscard]] UnimodalLaw<Scalar> unimodal_law(const CanonicalForm<Scalar>& form) {
  PieceFluxes<Scalar> all = fluxes_of(form);
  return {form.boundaries(), form.rates(), std::move(all.fluxes), std::move(all.of_piece)};
}

}  // namespace shearfront::exact
