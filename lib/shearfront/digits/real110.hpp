// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace shearfront {

/// 110 significant decimal digits, binary, exponents as wide as an int: what `--digits` prints up to 100 digits of,
/// and the oracle of the tests that shows what rounding does to double.
using Real110 =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<110>, boost::multiprecision::et_off>;

}  // namespace shearfront
