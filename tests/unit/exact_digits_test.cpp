// SPDX-License-Identifier: BSD-3-Clause
// Texts of event times: the first digits are those of double, and there are as many as asked for.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "shearfront/digits/exact_digits.hpp"
#include "shearfront/exact/events.hpp"
#include "shearfront/io/scene_file.hpp"

namespace shearfront {
namespace {

TEST(ExactDigits, BeginWithThoseOfDouble) {
  const std::string path = SHEARFRONT_SOURCE_DIR "/datasets/may-2010-piecewise/scene.toml";
  std::ifstream file(path);
  const std::string scene((std::istreambuf_iterator<char>(file)), {});
  const TimelineText text = exact_digits(scene, path, 60);
  const auto timeline = exact_timeline(read_scene<double>(path));
  ASSERT_EQ(text.interfaces.size(), timeline.interfaces.size());
  const auto check = [](const std::optional<std::string>& digits, const std::optional<double>& x) {
    ASSERT_TRUE(digits && x);
    EXPECT_EQ(digits->find_first_not_of("0."), digits->find_first_of("123456789"));
    EXPECT_GE(digits->size(), 60u) << *digits;
    EXPECT_NEAR(std::strtod(digits->c_str(), nullptr), *x, 1e-14 * *x);
  };
  check(text.t0, timeline.t0);
  check(text.t1, timeline.t1);
  check(text.t_star, timeline.t_star);
  check(text.interfaces[0].first, timeline.interfaces[0].first);
  check(text.interfaces[0].last, timeline.interfaces[0].last);
}

TEST(ExactDigits, ATextForEveryNumberOfDigits) {
  Timeline<double> timeline;
  timeline.t0 = 0.1 + 0.2;
  timeline.mass = 0;
  EXPECT_EQ(text_of(timeline, 0).t0, "0.30000000000000004");
  EXPECT_EQ(text_of(timeline, 3).t0, "0.3");
  EXPECT_EQ(text_of(timeline, 3).mass, "0");
  EXPECT_FALSE(text_of(timeline, 3).t1);
}

}  // namespace
}  // namespace shearfront
