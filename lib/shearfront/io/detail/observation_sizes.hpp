// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/scene/state_range.hpp"
#include "shearfront/solution/observation.hpp"

/// Whether measured values can be what they are said to be.
namespace shearfront::detail {

struct ImplausibleValue {
  std::size_t row;
  std::string constraint;
};

/// Values a thousand times farther off than any the scene allows: phi by the width of the range of states, M and H by the
/// height of the bed. They are no measurements with noise, and would drown all others in a fit.
[[nodiscard]] std::vector<ImplausibleValue> impossible_values(const Observations& observations,
                                                              const StateRange<double>& phi, double height);

/// The first concentration beyond 2 of those that are fractions of 1: percent that nobody declared.
[[nodiscard]] std::optional<ImplausibleValue> undeclared_percent(const Observations& observations);

/// What looks like another unit and is used all the same; `phi` that the scene allows, if there is one. Precondition: rows.
[[nodiscard]] std::vector<std::string> remarks_on_sizes(const Observations& observations,
                                                        const std::optional<StateRange<double>>& phi,
                                                        double height);

}  // namespace shearfront::detail
