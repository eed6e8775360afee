// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/prior_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

namespace shearfront::fit {
namespace {

using detail::ComplaintReport;
using detail::TomlSource;

constexpr std::string_view kPriorTable = "prior";

/// What is wrong with the numbers of a distribution in a file; empty if nothing is.
std::string refusal_of_numbers(const Prior& prior, const std::vector<double>& numbers) {
  const std::size_t n = prior.kind == PriorKind::half_normal ? 1 : 2;
  if (numbers.size() != n ||
      !std::all_of(numbers.begin(), numbers.end(), [](double x) { return std::isfinite(x); }))
    return n == 1 ? "must be a number" : "must be two numbers";
  return prior.refusal();
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
    prior.first = numbers.empty() ? 0 : numbers[0];
    prior.second = numbers.size() > 1 ? numbers[1] : 0;
    if (std::string why = refusal_of_numbers(prior, numbers); !why.empty())
      return add(node, name + "." + std::string(*kind), std::move(why));
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
  std::vector<std::string> with_prior;
  for (const Prior& prior : priors) {
    std::string constraint = parameters.refusal_of_name(prior.parameter);
    for (const Parameter& p : parameters) {
      if (!p.is_named(prior.parameter)) continue;
      if (std::find(with_prior.begin(), with_prior.end(), p.name()) != with_prior.end())
        constraint = "must not give " + p.name() + " a second distribution";
      with_prior.push_back(p.name());
    }
    if (constraint.empty()) continue;
    const toml::node* node = source.root().get(kPriorTable);
    report.add(TomlSource::position(*node),
               {std::string(kPriorTable) + "." + prior.parameter, "", constraint});
  }
}

}  // namespace shearfront::fit
