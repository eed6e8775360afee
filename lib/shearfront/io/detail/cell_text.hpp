// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

/// A cell of a table that is no number.
namespace shearfront::detail {

/// What is wrong with the text where a number with this decimal mark must be: "must be a number". Precondition:
/// number_with_mark() gives nothing.
[[nodiscard]] std::string why_no_number(std::string_view text, char decimal);

/// The text in a message: in quotes unless it looks like a number.
[[nodiscard]] std::string shown_number(std::string_view text);

/// Whether the text stands for a value that is missing: nothing, NA, N/A, n/a, na, NaN, nan, #N/A, NULL, - or one of these
/// words.
[[nodiscard]] bool is_missing(std::string_view text, const std::vector<std::string>& words);

}  // namespace shearfront::detail
