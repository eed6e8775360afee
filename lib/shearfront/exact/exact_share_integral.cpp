// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/exact/exact_share_integral.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <valarray>
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

/// Visits the bed at one time, 0 < t < infinity: stretches in which phi and the slope of g are smooth, and what lies between them.
class ShareStretches {
 public:
  ShareStretches(const ExactSolution<double>& exact, const ShareFunction& g, double t)
      : exact_(exact), integrand_(exact.form(), g), pieces_(exact, t) {}
  virtual ~ShareStretches() = default;

  void visit() {
    const std::vector<double>& z = pieces_.boundaries();
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      const PathNode<double> low = pieces_.node(z[k]);
      if (k > 0) at_boundary(k, below_, low);
      integrand_.set_layer(k);
      kinks_ = integrand_.kinks();
      // In a fan phi bends where the slope of f does.
      for (const double share : exact_.form().scene().fluxes()[exact_.form().layers().flux_index(k)].joints())
        kinks_.push_back(exact_.form().state_of(share, k));
      const bool is_top = k + 2 == z.size();
      below_ = is_top ? pieces_.node(z[k + 1]) : pieces_.below(z[k + 1]);
      layer_ = {z[k], is_top ? z[k + 1] : std::nextafter(z[k + 1], z[k])};
      pieces_.split(
          low, below_, [&](const PathNode<double>& a, const PathNode<double>& b) { cut_at_kinks(a, b); },
          [&](const PathNode<double>& a, const PathNode<double>& b) { at_cut(a, b); });
    }
  }

 protected:
  /// From lo to hi; is_constant: u is.
  virtual void smooth(double lo, double hi, bool is_constant) = 0;
  /// A shock, the edge of a fan, or what else lies between a and b, a rounding error apart.
  virtual void at_cut(const PathNode<double>& a, const PathNode<double>& b) = 0;
  /// The inner boundary k of the form; the layer set is the one below.
  virtual void at_boundary(std::size_t /*k*/, const PathNode<double>& /*below*/,
                           const PathNode<double>& /*above*/) {}

  [[nodiscard]] const ExactSolution<double>& exact() const { return exact_; }
  [[nodiscard]] Integrand& integrand() { return integrand_; }
  [[nodiscard]] const exact::SmoothPieces<double>& pieces() const { return pieces_; }
  /// The lowest and the highest place in the layer.
  [[nodiscard]] std::pair<double, double> layer() const { return layer_; }

 private:
  void cut_at_kinks(const PathNode<double>& a, const PathNode<double>& b) {
    if (!(b.z > a.z)) return;
    double lo = a.z;
    if (b.phi != a.phi) {
      std::vector<double> cuts;
      for (const double kink : kinks_)
        if (kink > std::min(a.phi, b.phi) && kink < std::max(a.phi, b.phi))
          cuts.push_back(height_of(kink, a, b));
      std::sort(cuts.begin(), cuts.end());
      for (const double z : cuts) {
        if (z > lo) smooth(lo, z, false);
        lo = z;
      }
    }
    if (b.z > lo) smooth(lo, b.z, b.phi == a.phi && exact_.form().is_monotone());
  }
  [[nodiscard]] double height_of(double phi, const PathNode<double>& a, const PathNode<double>& b) const {
    std::uintmax_t n = 100;
    const auto [lo, hi] = boost::math::tools::toms748_solve(
        [&](double z) { return pieces_.node(z).phi - phi; }, a.z, b.z, a.phi - phi, b.phi - phi,
        [&](double x, double y) { return y - x <= 1e-13 * (b.z - a.z); }, n);
    return lo + (hi - lo) / 2;
  }

  const ExactSolution<double>& exact_;
  Integrand integrand_;
  exact::SmoothPieces<double> pieces_;
  std::vector<double> kinks_;
  PathNode<double> below_{};
  std::pair<double, double> layer_;
};

class ShareIntegral final : public ShareStretches {
 public:
  using ShareStretches::ShareStretches;

  double run() {
    visit();
    return sum_.value();
  }
  double at_rest(const Profile<double>& profile) {
    const std::vector<double>& z = pieces().boundaries();
    std::size_t i = 0;
    for (std::size_t k = 0; k + 1 < z.size(); ++k) {
      integrand().set_layer(k);
      double lo = z[k];
      while (i < profile.n_cells()) {
        const double hi = std::min(z[k + 1], profile.z()[i + 1]);
        if (hi > lo) sum_ += (hi - lo) * integrand()(profile.below()[i]);
        lo = std::max(lo, hi);
        if (profile.z()[i + 1] > z[k + 1]) break;
        ++i;
      }
    }
    return sum_.value();
  }

