// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <exception>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/observation.hpp"

/// How the page talks to the engine: every call is a C function, takes texts and arrays by address, and leaves its answer,
/// numbers and a text, where the page reads it (sf_numbers, sf_text). Nothing is thrown to the page: a call returns 1, or 0
/// with the reason as the text.
namespace shearfront::web {

struct Answer {
  std::vector<double> numbers;
  std::string text;

  void add(double x) { numbers.push_back(x); }
  void add(const std::optional<double>& x);  ///< NaN if there is none
  void add(const std::vector<double>& xs) { numbers.insert(numbers.end(), xs.begin(), xs.end()); }
  void line(std::string_view text_line);  ///< of the text; breaks in it become blanks
};

/// Of the last call.
[[nodiscard]] Answer& answer();

/// What the page works on: set by sf_scene, sf_observations.
struct Work {
  std::optional<Scene<double>> scene;
  std::uint64_t scene_number = 0;  ///< grows with every scene that is set
  std::optional<Observations> observations;
};
[[nodiscard]] Work& work();

/// Answers by fill(answer); an exception becomes its text.
template <class Fill>
int answered(Fill&& fill) {
  answer() = {};
  try {
    fill(answer());
    return 1;
  } catch (const std::exception& error) {
    answer() = {};
    answer().text = error.what();
    return 0;
  }
}

}  // namespace shearfront::web
