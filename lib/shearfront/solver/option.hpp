// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <variant>

namespace shearfront {

/// The numbers an option may have; the lowest may be excluded.
struct OptionRange {
  double low = 0, high = std::numeric_limits<double>::max();
  bool excludes_low = false;
  [[nodiscard]] bool contains(double x) const { return (excludes_low ? x > low : x >= low) && x <= high; }
};

/// Self-description of one option of a solver. A solver lists its options once, in
///     template <class Self, class Visit> static void fields(Self& self, Visit&& visit)
/// of its struct Options, which calls visit(OptionInfo, member) for each. Members are double, std::uint64_t,
/// bool or an enumeration; the initial value of the member is the default. Command line (--name), fit files
/// ([forward] name, with _ for -), `compare` and `list` are generated from it.
struct OptionInfo {
  std::string_view name;      ///< "cell-tolerance"
  std::string_view sentence;  ///< what it is, one clause without a full stop, domain and default left out
  OptionRange range{};        ///< numbers only
  std::span<const std::string_view> names{};  ///< enumerations only: of the enumerators, in their order
  std::string_view
      unset{};  ///< what the default stands for, if it is no value one could give: "chosen by tolerance"
  bool leaves_samples = false;  ///< no sample depends on it: it may end a run early, or is about event times
};

/// One of OptionInfo::names, by its place among them.
struct OptionChoice {
  std::size_t index = 0;
};
/// The value of an option: its alternative is that of the option for ever.
using OptionValue = std::variant<double, std::uint64_t, bool, OptionChoice>;
/// An option of a method as it is set.
struct Option {
  OptionInfo info;
  OptionValue value;
};

}  // namespace shearfront
