// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/scene/input_error.hpp"

#include <utility>

namespace shearfront {

namespace {

std::string join(const Problems& problems) {
  std::string all;
  for (const Problem& p : problems) {
    if (!all.empty()) all += '\n';
    all += p.text();
  }
  return all;
}

}  // namespace

std::string Problem::text() const {
  return value.empty() ? key + ": " + constraint : key + " = " + value + "; " + constraint;
}

InputError::InputError(Problems problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

InputError::InputError(std::string key, std::string value, std::string constraint)
    : InputError(Problems{{std::move(key), std::move(value), std::move(constraint)}}) {}

}  // namespace shearfront
