// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/hopf_lax/l1_error.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "shearfront/hopf_lax/general_medium.hpp"
#include "shearfront/hopf_lax/medium.hpp"
#include "shearfront/numeric/contract.hpp"

namespace shearfront {
namespace {

template <Real Scalar>
Scalar size_of(const Scalar& x) {
  return x < 0 ? Scalar(-x) : x;
}

/// The exact solution at a height, approached from above or from below, and how its path begins.
template <Real Scalar>
struct Node {
  Scalar z, M, phi;
  hopf_lax::PathKind kind;
  bool upward;
  std::size_t source, interface;

  [[nodiscard]] bool is_of_family(const Node& other) const {
    return kind == other.kind && upward == other.upward && source == other.source &&
           interface == other.interface;
  }
};

template <Real Scalar>
class L1Integral {
 public:
  L1Integral(const ExactSolution<Scalar>& exact, const Profile<Scalar>& profile, const Scalar& t)
      : exact_(exact), profile_(profile), t_(t) {
    const Scene<Scalar>& scene = exact.scene();
    const Scalar u = unit_roundoff<Scalar>(), height = scene.top() - scene.bottom();
    noise_ = Scalar(8) * u * height;
    narrow_ = Scalar(4) * u * std::max({height, size_of(scene.top()), size_of(scene.bottom())});
    if (const auto* layered = dynamic_cast<const hopf_lax::LayeredMedium<Scalar>*>(&exact.medium()))
      boundaries_ = layered->layers().boundaries();
    else if (const auto* general = dynamic_cast<const hopf_lax::GeneralMedium<Scalar>*>(&exact.medium()))
      boundaries_ = general->layers().boundaries();
    else
      boundaries_ = {scene.bottom(), scene.top()};
  }

  ProfileErrors<Scalar> run() {
    const std::vector<Scalar>& z = profile_.z();
    std::size_t next = 1;  // the boundary ahead
    Node<Scalar> low = node(z.front());
    for (cell_ = 0; cell_ < profile_.n_cells(); ++cell_) {
      if (!(z[cell_ + 1] > z[cell_])) continue;
      while (next < boundaries_.size() && boundaries_[next] < z[cell_ + 1]) {
        split(low, below(boundaries_[next]));
        low = node(boundaries_[next]);
        ++next;
      }
      const bool is_boundary = next < boundaries_.size() && boundaries_[next] == z[cell_ + 1];
      const bool is_top = !(z[cell_ + 1] < exact_.scene().top());
      const Node<Scalar> high = is_top || !is_boundary ? node(z[cell_ + 1]) : below(z[cell_ + 1]);
      split(low, high);
      low = is_boundary && !is_top ? node(z[cell_ + 1]) : high;
      if (is_boundary) ++next;
    }
    errors_.l1 = sum_.value();
    errors_.l1_bound = Scalar(2) * noise_ * Scalar(static_cast<double>(errors_.n_pieces));
    return errors_;
  }

 private:
  Node<Scalar> node(const Scalar& z) const {
    const auto path = exact_.path(z, t_);
    const auto value = exact_.value_of(path, z, t_);
    return {z, value.M, value.phi, path.kind, path.upward, path.source, path.interface};
  }
  /// The limit from below at an interface.
  Node<Scalar> below(const Scalar& z) const {
    Node<Scalar> n = node(Scalar(z - narrow_ / Scalar(2)));
    n.M = exact_.M(z, t_);
    n.z = z;
    return n;
  }

  [[nodiscard]] Scalar slope() const {
    const Scalar width = profile_.z()[cell_ + 1] - profile_.z()[cell_];
    return (profile_.above()[cell_] - profile_.below()[cell_]) / width;
  }
  [[nodiscard]] Scalar phi_at(const Scalar& z) const {
    return profile_.below()[cell_] + slope() * (z - profile_.z()[cell_]);
  }
  /// phi - exact phi and M - exact M.
  [[nodiscard]] Scalar gap(const Node<Scalar>& n) const { return phi_at(n.z) - n.phi; }
  [[nodiscard]] Scalar M_gap(const Node<Scalar>& n) const {
    const Scalar d = n.z - profile_.z()[cell_];
    return (profile_.cumulative()[cell_] - n.M) + d * (profile_.below()[cell_] + slope() * d / Scalar(2));
  }

  void add(const Scalar& piece) {
    sum_ += size_of(piece);
    ++errors_.n_pieces;
  }

