// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <gtest/gtest.h>

#include <cstddef>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>

namespace shearfront::support {

/// Counts what a law has checked, by name; at the end of its scope it fails for those that were never checked. A law that
/// skips what it does not apply to (`continue`, `return`) counts what is left, so that it cannot pass without testing.
class Checked {
 public:
  /// `names`: of what must be checked at least `least` times.
  explicit Checked(std::initializer_list<std::string_view> names = {""}, std::size_t least = 1)
      : least_(least) {
    for (const std::string_view name : names) expect(name);
  }
  Checked(const Checked&) = delete;
  Checked& operator=(const Checked&) = delete;
  ~Checked() {
    for (const auto& [name, n] : counts_)
      EXPECT_GE(n, least_) << (name.empty() ? std::string("nothing") : name) << " has hardly been checked";
  }

  void expect(std::string_view name) { counts_.try_emplace(std::string(name)); }
  void count(std::string_view name = "") { ++counts_[std::string(name)]; }

 private:
  std::size_t least_;
  std::map<std::string, std::size_t> counts_;
};

}  // namespace shearfront::support
