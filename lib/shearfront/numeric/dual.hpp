// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <compare>
#include <concepts>
#include <cstddef>
#include <ios>
#include <limits>
#include <string>
#include <type_traits>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront {

/// A number and its derivatives with respect to N others: x + sum_j d[j] e_j with e_j e_k = 0 (Clifford 1873). What is computed with
/// it carries its derivatives along, exact to rounding.
///
/// Compares by value, so that it takes the turns that the value takes; it is a Real, and engines and models can be instantiated for it.
/// At a point where a function has no derivative (sqrt and pow at 0) that is 0. Cost: N + 1 times that of a double, or less where N
/// fill vector registers.
template <std::size_t N>
struct Dual {
  double v = 0;
  std::array<double, N> d{};

  constexpr Dual() = default;
  template <class Number>
  requires std::is_arithmetic_v<Number>
  constexpr Dual(Number x) : v(static_cast<double>(x)) {}
  /// With one derivative.
  constexpr Dual(double x, double by) requires(N == 1) : v(x), d{by} {}

  explicit constexpr operator double() const { return v; }
  /// Its value, as messages have it.
  [[nodiscard]] std::string str(int /*digits*/, std::ios_base::fmtflags /*flags*/) const {
    return number_text(v);
  }

  constexpr Dual& operator+=(const Dual& y) {
    v += y.v;
    for (std::size_t j = 0; j < N; ++j) d[j] += y.d[j];
    return *this;
  }
  constexpr Dual& operator-=(const Dual& y) {
    v -= y.v;
    for (std::size_t j = 0; j < N; ++j) d[j] -= y.d[j];
    return *this;
  }
  constexpr Dual& operator*=(const Dual& y) {
    for (std::size_t j = 0; j < N; ++j) d[j] = d[j] * y.v + v * y.d[j];
    v *= y.v;
    return *this;
  }
  constexpr Dual& operator/=(const Dual& y) {
    v /= y.v;
    const double inverse = 1 / y.v;
    for (std::size_t j = 0; j < N; ++j) d[j] = (d[j] - v * y.d[j]) * inverse;
    return *this;
  }
  friend constexpr Dual operator+(Dual x, const Dual& y) { return x += y; }
  friend constexpr Dual operator-(Dual x, const Dual& y) { return x -= y; }
  friend constexpr Dual operator*(Dual x, const Dual& y) { return x *= y; }
  friend constexpr Dual operator/(Dual x, const Dual& y) { return x /= y; }
  friend constexpr Dual operator+(const Dual& x) { return x; }
  friend constexpr Dual operator-(const Dual& x) { return x.mapped(-x.v, -1); }
  friend constexpr bool operator==(const Dual& x, const Dual& y) { return x.v == y.v; }
  friend constexpr std::partial_ordering operator<=>(const Dual& x, const Dual& y) { return x.v <=> y.v; }

  friend Dual sqrt(const Dual& x) {
    const double root = std::sqrt(x.v);
    return x.mapped(root, root > 0 ? 0.5 / root : 0);
  }
  friend Dual exp(const Dual& x) { return x.mapped(std::exp(x.v), std::exp(x.v)); }
  friend Dual expm1(const Dual& x) { return x.mapped(std::expm1(x.v), std::exp(x.v)); }
  friend Dual log(const Dual& x) { return x.mapped(std::log(x.v), 1 / x.v); }
  friend Dual log1p(const Dual& x) { return x.mapped(std::log1p(x.v), 1 / (1 + x.v)); }
  friend Dual abs(const Dual& x) { return x.v < 0 ? -x : x; }
  friend Dual pow(const Dual& x, const Dual& y) {
    Dual z;
    z.v = std::pow(x.v, y.v);
    if (!(x.v > 0)) return z;
    const double by_x = y.v * std::pow(x.v, y.v - 1), by_y = z.v * std::log(x.v);
    for (std::size_t j = 0; j < N; ++j) z.d[j] = by_x * x.d[j] + by_y * y.d[j];
    return z;
  }

 private:
  [[nodiscard]] constexpr Dual mapped(double value, double slope) const {
    Dual y;
    y.v = value;
    for (std::size_t j = 0; j < N; ++j) y.d[j] = slope * d[j];
    return y;
  }
};

}  // namespace shearfront

/// Those of its value.
template <std::size_t N>
class std::numeric_limits<shearfront::Dual<N>> : public std::numeric_limits<double> {};

namespace shearfront {

/// Sum and rounding error of one addition: the error is that of the values, derivatives are rounded.
template <std::size_t N>
struct TwoSum<Dual<N>> {
  Dual<N> high, low;
  TwoSum(const Dual<N>& a, const Dual<N>& b) : high(a + b), low(TwoSum<double>(a.v, b.v).low) {}
};

}  // namespace shearfront
