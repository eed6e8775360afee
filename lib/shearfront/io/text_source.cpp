// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <system_error>
#include <utility>

#include "shearfront/io/detail/encoding.hpp"
#include "shearfront/io/detail/text_source.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::detail {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20;  // endless devices must not fill the memory

std::string read_bytes(const std::string& path) {
  const auto fail = [&](int error) {
    throw_file_error(path, "cannot be read: " + std::generic_category().message(error));
  };
  const auto close = [](std::FILE* f) { return f == stdin ? 0 : std::fclose(f); };
  const std::unique_ptr<std::FILE, decltype(close)> file(path == "-" ? stdin : std::fopen(path.c_str(), "rb"),
                                                         close);
  if (!file) fail(errno);
  std::string text;
  std::array<char, 1 << 16> block;
  while (const std::size_t n = std::fread(block.data(), 1, block.size(), file.get())) {
    text.append(block.data(), n);
    if (text.size() > kLargestFile) throw_file_error(path, "is larger than 256 MiB");
  }
  if (std::ferror(file.get()) != 0) fail(errno);
  return text;
}

bool continues(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

}  // namespace

void throw_file_error(const std::string& file, const std::string& what) {
  const std::string name = printable(file);
  throw FileError({{name, "", what, Complaint::Kind::unreadable}}, name + ": " + what);
}

TextSource::TextSource(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);
  if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF"))
    throw_file_error(name_, "is UTF-16 text; must be UTF-8");
  line_starts_.push_back(0);
  for (std::size_t i = text_.find('\n'); i != std::string::npos; i = text_.find('\n', i + 1))
    line_starts_.push_back(i + 1);
  is_ascii_ = std::none_of(text_.begin(), text_.end(), [](char c) { return (c & '\x80') != 0; });

  const std::size_t nul = text_.find('\0'), bad = first_bad_utf8(text_);
  if (nul == std::string::npos && bad == text_.size()) return;
  const std::size_t where = std::min(nul, bad);
  ComplaintReport report(name_);
  const auto byte = static_cast<unsigned char>(text_[where]);
  if (byte == 0)
    report.add(position(where), {"NUL byte", "", "must not occur in a text file", Complaint::Kind::syntax});
  else
    report.add(position(where),
               {fmt::format("byte 0x{:02x}", byte), "", "must be UTF-8 text", Complaint::Kind::syntax});
  report.throw_if_any();
}

TextSource TextSource::read(const std::string& path) { return {path, read_bytes(path)}; }

TextSource TextSource::read_decoded(const std::string& path) { return decode(path, read_bytes(path)); }

TextSource TextSource::decode(std::string name, std::string bytes) {
  DecodedText decoded_text = decoded(std::move(bytes));
  TextSource source(std::move(name), std::move(decoded_text.text));
  source.encoding_ = decoded_text.encoding;
  return source;
}

std::size_t TextSource::offset(Position position) const {
  if (position.line == 0 || position.line > line_starts_.size()) return text_.size();
  const std::size_t start = line_starts_[position.line - 1];
  if (is_ascii_) return std::min(start + position.column - 1, text_.size());
  if (position < last_ || position.line != last_.line) {
    last_ = {position.line, 1};
    last_offset_ = start;
  }
  while (last_.column < position.column && last_offset_ < text_.size()) {
    do ++last_offset_;
    while (last_offset_ < text_.size() && continues(text_[last_offset_]));
    ++last_.column;
  }
  return last_offset_;
}

Position TextSource::position(std::size_t offset) const {
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::size_t start = *(next - 1);
  const auto begin = text_.begin() + static_cast<std::ptrdiff_t>(start);
  const auto characters = std::count_if(begin, begin + static_cast<std::ptrdiff_t>(offset - start),
                                        [](char c) { return !continues(c); });
  return {static_cast<std::uint32_t>(next - line_starts_.begin()),
          static_cast<std::uint32_t>(characters + 1)};
}

void ComplaintReport::sort(std::vector<Located>& located) {
  std::stable_sort(located.begin(), located.end(),
                   [](const Located& a, const Located& b) { return a.position < b.position; });
}

void ComplaintReport::add(Position position, Position shown, Complaint complaint) {
  located_.push_back({position, shown, std::move(complaint)});
  if (located_.size() / 2 < most_) return;
  sort(located_);
  n_dropped_ += located_.size() - most_;
  located_.resize(most_);
}

bool ComplaintReport::is_spoiled(std::string_view key) const {
  while (!key.empty()) {
    if (spoiled_.contains(key)) return true;
    const std::size_t cut = key.find_last_of(".[");
    key = key.substr(0, cut == std::string_view::npos ? 0 : cut);
  }
  return false;
}

void ComplaintReport::throw_if_any() const {
  if (auto all = error()) throw FileError(std::move(*all));
}

std::optional<FileError> ComplaintReport::error() const {
  if (located_.empty()) return std::nullopt;
  std::vector<Located> order = located_;
  sort(order);
  const std::string name = printable(file_);
  std::string report, last;
  Complaints complaints;
  std::size_t n_more = n_dropped_;
  for (Located& l : order) {
    std::string line = fmt::format("{}:{}:{}: {}", name, l.shown.line, l.shown.column, l.complaint.text());
    if (line == last) continue;
    if (complaints.size() == most_) {
      ++n_more;
      continue;
    }
    report += (report.empty() ? "" : "\n") + line;
    complaints.push_back(std::move(l.complaint));
    last = std::move(line);
  }
  if (n_more > 0) report += fmt::format("\n{}: and {} more problem{}", name, n_more, n_more == 1 ? "" : "s");
  return FileError(std::move(complaints), std::move(report));
}

void throw_joined(const std::vector<FileError>& errors) {
  if (errors.empty()) return;
  Complaints complaints;
  std::string text;
  for (const FileError& error : errors) {
    complaints.insert(complaints.end(), error.complaints().begin(), error.complaints().end());
    text += (text.empty() ? "" : "\n") + std::string(error.what());
  }
  throw FileError(std::move(complaints), std::move(text));
}

}  // namespace shearfront::detail
