// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Text that comes from outside: how it is shown in messages and how numbers are read from it.
namespace shearfront {

/// Text made safe for one line of a terminal: control characters, invisible and direction-changing characters
/// and bytes that are not UTF-8 become escapes (\n, \x1b, \u202e); at most `longest` characters are kept,
/// then "...".
[[nodiscard]] std::string printable(std::string_view text, std::size_t longest = 200);

/// printable() between double quotes, with quotes and backslashes escaped: for values in messages.
[[nodiscard]] std::string quoted_text(std::string_view text, std::size_t longest = 40);

/// A finite decimal number that fills the whole text ("0.5", "-1e3", "+2"); nothing for anything else,
/// numbers beyond the range of double included. Locale-free.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

/// A whole number >= 0 that fills the whole text; 1e6 is accepted. Nothing for anything else or beyond 2^63.
[[nodiscard]] std::optional<unsigned long long> parse_count(std::string_view text);

/// The known name that a misspelt one was probably meant to be: at most two changes of a letter away.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view name,
                                                      const std::vector<std::string>& known);

/// Offset of the first byte that is not part of well-formed UTF-8; text.size() if there is none.
[[nodiscard]] std::size_t first_bad_utf8(std::string_view text);

}  // namespace shearfront
