// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/prior_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "shearfront/io/text.hpp"

namespace shearfront::fit {
namespace {

using detail::ComplaintReport;
using detail::TomlSource;

constexpr std::string_view kPriorTable = "prior";

/// What is wrong with the numbers of a distribution; empty if nothing is.
std::string refusal_of_numbers(PriorKind kind, const std::vector<double>& numbers) {
  const std::size_t n = kind == PriorKind::half_normal ? 1 : 2;
  if (numbers.size() != n ||
      !std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }))
    return n == 1 ? "must be a number" : "must be two numbers";
  switch (kind) {
    case PriorKind::uniform:
      return numbers[0] < numbers[1] ? "" : "must ascend";
    case PriorKind::lognormal:
      if (!(numbers[0] > 0)) return "must have a median > 0";
      [[fallthrough]];
    case PriorKind::normal:
      return numbers[1] > 0 ? "" : "must have a standard deviation > 0";
    case PriorKind::half_normal:
      break;
  }
  return numbers[0] > 0 ? "" : "must have a standard deviation > 0";
}

class PriorReader {
 public:
  PriorReader(const TomlSource& source, ComplaintReport& report) : source_(source), report_(report) {}

  /// Dotted names are tables in tables, down to one that says a distribution.
  void read(const toml::table& table, const std::string& prefix) {
    for (const auto& [key, node] : table) {
      const std::string name = prefix + std::string(key.str());
      const toml::table* inner = node.as_table();
      if (!inner)
        add(node, name, "must be a table with a distribution such as { normal = [1, 0.1] }");
      else if (std::any_of(kPriorNames.begin(), kPriorNames.end(),
                           [&](std::string_view kind) { return inner->contains(kind); }))
        distribution(name, *inner);
      else
        read(*inner, name + ".");
    }
  }
  std::vector<Prior> take() { return std::move(priors_); }

 private:
  void add(const toml::node& node, const std::string& key, std::string constraint) {
    report_.add(TomlSource::position(node),
                {std::string(kPriorTable) + "." + key, source_.shown(node), std::move(constraint)});
  }

  void distribution(const std::string& name, const toml::table& table) {
    const auto only = table.begin();  // what it points to lives in it
    const toml::node& node = only->second;
    const auto kind = std::find(kPriorNames.begin(), kPriorNames.end(), only->first.str());
    if (table.size() != 1 || kind == kPriorNames.end())
      return add(table, name, fmt::format("must have one of: {}", fmt::join(kPriorNames, ", ")));
    Prior prior{name, static_cast<PriorKind>(kind - kPriorNames.begin())};
    std::vector<double> numbers;
    if (const toml::array* array = node.as_array())
      for (const toml::node& element : *array) numbers.push_back(element.value<double>().value_or(NAN));
    else
      numbers.push_back(node.value<double>().value_or(NAN));
    if (std::string why = refusal_of_numbers(prior.kind, numbers); !why.empty())
      return add(node, name + "." + std::string(*kind), std::move(why));
    prior.first = numbers[0];
    prior.second = numbers.size() > 1 ? numbers[1] : 0;
    priors_.push_back(std::move(prior));
  }

  const TomlSource& source_;
  ComplaintReport& report_;
  std::vector<Prior> priors_;
};

}  // namespace

std::vector<Prior> read_priors(const TomlSource& source, ComplaintReport& report) {
  const toml::node* node = source.root().get(kPriorTable);
  if (!node || !node->is_table()) return {};
  PriorReader reader(source, report);
  reader.read(*node->as_table(), "");
  return reader.take();
}

void check_priors(const std::vector<Prior>& priors, const Parameters& parameters, const TomlSource& source,
                  ComplaintReport& report) {
  std::vector<std::string> names, with_prior;
  for (const Parameter& p : parameters) names.push_back(p.name());
  for (const Prior& prior : priors) {
    std::size_t n = 0;
    std::string constraint;
    for (const Parameter& p : parameters) {
      if (p.entry.field != prior.parameter && p.name() != prior.parameter) continue;
      ++n;
      if (std::find(with_prior.begin(), with_prior.end(), p.name()) != with_prior.end())
        constraint = "must not give " + p.name() + " a second distribution";
      with_prior.push_back(p.name());
    }
    if (n == 0) {
      const auto meant = nearest_name(prior.parameter, names);
      constraint = fmt::format("must be an unknown of the fit: {}", fmt::join(names, ", "));
      if (meant) constraint += " (did you mean " + *meant + "?)";
    }
    if (constraint.empty()) continue;
    const toml::node* node = source.root().get(kPriorTable);
    report.add(TomlSource::position(*node),
               {std::string(kPriorTable) + "." + prior.parameter, "", constraint});
  }
}

}  // namespace shearfront::fit
