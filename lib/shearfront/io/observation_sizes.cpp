// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/observation_sizes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "shearfront/numeric/number_text.hpp"

namespace shearfront::detail {
namespace {

constexpr double kPlausiblePhi = 2;  // beyond it phi is no fraction with noise, but probably in percent
/// A value this many times farther off than any that is possible is no measurement with noise.
constexpr double kImpossible = 1000;

bool is_concentration(Quantity quantity) {
  return quantity != Quantity::cumulative && quantity != Quantity::bed_height;
}

}  // namespace

std::vector<ImplausibleValue> impossible_values(const Observations& observations,
                                                const StateRange<double>& phi, double bed) {
  const bool is_sum = observations.quantity == Quantity::cumulative,
             is_height = observations.quantity == Quantity::bed_height;
  const StateRange<double> possible = is_height ? StateRange<double>{0, 1} : phi;
  const double height = is_height || is_sum ? bed : 1;
  const double width = height * (possible.highest - possible.lowest);
  const double lowest =
      height * std::min(possible.lowest, is_sum ? 0.0 : possible.lowest) - kImpossible * width;
  const double highest = height * possible.highest + kImpossible * width;
  std::vector<ImplausibleValue> found;
  for (std::size_t i = 0; i < observations.rows.size(); ++i) {
    const double value = observations.rows[i].value;
    if (value >= lowest && value <= highest) continue;
    found.push_back({i, fmt::format("must lie near what the scene allows, {} to {}",
                                    number_text(height * possible.lowest, 6),
                                    number_text(height * possible.highest, 6))});
  }
  return found;
}

std::optional<ImplausibleValue> undeclared_percent(const Observations& observations) {
  if (!is_concentration(observations.quantity)) return std::nullopt;
  for (std::size_t i = 0; i < observations.rows.size(); ++i)
    if (std::abs(observations.rows[i].value) > kPlausiblePhi)  // the others are as wrong
      return ImplausibleValue{
          i, "must be a fraction of 1; what is in percent must say so: phi [%] in the header"};
  return std::nullopt;
}

std::vector<std::string> remarks_on_sizes(const Observations& observations,
                                          const std::optional<StateRange<double>>& phi, double height) {
  const std::vector<Observation>& rows = observations.rows;
  if (observations.quantity == Quantity::cumulative) return {};
  if (observations.quantity == Quantity::bed_height) {
    // A bed whose grains have come apart is as high as the domain, one that mixes hardly lower.
    constexpr double kPlausible = 2;
    if (!std::isfinite(height)) return {};
    for (const Observation& o : rows)
      if (!(o.value < kPlausible * height && o.value > height / kPlausible))
        return {
            fmt::format("H = {} where a segregated bed has {}, the height of the domain (in another unit?)",
                        number_text(o.value), number_text(height))};
    return {};
  }
  if (phi && !(phi->lowest == 0 && phi->highest <= 1)) {
    const double width = phi->highest - phi->lowest;
    for (const Observation& o : rows)
      if (!(o.value <= phi->highest + width && o.value >= phi->lowest - width))
        return {fmt::format("phi = {} where the flux has states from {} to {} (in another unit?)",
                            number_text(o.value), number_text(phi->lowest, 6), number_text(phi->highest, 6))};
    return {};
  }
  const auto largest = std::max_element(
      rows.begin(), rows.end(), [](const Observation& a, const Observation& b) { return a.value < b.value; });
  if (!(largest->value > kPlausiblePhi)) return {};
  return {fmt::format("phi goes up to {}; {} (is it in percent?)", number_text(largest->value),
                      phi ? "it must be a fraction, 1 where all grains are small"
                          : "it must be a fraction unless the flux of its scene has other states")};
}

}  // namespace shearfront::detail
