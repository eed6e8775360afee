// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/track/flux_branches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/contract.hpp"

namespace shearfront {
namespace {

constexpr std::size_t kBranchNodes = 11;

/// The nodes of Chebyshev in -1 ... 1, and the coefficients of the polynomial through values there.
const std::array<double, kBranchNodes>& branch_nodes() {
  static const std::array<double, kBranchNodes> all = [] {
    std::array<double, kBranchNodes> x{};
    for (std::size_t i = 0; i < kBranchNodes; ++i)
      x[i] = std::cos(M_PI * (static_cast<double>(i) + 0.5) / static_cast<double>(kBranchNodes));
    return x;
  }();
  return all;
}

std::array<double, kBranchNodes> branch_polynomial_through(const std::array<double, kBranchNodes>& values) {
  // Chebyshev coefficients, then powers.
  constexpr double n = kBranchNodes;
  std::array<double, kBranchNodes> result{}, before{}, now{};
  before[0] = 1;  // T_0
  now[1] = 1;     // T_1
  for (std::size_t k = 0; k < kBranchNodes; ++k) {
    double c = 0;
    for (std::size_t i = 0; i < kBranchNodes; ++i)
      c += values[i] * std::cos(M_PI * static_cast<double>(k) * (static_cast<double>(i) + 0.5) / n);
    c *= (k == 0 ? 1 : 2) / n;
    for (std::size_t i = 0; i < kBranchNodes; ++i) result[i] += c * before[i];
    std::array<double, kBranchNodes> next{};
    for (std::size_t i = 0; i + 1 < kBranchNodes; ++i) next[i + 1] = 2 * now[i];
    for (std::size_t i = 0; i < kBranchNodes; ++i) next[i] -= before[i];
    before = now;
    now = next;
  }
  return result;
}

double branch_polynomial(const std::array<double, kBranchNodes>& c, double x) {
  double sum = c[kBranchNodes - 1];
  for (std::size_t i = kBranchNodes - 1; i-- > 0;) sum = sum * x + c[i];
  return sum;
}

constexpr std::array<double, 5> kBranchGauss{0, 0.5384693101056830910, -0.5384693101056830910,
                                             0.9061798459386639928, -0.9061798459386639928};
constexpr std::array<double, 5> kBranchWeight{0.5688888888888888889 / 2, 0.4786286704993664680 / 2,
                                              0.4786286704993664680 / 2, 0.2369268850561890875 / 2,
                                              0.2369268850561890875 / 2};

/// The distance d at which value(d) = `target`, value rising from 0 on, by Newton's method in a bracket.
double branch_distance(double target, double most, double start, const std::function<double(double)>& value,
                       const std::function<double(double)>& slope) {
  if (!(target > 0)) return 0;
  double lo = 0, hi = most, d = start > 0 && start < most ? start : most / 2;
  constexpr int kMostSteps = 80;
  for (int n = 0; n < kMostSteps; ++n) {
    const double excess = value(d) - target;
    if (excess == 0) return d;
    (excess < 0 ? lo : hi) = d;
    double next = d - excess / slope(d);
    if (!(next > lo && next < hi)) next = lo + (hi - lo) / 2;
    if (std::abs(next - d) <= 1.2e-16 * d || next == lo || next == hi) return next;
    d = next;
  }
  return d;
}

/// Places where the flux is not analytic, as far as its model knows.
std::vector<double> branch_joints(const Flux<double>& flux) {
  return with_model(flux, [](const auto& model) -> std::vector<double> {
    if constexpr (requires { model.joints(); }) return model.joints();
    return {};
  });
}

}  // namespace

bool FluxBranches::suits(const Flux<double>& flux) {
  const StateRange<double> range = flux.range();
  if (flux.extrema().size() != 1 || flux.curvature() == Curvature::mixed || flux.value(range.lowest) != 0 ||
      flux.value(range.highest) != 0 || flux.value(flux.extrema().front()) == 0)
    return false;
  std::vector<double> ends = branch_joints(flux);
  ends.insert(ends.end(), {range.lowest, flux.extrema().front(), range.highest});
  std::sort(ends.begin(), ends.end());
  constexpr int kParts = 4;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i)
    for (int k = 0; k < kParts && ends[i + 1] > ends[i]; ++k) {
      const double width = (ends[i + 1] - ends[i]) / kParts;
      if (is_straight(flux, ends[i] + k * width, ends[i] + (k + 1) * width)) return false;
    }
  return true;
}

