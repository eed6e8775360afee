// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/method_table.hpp"

#include <algorithm>
#include <concepts>
#include <string>
#include <variant>
#include <vector>

#include "shearfront/io/method_text.hpp"

namespace shearfront::fit {
namespace {

using detail::TableReader;
using Need = TableReader::Need;

std::string key_of(const OptionInfo& info) {
  std::string key(info.name);
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

/// What the file does not say is chosen beside what it says.
void prefer_smooth(const TableReader& table, Method& method, const Scene<double>& scene) {
  Method smooth = method;
  smooth.prefer_smooth(scene);
  for (const Option& option : method.options())
    if (table.node(key_of(option.info)) != nullptr) smooth.set(option.info.name, option.value);
  method = smooth;
}

template <class Value>
OptionValue read_option(TableReader& table, const std::string& key, const OptionInfo& info, Value value) {
  if constexpr (std::same_as<Value, bool>) {
    return table.boolean(key, Need::optional).value_or(value);
  } else if constexpr (std::same_as<Value, OptionChoice>) {
    const std::vector<std::string> names(info.names.begin(), info.names.end());
    if (const auto name = table.choice(key, Need::optional, names))
      value.index = static_cast<std::size_t>(std::find(names.begin(), names.end(), *name) - names.begin());
    return value;
  } else if constexpr (std::same_as<Value, std::uint64_t>) {
    const auto low = static_cast<unsigned long long>(info.range.low);
    const auto high = static_cast<unsigned long long>(info.range.high);
    return std::uint64_t{table.count(key, Need::optional, low, high).value_or(value)};
  } else {
    table.number(key, Need::optional, value);
    if (table.is_good(key) && !info.range.contains(value))
      table.add(*table.node(key), table.path(key), "must be " + allowed_text(info.range));
    return value;
  }
}

/// The options of a method that are not `known` yet.
void read_options(TableReader& table, Method& method, std::vector<std::string>& known) {
  for (const Option& option : method.options()) {
    const OptionInfo& info = option.info;
    const std::string key = key_of(info);
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    known.push_back(key);
    method.set(info.name, std::visit([&](const auto& value) { return read_option(table, key, info, value); },
                                     option.value));
  }
}

}  // namespace

void read_method(TableReader& table, Method& method, const Scene<double>* scene) {
  if (auto name = table.choice("method", Need::optional, Method::names())) method = Method(*name);
  std::vector<std::string> known;
  read_options(table, method, known);
  if (scene) prefer_smooth(table, method, *scene);
  for (const std::string& name : Method::names()) {
    Method other(name);
    read_options(table, other, known);
  }
  table.finish();
}

}  // namespace shearfront::fit
