// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/digits/real110.hpp"

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <new>
#include <ostream>
#include <type_traits>

namespace shearfront {

using Number =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<110>, boost::multiprecision::et_off>;

/// The number that lives in the bytes of a Real110.
struct Real110Number {
  static_assert(sizeof(Number) <= Real110::kBytes && alignof(Number) <= alignof(std::max_align_t));
  static_assert(std::is_trivially_destructible_v<Number>, "Real110 does not destroy it");

  static const Number& of(const Real110& x) {
    return *std::launder(reinterpret_cast<const Number*>(x.number_));
  }
  static Number& of(Real110& x) { return *std::launder(reinterpret_cast<Number*>(x.number_)); }
  template <class Value>
  static void make(Real110& x, const Value& value) {
    ::new (static_cast<void*>(x.number_)) Number(value);
  }
  static Real110 holding(const Number& value) {
    Real110 x{Real110::Unmade{}};
    make(x, value);
    return x;
  }
};

namespace {

const Number& in(const Real110& x) { return Real110Number::of(x); }
Real110 out(const Number& x) { return Real110Number::holding(x); }

}  // namespace

Real110::Real110() { Real110Number::make(*this, 0); }
Real110::Real110(double x) { Real110Number::make(*this, x); }
Real110::Real110(Exactly, long long x) { Real110Number::make(*this, x); }
Real110::Real110(Exactly, unsigned long long x) { Real110Number::make(*this, x); }
Real110::Real110(const std::string& decimal) { Real110Number::make(*this, decimal); }
Real110::Real110(const char* decimal) { Real110Number::make(*this, decimal); }
Real110::Real110(const Real110& other) { Real110Number::make(*this, in(other)); }
Real110& Real110::operator=(const Real110& other) {
  Real110Number::of(*this) = in(other);
  return *this;
}

Real110::operator double() const { return static_cast<double>(in(*this)); }
long long Real110::truncated() const { return static_cast<long long>(in(*this)); }
std::string Real110::str(int digits, std::ios_base::fmtflags flags) const {
  return in(*this).str(digits, flags);
}

Real110& Real110::operator+=(const Real110& y) {
  Real110Number::of(*this) += in(y);
  return *this;
}
Real110& Real110::operator-=(const Real110& y) {
  Real110Number::of(*this) -= in(y);
  return *this;
}
Real110& Real110::operator*=(const Real110& y) {
  Real110Number::of(*this) *= in(y);
  return *this;
}
Real110& Real110::operator/=(const Real110& y) {
  Real110Number::of(*this) /= in(y);
  return *this;
}
Real110 operator+(const Real110& x, const Real110& y) { return out(in(x) + in(y)); }
Real110 operator-(const Real110& x, const Real110& y) { return out(in(x)-in(y)); }
Real110 operator*(const Real110& x, const Real110& y) { return out(in(x)*in(y)); }
Real110 operator/(const Real110& x, const Real110& y) { return out(in(x) / in(y)); }
Real110 operator-(const Real110& x) { return out(-in(x)); }
bool operator==(const Real110& x, const Real110& y) { return in(x) == in(y); }
std::partial_ordering operator<=>(const Real110& x, const Real110& y) {
  if (isnan(in(x)) || isnan(in(y))) return std::partial_ordering::unordered;
  return in(x).compare(in(y)) <=> 0;
}
std::ostream& operator<<(std::ostream& stream, const Real110& x) { return stream << in(x); }

Real110 abs(const Real110& x) { return out(abs(in(x))); }
Real110 floor(const Real110& x) { return out(floor(in(x))); }
Real110 ceil(const Real110& x) { return out(ceil(in(x))); }
Real110 sqrt(const Real110& x) { return out(sqrt(in(x))); }
Real110 cbrt(const Real110& x) { return out(cbrt(in(x))); }
Real110 exp(const Real110& x) { return out(exp(in(x))); }
Real110 expm1(const Real110& x) { return out(expm1(in(x))); }
Real110 log(const Real110& x) { return out(log(in(x))); }
Real110 log1p(const Real110& x) { return out(log1p(in(x))); }
Real110 sin(const Real110& x) { return out(sin(in(x))); }
Real110 cos(const Real110& x) { return out(cos(in(x))); }
Real110 tan(const Real110& x) { return out(tan(in(x))); }
Real110 acos(const Real110& x) { return out(acos(in(x))); }
Real110 atan(const Real110& x) { return out(atan(in(x))); }
Real110 cosh(const Real110& x) { return out(cosh(in(x))); }
Real110 tanh(const Real110& x) { return out(tanh(in(x))); }
Real110 atanh(const Real110& x) { return out(atanh(in(x))); }
Real110 ldexp(const Real110& x, int exponent) { return out(ldexp(in(x), exponent)); }
Real110 frexp(const Real110& x, int* exponent) { return out(frexp(in(x), exponent)); }
Real110 pow(const Real110& x, const Real110& y) { return out(pow(in(x), in(y))); }

}  // namespace shearfront

namespace {

using shearfront::Real110;
using NumberLimits = std::numeric_limits<shearfront::Number>;
using Limits = std::numeric_limits<Real110>;
static_assert(NumberLimits::digits == Limits::digits && NumberLimits::digits10 == Limits::digits10 &&
              NumberLimits::max_digits10 == Limits::max_digits10 &&
              NumberLimits::max_exponent == Limits::max_exponent &&
              NumberLimits::min_exponent == Limits::min_exponent &&
              NumberLimits::max_exponent10 == Limits::max_exponent10 &&
              NumberLimits::min_exponent10 == Limits::min_exponent10);

}  // namespace

Real110 std::numeric_limits<Real110>::min() { return shearfront::out((NumberLimits::min)()); }
Real110 std::numeric_limits<Real110>::max() { return shearfront::out((NumberLimits::max)()); }
Real110 std::numeric_limits<Real110>::epsilon() { return shearfront::out((NumberLimits::epsilon)()); }
Real110 std::numeric_limits<Real110>::infinity() { return shearfront::out((NumberLimits::infinity)()); }
Real110 std::numeric_limits<Real110>::quiet_NaN() { return shearfront::out((NumberLimits::quiet_NaN)()); }
