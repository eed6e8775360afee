// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/model/depth/kinetic.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/numeric/instantiated.hpp"

namespace shearfront {
/// With a name of its own: lambdas of class members hold these types.
namespace kinetic_march {

/// A number with its first derivatives in N directions.
template <Real S, std::size_t N>
struct KineticJet {
  S x{0};
  std::array<S, N> by{};

  KineticJet() = default;
  explicit KineticJet(S value) : x(std::move(value)) {}
  [[nodiscard]] static KineticJet direction(S value, std::size_t i, S by_i = S(1)) {
    KineticJet jet(std::move(value));
    jet.by[i] = std::move(by_i);
    return jet;
  }
  friend KineticJet operator+(KineticJet a, const KineticJet& b) {
    a.x += b.x;
    for (std::size_t i = 0; i < N; ++i) a.by[i] += b.by[i];
    return a;
  }
  friend KineticJet operator-(KineticJet a, const KineticJet& b) {
    a.x -= b.x;
    for (std::size_t i = 0; i < N; ++i) a.by[i] -= b.by[i];
    return a;
  }
  friend KineticJet operator*(const KineticJet& a, const KineticJet& b) {
    KineticJet product(S(a.x * b.x));
    for (std::size_t i = 0; i < N; ++i) product.by[i] = a.by[i] * b.x + a.x * b.by[i];
    return product;
  }
  friend KineticJet operator/(const KineticJet& a, const KineticJet& b) {
    KineticJet ratio(S(a.x / b.x));
    for (std::size_t i = 0; i < N; ++i) ratio.by[i] = (a.by[i] - ratio.x * b.by[i]) / b.x;
    return ratio;
  }
  friend KineticJet operator*(KineticJet a, const S& b) {
    a.x *= b;
    for (S& d : a.by) d *= b;
    return a;
  }
};

/// Terms of the series: over a step the n-th is below 8^-n beside the pole at y = 0, and 2^-n / n! of what oscillates.
template <Real S>
constexpr int kKineticTerms = std::numeric_limits<S>::digits / 3 + 7;

/// Heights of the nodes, ascending, the ground first and the lid last; empty if there are more than `most`. Whatever nu is in its
/// bracket, w''/w is at most `most_bend` / y^2 there.
template <Real S, class Bed>
std::vector<S> kinetic_nodes(const Bed& bed, std::size_t most) {
  using std::cbrt, std::sqrt;
  if (!(bed.length > 0 && bed.load > 0 && bed.ground < bed.lid)) return {};
  const S height = bed.lid - bed.ground, m = S(1) / (bed.length * bed.length);
  std::vector<S> z{bed.ground};
  const auto bend = [&](const S& depth) { return S(depth * (S(2) * bed.load + depth) * m); };
  const S whole = bend(height);
  while (z.back() < bed.lid) {
    if (z.size() > most) return {};
    const S depth = bed.lid - z.back(), y = bed.load + depth, here = bend(depth);
    const S largest = std::max(here, S(whole - here));
    S step = std::min(S(y / S(8)), S(cbrt(S(y / (S(8) * m)))));
    if (largest > 0) step = std::min(step, S(y / (S(2) * sqrt(largest))));
    const S next = z.back() + step;
    // The last two steps alike, so that none is nothing but rounding.
    z.push_back(next + step / S(2) < bed.lid ? next : depth > step ? S(z.back() + depth / S(2)) : bed.lid);
    if (!(z.back() > z[z.size() - 2])) return {};
  }
  return z;
}

/// c_0 = 1, c_1 = g, and so on, of the power series of w upwards from a height `depth` below the lid:
///     Y^2 (n+2)(n+1) c_n+2 = Y (n+1)(2n+1) c_n+1 - (n^2 + K) c_n - 2 Y m c_n-1 + m c_n-2,   K = nu^2 - Y^2 m.
template <Real S, class Number>
void kinetic_series(const Number& Y, const Number& K, const Number& m, const Number& g,
                    std::vector<Number>& c) {
  constexpr int kTerms = kKineticTerms<S>;
  c.assign(kTerms, Number(S(0)));
  c[0] = Number(S(1));
  c[1] = g;
  const Number inverse = Number(S(1)) / (Y * Y), two_Ym = Y * m * S(2);
  for (int n = 0; n + 2 < kTerms; ++n) {
    const auto i = static_cast<std::size_t>(n);
    Number sum = Y * c[i + 1] * S((n + 1) * (2 * n + 1)) - (K + Number(S(n * n))) * c[i];
    if (n > 0) sum = sum - two_Ym * c[i - 1];
    if (n > 1) sum = sum + m * c[i - 2];
    c[i + 2] = sum * inverse * S(S(1) / S((n + 2) * (n + 1)));
  }
}

template <Real S, class Number>
Number kinetic_sum(const std::vector<Number>& c, const S& s) {
  Number sum = c.back();
  for (std::size_t n = c.size() - 1; n-- > 0;) sum = sum * s + c[n];
  return sum;
}
template <Real S, class Number>
Number kinetic_slope(const std::vector<Number>& c, const S& s) {
  Number sum = c.back() * S(static_cast<double>(c.size() - 1));
  for (std::size_t n = c.size() - 1; n-- > 1;) sum = sum * s + c[n] * S(static_cast<double>(n));
  return sum;
}

/// What a march needs: numbers of the bed, and nu^2 - (load / length)^2, which loses nothing where the lid is heavy.
template <class Number>
struct KineticMarch {
  Number excess, m, load, lid, start;  ///< start: w'/w at the ground
};

/// Calls visit(node, series) for each node; w'/w at the lid, or nothing where w vanished on the way.
template <Real S, class Number, class Visit>
std::pair<bool, Number> march_up(const std::vector<S>& z, const KineticMarch<Number>& bed, const Visit& visit,
                                 const auto& real) {
  std::vector<Number> c;
  Number g = bed.start;
  for (std::size_t k = 0; k < z.size(); ++k) {
    const Number depth = bed.lid - Number(z[k]), Y = bed.load + depth;
    const Number K = bed.excess - depth * (bed.load * S(2) + depth) * bed.m;
    kinetic_series<S>(Y, K, bed.m, g, c);
    visit(k, c);
    if (k + 1 == z.size()) break;
    const S s = z[k + 1] - z[k];
    const Number w = kinetic_sum<S>(c, s);
    if (!(real(w) > S(0))) return {false, g};
    g = kinetic_slope<S>(c, s) / w;
  }
  return {true, g};
}

/// nu^2 - (load / length)^2: where w'/w at the lid, which falls with it, is 0.
template <Real S, class Bed>
S kinetic_excess(const Bed& bed, const std::vector<S>& z) {
  using Jet = KineticJet<S, 1>;
  const S height = bed.lid - bed.ground, m = S(1) / (bed.length * bed.length);
  S low(0), high = height * (S(2) * bed.load + height) * m, at = high / S(2);
  const int most = 4 * std::numeric_limits<S>::digits;
  for (int i = 0; i < most && low < high; ++i) {
    const KineticMarch<Jet> march{Jet::direction(at, 0), Jet(m), Jet(bed.load), Jet(bed.lid), Jet(S(0))};
    const auto [is_positive, g] = march_up<S>(
        z, march, [](std::size_t, const auto&) {}, [](const Jet& x) { return x.x; });
    const bool is_low = is_positive && g.x > 0;
    (is_low ? low : high) = at;
    S next = is_positive && g.by[0] < 0 ? S(at - g.x / g.by[0]) : low;
    if (!(next > low && next < high)) next = low + (high - low) / S(2);
    const S change = next > at ? S(next - at) : S(at - next);
    at = next;
    if (!(change > S(4) * unit_roundoff<S>() * at)) break;
  }
  return at;
}

constexpr std::size_t kKineticQuadrature = 10;

}  // namespace kinetic_march

using namespace kinetic_march;

template <Real S>
std::size_t KineticProfile<S>::n_nodes(const Bed& bed) {
  const std::size_t n = kinetic_nodes<S>(bed, kMostNodes).size();
  return n == 0 ? kMostNodes + 1 : n;
}

template <Real S>
KineticProfile<S>::KineticProfile(const Bed& bed) : bed_(bed) {
  using std::exp, std::log;
  constexpr std::size_t kExcess = kNumbers, kAll = kNumbers + 1;
  using Jet = KineticJet<S, kAll>;
  const std::vector<S> z = kinetic_nodes<S>(bed, kMostNodes);
  if (z.empty()) return;  // value() is NaN
  excess_ = kinetic_excess<S>(bed, z);
  const S m = S(1) / (bed.length * bed.length), height = bed.lid - bed.ground, y = bed.load + height;
  // The ground moved up by 1 lowers w'/w where it was by w''/w.
  const S at_ground = (height * (S(2) * bed.load + height) * m - excess_) / (y * y);
  const KineticMarch<Jet> march{Jet::direction(excess_, kExcess),
                                Jet::direction(m, 0, S(S(-2) * m / bed.length)), Jet::direction(bed.load, 1),
                                Jet::direction(bed.lid, 3), Jet::direction(S(0), 2, S(-at_ground))};
  std::vector<Jet> log_scales;
  std::vector<std::vector<Jet>> series;
  Jet log_scale(S(0)), end;
  const auto keep = [&](std::size_t k, const std::vector<Jet>& c) {
    log_scales.push_back(log_scale);
    series.push_back(c);
    if (k + 1 == z.size()) return;
    const Jet w = kinetic_sum<S>(c, S(z[k + 1] - z[k]));
    log_scale.x += log(w.x);
    for (std::size_t i = 0; i < kAll; ++i) log_scale.by[i] += w.by[i] / w.x;
  };
  end = march_up<S>(z, march, keep, [](const Jet& x) { return x.x; }).second;
  // w'/w stays 0 at the lid, wherever that is; w'' / w there is 2 c_2.
  Gradient excess_by;
  for (std::size_t e = 0; e < kNumbers; ++e) {
    const S moved = e == 3 ? S(S(2) * series.back()[2].x) : S(0);
    excess_by[e] = -(end.by[e] + moved) / end.by[kExcess];
  }
  const auto total = [&](const Jet& x, std::size_t e) { return S(x.by[e] + x.by[kExcess] * excess_by[e]); };
  const Jet at_lid = log_scales.back();
  for (std::size_t k = 0; k < z.size(); ++k) {
    Node node{.z = z[k], .scale = exp(S(log_scales[k].x - at_lid.x)), .by_log = {}, .c = {}, .by = {}};
    for (const Jet& c : series[k]) node.c.push_back(c.x);
    for (std::size_t e = 0; e < kNumbers; ++e) {
      node.by_log[e] = total(log_scales[k], e) - total(at_lid, e);
      for (const Jet& c : series[k]) node.by[e].push_back(total(c, e));
    }
    nodes_.push_back(std::move(node));
  }
}

template <Real S>
auto KineticProfile<S>::of(const Bed& bed) -> std::shared_ptr<const KineticProfile> {
  // A fit goes back and forth between few: the number of unknowns and the steps of a difference.
  constexpr std::size_t kKept = 16;
  thread_local std::array<std::shared_ptr<const KineticProfile>, kKept> kept;
  thread_local std::size_t next = 0;
  for (const auto& profile : kept)
    if (profile && profile->bed() == bed) return profile;
  auto& place = kept[next++ % kKept];
  place = std::make_shared<const KineticProfile>(bed);
  return place;
}

template <Real S>
S KineticProfile<S>::nu() const {
  return stress() * bed_.load / bed_.length;
}

template <Real S>
S KineticProfile<S>::stress() const {
  using std::sqrt;
  const S ratio = bed_.length / bed_.load;
  return sqrt(S(S(1) + excess_ * ratio * ratio));
}

template <Real S>
auto KineticProfile<S>::node_at(const S& z) const -> const Node& {
  const auto above = std::upper_bound(nodes_.begin() + 1, nodes_.end() - 1, z,
                                      [](const S& height, const Node& node) { return height < node.z; });
  return *(above - 1);
}

template <Real S>
S KineticProfile<S>::value(const S& z) const {
  if (nodes_.empty()) return std::numeric_limits<S>::quiet_NaN();
  const Node& node = node_at(z);
  return node.scale * kinetic_sum<S>(node.c, S(z - node.z));
}

template <Real S>
auto KineticProfile<S>::with_derivatives(const S& z) const -> Value {
  if (nodes_.empty()) return {value(z), {}};
  const Node& node = node_at(z);
  const S s = z - node.z, sum = kinetic_sum<S>(node.c, s);
  Value value{S(node.scale * sum), {}};
  for (std::size_t e = 0; e < kNumbers; ++e)
    value.by[e] = node.scale * (kinetic_sum<S>(node.by[e], s) + node.by_log[e] * sum);
  return value;
}

template <Real S>
auto KineticProfile<S>::slowness(const S& lo, const S& hi, bool with_derivatives) const -> Slowness {
  using Rule = boost::math::quadrature::gauss<S, kKineticQuadrature>;
  Slowness sum;
  const auto add = [&](const S& z, const S& weight) {
    const Value at = with_derivatives ? this->with_derivatives(z) : Value{value(z), {}};
    S part = weight / at.w;
    for (std::size_t k = 0; k < 3; ++k) {
      sum.moment[k] += part;
      if (with_derivatives)
        for (std::size_t e = 0; e < kNumbers; ++e) sum.by[k][e] -= part * (at.by[e] / at.w);
      part *= hi - z;
    }
  };
  S from = lo;
  const auto piece = [&](const S& to) {
    const S half = (to - from) / S(2), middle = from + half;
    for (std::size_t i = 0; i < Rule::abscissa().size(); ++i)
      for (const S& x : {S(Rule::abscissa()[i]), S(-Rule::abscissa()[i])})
        add(S(middle + half * x), S(half * Rule::weights()[i]));
    from = to;
  };
  const auto first = std::upper_bound(nodes_.begin(), nodes_.end(), lo,
                                      [](const S& height, const Node& node) { return height < node.z; });
  for (auto node = first; node != nodes_.end() && node->z < hi; ++node) piece(node->z);
  piece(hi);
  return sum;
}

template class KineticProfile<Instantiated>;

}  // namespace shearfront
