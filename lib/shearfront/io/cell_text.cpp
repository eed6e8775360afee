// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/cell_text.hpp"

#include <algorithm>
#include <array>
#include <system_error>

#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::detail {
namespace {

constexpr std::array<std::string_view, 9> kMissing{"NA",  "N/A",  "n/a",  "na", "NaN",
                                                   "nan", "#N/A", "NULL", "-"};

/// Why parse_number() refuses the text.
std::string_view why_no_point_number(std::string_view text) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  const ReadNumber read = read_number(text);
  if (text.empty() || read.length != text.size()) return "must be a number";
  return read.error == std::errc::result_out_of_range
             ? "must be 0 or between 5e-324 and 1.7976931348623157e308 in size"
             : "must be a finite number";
}

}  // namespace

std::string why_no_number(std::string_view text, char decimal) {
  if (decimal == ',' && parse_number(text))
    return "must have a decimal comma, as other numbers of the file do";
  return (text.empty() ? "missing; " : "") + std::string(why_no_point_number(text));
}

std::string shown_number(std::string_view text) {
  constexpr std::size_t kLongestShown = 40;
  if (text.empty()) return {};
  return why_no_point_number(text) == "must be a number" ? quoted_text(text) : printable(text, kLongestShown);
}

bool is_missing(std::string_view text, const std::vector<std::string>& words) {
  return text.empty() || std::find(kMissing.begin(), kMissing.end(), text) != kMissing.end() ||
         std::find(words.begin(), words.end(), text) != words.end();
}

}  // namespace shearfront::detail