  /// The integral of the gap over a piece where it keeps its sign.
  void add_piece(const Node<Scalar>& a, const Node<Scalar>& b) {
    const Scalar begin = M_gap(a), end = M_gap(b);
    errors_.M_max = std::max({errors_.M_max, size_of(begin), size_of(end)});
    const Scalar change = end - begin, trapezoid = (b.z - a.z) * (gap(a) + gap(b)) / Scalar(2);
    add(size_of(Scalar(change - trapezoid)) <= noise_ ? trapezoid : change);
  }

  /// The same where it is linear and changes its sign.
  void add_linear(const Node<Scalar>& a, const Node<Scalar>& b) {
    const Scalar p = gap(a), q = gap(b), all = size_of(p) + size_of(q);
    if (all > 0) add(Scalar((b.z - a.z) * (p * p + q * q) / (Scalar(2) * all)));
  }

  [[nodiscard]] bool is_opposite(const Node<Scalar>& a, const Node<Scalar>& b) const {
    const Scalar p = gap(a), q = gap(b);
    return (p < 0 && q > 0) || (p > 0 && q < 0);
  }
  /// Neither phi decreases nor the exact one: without an overlap of their ranges the sign stays.
  [[nodiscard]] bool has_overlap(const Node<Scalar>& a, const Node<Scalar>& b) const {
    const Scalar p = phi_at(a.z), q = phi_at(b.z);
    return std::min(p, q) < std::max(a.phi, b.phi) && std::min(a.phi, b.phi) < std::max(p, q);
  }

  /// A piece with one kind of path.
  void add_smooth(const Node<Scalar>& a, const Node<Scalar>& b, int depth) {
    if (!(b.z > a.z)) return;
    const bool is_constant = profile_.below()[cell_] == profile_.above()[cell_];
    const bool opposite = is_opposite(a, b);
    if (!has_overlap(a, b) || (is_constant && !opposite)) return add_piece(a, b);
    const Scalar width = b.z - a.z;
    if (width * std::max(size_of(gap(a)), size_of(gap(b))) <= noise_ || depth == 0)
      return opposite ? add_linear(a, b) : add_piece(a, b);
    const Node<Scalar> middle = node(Scalar(a.z + width / Scalar(2)));
    const Scalar bend = size_of(Scalar(gap(a) - Scalar(2) * gap(middle) + gap(b)));
    if (width * bend <= noise_) return opposite ? add_linear(a, b) : add_piece(a, b);
    add_half(a, middle, bend, depth);
    add_half(middle, b, bend, depth);
  }

  void add_half(const Node<Scalar>& a, const Node<Scalar>& b, const Scalar& bend, int depth) {
    const Scalar p = gap(a), q = gap(b);
    const bool is_constant = profile_.below()[cell_] == profile_.above()[cell_];
    if (is_opposite(a, b)) {
      if (is_constant || size_of(Scalar(q - p)) > bend) return add_crossing(a, b);
    } else if (is_constant || std::min(size_of(p), size_of(q)) > bend / Scalar(2)) {
      return add_piece(a, b);
    }
    add_smooth(a, b, depth - 1);
  }

  /// One change of sign. The integral is stationary in its place, so half the digits of the place will do.
  void add_crossing(const Node<Scalar>& a, const Node<Scalar>& b) {
    using std::sqrt;
    const Scalar p = gap(a), q = gap(b);
    const Scalar close = sqrt(Scalar(noise_ * (b.z - a.z) / (Scalar(16) * size_of(Scalar(q - p)))));
    std::uintmax_t n = 200;
    const auto [low, high] = boost::math::tools::toms748_solve(
        [&](const Scalar& z) { return Scalar(phi_at(z) - node(z).phi); }, a.z, b.z, p, q,
        [&](const Scalar& x, const Scalar& y) { return y - x <= close; }, n);
    const Node<Scalar> middle = node(Scalar(low + (high - low) / Scalar(2)));
    add_piece(a, middle);
    add_piece(middle, b);
  }

  /// Where the lines of M through both ends cross, as a part of the way; 1/2 if phi does not jump down.
  static Scalar intersection(const Node<Scalar>& a, const Node<Scalar>& b) {
    const Scalar jump = a.phi - b.phi, width = b.z - a.z;
    if (!(jump > Scalar(1e-3))) return Scalar(0.5);
    return ((b.M - a.M) - b.phi * width) / (jump * width);
  }

