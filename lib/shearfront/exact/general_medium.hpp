// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include "shearfront/exact/path.hpp"
#include "shearfront/exact/cells.hpp"
#include "shearfront/exact/canonical_form.hpp"
#include "shearfront/exact/unimodal_law.hpp"

namespace shearfront::exact {

/// The Lax-Hopf formula in a stack of layers, each with its own convex flux (in the canonical form of a scene).
///
/// In layer k a path with the conserved H has e_k = 1 - H / C_k, C_k the capacity, and the momentum
/// p_k = peak +- d_k(e_k) (exact/unimodal_law.hpp), + going up, at the speed C_k e_k'(d_k). From x to z in
/// the time t the cost is the largest value over 0 <= H <= min C_k of
///
///     H t + sum +-p_k(H) (distance in layer k),     where T(H) = t, or at H = min C_k if T is less than t
///     there:
///
/// then the path rests, or, in a flux with a kink, moves more slowly than its states do at no extra cost.
/// Candidates: fans from all initial jumps and interfaces; the same resting at an interface at its capacity
/// H_i = min(C_below, C_above), coming from either side and leaving to either side; constant initial states.
/// Only what cannot start an optimal path is left out (LayeredMedium says why).
///
/// Path::r_reference is 4 min C_k and H = min C_k (1 - x^2).
/// Cost: construction O(layers (layers + jumps)); a query O(layers crossed) per source, about ten times that
/// of a root of T. Immutable after construction, safe to share between threads.
template <Real Scalar>
class GeneralMedium final : public Medium<Scalar> {
 public:
  explicit GeneralMedium(const CanonicalForm<Scalar>& form);

  [[nodiscard]] Path<Scalar> best_free(const Scalar& z, const Scalar& t,
                                            const Scalar& upper) const override;
  [[nodiscard]] Path<Scalar> best_moving(const Scalar& z, const Scalar& t) const override;
  [[nodiscard]] Scalar pure_travel_time(const Scalar& from, const Scalar& to) const override;
  [[nodiscard]] Scalar shortfall(const Path<Scalar>& path, const Scalar& z, const Scalar& t,
                                 FinalAmount amount) const override;
  [[nodiscard]] Scalar rate_at(const Scalar& z) const override {
    return Scalar(4) * capacity_[layers_.layer_at(z)];
  }
  [[nodiscard]] Scalar flux_at(const Scalar& z, const Scalar& phi) const override;

  [[nodiscard]] const LayerStack<Scalar>& layers() const { return layers_; }
  [[nodiscard]] const Cells<Scalar>& cells() const { return cells_; }
  [[nodiscard]] const Scalar& capacity(std::size_t k) const { return capacity_[k]; }
  [[nodiscard]] const UnimodalLaw<Scalar>& law(std::size_t k) const { return laws_[law_of_[k]]; }
  /// e_k of a path with H = reference (1 - x^2).
  [[nodiscard]] Scalar lack(std::size_t k, const Scalar& reference, const Scalar& x) const {
    return ((capacity_[k] - reference) + reference * x * x) / capacity_[k];
  }

 private:
  struct Query {
    Scalar z, t;
    std::size_t k;
    bool moving_only;
  };
  /// Travel time and sum +-p d of a part of a path.
  struct Leg {
    Scalar time{0}, cost{0};
  };
  /// A start from which an interface is reached with its H: value A on arrival after the time tau.
  struct Entry {
    Scalar tau, A;
    std::size_t source;
  };
  struct Rest {
    Scalar H;
    std::vector<Leg> up, down;   ///< from the interface to the boundaries above (below), itself first
    std::vector<Entry> entries;  ///< tau increasing, A decreasing
  };
  [[nodiscard]] Scalar flux_of(std::size_t k, const Scalar& phi) const;
  void add_layer(std::size_t k, const Scalar& d, bool upward, const Scalar& reference, const Scalar& x,
                 Leg& leg) const;
  [[nodiscard]] Leg leg(const Scalar& from, const Scalar& to, const Scalar& reference, const Scalar& x) const;
  [[nodiscard]] Scalar momentum(std::size_t k, bool upward, const Scalar& reference, const Scalar& x) const;
  [[nodiscard]] bool emits(std::size_t i, bool upward) const;
  [[nodiscard]] Rest rest_at(std::size_t i) const;
  [[nodiscard]] Path<Scalar> search(const Query& query) const;
  void try_source(const Query& query, std::size_t i, bool upward, const Scalar& reference,
                  Path<Scalar>& best) const;
  void try_cell(const Query& query, std::size_t i, bool upward, const Scalar& slowest,
                Path<Scalar>& best) const;
  void try_rest(const Query& query, std::size_t i, Path<Scalar>& best) const;

  LayerStack<Scalar> layers_;
  Cells<Scalar> cells_;
  std::vector<UnimodalLaw<Scalar>> laws_;
  std::vector<std::size_t> law_of_;
  std::vector<Scalar> capacity_, H_cell_;
  std::vector<bool> emits_up_, emits_down_;
  std::vector<Rest> rests_;  ///< per boundary; the walls' stay empty
};

extern template class GeneralMedium<double>;

}  // namespace shearfront::exact
