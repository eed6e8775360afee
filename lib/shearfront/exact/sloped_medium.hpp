// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "shearfront/exact/medium.hpp"
#include "shearfront/exact/sloped_bed.hpp"
#include "shearfront/exact/sloped_place.hpp"
#include "shearfront/exact/sloped_throats.hpp"

namespace shearfront::exact {

/// The Lax-Hopf formula for a(z) linear or exponential in pieces, jumps allowed: minimum over
///   1. paths inside one piece, in closed form, a turn included,
///   2. fans and constant states that leave their piece and go straight to z, or turn once where s a = 4 H in a piece that
///      falls along their way (exact/sloped_search.hpp),
///   3. paths that rest at a throat at its capacity (exact/sloped_throats.hpp).
/// Walls are added by best_path().
///
/// There are no others: a minimiser shifted in time is one, too, and the two meet once at most; two turns, or a turn and
/// a rest elsewhere, would make them meet twice. Every candidate is a path, so one more does no harm.
///
/// Cost of a query: O(pieces crossed) per source and per piece in which its paths may turn, those left out that cost more
/// than the best so far. Immutable after construction, safe to share between threads.
template <Real Scalar>
class SlopedMedium final : public Medium<Scalar> {
 public:
  /// Without fluxes all are parabolas.
  SlopedMedium(SlopedPieces<Scalar> pieces, Cells<Scalar> cells, Scalar mass,
               std::shared_ptr<const PieceFluxes<Scalar>> fluxes = nullptr);

  [[nodiscard]] const std::vector<Scalar>& boundaries() const override { return pieces_.boundaries; }
  /// s a at the lower and at the upper end.
  [[nodiscard]] std::size_t numbers_per_piece() const override { return 2; }
  [[nodiscard]] Path<Scalar> best_free(const Scalar& z, const Scalar& t, const Scalar& upper) const override;
  [[nodiscard]] Path<Scalar> best_moving(const Scalar& z, const Scalar& t) const override;
  /// Optimal paths do not cross: one between two others starts between them, and stays there. So between two that come from one wall
  /// all do, between two fans of a node that turn in one piece all turn there, with an H between theirs, and elsewhere few starts are left.
  [[nodiscard]] std::vector<Path<Scalar>> best_paths(const std::vector<Scalar>& z,
                                                     const Scalar& t) const override;
  [[nodiscard]] Scalar pure_travel_time(const Scalar& from, const Scalar& to) const override;
  [[nodiscard]] bool is_reached_from(bool is_bottom, const Scalar& z, const Scalar& t) const override;
  /// To a few u H t where paths lose little (and turn in linear pieces): amounts and heights are added up in twice the digits.
  [[nodiscard]] Scalar shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                 FinalAmount amount) const override;
  [[nodiscard]] Scalar rate_at(const Scalar& z) const override {
    return pieces_.rate(pieces_.piece_at(z), z);
  }
  [[nodiscard]] Scalar flux_at(const Scalar& z, const Scalar& phi) const override {
    if (!fluxes_) return rate_at(z) * phi * (Scalar(1) - phi);
    return rate_at(z) * fluxes_->flux(pieces_.piece_at(z)).height_of(phi) / Scalar(4);
  }
  [[nodiscard]] std::optional<Scalar> first_wave(std::size_t i) const override;
  [[nodiscard]] PathGradient<Scalar> gradient(const Path<Scalar>& path, const Scalar& z,
                                              const Scalar& t) const override;

  [[nodiscard]] const SlopedPieces<Scalar>& pieces() const { return pieces_; }
  /// Of a constant state in a cell at a height with the rate r.
  [[nodiscard]] Scalar speed(std::size_t cell, const Scalar& r) const;
  [[nodiscard]] const SlopedView<Scalar>& view(bool is_mirror) const { return is_mirror ? down_ : up_; }

 private:
  using Medium<Scalar>::cells_;
  /// The momentum of a path at its end.
  void settle(const SlopedPlace<Scalar>& place, const Scalar& t, Path<Scalar>& best) const;
  /// The path that has been at z all the time, where no better one is known.
  void rest(const SlopedPlace<Scalar>& place, const Scalar& t, Path<Scalar>& best) const;
  /// Heights between which a path starts.
  struct Starts {
    Scalar least = -infinity<Scalar>(), most = infinity<Scalar>();
  };
  [[nodiscard]] Path<Scalar> search(const Scalar& z, const Scalar& t, const Scalar& upper, bool moving_only,
                                    const Starts& starts = {}) const;
  /// A height with its best path.
  struct Known {
    const Scalar& z;
    const Path<Scalar>& path;
  };
  /// The best path to z, low.z <= z <= high.z, which starts between theirs.
  [[nodiscard]] Path<Scalar> best_between(const Known& low, const Known& high, const Scalar& z,
                                          const Scalar& t) const;
  /// The same between two fans of one source and one way, where it must be one, too; kind none where that is not known.
  [[nodiscard]] Path<Scalar> fan_between(const Known& low, const Known& high, const Scalar& z,
                                         const Scalar& t) const;
  /// Fluxes that are no parabolas.
  [[nodiscard]] Path<Scalar> search_for_law(const SlopedPlace<Scalar>& place, const Scalar& t,
                                            const Scalar& upper, bool moving_only) const;
  /// Of a path at the rate r of a piece.
  [[nodiscard]] LawState<Scalar> state_on(const Path<Scalar>& path, std::size_t piece, const Scalar& r,
                                          bool is_up) const;
  /// Of a pure state between two heights of a piece.
  [[nodiscard]] Scalar pure_time_inside(std::size_t k, const Scalar& a, const Scalar& b, bool is_up) const;
  void set_pure_times();
  struct Costs {
    Scalar T{0}, X{0};
  };
  void add_run(const Path<Scalar>& path, const Scalar& from, const Scalar& to, Costs& costs) const;
  void add_turn(const Path<Scalar>& path, std::size_t piece, const Scalar& r, bool is_set_up,
                Costs& costs) const;

  std::shared_ptr<const PieceFluxes<Scalar>> fluxes_;
  SlopedPieces<Scalar> pieces_;
  SlopedView<Scalar> up_, down_;
  SlopedThroats<Scalar> throats_;
  std::vector<Scalar> from_bottom_, from_top_;  ///< times of pure states to the boundaries
};

}  // namespace shearfront::exact
