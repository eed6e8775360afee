// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/method_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <concepts>
#include <limits>
#include <type_traits>

#include "shearfront/io/text.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

template <class Member>
constexpr bool kIsCount = std::same_as<Member, std::uint64_t>;

template <class Member>
std::string allowed(const OptionInfo& info) {
  if constexpr (kIsCount<Member>)
    return fmt::format("from {} to {}", static_cast<std::uint64_t>(info.range.low),
                       static_cast<std::uint64_t>(info.range.high));
  else
    return allowed_text(info.range);
}

std::string names_of(const OptionInfo& info, const char* separator) {
  return fmt::format("{}", fmt::join(info.names, separator));
}

[[noreturn]] void refuse(const std::string& key, std::string_view text, const std::string& constraint) {
  throw InputError(key, parse_number(text) ? std::string(text) : quoted_text(text), constraint);
}

template <class Member>
void set(const OptionInfo& info, Member& member, std::string_view text, const std::string& key) {
  if constexpr (std::same_as<Member, bool>) {
    if (text != "true" && text != "false") refuse(key, text, "must be true or false");
    member = text == "true";
  } else if constexpr (std::is_enum_v<Member>) {
    const auto it = std::find(info.names.begin(), info.names.end(), text);
    if (it == info.names.end()) refuse(key, text, "must be one of: " + names_of(info, ", "));
    member = static_cast<Member>(it - info.names.begin());
  } else if constexpr (kIsCount<Member>) {
    const auto n = parse_count(text);
    if (!n || !info.range.contains(static_cast<double>(*n)))
      refuse(key, text, "must be a whole number " + allowed<Member>(info));
    member = *n;
  } else {
    const auto x = parse_number(text);
    if (!x) refuse(key, text, "must be a number " + allowed<Member>(info));
    if (!info.range.contains(*x)) refuse(key, text, "must be " + allowed<Member>(info));
    member = *x;
  }
}

template <class Member>
std::string text_of(const OptionInfo& info, const Member& member) {
  if constexpr (std::same_as<Member, bool>) return member ? "on" : "off";
  else if constexpr (std::is_enum_v<Member>) return std::string(info.names[static_cast<std::size_t>(member)]);
  else if constexpr (kIsCount<Member>) return std::to_string(member);
  else return number_text(member);
}

template <class Member>
OptionText described(const OptionInfo& info, const Member& member) {
  OptionText text{std::string(info.name), std::string(info.sentence), "", "", std::string(info.unset), {}};
  if constexpr (std::is_enum_v<Member>) {
    text.kind = names_of(info, "|");
  } else if constexpr (!std::same_as<Member, bool>) {
    text.kind = kIsCount<Member> ? "N" : "X";
    text.allowed = allowed<Member>(info);
  }
  if (text.initial.empty()) text.initial = text_of(info, member);
  return text;
}

}  // namespace

std::string allowed_text(const OptionRange& range) {
  constexpr double kUnlimited = 1e300;
  const std::string low = (range.excludes_low ? "> " : ">= ") + number_text(range.low);
  return range.high >= kUnlimited ? low : low + " and <= " + number_text(range.high);
}

std::vector<OptionText> all_options() {
  std::vector<OptionText> all;
  for (const std::string& name : Method::names())
    Method(name).visit_options([&](const OptionInfo& info, const auto& member) {
      auto known = std::find_if(all.begin(), all.end(), [&](const OptionText& o) { return o.name == info.name; });
      if (known == all.end()) known = all.insert(all.end(), described(info, member));
      known->solvers.push_back(name);
    });
  return all;
}

void set_option(Method& method, std::string_view name, std::string_view text, const std::string& key) {
  method.visit_options([&](const OptionInfo& info, auto& member) {
    if (info.name == name) set(info, member, text, key);
  });
}

std::string settings(const Method& method) {
  std::string all = fmt::format("--method {}", method.name());
  method.visit_options([&]<class Member>(const OptionInfo& info, const Member& member) {
    if constexpr (std::same_as<Member, bool>) {
      if (member) all += fmt::format(" --{}", info.name);
    } else {
      // The default of such an option lies outside its range.
      if constexpr (!std::is_enum_v<Member>)
        if (!info.unset.empty() && !info.range.contains(static_cast<double>(member))) return;
      all += fmt::format(" --{} {}", info.name, text_of(info, member));
    }
  });
  return all;
}

}  // namespace shearfront
