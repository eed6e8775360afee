// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

/// Bad input, kind 2 of the three kinds of error (contract violation, bad input, outcome of a computation).
namespace shearfront {

/// One thing wrong with an input: `shear_rate.values[1] = -0.31; must be > 0`.
struct Complaint {
  /// For the code that handles complaints, which never searches their text.
  enum class Kind {
    out_of_range,  ///< a value that is not allowed, by itself or beside others
    missing,
    unknown,  ///< a key nobody asked for
    wrong_type,
    wrong_length,  ///< of an array
    syntax,        ///< a file that cannot be taken apart
    unreadable     ///< a file that cannot be opened or is no text
  };

  std::string key;         ///< dotted path of the entry, elements of arrays as [i] counted from 0
  std::string value;       ///< the offending value as text; empty when there is none (a missing key)
  std::string constraint;  ///< what is allowed, beginning with a verb: "must be > 0"
  Kind kind = Kind::out_of_range;

  [[nodiscard]] std::string text() const;
};

using Complaints = std::vector<Complaint>;

/// `initial.values = (3 entries); must have one entry more than breaks (4)`.
[[nodiscard]] Complaint wrong_length(std::string key, std::size_t n_entries, std::string constraint);

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
