// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/model_choice_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "shearfront/fit/model_choice.hpp"
#include "shearfront/io/text.hpp"
#include "shearfront/model/depth/all.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::fit {
namespace {

using detail::TableReader;
using Need = TableReader::Need;

constexpr unsigned kMostLayers = 1000;

}  // namespace

ModelChoice read_model_choice(TableReader& table, const std::function<void(Complaint)>& add) {
  ModelChoice choice;
  bool is_refused = false;
  const auto refuse = [&](const std::string& key, std::size_t i, const std::string& value, std::string why) {
    is_refused = true;
    add({fmt::format("{}[{}]", table.path(key), i), value, std::move(why)});
  };
  if (table.node("layers")) {
    std::vector<double> counts;
    table.number("layers", Need::optional, counts);
    for (std::size_t i = 0; table.is_good("layers") && i < counts.size(); ++i) {
      if (!(counts[i] >= 1 && counts[i] <= kMostLayers && counts[i] == std::floor(counts[i])))
        refuse("layers", i, "", fmt::format("must be a whole number from 1 to {}", kMostLayers));
      else
        choice.models.push_back({layered_name(), static_cast<std::size_t>(counts[i]), {}});
    }
  }
  if (table.node("models")) {
    const auto names = table.texts("models", Need::optional, "must be an array of names such as \"table:6\"");
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].empty()) continue;  // refused
      const std::size_t colon = names[i].find(':');
      const auto n = colon == std::string::npos ? 0 : parse_count(names[i].substr(colon + 1));
      const ModelChoice::Model model{names[i].substr(0, colon), static_cast<std::size_t>(n.value_or(0)), {}};
      if (!n || *n > kMostLayers)
        refuse("models", i, quoted_text(names[i]), "must be a name, or a name and a number such as table:6");
      else if (std::string why = refusal(model); !why.empty())
        refuse("models", i, quoted_text(names[i]), std::move(why));
      else
        choice.models.push_back(model);
    }
  }
  if (const toml::node* breaks = table.node("breaks"); breaks && breaks->is_array()) {
    std::vector<double> known;
    table.number("breaks", Need::optional, known);
    for (std::size_t i = 1; table.is_good("breaks") && i < known.size(); ++i)
      if (!(known[i] > known[i - 1]))
        refuse("breaks", i, number_text(known[i]), "must be in ascending order");
    if (table.is_good("breaks") && !known.empty())
      choice.models.push_back({layered_name(), known.size() + 1, std::move(known)});
  } else {
    choice.has_free_breaks = table.choice("breaks", Need::optional, {"equal", "free"}).value_or("") == "free";
  }
  const std::vector<std::string> criteria{"AIC", "BIC", "mBIC"};  // in the order of ModelCriterion
  const std::string criterion = table.choice("criterion", Need::optional, criteria).value_or("AIC");
  choice.criterion =
      static_cast<ModelCriterion>(std::find(criteria.begin(), criteria.end(), criterion) - criteria.begin());
  const auto is_fine = [&](const char* key) { return !table.node(key) || table.is_good(key); };
  if (choice.models.empty() && !is_refused && is_fine("layers") && is_fine("models") && is_fine("breaks"))
    add({"compare", "", "must have layers, models or known breaks"});
  table.finish();
  return choice;
}

}  // namespace shearfront::fit
