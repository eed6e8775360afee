// SPDX-License-Identifier: BSD-3-Clause
// The pages show how long a search was. The test of the pages does not compare that, for it differs between compilers; this
// one does, with room for that: counts of another version of the search are not left standing.
#include <gtest/gtest.h>

#include <cstddef>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "shearfront/fit.hpp"

namespace shearfront {
namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(std::string(SHEARFRONT_SOURCE_DIR) + "/" + path);
  EXPECT_TRUE(file.good()) << path;
  return {std::istreambuf_iterator<char>(file), {}};
}

void expect_near_count(const std::string& shown, std::size_t now, const std::string& where) {
  const double count = std::stod(shown);
  EXPECT_NEAR(count, static_cast<double>(now), 2 + 0.1 * count) << where;
}

TEST(ShownSearch, IsAsLongAsTheSearchIs) {
  const auto estimate = fit::fit(fit::read_fit(std::string(SHEARFRONT_SOURCE_DIR) +
                                               "/datasets/paper-example-4/fit-bin-noise-0.01.toml"));
  const std::regex line(std::to_string(estimate.observations) +
                        R"( observations, (\d+) evaluations, (\d+) iterations)");
  for (const std::string page : {"README.md", "docs/how-to/identification.md"}) {
    std::smatch found;
    const std::string text = text_of(page);
    ASSERT_TRUE(std::regex_search(text, found, line)) << page;
    expect_near_count(found[1], estimate.evaluations, page);
    expect_near_count(found[2], estimate.iterations, page);
  }
}

}  // namespace
}  // namespace shearfront
