// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/numeric/multiprecision.hpp"

SHEARFRONT_MULTIPRECISION(, cpp_bin_float<50>)
SHEARFRONT_MULTIPRECISION(, cpp_bin_float<110>)
