// SPDX-License-Identifier: BSD-3-Clause
// A second's worth of tests/bench/soak, which checks the same laws for as long as wanted.
#include <gtest/gtest.h>

#include "soak/laws.hpp"

namespace shearfront {
namespace {

class Soak : public testing::TestWithParam<std::uint64_t> {};

TEST_P(Soak, NoLawIsViolated) {
  constexpr std::uint64_t kScenes = 20;
  for (std::uint64_t n = 0; n < kScenes; ++n) {
    const soak::Trial trial = soak::draw_trial(support::seed_of(GetParam() + n));
    const soak::Findings findings = soak::check_trial(trial);
    EXPECT_GT(findings.n_checked, 100u);
    for (const auto& [law, places] : findings.violations())
      ADD_FAILURE() << law << ": " << places.front() << "\n" << soak::text_of(trial);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, Soak, testing::Values(1, 21, 41, 61));

TEST(SoakScenes, AreFunctionsOfTheSeedAndReadBack) {
  EXPECT_EQ(soak::text_of(soak::draw_trial(7)), soak::text_of(soak::draw_trial(7)));
  EXPECT_NE(soak::text_of(soak::draw_trial(7)), soak::text_of(soak::draw_trial(8)));
}

}  // namespace
}  // namespace shearfront
