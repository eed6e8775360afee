// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <string_view>

namespace shearfront::detail {

struct DecodedText {
  std::string text;           ///< UTF-8, if the bytes could be read as text at all
  std::string_view encoding;  ///< what it was; empty: UTF-8
};

/// The text of a file that may be UTF-8, UTF-16 (by its byte order mark, or by a zero byte in its first character) or
/// Windows-1252 (what is no UTF-8 and has no NUL byte). Bytes that are none of these come back as they are.
[[nodiscard]] DecodedText decoded(std::string bytes);

}  // namespace shearfront::detail
