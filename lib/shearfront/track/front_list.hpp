// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shearfront/numeric/scalar.hpp"
#include "shearfront/riemann/state.hpp"
#include "shearfront/track/observers.hpp"

namespace shearfront {

/// Slot of a front or boundary in a FrontList.
using FrontIndex = std::uint32_t;
inline constexpr FrontIndex kNoFront = UINT32_MAX;

/// A front, or a boundary (interface or wall), which rests. A cache line of its own for every front of
/// doubles.
template <Real Scalar>
struct alignas(std::same_as<Scalar, double> ? 64 : alignof(Scalar)) FrontNode {
  Scalar z{0}, z_low{0}, t{0};  // passes z + z_low at time t
  Scalar speed{0};
  Scalar meets{0};  // when it meets its upper neighbour; infinity if never
  State below = 0, above = 0;
  FrontIndex prev = kNoFront, next = kNoFront;
  std::uint32_t layer = 0;  // of a front; of a boundary the layer above it
  std::uint32_t stamp = 0;

  /// How far it has moved from z at time `now`.
  [[nodiscard]] Scalar moved(const Scalar& now) const { return z_low + speed * (now - t); }
  [[nodiscard]] Scalar position(const Scalar& now) const { return z + moved(now); }
};

/// Fronts and boundaries from bottom to top, linked; nodes 0 .. n_layers are the boundaries, all others
/// fronts. Slots of fronts that are gone are used again. Cost: O(1) per operation.
template <Real S, class NodeType = FrontNode<S>>
class FrontList {
 public:
  using Scalar = S;
  using Node = NodeType;

  /// Only the boundaries, at the given heights; room for `n_fronts` fronts.
  template <class Grid>
  FrontList(const Grid& grid, std::size_t n_fronts) : n_boundaries_(grid.n_layers() + 1) {
    const std::size_t n = n_boundaries_;
    nodes_.reserve(n + n_fronts);
    nodes_.resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      Node& b = nodes_[k];
      b.z = grid.boundary(k);
      b.layer = static_cast<std::uint32_t>(k);
      b.meets = infinity<Scalar>();
      b.prev = k == 0 ? kNoFront : static_cast<FrontIndex>(k - 1);
      b.next = k + 1 == n ? kNoFront : static_cast<FrontIndex>(k + 1);
    }
  }

  [[nodiscard]] Node& operator[](FrontIndex i) { return nodes_[i]; }
  [[nodiscard]] const Node& operator[](FrontIndex i) const { return nodes_[i]; }
  [[nodiscard]] std::size_t n_boundaries() const { return n_boundaries_; }
  [[nodiscard]] std::size_t n_fronts() const { return n_fronts_; }
  [[nodiscard]] bool is_boundary(FrontIndex i) const { return i < n_boundaries_; }
  [[nodiscard]] FrontView<Scalar> view_of(FrontIndex i) const {
    const Node& n = nodes_[i];
    return {is_boundary(i) ? static_cast<std::size_t>(i) : n.layer, n.t, n.z, n.speed, n.below, n.above, i};
  }
  /// visit(index, node) from bottom to top.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (FrontIndex i = 0; i != kNoFront; i = nodes_[i].next) visit(i, nodes_[i]);
  }

  /// A slot above node `under`, its stamp unlike any before; the caller fills in the front. References to
  /// nodes become invalid.
  FrontIndex insert_above(FrontIndex under) {
    const FrontIndex i = allocate();
    Node& n = nodes_[i];
    Node& u = nodes_[under];
    n.prev = under;
    n.next = u.next;
    if (u.next != kNoFront) nodes_[u.next].prev = i;
    u.next = i;
    ++n.stamp;
    ++n_fronts_;
    return i;
  }
  void remove(FrontIndex i) {
    const Node& n = nodes_[i];
    nodes_[n.prev].next = n.next;
    nodes_[n.next].prev = n.prev;
    free_.push_back(i);
    --n_fronts_;
  }

 private:
  FrontIndex allocate() {
    if (!free_.empty()) {
      const FrontIndex i = free_.back();
      free_.pop_back();
      return i;
    }
    nodes_.emplace_back();
    return static_cast<FrontIndex>(nodes_.size() - 1);
  }

  std::vector<Node> nodes_;
  std::vector<FrontIndex> free_;
  std::size_t n_boundaries_, n_fronts_ = 0;
};

}  // namespace shearfront