FluxBranches::FluxBranches(const Flux<double>& flux) : flux_(flux) {
  SHEARFRONT_EXPECTS(suits(flux), "a convex or concave flux between zeros");
  const StateRange<double> range = flux.range();
  const double extreme = flux.extrema().front(), width = range.highest - range.lowest;
  const bool has_maximum = flux.value(extreme) > 0;
  end_ = has_maximum ? range.highest : range.lowest;
  slope_ = has_maximum ? -width : width;
  top_ = (extreme - end_) / slope_;
  extremum_ = std::abs(flux.value(extreme));
  for (const bool is_high : {false, true}) build(flux, is_high);
}

double FluxBranches::value(double u) const {
  if (!(u > 0 && u < 1)) return 0;
  // From the nearer pure state: f = secant * distance.
  const bool is_high = u > top_;
  const double pure = is_high ? end_ + slope_ : end_, distance = is_high ? 1 - u : u;
  return std::min(1.0,
                  std::abs(flux_.secant(pure, end_ + slope_ * u)) * std::abs(slope_) * distance / extremum_);
}
double FluxBranches::root_of(double u) const {
  const double d = std::abs(u - top_);
  return std::sqrt(std::min(1.0, std::abs(flux_.secant(end_ + slope_ * top_, end_ + slope_ * u)) *
                                     std::abs(slope_) * d / extremum_));
}
double FluxBranches::steepness(double u) const {
  return std::abs(flux_.derivative(end_ + slope_ * u) * slope_) / extremum_;
}

void FluxBranches::build(const Flux<double>& flux, bool is_high) {
  Side& side = sides_[is_high ? 1 : 0];
  const double pure = is_high ? end_ + slope_ : end_, extreme = end_ + slope_ * top_,
               width = std::abs(slope_);
  const double way = is_high ? 1 - top_ : top_;  // from the pure state to the maximum, in u
  const double inward = (extreme > pure ? 1 : -1) * width;
  side.spread = 2 * way;
  // At a kink of f the derivative is the slope above it.
  side.pure_shape = 2 * extremum_ / (std::abs(flux.derivative(pure)) * width);
  const auto slope_at = [&](double phi) { return std::abs(flux.derivative(phi)) * width / extremum_; };
  const auto from_pure = [&](double d) {
    return std::abs(flux.secant(pure, pure + inward * d)) * width * d / extremum_;
  };
  const auto from_top = [&](double d) {
    return std::abs(flux.secant(extreme, extreme - inward * d)) * width * d / extremum_;
  };
  double last = 0;
  const auto shape_at = [&](double w) {
    const double x = (1 - w) * (1 + w);
    if (x < 0.5) {
      last = branch_distance(x, way, last, from_pure, [&](double d) { return slope_at(pure + inward * d); });
      return 2 * last / x;
    }
    const double start = last > 0 ? way - last : way * w;
    const double d = branch_distance(w * w, way, start, from_top,
                                     [&](double y) { return slope_at(extreme - inward * y); });
    last = way - d;
    return (side.spread - 2 * d) / x;
  };
  std::vector<double> cuts;
  for (std::size_t i = 0; i <= kBins; ++i)
    cuts.push_back(static_cast<double>(i) / static_cast<double>(kBins));
  for (const double joint : branch_joints(flux)) {
    const double u = (joint - end_) / slope_;
    if (u > 0 && u < 1 && (u > top_) == is_high && u != top_) cuts.push_back(root_of(u));
  }
  std::sort(cuts.begin(), cuts.end());
  constexpr double kThinnest = 1e-5, kTolerance = 4e-15;
  cuts.erase(std::unique(cuts.begin(), cuts.end(), [](double a, double b) { return b - a < kThinnest; }),
             cuts.end());
  cuts.back() = 1;
  struct Panel {
    double low, high;
  };
  std::vector<Panel> todo;
  for (std::size_t i = cuts.size() - 1; i > 0; --i) todo.push_back({cuts[i - 1], cuts[i]});
  while (!todo.empty()) {
    const auto [low, high] = todo.back();
    todo.pop_back();
    const double middle = low + (high - low) / 2, half = (high - low) / 2;
    std::array<double, kBranchNodes> shapes{}, rests{};
    for (std::size_t i = 0; i < kBranchNodes; ++i) {
      const double w = middle + half * branch_nodes()[i];
      shapes[i] = shape_at(w);
      rests[i] = (shapes[i] - side.pure_shape) / ((1 - w) * (1 + w));
    }
    const Polynomial shape = branch_polynomial_through(shapes), rest = branch_polynomial_through(rests);
    double error = 0;
    for (const double x : {-0.97, -0.55, 0.14, 0.85})
      error = std::max(error, std::abs(branch_polynomial(shape, x) / shape_at(middle + half * x) - 1));
    if (error > kTolerance && half > kThinnest) {
      todo.push_back({middle, high});
      todo.push_back({low, middle});
      continue;
    }
    error_ = std::max(error_, error);
    side.ends.push_back(high);
    side.functions[kShape].push_back(shape);
    side.functions[kRest].push_back(rest);
  }
  // Primitives from 1 down: int f 2 w dw. Their polynomials have one degree more; its term is put on the highest one kept by
  // interpolation, at the nodes.
  for (const Function function : {kShape, kRest}) {
    const Function primitive = function == kShape ? kShapeIntegral : kRestIntegral;
    std::vector<Polynomial>& all = side.functions[primitive];
    all.resize(side.ends.size());
    double above = 0;
    for (std::size_t k = side.ends.size(); k-- > 0;) {
      const double low = k == 0 ? 0 : side.ends[k - 1], high = side.ends[k];
      const double middle = low + (high - low) / 2, half = (high - low) / 2;
      const Polynomial& f = side.functions[function][k];
      const auto from = [&](double y) {  // of the panel's part above y
        double sum = 0;
        for (const double part : {0.25, 0.75})
          for (std::size_t i = 0; i < kBranchGauss.size(); ++i) {
            const double x = y + (1 - y) * (part + kBranchGauss[i] / 4);
            sum += kBranchWeight[i] * branch_polynomial(f, x) * 2 * (middle + half * x);
          }
        return sum / 2 * half * (1 - y);
      };
      std::array<double, kBranchNodes> values{};
      for (std::size_t i = 0; i < kBranchNodes; ++i) values[i] = above + from(branch_nodes()[i]);
      all[k] = branch_polynomial_through(values);
      above += from(-1);
    }
  }
  std::size_t panel = 0;
  for (std::size_t bin = 0; bin <= kBins; ++bin) {
    const double w = static_cast<double>(bin) / static_cast<double>(kBins);
    while (panel + 1 < side.ends.size() && !(side.ends[panel] > w)) ++panel;
    side.first[bin] = panel;
  }
}