 private:
  void at_cut(const PathNode<double>& a, const PathNode<double>& b) override {
    sum_ += (b.z - a.z) * ((integrand()(a.phi) + integrand()(b.phi)) / 2);
  }
  void smooth(double lo, double hi, bool is_constant) override {
    const auto value = [&](double z) { return integrand()(pieces().node(z).phi); };
    if (is_constant) {
      sum_ += (hi - lo) * value(lo);
      return;
    }
    if (!exact().is_exact()) {  // a rule of low order will do
      // Inside, for the ends may belong to the next piece.
      const double middle = lo + (hi - lo) / 2, half = (hi - lo) / 2 * std::sqrt(0.6);
      sum_ += (hi - lo) * ((5 * value(middle - half) + 8 * value(middle) + 5 * value(middle + half)) / 18);
      return;
    }
    // Relative to the whole bed: in a short piece the rounding of phi would be taken for structure.
    constexpr unsigned kMostHalvings = 8;
    const double tolerance = 1e-12 * ((exact().medium().top() - exact().medium().bottom()) / (hi - lo));
    sum_ += integral_of_smooth<double>(value, lo, hi, kMostHalvings, std::min(tolerance, 1e-3));
  }

  CompensatedSum<double> sum_;
};

using EntryNumbers = std::valarray<double>;

/// int g'(phi / c) dphi dz, and what shocks and boundaries of the bed add by moving.
class ShareIntegralDerivatives final : public ShareStretches {
 public:
  ShareIntegralDerivatives(const ExactSolution<double>& exact, const Derivatives<double>& derivatives,
                           const ShareFunction& g, double t)
      : ShareStretches(exact, g, t),
        derivatives_(derivatives),
        form_(exact.form()),
        g_(g),
        t_(t),
        sum_(0.0, derivatives.n_entries()) {}

