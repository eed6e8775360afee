// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/l1_error.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "shearfront/exact/smooth_pieces.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {
namespace {

template <Real Scalar>
Scalar size_of(const Scalar& x) {
  return x < 0 ? Scalar(-x) : x;
}

template <Real Scalar>
class L1Integral {
 public:
  L1Integral(const ExactSolution<Scalar>& exact, const Profile<Scalar>& profile, const Scalar& t)
      : pieces_(exact, t), profile_(profile), top_(exact.medium().top()) {
    noise_ = Scalar(8) * unit_roundoff<Scalar>() * (top_ - exact.medium().bottom());
  }

  ProfileErrors<Scalar> run() {
    const std::vector<Scalar>& z = profile_.z();
    const std::vector<Scalar>& boundaries = pieces_.boundaries();
    std::size_t next = 1;  // the boundary ahead
    Node low = pieces_.node(z.front());
    for (cell_ = 0; cell_ < profile_.n_cells(); ++cell_) {
      if (!(z[cell_ + 1] > z[cell_])) continue;
      while (next < boundaries.size() && boundaries[next] < z[cell_ + 1]) {
        split(low, pieces_.below(boundaries[next]));
        low = pieces_.node(boundaries[next]);
        ++next;
      }
      const bool is_boundary = next < boundaries.size() && boundaries[next] == z[cell_ + 1];
      const bool is_top = !(z[cell_ + 1] < top_);
      const Node high = is_top || !is_boundary ? pieces_.node(z[cell_ + 1]) : pieces_.below(z[cell_ + 1]);
      split(low, high);
      low = is_boundary && !is_top ? pieces_.node(z[cell_ + 1]) : high;
      if (is_boundary) ++next;
    }
    errors_.l1 = sum_.value();
    errors_.l1_bound = Scalar(2) * noise_ * Scalar(static_cast<double>(errors_.n_pieces));
    return errors_;
  }

 private:
  using Node = exact::PathNode<Scalar>;

  /// A piece of one cell in one layer.
  void split(const Node& a, const Node& b) {
    pieces_.split(
        a, b, [&](const Node& low, const Node& high) { add_smooth(low, high, kMostHalvings); },
        [&](const Node& low, const Node& high) { add_piece(low, high); });
  }

  [[nodiscard]] Scalar slope() const {
    const Scalar width = profile_.z()[cell_ + 1] - profile_.z()[cell_];
    return (profile_.above()[cell_] - profile_.below()[cell_]) / width;
  }
  [[nodiscard]] Scalar phi_at(const Scalar& z) const {
    return profile_.below()[cell_] + slope() * (z - profile_.z()[cell_]);
  }
  /// phi - exact phi and M - exact M.
  [[nodiscard]] Scalar gap(const Node& n) const { return phi_at(n.z) - n.phi; }
  [[nodiscard]] Scalar M_gap(const Node& n) const {
    const Scalar d = n.z - profile_.z()[cell_];
    return (profile_.cumulative()[cell_] - n.M) + d * (profile_.below()[cell_] + slope() * d / Scalar(2));
  }

  void add(const Scalar& piece) {
    sum_ += size_of(piece);
    ++errors_.n_pieces;
  }

  /// The integral of the gap over a piece where it keeps its sign.
  void add_piece(const Node& a, const Node& b) {
    const Scalar begin = M_gap(a), end = M_gap(b);
    errors_.M_max = std::max({errors_.M_max, size_of(begin), size_of(end)});
    const Scalar change = end - begin, trapezoid = (b.z - a.z) * (gap(a) + gap(b)) / Scalar(2);
    add(size_of(Scalar(change - trapezoid)) <= noise_ ? trapezoid : change);
  }

  /// The same where it is linear and changes its sign.
  void add_linear(const Node& a, const Node& b) {
    const Scalar p = gap(a), q = gap(b), all = size_of(p) + size_of(q);
    if (all > 0) add(Scalar((b.z - a.z) * (p * p + q * q) / (Scalar(2) * all)));
  }

