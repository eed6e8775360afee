// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

/// Bad input, kind 2 of the three kinds of error (contract violation, bad input, outcome of a computation).
namespace shearfront {

/// One thing wrong with an input: `shear_rate.values[1] = -0.31; must be > 0`.
struct Complaint {
  std::string key;         ///< dotted path of the entry, elements of arrays as [i] counted from 0
  std::string value;       ///< the offending value as text; empty when there is none (a missing key)
  std::string constraint;  ///< what is allowed, beginning with a verb: "must be > 0"

  [[nodiscard]] std::string text() const;
};

using Complaints = std::vector<Complaint>;

/// Thrown when an input cannot be used; carries all complaints, not only the first.
class InputError : public std::runtime_error {
 public:
  explicit InputError(Complaints complaints);
  InputError(std::string key, std::string value, std::string constraint);

  [[nodiscard]] const Complaints& complaints() const { return complaints_; }

 private:
  Complaints complaints_;
};

}  // namespace shearfront
