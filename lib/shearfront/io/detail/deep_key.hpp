// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string_view>

namespace shearfront::detail {

/// More names than any key of this program has, and few enough for a parser that recurses over them, also at its own
/// limit of nested values.
inline constexpr std::size_t kMostKeyNames = 32;

/// Where the first key of more than kMostKeyNames names joined by points (a.b."c" ...) begins in a TOML text. So many
/// joined words in text between three quotation marks do not count. Cost: O(size).
[[nodiscard]] std::optional<std::size_t> first_deep_key(std::string_view toml);

}  // namespace shearfront::detail