  [[nodiscard]] bool is_constant() const { return profile_.below()[cell_] == profile_.above()[cell_]; }
  [[nodiscard]] bool is_opposite(const Node& a, const Node& b) const {
    const Scalar p = gap(a), q = gap(b);
    return (p < 0 && q > 0) || (p > 0 && q < 0);
  }
  /// Neither phi decreases nor the exact one: without an overlap of their ranges the sign stays.
  [[nodiscard]] bool has_overlap(const Node& a, const Node& b) const {
    const Scalar p = phi_at(a.z), q = phi_at(b.z);
    return std::min(p, q) < std::max(a.phi, b.phi) && std::min(a.phi, b.phi) < std::max(p, q);
  }

  /// A piece with one kind of path.
  void add_smooth(const Node& a, const Node& b, int depth) {
    if (!(b.z > a.z)) return;
    const bool opposite = is_opposite(a, b);
    if (pieces_.is_monotone() && (!has_overlap(a, b) || (is_constant() && !opposite))) return add_piece(a, b);
    const Scalar width = b.z - a.z;
    if (width * std::max(size_of(gap(a)), size_of(gap(b))) <= noise_ || depth == 0)
      return opposite ? add_linear(a, b) : add_piece(a, b);
    const Node middle = pieces_.node(Scalar(a.z + width / Scalar(2)));
    const Scalar bend = size_of(Scalar(gap(a) - Scalar(2) * gap(middle) + gap(b)));
    if (width * bend <= noise_) return opposite ? add_linear(a, b) : add_piece(a, b);
    add_half(a, middle, bend, depth);
    add_half(middle, b, bend, depth);
  }

  void add_half(const Node& a, const Node& b, const Scalar& bend, int depth) {
    const Scalar p = gap(a), q = gap(b);
    const bool one_change = is_constant() && pieces_.is_monotone();
    if (is_opposite(a, b)) {
      if (one_change || size_of(Scalar(q - p)) > bend) return add_crossing(a, b);
    } else if (one_change || std::min(size_of(p), size_of(q)) > bend / Scalar(2)) {
      return add_piece(a, b);
    }
    add_smooth(a, b, depth - 1);
  }

  /// One change of sign. The integral is stationary in its place, so half the digits of the place will do.
  void add_crossing(const Node& a, const Node& b) {
    using std::sqrt;
    const Scalar p = gap(a), q = gap(b);
    const Scalar close = sqrt(Scalar(noise_ * (b.z - a.z) / (Scalar(16) * size_of(Scalar(q - p)))));
    std::uintmax_t n = 200;
    const auto [low, high] = boost::math::tools::toms748_solve(
        [&](const Scalar& z) { return Scalar(phi_at(z) - pieces_.node(z).phi); }, a.z, b.z, p, q,
        [&](const Scalar& x, const Scalar& y) { return y - x <= close; }, n);
    const Node middle = pieces_.node(Scalar(low + (high - low) / Scalar(2)));
    add_piece(a, middle);
    add_piece(middle, b);
  }

  static constexpr int kMostHalvings = 40;

  exact::SmoothPieces<Scalar> pieces_;
  const Profile<Scalar>& profile_;
  Scalar top_, noise_;
  std::size_t cell_ = 0;
  CompensatedSum<Scalar> sum_;
  ProfileErrors<Scalar> errors_;
};

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
  // |phi - exact phi| dz = |u - exact u| dy: the canonical form has the same errors.
  const Profile<Scalar> image = exact.form().image_of(profile);
  if (exact::is_at_rest(exact, t))
    return errors_at_rest(exact::profile_at_rest(exact, t == Scalar(0)), image);
  return L1Integral<Scalar>(exact, image, t).run();
}

template ProfileErrors<Instantiated> errors_against(const ExactSolution<Instantiated>&,
                                                    const Profile<Instantiated>&, const Instantiated&);

}  // namespace shearfront
