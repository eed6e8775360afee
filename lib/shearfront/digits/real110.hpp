// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <compare>
#include <concepts>
#include <cstddef>
#include <ios>
#include <iosfwd>
#include <limits>
#include <string>
#include <type_traits>

namespace shearfront {

/// 110 significant decimal digits, binary, exponents as wide as an int: what `--digits` prints up to 100 digits of,
/// and the oracle of the tests that shows what rounding does to double.
///
/// It is Boost's cpp_bin_float<110>, whose operations are compiled once, in real110.cpp: nothing that computes with it has to
/// read Boost.Multiprecision or to instantiate it, which takes longer than all the rest. Every operation rounds to nearest as
/// Boost's does; functions are within a few units of the last place. Arithmetic types convert exactly, long double excepted.
/// Cost: 0.06 us for a sum, 0.1 us for a product, 30 us for an exponential, 60 us for a logarithm.
class Real110 {
 public:
  Real110();  ///< 0
  Real110(double x);
  template <std::integral Integer>
  Real110(Integer x) : Real110(Exactly{}, static_cast<Wide<Integer>>(x)) {}
  /// The nearest to a decimal ("0.31", "1e-300"), "inf" or "nan". Errors: std::runtime_error for any other text.
  explicit Real110(const std::string& decimal);
  explicit Real110(const char* decimal);
  Real110(const Real110& other);
  Real110& operator=(const Real110& other);
  ~Real110() = default;

  /// The nearest double.
  explicit operator double() const;
  /// Without its fraction.
  template <std::integral Integer>
  explicit operator Integer() const {
    return static_cast<Integer>(truncated());
  }
  /// So many significant digits.
  [[nodiscard]] std::string str(int digits, std::ios_base::fmtflags flags) const;

  Real110& operator+=(const Real110& y);
  Real110& operator-=(const Real110& y);
  Real110& operator*=(const Real110& y);
  Real110& operator/=(const Real110& y);
  friend Real110 operator+(const Real110& x, const Real110& y);
  friend Real110 operator-(const Real110& x, const Real110& y);
  friend Real110 operator*(const Real110& x, const Real110& y);
  friend Real110 operator/(const Real110& x, const Real110& y);
  friend Real110 operator-(const Real110& x);
  friend Real110 operator+(const Real110& x) { return x; }
  friend bool operator==(const Real110& x, const Real110& y);
  friend std::partial_ordering operator<=>(const Real110& x, const Real110& y);
  friend std::ostream& operator<<(std::ostream& out, const Real110& x);

  friend Real110 abs(const Real110& x);
  friend Real110 fabs(const Real110& x) { return abs(x); }
  friend Real110 floor(const Real110& x);
  friend Real110 ceil(const Real110& x);
  friend Real110 ldexp(const Real110& x, int exponent);
  friend Real110 frexp(const Real110& x, int* exponent);
  friend Real110 sqrt(const Real110& x);
  friend Real110 cbrt(const Real110& x);
  friend Real110 pow(const Real110& x, const Real110& y);
  friend Real110 exp(const Real110& x);
  friend Real110 expm1(const Real110& x);
  friend Real110 log(const Real110& x);
  friend Real110 log1p(const Real110& x);
  friend Real110 sin(const Real110& x);
  friend Real110 cos(const Real110& x);
  friend Real110 tan(const Real110& x);
  friend Real110 acos(const Real110& x);
  friend Real110 atan(const Real110& x);
  friend Real110 cosh(const Real110& x);
  friend Real110 tanh(const Real110& x);
  friend Real110 atanh(const Real110& x);

 private:
  struct Exactly {};
  struct Unmade {};
  template <class Integer>
  using Wide = std::conditional_t<std::is_signed_v<Integer>, long long, unsigned long long>;
  explicit Real110(Unmade) {}
  Real110(Exactly, long long x);
  Real110(Exactly, unsigned long long x);
  [[nodiscard]] long long truncated() const;
  friend struct Real110Number;

  static constexpr std::size_t kBytes = 80;
  alignas(std::max_align_t) std::byte number_[kBytes];
};

}  // namespace shearfront

template <>
class std::numeric_limits<shearfront::Real110> {
 public:
  static constexpr bool is_specialized = true, is_signed = true, is_integer = false, is_exact = false;
  static constexpr bool has_infinity = true, has_quiet_NaN = true, has_signaling_NaN = false;
  static constexpr bool is_iec559 = false, is_bounded = true, is_modulo = false, traps = true;
  static constexpr bool tinyness_before = false;
  static constexpr std::float_round_style round_style = std::round_to_nearest;
  static constexpr int radix = 2, digits = 367, digits10 = 110, max_digits10 = 113;
  static constexpr int max_exponent = 2147482913, min_exponent = -2147482914;
  static constexpr int max_exponent10 = 646392082, min_exponent10 = -646392082;
  [[nodiscard]] static shearfront::Real110 min();
  [[nodiscard]] static shearfront::Real110 max();
  [[nodiscard]] static shearfront::Real110 lowest() { return -max(); }
  [[nodiscard]] static shearfront::Real110 epsilon();
  [[nodiscard]] static shearfront::Real110 infinity();
  [[nodiscard]] static shearfront::Real110 quiet_NaN();
};
