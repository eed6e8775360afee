// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// Shortest decimal text that reads back to the same double ("0.31", "1e-300", "inf", "nan"). Locale-free.
[[nodiscard]] std::string number_text(double x);

/// Multiprecision: as many digits as the type guarantees.
[[nodiscard]] std::string number_text(const Real50& x);
[[nodiscard]] std::string number_text(const Real110& x);

/// `digits` significant digits; of a multiprecision number with trailing zeros.
[[nodiscard]] std::string number_text(double x, int digits);
[[nodiscard]] std::string number_text(const Real50& x, int digits);
[[nodiscard]] std::string number_text(const Real110& x, int digits);

}  // namespace shearfront