  /// A piece of one cell in one layer: cut where the kind of path changes.
  void split(const Node<Scalar>& a, const Node<Scalar>& b) {
    if (!(b.z > a.z)) return;
    if (a.is_of_family(b)) return add_smooth(a, b, kMostHalvings);
    Node<Scalar> low = a, high = b;
    Scalar margin = Scalar(1) / Scalar(16);
    bool is_low = true;  // side of the intersection that is tried next
    for (int n = 0; high.z - low.z > narrow_; ++n) {
      const Scalar width = high.z - low.z;
      Scalar z = low.z + width / Scalar(2);
      const bool is_bisection = n % 4 == 3;
      if (!is_bisection) {
        const Scalar part = intersection(low, high) + (is_low ? Scalar(-margin) : margin);
        if (part > 0 && part < 1) z = low.z + width * part;
      }
      if (!(z > low.z && z < high.z)) z = low.z + width / Scalar(2);
      if (!(z > low.z && z < high.z)) break;
      const Node<Scalar> middle = node(z);
      const bool is_below = middle.is_of_family(low);
      if (!is_below && !middle.is_of_family(high)) {
        add_smooth(a, low, kMostHalvings);
        split(low, middle);
        split(middle, high);
        return add_smooth(high, b, kMostHalvings);
      }
      if (!is_bisection) adapt(is_below == is_low, margin, is_low);
      (is_below ? low : high) = middle;
    }
    add_smooth(a, low, kMostHalvings);
    add_piece(low, high);
    add_smooth(high, b, kMostHalvings);
  }

  /// Intersections converge quadratically; after a miss more room is left.
  static void adapt(bool is_hit, Scalar& margin, bool& is_low) {
    using std::sqrt;
    if (!is_hit)
      margin = std::min(Scalar(0.25), Scalar(sqrt(margin)));
    else if (!is_low)
      margin = std::max(Scalar(margin * margin), Scalar(unit_roundoff<Scalar>()));
    if (is_hit) is_low = !is_low;
  }

  static constexpr int kMostHalvings = 40;

  const ExactSolution<Scalar>& exact_;
  const Profile<Scalar>& profile_;
  Scalar t_, noise_, narrow_;
  std::vector<Scalar> boundaries_;
  std::size_t cell_ = 0;
  CompensatedSum<Scalar> sum_;
  ProfileErrors<Scalar> errors_;
};

/// The exact solution where it is constant in pieces: at t = 0 and in the steady state.
template <Real Scalar>
Profile<Scalar> profile_at_rest(const ExactSolution<Scalar>& exact, bool is_initial) {
  const Scene<Scalar>& scene = exact.scene();
  std::vector<Scalar> z{scene.bottom()}, phi;
  if (is_initial) {
    phi = scene.initial_values();
    z.insert(z.end(), scene.initial_breaks().begin(), scene.initial_breaks().end());
  } else {
    phi = {Scalar(1), Scalar(0)};
    z.push_back(exact.steady_height());
  }
  z.push_back(scene.top());
  return {std::move(z), phi, phi};
}

template <Real Scalar>
ProfileErrors<Scalar> errors_at_rest(const Profile<Scalar>& exact, const Profile<Scalar>& profile) {
  ProfileErrors<Scalar> errors;
  errors.l1 = l1_distance(profile, exact);
  for (const auto* edges : {&profile.z(), &exact.z()})
    for (const Scalar& z : *edges)
      errors.M_max = std::max(errors.M_max, size_of(Scalar(profile.at(z).M - exact.at(z).M)));
  errors.n_pieces = profile.n_cells() + exact.n_cells();
  errors.l1_bound = Scalar(16) * unit_roundoff<Scalar>() * (profile.z().back() - profile.z().front()) *
                    Scalar(static_cast<double>(errors.n_pieces));
  return errors;
}

}  // namespace

template <Real Scalar>
ProfileErrors<Scalar> errors_against(const ExactSolution<Scalar>& exact, const Profile<Scalar>& profile,
                                     const Scalar& t) {
  SHEARFRONT_EXPECTS(profile.n_cells() > 0 && t >= Scalar(0), "a profile at a time");
  // |phi - exact phi| dz = |u - exact u| dy: the normal form has the same errors.
  if (exact.image()) return errors_against(*exact.image(), exact.normal_form()->image_of(profile), t);
  if (t == Scalar(0) || !is_finite(t)) return errors_at_rest(profile_at_rest(exact, t == Scalar(0)), profile);
  return L1Integral<Scalar>(exact, profile, t).run();
}

template ProfileErrors<double> errors_against(const ExactSolution<double>&, const Profile<double>&,
                                              const double&);
template ProfileErrors<Real50> errors_against(const ExactSolution<Real50>&, const Profile<Real50>&,
                                              const Real50&);

}  // namespace shearfront
