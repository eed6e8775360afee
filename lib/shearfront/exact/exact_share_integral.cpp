// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/exact_share_integral.hpp"

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "shearfront/exact/smooth_pieces.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/quadrature.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront {
namespace {

using exact::PathNode;

/// c g(x) dz in the coordinates of the canonical form: g(share of u) times d(solid) / dy.
class Integrand {
 public:
  Integrand(const exact::CanonicalForm<double>& form, const ShareFunction& g) : form_(form), g_(g) {}

  void set_layer(std::size_t k) {
    layer_ = k;
    solid_ = 1 / std::abs(form_.state_slope(k));
  }
  [[nodiscard]] double operator()(double u) const { return g_.value(form_.share_of(u, layer_)) * solid_; }
  /// The states u where the slope of g jumps, in any order.
  [[nodiscard]] std::vector<double> kinks() const {
    std::vector<double> all = g_.kinks;
    for (double& x : all) x = form_.state_of(x, layer_);
    return all;
  }

 private:
  const exact::CanonicalForm<double>& form_;
  const ShareFunction& g_;
  std::size_t layer_ = 0;
  double solid_ = 1;
};

class ShareIntegral {
 public:
  ShareIntegral(const ExactSolution<double>& exact, const ShareFunction& g, double t)
      : exact_(exact), integrand_(exact.form(), g), pieces_(exact, t), t_(t) {}

  double run() {
    if (exact::is_at_rest(exact_, t_)) return at_rest(exact::profile_at_rest(exact_, t_ == 0));
    const exact::SmoothPieces<double>& pieces = pieces_;
    const std::vector<double>& z = pieces.boundaries();
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      integrand_.set_layer(k);
      kinks_ = integrand_.kinks();
      const bool is_top = k + 2 == z.size();
      pieces.split(
          pieces.node(z[k]), is_top ? pieces.node(z[k + 1]) : pieces.below(z[k + 1]),
          [&](const PathNode<double>& a, const PathNode<double>& b) { add_smooth(a, b); },
          [&](const PathNode<double>& a, const PathNode<double>& b) { add_gap(a, b); });
    }
    return sum_.value();
  }

 private:
  double at_rest(const Profile<double>& profile) {
    const exact::SmoothPieces<double> pieces(exact_, 1);
    const std::vector<double>& z = pieces.boundaries();
    std::size_t i = 0;
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      integrand_.set_layer(k);
      double lo = z[k];
      while (i < profile.n_cells()) {
        const double hi = std::min(z[k + 1], profile.z()[i + 1]);
        if (hi > lo) sum_ += (hi - lo) * integrand_(profile.below()[i]);
        lo = std::max(lo, hi);
        if (profile.z()[i + 1] > z[k + 1]) break;
        ++i;
      }
    }
    return sum_.value();
  }

  void add_gap(const PathNode<double>& a, const PathNode<double>& b) {
    sum_ += (b.z - a.z) * ((integrand_(a.phi) + integrand_(b.phi)) / 2);
  }

  /// A piece on which phi is smooth: cut at the kinks of g.
  void add_smooth(const PathNode<double>& a, const PathNode<double>& b) {
    if (!(b.z > a.z)) return;
    double lo = a.z;
    if (b.phi != a.phi) {
      std::vector<double> cuts;
      for (const double kink : kinks_)
        if (kink > std::min(a.phi, b.phi) && kink < std::max(a.phi, b.phi))
          cuts.push_back(height_of(kink, a, b));
      std::sort(cuts.begin(), cuts.end());
      for (const double z : cuts) {
        add(lo, z);
        lo = z;
      }
    }
    if (b.phi == a.phi && exact_.form().is_monotone())
      sum_ += (b.z - lo) * integrand_(a.phi);
    else
      add(lo, b.z);
  }

  [[nodiscard]] double state_at(double y) const { return pieces_.node(y).phi; }
  [[nodiscard]] double height_of(double phi, const PathNode<double>& a, const PathNode<double>& b) const {
    std::uintmax_t n = 100;
    const auto [lo, hi] = boost::math::tools::toms748_solve(
        [&](double z) { return state_at(z) - phi; }, a.z, b.z, a.phi - phi, b.phi - phi,
        [&](double x, double y) { return y - x <= 1e-13 * (b.z - a.z); }, n);
    return lo + (hi - lo) / 2;
  }

  void add(double lo, double hi) {
    if (!(hi > lo)) return;
    const auto value = [&](double z) { return integrand_(state_at(z)); };
    if (!exact_.is_exact()) {  // a rule of low order will do
      // Inside, for the ends may belong to the next piece.
      const double middle = lo + (hi - lo) / 2, half = (hi - lo) / 2 * std::sqrt(0.6);
      sum_ += (hi - lo) * ((5 * value(middle - half) + 8 * value(middle) + 5 * value(middle + half)) / 18);
      return;
    }
    // Relative to the whole bed: in a short piece the rounding of phi would be taken for structure.
    constexpr unsigned kMostHalvings = 8;
    const double tolerance = 1e-12 * ((exact_.medium().top() - exact_.medium().bottom()) / (hi - lo));
    sum_ += integral_of_smooth<double>(value, lo, hi, kMostHalvings, std::min(tolerance, 1e-3));
  }

  const ExactSolution<double>& exact_;
  Integrand integrand_;
  exact::SmoothPieces<double> pieces_;
  double t_;
  std::vector<double> kinks_;
  CompensatedSum<double> sum_;
};

}  // namespace

double share_integral(const ExactSolution<double>& exact, double t, const ShareFunction& g) {
  SHEARFRONT_EXPECTS(t >= 0 && g, "a time and a function");
  return ShareIntegral(exact, g, t).run();
}

}  // namespace shearfront
