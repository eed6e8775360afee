// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "compare/observed.hpp"
#include "compare/race.hpp"

/// The results of `shearfront compare` as text, CSV and JSON.
namespace shearfront::tools {

/// A table per time and the time every method needs for some errors.
[[nodiscard]] std::string race_text(const std::vector<Panel>& panels);
/// Header method,resolution,t,l1_error,wall_s,work and one row per rung.
[[nodiscard]] std::string race_csv(const std::vector<Panel>& panels);
/// Relative errors of the event times, one column per event.
[[nodiscard]] std::string events_text(const ObservedEvents& events);
/// {"scene","times":[{"t","methods":[{"method","rungs":[..],"time_to_error":[..]}]}],"events":[..]}.
[[nodiscard]] std::string race_json(std::string_view scene, const std::vector<Panel>& panels,
                                    const ObservedEvents* events);

/// A duration in the unit that suits it: "0.0021 s", "3.5 min", "2.1 h".
[[nodiscard]] std::string duration_text(double seconds);

}  // namespace shearfront::tools
