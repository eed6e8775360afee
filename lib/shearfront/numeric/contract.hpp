// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdexcept>
#include <string>

/// Contracts: a violated one is a bug of shearfront or of the code that calls it, never bad input of a user.
/// Checked when SHEARFRONT_CONTRACTS is defined to 1 (presets dev and asan); otherwise the condition is not
/// evaluated.
namespace shearfront {

class ContractViolation : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

}  // namespace shearfront

#if defined(SHEARFRONT_CONTRACTS) && SHEARFRONT_CONTRACTS
#define SHEARFRONT_STRING_(x) #x
#define SHEARFRONT_STRING(x) SHEARFRONT_STRING_(x)
#define SHEARFRONT_EXPECTS(cond, text)                                                             \
  do {                                                                                             \
    if (!(cond))                                                                                   \
      throw ::shearfront::ContractViolation(                                                       \
          std::string(__FILE__ ":" SHEARFRONT_STRING(__LINE__) ": expects " #cond ": ") + (text)); \
  } while (false)
#else
#define SHEARFRONT_EXPECTS(cond, text) \
  do {                                 \
    if (false) {                       \
      (void)(cond);                    \
    }                                  \
  } while (false)
#endif
