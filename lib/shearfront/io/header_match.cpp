// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/header_match.hpp"

#include <algorithm>
#include <utility>

#include "shearfront/io/text.hpp"

namespace shearfront::detail {
namespace {

/// Names that can only mean this column. "conc" is not among those of phi: of which grains?
std::vector<std::string_view> usual_names(Column column) {
  switch (column) {
    case Column::t:
      return {"time"};
    case Column::z:
      return {"height"};
    case Column::sigma:
      return {"std", "sd", "stderr"};
    default:
      return {};
  }
}

/// The one number in a name, and what stands behind it.
std::optional<std::pair<double, std::string>> number_in(const Heading& heading) {
  constexpr std::string_view kDigits = "0123456789";
  std::string text = heading.name;
  if (text.find('.') == std::string::npos)
    std::replace(text.begin(), text.end(), ',', '.');  // a decimal comma
  const std::size_t digit = text.find_first_of(kDigits);
  if (digit == std::string::npos) return std::nullopt;
  std::size_t begin = digit;
  if (begin > 0 && text[begin - 1] == '.') --begin;
  if (begin > 0 && text[begin - 1] == '-' && (begin == 1 || text[begin - 2] == ' ' || text[begin - 2] == '='))
    --begin;
  std::size_t end = std::min(text.find_first_not_of("0123456789.", digit), text.size());
  // An exponent, unless it is a word.
  if (end < text.size() && (text[end] == 'e' || text[end] == 'E')) {
    const std::size_t sign = end + 1 < text.size() && (text[end + 1] == '-' || text[end + 1] == '+') ? 1 : 0;
    const std::size_t after = std::min(text.find_first_not_of(kDigits, end + 1 + sign), text.size());
    if (after > end + 1 + sign) end = after;
  }
  const auto number = parse_number(text.substr(begin, end - begin));
  if (!number || text.find_first_of(kDigits, end) != std::string::npos) return std::nullopt;
  const std::string behind(trimmed(std::string_view(text).substr(end)));
  return std::pair(*number, behind.empty() ? heading.unit : behind);
}

}  // namespace

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return out;
}

bool HeaderMatch::is_complete() const {
  const bool has_phi = has(Column::phi) || has(Column::phi_large) || has(Column::M);
  return has(Column::t) && (has(Column::H) || (has(Column::z) && has_phi));
}

HeaderMatch match(const std::vector<Heading>& headings, const ObservationFormat& format) {
  HeaderMatch result;
  std::vector<bool> is_taken(headings.size(), false);
  const auto find = [&](std::size_t c, const auto& fits) {
    for (std::size_t i = 0; i < headings.size(); ++i)
      if (!is_taken[i] && fits(headings[i])) result.fields[c].push_back(i);
    for (const std::size_t i : result.fields[c]) is_taken[i] = true;
  };
  for (std::size_t c = 0; c < kColumnNames.size(); ++c)
    if (const std::string& name = format.columns[c].name; !name.empty())
      find(c, [&](const Heading& h) { return h.name == name || h.text == name; });
  const auto unnamed = [&](std::size_t c) {
    return format.columns[c].name.empty() && result.fields[c].empty() &&
           static_cast<Column>(c) != Column::phi_large;
  };
  for (std::size_t c = 0; c < kColumnNames.size(); ++c)
    if (unnamed(c)) find(c, [&](const Heading& h) { return h.name == kColumnNames[c]; });
  for (std::size_t c = 0; c < kColumnNames.size(); ++c)
    for (const std::string_view usual : usual_names(static_cast<Column>(c)))
      if (unnamed(c)) {
        find(c, [&](const Heading& h) { return lower_case(h.name) == usual; });
        if (result.fields[c].size() > 1) result.fields[c].resize(1);
      }
  const auto t = static_cast<std::size_t>(Column::t);
  if (format.is_chute && unnamed(t)) find(t, [](const Heading& h) { return h.name == "x"; });
  return result;
}

std::optional<std::vector<PlaceColumn>> places_in(const std::vector<Heading>& headings, std::string& unit) {
  std::vector<PlaceColumn> places;
  std::optional<std::string> common;
  for (std::size_t i = 1; i < headings.size(); ++i) {
    if (headings[i].text.empty()) continue;  // columns without a name are not used
    const auto number = number_in(headings[i]);
    if (!number) return std::nullopt;
    places.push_back({i, number->first});
    if (common && *common != number->second) return std::nullopt;
    common = number->second;
  }
  if (places.size() < 2) return std::nullopt;
  if (!common->empty()) unit = *common;
  return places;
}

}  // namespace shearfront::detail
