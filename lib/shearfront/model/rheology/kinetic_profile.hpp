// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// The granular temperature of a bed sheared under a lid: w(z) = sqrt(T(z) / T(lid)), the positive solution of
///
///     y^2 w_yy + y w_y + (nu^2 - y^2 / length^2) w = 0,   y = load + lid - z,   w' = 0 at ground and lid:
///
/// the steady balance of heating by shear, conduction and dissipation in a granular fluid whose pressure grows with the weight
/// above, y its pressure as a height of bed. One nu only has a positive w, the smallest; nu length / load is the shear stress over that
/// which friction holds at the lid, between 1 and sqrt(int y dz / int dz / y) / load. w rises from the ground to the lid.
///
/// Method: the Riccati variable y w'/w is marched upwards from 0 at the ground, from node to node by the power series of w (recursion
/// of four terms) about each, and nu found by Newton's method such that it is 0 at the lid. Upwards w grows, so that its relative
/// error is a few roundoffs per node over any contrast. Derivatives by the same march of first-order jets.
/// Domain: length > 0, load > 0, ground < lid, n_nodes() <= kMostNodes. Cost: about 0.2 ms; value() 40 ns. Immutable, safe to
/// share. Source: equations of dense granular flow after Savage (1998) with the closures eta = eta0 p / sqrt T, lambda = lambda0
/// p / sqrt T, dissipation eps0 p sqrt T, whose length is sqrt(4 lambda0 / (3 eps0)).
template <Real Scalar>
class KineticProfile {
 public:
  /// What w depends on, in the order of derivatives.
  struct Bed {
    Scalar length{1}, load{1}, ground{0}, lid{1};
    friend bool operator==(const Bed&, const Bed&) = default;
  };
  static constexpr std::size_t kNumbers = 4, kMostNodes = 1 << 14;
  using Gradient = std::array<Scalar, kNumbers>;
  struct Value {
    Scalar w{1};
    Gradient by{};
  };
  /// int (hi - z)^k / w dz over [lo, hi], k = 0, 1, 2, and its derivatives, the ends held fixed.
  struct Slowness {
    std::array<Scalar, 3> moment{};
    std::array<Gradient, 3> by{};
  };

  explicit KineticProfile(const Bed& bed);
  /// The one of this bed: that of an earlier call if it is among the last of this thread.
  [[nodiscard]] static std::shared_ptr<const KineticProfile> of(const Bed& bed);
  /// How many nodes it takes; more than kMostNodes where w would vanish at the ground.
  [[nodiscard]] static std::size_t n_nodes(const Bed& bed);

  [[nodiscard]] const Bed& bed() const { return bed_; }
  /// nu length / load: shear stress over friction times the pressure at the lid, >= 1.
  [[nodiscard]] Scalar stress() const;
  [[nodiscard]] Scalar nu() const;
  [[nodiscard]] Scalar value(const Scalar& z) const;
  [[nodiscard]] Value with_derivatives(const Scalar& z) const;
  [[nodiscard]] Slowness slowness(const Scalar& lo, const Scalar& hi, bool with_derivatives) const;

 private:
  /// w = scale sum c_n (z - z_node)^n up to the next node.
  struct Node {
    Scalar z, scale;
    Gradient by_log{};  ///< of log scale
    std::vector<Scalar> c;
    std::array<std::vector<Scalar>, kNumbers> by;  ///< of c
  };
  [[nodiscard]] const Node& node_at(const Scalar& z) const;

  Bed bed_;
  Scalar excess_{0};  ///< nu^2 - (load / length)^2
  std::vector<Node> nodes_;
};

extern template class KineticProfile<double>;

}  // namespace shearfront