double FluxBranches::evaluate(const Side& side, Function function, double w) {
  const std::size_t panel = panel_of(side, w);
  const double low = panel == 0 ? 0 : side.ends[panel - 1], high = side.ends[panel];
  return branch_polynomial(side.functions[function][panel], ((w - low) - (high - w)) / (high - low));
}

double FluxBranches::lack_slope(bool is_high, double w, double x) const {
  const Side& of = side(is_high);
  const std::size_t panel = panel_of(of, w);
  const double low = panel == 0 ? 0 : of.ends[panel - 1], high = of.ends[panel];
  const Polynomial& c = of.functions[kShape][panel];
  const double y = ((w - low) - (high - w)) / (high - low);
  double sum = c[kCoefficients - 1], slope = 0;
  for (std::size_t i = kCoefficients - 1; i-- > 0;) {
    slope = slope * y + sum;
    sum = sum * y + c[i];
  }
  return sum - x * slope * (2 / (high - low)) / (2 * w);
}

double FluxBranches::integral(const Side& side, Function function, Function primitive, double from, double to,
                              double dx) {
  constexpr double kThin = 0.05;
  if (std::abs(to - from) > kThin) return evaluate(side, primitive, from) - evaluate(side, primitive, to);
  if (!(from + to > 0)) return 0;
  // int f 2 w dw over one panel as a part of int 2 w dw.
  const auto part = [&](double lo, double hi) {
    const double middle = (lo + hi) / 2, half = (hi - lo) / 2;
    double sum = 0;
    for (std::size_t i = 0; i < kBranchGauss.size(); ++i) {
      const double w = middle + half * kBranchGauss[i];
      sum += kBranchWeight[i] * evaluate(side, function, w) * w;
    }
    return sum / middle;
  };
  const double lo = std::min(from, to), hi = std::max(from, to);
  const std::size_t last = panel_of(side, hi);
  std::size_t panel = panel_of(side, lo);
  if (panel == last) return part(lo, hi) * dx;
  double sum = 0, below = lo;
  for (; panel <= last; ++panel) {
    const double above = panel == last ? hi : side.ends[panel];
    if (above > below) sum += (above - below) * (above + below) * part(below, above);
    below = above;
  }
  return dx * (sum / ((hi - lo) * (hi + lo)));
}

}  // namespace shearfront
