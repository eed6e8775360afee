// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/model/complaint.hpp"

#include <utility>

namespace shearfront {

namespace {

std::string join(const Complaints& complaints) {
  std::string all;
  for (const Complaint& p : complaints) {
    if (!all.empty()) all += '\n';
    all += p.text();
  }
  return all;
}

}  // namespace

std::string Complaint::text() const {
  return value.empty() ? key + ": " + constraint : key + " = " + value + "; " + constraint;
}

Complaint wrong_length(std::string key, std::size_t n_entries, std::string constraint) {
  return {std::move(key), "(" + std::to_string(n_entries) + " entries)", std::move(constraint),
          Complaint::Kind::wrong_length};
}

InputError::InputError(Complaints complaints)
    : std::runtime_error(join(complaints)), complaints_(std::move(complaints)) {}

InputError::InputError(std::string key, std::string value, std::string constraint)
    : InputError(Complaints{{std::move(key), std::move(value), std::move(constraint)}}) {}

}  // namespace shearfront
