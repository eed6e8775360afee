// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace shearfront {

/// 50 and 110 significant decimal digits, binary, exponents as wide as an int.
using Real50 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<50>, boost::multiprecision::et_off>;
using Real110 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<110>, boost::multiprecision::et_off>;

}  // namespace shearfront

/// The arithmetic that every engine needs in both types, compiled once (multiprecision.cpp) and not in every
/// file that uses it: a third of the time the engines take to compile. `specifier` is extern or nothing.
#define SHEARFRONT_MULTIPRECISION(specifier, Number)                               \
  namespace boost::multiprecision {                                                \
  namespace backends {                                                             \
  specifier template void do_eval_add(Number&, const Number&, const Number&);      \
  specifier template void do_eval_subtract(Number&, const Number&, const Number&); \
  specifier template void eval_add(Number&, const Number&, const Number&);         \
  specifier template void eval_subtract(Number&, const Number&, const Number&);    \
  specifier template void eval_multiply(Number&, const Number&, const Number&);    \
  specifier template void eval_divide(Number&, const Number&, const Number&);      \
  specifier template void eval_sqrt(Number&, const Number&);                       \
  specifier template void eval_exp(Number&, const Number&);                        \
  specifier template class Number;                                                 \
  }                                                                                \
  namespace default_ops {                                                          \
  specifier template void eval_log(Number&, const Number&);                        \
  specifier template void eval_pow(Number&, const Number&, const Number&);         \
  }                                                                                \
  }

SHEARFRONT_MULTIPRECISION(extern, cpp_bin_float<50>)
SHEARFRONT_MULTIPRECISION(extern, cpp_bin_float<110>)
