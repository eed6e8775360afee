// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/method_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <concepts>
#include <limits>
#include <variant>

#include "shearfront/io/text.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

template <class Value>
constexpr bool kIsCount = std::same_as<Value, std::uint64_t>;

template <class Value>
std::string allowed(const OptionInfo& info) {
  if constexpr (kIsCount<Value>)
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

/// `text` as a value of the kind of `like`.
OptionValue parsed(const OptionInfo& info, const OptionValue& like, std::string_view text,
                   const std::string& key) {
  return std::visit(
      [&]<class Value>(const Value&) -> OptionValue {
        if constexpr (std::same_as<Value, bool>) {
          if (text != "true" && text != "false") refuse(key, text, "must be true or false");
          return text == "true";
        } else if constexpr (std::same_as<Value, OptionChoice>) {
          const auto it = std::find(info.names.begin(), info.names.end(), text);
          if (it == info.names.end()) refuse(key, text, "must be one of: " + names_of(info, ", "));
          return OptionChoice{static_cast<std::size_t>(it - info.names.begin())};
        } else if constexpr (kIsCount<Value>) {
          const auto n = parse_count(text);
          if (!n || !info.range.contains(static_cast<double>(*n)))
            refuse(key, text, "must be a whole number " + allowed<Value>(info));
          return std::uint64_t{*n};
        } else {
          const auto x = parse_number(text);
          if (!x) refuse(key, text, "must be a number " + allowed<Value>(info));
          if (!info.range.contains(*x)) refuse(key, text, "must be " + allowed<Value>(info));
          return *x;
        }
      },
      like);
}

std::string text_of(const Option& option) {
  return std::visit(
      [&]<class Value>(const Value& value) {
        if constexpr (std::same_as<Value, bool>)
          return std::string(value ? "on" : "off");
        else if constexpr (std::same_as<Value, OptionChoice>)
          return std::string(option.info.names[value.index]);
        else if constexpr (kIsCount<Value>)
          return std::to_string(value);
        else
          return number_text(value);
      },
      option.value);
}

std::string kind_of(const Option& option) {
  return std::visit(
      [&]<class Value>(const Value&) -> std::string {
        if constexpr (std::same_as<Value, OptionChoice>) return names_of(option.info, "|");
        if constexpr (std::same_as<Value, bool>) return "";
        return kIsCount<Value> ? "N" : "X";
      },
      option.value);
}

/// Without its solvers.
OptionValues values_of(const Option& option) {
  return {std::string(option.info.sentence),
          std::visit(
              [&]<class Value>(const Value&) -> std::string {
                if constexpr (std::same_as<Value, OptionChoice> || std::same_as<Value, bool>)
                  return "";
                else
                  return allowed<Value>(option.info);
              },
              option.value),
          option.info.unset.empty() ? text_of(option) : std::string(option.info.unset),
          {}};
}

/// Whether the option is left at a default that lies outside its range.
bool is_unset(const Option& option) {
  return !option.info.unset.empty() && std::visit(
                                           [&]<class Value>(const Value& value) {
                                             if constexpr (std::same_as<Value, OptionChoice>)
                                               return false;
                                             else
                                               return !option.info.range.contains(static_cast<double>(value));
                                           },
                                           option.value);
}

}  // namespace

std::string allowed_text(const OptionRange& range) {
  constexpr double kUnlimited = 1e300;
  const std::string low = (range.excludes_low ? "> " : ">= ") + number_text(range.low);
  return range.high >= kUnlimited ? low : low + " and <= " + number_text(range.high);
}

std::vector<std::string> OptionText::solvers() const {
  std::vector<std::string> all;
  for (const std::string& solver : Method::names())
    for (const OptionValues& some : values)
      if (std::find(some.solvers.begin(), some.solvers.end(), solver) != some.solvers.end())
        all.push_back(solver);
  return all;
}

std::vector<OptionText> all_options() {
  std::vector<OptionText> all;
  for (const std::string& name : Method::names())
    for (const Option& option : Method(name).options()) {
      auto known = std::find_if(all.begin(), all.end(),
                                [&](const OptionText& o) { return o.name == option.info.name; });
      const std::string kind = kind_of(option);
      if (known == all.end()) known = all.insert(all.end(), {std::string(option.info.name), kind, {}});
      SHEARFRONT_EXPECTS(known->kind == kind, "an option that is given alike to all its solvers");
      OptionValues own = values_of(option);
      auto values = std::find_if(known->values.begin(), known->values.end(), [&](const OptionValues& v) {
        return v.sentence == own.sentence && v.allowed == own.allowed && v.initial == own.initial;
      });
      if (values == known->values.end()) values = known->values.insert(values, std::move(own));
      values->solvers.push_back(name);
    }
  return all;
}

void set_option(Method& method, std::string_view name, std::string_view text, const std::string& key) {
  for (const Option& option : method.options())
    if (option.info.name == name) method.set(name, parsed(option.info, option.value, text, key));
}

std::string settings(const Method& method) {
  std::string all = fmt::format("--method {}", method.name());
  const std::vector<Option> options = method.options(), defaults = Method(method.name()).options();
  for (std::size_t i = 0; i < options.size(); ++i) {
    const Option& option = options[i];
    if (option.info.leaves_samples && text_of(option) == text_of(defaults[i])) continue;
    if (const bool* flag = std::get_if<bool>(&option.value)) {
      if (*flag) all += fmt::format(" --{}", option.info.name);
    } else if (!is_unset(option)) {
      all += fmt::format(" --{} {}", option.info.name, text_of(option));
    }
  }
  return all;
}

}  // namespace shearfront
