// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shearfront/model/depth/model.hpp"
#include "shearfront/model/field.hpp"
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

/// The bed of a kinetic model: its numbers, the walls of the cell, and the profile that belongs to them. Walls that are not given
/// (ground = lid) are the ends of the domain, which prepare() tells; without it 0 and 1.
template <Real Scalar>
struct KineticBed {
  Scalar length{1}, load{1}, ground{0}, lid{0};

  /// Solves for the profile once, so that copies share it. Before it is called, and after an entry has changed, value() looks it up.
  void prepare(const Scalar& bottom, const Scalar& top) {
    if (!has_walls()) bottom_ = bottom, top_ = top;
    if (is_solvable()) profile_ = KineticProfile<Scalar>::of(bed());
  }
  void check(const std::string& prefix, const Scalar& bottom, const Scalar& top,
             Complaints& complaints) const {
    if (!(length > 0) || !(load > 0) || !is_finite(length) || !is_finite(load) || !is_finite(ground) ||
        !is_finite(lid))
      return;  // reported elsewhere
    if (has_walls() && ground > bottom)
      complaints.push_back({prefix + "ground", number_text(ground),
                            "must not lie above the bottom of the domain (" + number_text(bottom) + ")"});
    if (has_walls() && lid < top)
      complaints.push_back({prefix + "lid", number_text(lid),
                            "must not lie below the top of the domain (" + number_text(top) + ")"});
    KineticBed own = *this;
    own.prepare(bottom, top);
    if ((!has_walls() || ground < lid) && !own.is_solvable())
      complaints.push_back(
          {prefix + "length", number_text(length), "must not be so small that a(z) vanishes at the ground"});
  }
  [[nodiscard]] const KineticProfile<Scalar>& profile() const {
    if (profile_ && profile_->bed() == bed()) return *profile_;
    return *KineticProfile<Scalar>::of(bed());
  }
  /// The pressure at a height, as the height of the bed that weighs as much.
  [[nodiscard]] Scalar depth(const Scalar& z) const { return load + ((has_walls() ? lid : top_) - z); }
  /// Adds what depth() gains with its entries, `first` the place of length among them.
  template <class Add>
  void add_depth(std::size_t first, const Add& add) const {
    add(first + 1, Scalar(1));
    if (has_walls()) add(first + 3, Scalar(1));
  }
  /// Which of a profile's numbers are entries: the walls only where they are given.
  [[nodiscard]] std::size_t n_numbers() const { return has_walls() ? 4 : 2; }

 private:
  [[nodiscard]] bool has_walls() const { return ground != lid; }
  [[nodiscard]] typename KineticProfile<Scalar>::Bed bed() const {
    return {length, load, has_walls() ? ground : bottom_, has_walls() ? lid : top_};
  }
  [[nodiscard]] bool is_solvable() const {
    const auto b = bed();
    return length > 0 && load > 0 && is_finite(length) && is_finite(load) && b.ground < b.lid &&
           is_finite(b.ground) && is_finite(b.lid) &&
           KineticProfile<Scalar>::n_nodes(b) <= KineticProfile<Scalar>::kMostNodes;
  }

  Scalar bottom_{0}, top_{1};
  std::shared_ptr<const KineticProfile<Scalar>> profile_;
};

/// Shear rate of a granular bed under a moving lid, from its granular temperature T: a(z) = amplitude sqrt(T(z) / T(lid)), the
/// speed at which pure grains segregate in it (KineticProfile). `length` is how far fluctuations are conducted, sqrt(4 lambda0 / (3
/// eps0)) of the grains, `load` the weight of the lid as a height of bed. The shape depends on length and load over the height of the cell
/// only, not on the speed of the lid; the amplitude is S0 sqrt(T(lid)) g.
///
/// Domain: amplitude > 0 (1/time when s = 1), length > 0, load > 0 (without load no steady flow has T > 0), unit of z; ground and lid are
/// the walls of the cell, which must enclose the domain: its ends if not given. A light lid (load < height) sets length and load apart, a heavy one
/// (length << height << load) only length^2 load: w is then Ai(s/d - 1.0188) / Ai(-1.0188), s = lid - z, d = (length^2 load / 2)^(1/3).
/// Source: Savage (1998), J. Fluid Mech. 377, 1, whose equations are reduced to one of second order.
template <Real Scalar>
struct Kinetic : KineticBed<Scalar> {
  static constexpr std::string_view kName = "kinetic";
  static constexpr std::string_view kFormula = "amplitude sqrt(T(z)/T(lid)) of a sheared bed under a lid";
  static constexpr bool kIsLayered = false;

  Scalar amplitude{1};

  template <class Self, class Visit>
  static void fields(Self& self, Visit&& visit) {
    visit(FieldInfo{"amplitude", Range::positive}, self.amplitude);
    visit(FieldInfo{.key = "length", .range = Range::positive, .also = "not far below the bed's"},
          self.length);
    visit(FieldInfo{"load", Range::positive}, self.load);
    visit(
        FieldInfo{
            .key = "ground", .is_optional = true, .measure = Measure::height, .also = "not above the bottom"},
        self.ground);
    visit(
        FieldInfo{.key = "lid", .is_optional = true, .measure = Measure::height, .also = "not below the top"},
        self.lid);
  }

  [[nodiscard]] Scalar value(const Scalar& z) const { return amplitude * this->profile().value(z); }
  /// By quadrature from node to node of the profile: a few roundoffs.
  [[nodiscard]] Scalar harmonic_mean(const Scalar& lo, const Scalar& hi) const {
    if (!(hi > lo)) return value(lo);
    return amplitude * ((hi - lo) / this->profile().slowness(lo, hi, false).moment[0]);
  }
  template <class Add>
  void harmonic_mean_derivatives(const Scalar& lo, const Scalar& hi, Add&& add) const {
    const auto slow = this->profile().slowness(lo, hi, true);
    const Scalar mean = (hi - lo) / slow.moment[0];
    add(0, mean);
    for (std::size_t e = 0; e < this->n_numbers(); ++e)
      add(1 + e, Scalar(-amplitude * mean * (slow.by[0][e] / slow.moment[0])));
  }
  template <class AddLow, class AddHigh>
  void end_value_derivatives(const Scalar& lo, const Scalar& hi, AddLow&& add_low, AddHigh&& add_high) const {
    const auto at = [&](const Scalar& z, auto& add) {
      const auto v = this->profile().with_derivatives(z);
      add(0, v.w);
      for (std::size_t e = 0; e < this->n_numbers(); ++e) add(1 + e, Scalar(amplitude * v.by[e]));
    };
    at(lo, add_low);
    at(hi, add_high);
  }
  [[nodiscard]] std::vector<Scalar> knots() const { return {}; }

  static std::vector<Kinetic> samples() {
    const auto make = [](double rate, double l, double weight, double low, double high) {
      Kinetic a;
      a.amplitude = Scalar(rate), a.length = Scalar(l), a.load = Scalar(weight);
      a.ground = Scalar(low), a.lid = Scalar(high);
      return a;
    };
    return {make(1, 0.1, 1, 0, 1), make(2, 0.3, 0.2, -0.25, 1.5), make(0.5, 0.05, 5, 0, 1)};
  }
};

}  // namespace shearfront