  EntryNumbers run() {
    visit();
    add_cut();
    return sum_;
  }
  EntryNumbers at_rest(const Profile<double>& profile) {
    std::vector<double> cuts = pieces().boundaries();
    cuts.insert(cuts.end(), profile.z().begin(), profile.z().end());
    std::sort(cuts.begin(), cuts.end());
    const double tiny = distance();
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (!(cuts[i + 1] - cuts[i] > 4 * tiny)) continue;
      const double middle = cuts[i] + (cuts[i + 1] - cuts[i]) / 2;
      sum_ += (cuts[i + 1] - cuts[i]) * by(middle);
      if (cuts[i] > cuts.front()) add_moving(at(cuts[i] - tiny), at(cuts[i] + tiny));
    }
    return sum_;
  }

 private:
  using At = Derivatives<double>::At;
  struct Side {
    At at;
    double amount;  ///< c g(phi / c)
  };

  [[nodiscard]] double share_at(const At& at, double z) const {
    return at.value.phi / form_.scene().solid_fraction_at(z);
  }
  /// At the height y of the form.
  [[nodiscard]] Side at(double y) const {
    const double z = form_.height_of(y);
    Side side{};
    if (t_ > 0 && std::isfinite(t_))
      derivatives_.along(exact().medium().best_path(y, t_), z, t_, side.at);
    else
      derivatives_.at(z, t_, side.at);
    side.amount = form_.scene().solid_fraction_at(z) * g_.value(share_at(side.at, z));
    return side;
  }
  /// g'(phi / c) dphi dz / dy.
  [[nodiscard]] EntryNumbers by(double y) const {
    const double z = form_.height_of(y);
    const Side here = at(y);
    const std::size_t k = form_.layers().layer_at(z);
    return array_of(here.at.phi) * (g_.slope(share_at(here.at, z)) / form_.stretch(k));
  }
  static EntryNumbers array_of(const std::vector<double>& x) { return {x.data(), x.size()}; }
  /// A jump of phi, at which M has one value.
  void add_moving(const Side& below, const Side& above) {
    constexpr double kSmallestJump = 1e-9;
    const double jump = above.at.value.phi - below.at.value.phi;
    if (!(std::abs(jump) > kSmallestJump)) return;
    sum_ += (array_of(above.at.M) - array_of(below.at.M)) * ((above.amount - below.amount) / jump);
  }

  /// At a little distance: where a contact begins, rounding must not decide on which side of a jump of the initial data. And one jump
  /// for all cuts that are no farther apart: beside a contact of a straight branch paths of several families tie.
  void at_cut(const PathNode<double>& a, const PathNode<double>& b) override {
    const auto [bottom, top] = layer();
    const double low = std::max(a.z - distance(), bottom), high = std::min(b.z + distance(), top);
    if (cut_ && !(low > cut_->second + distance())) {
      cut_->second = high;
      return;
    }
    add_cut();
    cut_ = {low, high};
  }
  void add_cut() {
    if (cut_) add_moving(at(cut_->first), at(cut_->second));
    cut_.reset();
  }
  [[nodiscard]] double distance() const {
    const double bottom = exact().medium().bottom(), top = exact().medium().top();
    return 1e-12 * std::max({top - bottom, top, -bottom});
  }
  void at_boundary(std::size_t k, const PathNode<double>& below, const PathNode<double>& above) override {
    add_cut();
    const std::vector<double> moved = derivatives_.boundary(k);
    if (std::all_of(moved.begin(), moved.end(), [](double x) { return x == 0; })) return;
    const double amount_below = integrand()(below.phi) * form_.stretch(k - 1);
    integrand().set_layer(k);
    const double amount_above = integrand()(above.phi) * form_.stretch(k);
    sum_ += (amount_below - amount_above) * array_of(moved);
  }
  /// y = lo + (hi - lo) (3 x^2 - 2 x^3): where a fan comes from a state at its capacity, dphi grows like a root's slope.
  void smooth(double lo, double hi, bool) override {
    const auto value = [&](double x) -> EntryNumbers {
      return by(lo + (hi - lo) * (x * x * (3 - 2 * x))) * (6 * x * (1 - x) * (hi - lo));
    };
    if (exact().is_exact()) {
      sum_ += integral_of(value, 1e-10);
      return;
    }
    // Gauss's rules with 2 and 3 points; better ones only in the few pieces where phi is bent.
    const double two = 0.5 / std::sqrt(3.0), three = 0.5 * std::sqrt(0.6);
    const EntryNumbers coarse = (value(0.5 - two) + value(0.5 + two)) / 2.0,
                       fine = (5.0 * value(0.5 - three) + 8.0 * value(0.5) + 5.0 * value(0.5 + three)) / 18.0;
    constexpr double kBent = 1e-3;
    const bool is_bent = std::abs(EntryNumbers(fine - coarse)).max() > kBent * std::abs(fine).max();
    sum_ += is_bent ? integral_of(value, 1e-6) : fine;
  }

  struct Part {
    double lo, hi;
    EntryNumbers value;
    double error;  ///< the largest of all entries
  };
  /// Over (0, 1): the worst part is halved until the sum is good enough, or has become dear.
  template <class Value>
  EntryNumbers integral_of(const Value& value, double tolerance) const {
    constexpr std::size_t kMostParts = 48;
    std::vector<Part> parts{part_of(value, 0, 1)};
    const double size = std::max(std::abs(parts.front().value).max(), std::abs(sum_).max());
    while (parts.size() < kMostParts) {
      double sum = 0;
      for (const Part& part : parts) sum += part.error;
      if (!(sum > tolerance * size)) break;
      const auto worst = std::max_element(parts.begin(), parts.end(),
                                          [](const Part& a, const Part& b) { return a.error < b.error; });
      const double lo = worst->lo, hi = worst->hi, middle = lo + (hi - lo) / 2;
      *worst = part_of(value, lo, middle);
      parts.push_back(part_of(value, middle, hi));
    }
    EntryNumbers sum = parts.front().value;
    for (std::size_t i = 1; i < parts.size(); ++i) sum += parts[i].value;
    return sum;
  }
  /// By the rules of Gauss and Kronrod with 7 and 15 points.
  template <class Value>
  static Part part_of(const Value& value, double lo, double hi) {
    using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
    using Gauss = boost::math::quadrature::gauss<double, 7>;
    const double half = (hi - lo) / 2, middle = lo + half;
    const EntryNumbers centre = value(middle);
    EntryNumbers fine = Kronrod::weights()[0] * centre, coarse = Gauss::weights()[0] * centre;
    for (std::size_t i = 1; i < Kronrod::abscissa().size(); ++i) {
      const double x = half * Kronrod::abscissa()[i];
      const EntryNumbers both = value(middle - x) + value(middle + x);
      fine += Kronrod::weights()[i] * both;
      if (i % 2 == 0) coarse += Gauss::weights()[i / 2] * both;
    }
    return {lo, hi, half * fine, half * std::abs(EntryNumbers(fine - coarse)).max()};
  }

  const Derivatives<double>& derivatives_;
  const exact::CanonicalForm<double>& form_;
  const ShareFunction& g_;
  double t_;
  EntryNumbers sum_;
  std::optional<std::pair<double, double>> cut_;  ///< the last one, not added yet
};

}  // namespace

double share_integral(const ExactSolution<double>& exact, double t, const ShareFunction& g) {
  SHEARFRONT_EXPECTS(t >= 0 && g, "a time and a function");
  if (exact::is_at_rest(exact, t))
    return ShareIntegral(exact, g, 1).at_rest(exact::profile_at_rest(exact, t == 0));
  return ShareIntegral(exact, g, t).run();
}

std::vector<double> share_integral_derivatives(const ExactSolution<double>& exact,
                                               const Derivatives<double>& derivatives, double t,
                                               const ShareFunction& g) {
  SHEARFRONT_EXPECTS(t >= 0 && g && g.slope, "a time, a function and its slope");
  ShareIntegralDerivatives integral(exact, derivatives, g, t);
  const EntryNumbers by =
      exact::is_at_rest(exact, t) ? integral.at_rest(exact::profile_at_rest(exact, t == 0)) : integral.run();
  return {std::begin(by), std::end(by)};
}

}  // namespace shearfront
