// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#ifdef SHEARFRONT_DIGITS
#include "shearfront/digits/real110.hpp"
#endif

namespace shearfront {

/// The scalar a source file of the library is compiled for. shearfront::core compiles it for double; shearfront::digits
/// compiles some of the same files again for 110 digits.
#ifdef SHEARFRONT_DIGITS
using Instantiated = Real110;
#else
using Instantiated = double;
#endif

}  // namespace shearfront
