// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/io/detail/encoding.hpp"

#include <iconv.h>

#include <optional>
#include <utility>

#include "shearfront/io/text.hpp"

namespace shearfront::detail {
namespace {

std::optional<std::string> to_utf8(std::string_view bytes, const char* from) {
  const iconv_t converter = iconv_open("UTF-8", from);
  if (converter == iconv_t(-1)) return std::nullopt;
  std::string source(bytes), text(4 * bytes.size() + 4, '\0');
  char *in = source.data(), *out = text.data();
  std::size_t left = source.size(), room = text.size();
  const bool is_good = iconv(converter, &in, &left, &out, &room) != static_cast<std::size_t>(-1) && left == 0;
  iconv_close(converter);
  text.resize(text.size() - room);
  return is_good ? std::optional(std::move(text)) : std::nullopt;
}

/// "UTF-16LE", "UTF-16BE", or null if it is none.
const char* utf16(std::string_view bytes) {
  if (bytes.size() < 2) return nullptr;
  if (bytes.starts_with("\xFF\xFE") || (bytes[0] != '\0' && bytes[1] == '\0')) return "UTF-16LE";
  if (bytes.starts_with("\xFE\xFF") || (bytes[0] == '\0' && bytes[1] != '\0')) return "UTF-16BE";
  return nullptr;
}

}  // namespace

DecodedText decoded(std::string bytes) {
  if (const char* form = utf16(bytes)) {
    const bool is_marked = bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF");
    if (auto text = to_utf8(std::string_view(bytes).substr(is_marked ? 2 : 0), form); text)
      return {std::move(*text), "UTF-16"};
    return {std::move(bytes), ""};
  }
  if (first_bad_utf8(bytes) == bytes.size() || bytes.find('\0') != std::string::npos)
    return {std::move(bytes), ""};
  if (auto text = to_utf8(bytes, "WINDOWS-1252"); text) return {std::move(*text), "Windows-1252"};
  return {std::move(bytes), ""};
}

}  // namespace shearfront::detail
