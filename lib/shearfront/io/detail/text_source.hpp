// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/file_error.hpp"

namespace shearfront::detail {

/// A place in a text file, counted from 1; columns count code points.
struct Position {
  std::uint32_t line = 0, column = 0;
  friend bool operator==(const Position&, const Position&) = default;
  friend bool operator<(const Position& a, const Position& b) {
    return a.line < b.line || (a.line == b.line && a.column < b.column);
  }
};

/// The text of an input file: UTF-8 without byte order mark and without NUL bytes.
class TextSource {
 public:
  /// Errors: FileError if the text is not UTF-8 or contains NUL bytes.
  TextSource(std::string name, std::string text);
  /// "-" is standard input. Errors: FileError if the file cannot be read, too.
  static TextSource read(const std::string& path);
  /// The same of a file in any encoding that decoded() knows; the text is then UTF-8.
  static TextSource read_decoded(const std::string& path);
  [[nodiscard]] static TextSource decode(std::string name, std::string bytes);
  /// What a decoded text was; empty: UTF-8.
  [[nodiscard]] std::string_view encoding() const { return encoding_; }

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] const std::string& text() const { return text_; }
  /// Byte offset of a place; the end of the text if there is no such place. Cost: O(1) for ASCII text,
  /// otherwise amortised O(1) when asked in ascending order.
  [[nodiscard]] std::size_t offset(Position position) const;
  [[nodiscard]] Position position(std::size_t offset) const;

 private:
  std::string name_, text_;
  std::string_view encoding_;
  std::vector<std::size_t> line_starts_;
  bool is_ascii_ = true;
  mutable Position last_{1, 1};  ///< where the last search ended
  mutable std::size_t last_offset_ = 0;
};

/// Collects the complaints about one file and reports them in the order of the file: all of them, or the first
/// `most` and how many more there are. Memory: O(most).
class ComplaintReport {
 public:
  static constexpr std::size_t kUsualMost = 1000;  ///< complaints that are told; of the others their number
  explicit ComplaintReport(std::string file, std::size_t most = kUsualMost)
      : file_(std::move(file)), most_(most) {}

  void add(Position position, Complaint complaint) { add(position, position, std::move(complaint)); }
  /// Ordered by `position` and printed with `shown`.
  void add(Position position, Position shown, Complaint complaint);
  /// Remembers that an entry could not be read, so that what only follows from this is not reported.
  void spoil(std::string key) { spoiled_.insert(std::move(key)); }
  /// Whether this entry or a table or array around it could not be read.
  [[nodiscard]] bool is_spoiled(std::string_view key) const;
  [[nodiscard]] bool is_empty() const { return located_.empty(); }
  /// The complaints, sorted by place, each line once; nothing if there are none.
  [[nodiscard]] std::optional<FileError> error() const;
  /// Errors: that.
  void throw_if_any() const;

 private:
  struct Located {
    Position position, shown;
    Complaint complaint;
  };
  static void sort(std::vector<Located>& located);

  std::string file_;
  std::size_t most_;
  std::size_t n_dropped_ = 0;  ///< complaints beyond the first most_
  std::vector<Located> located_;
  std::set<std::string, std::less<>> spoiled_;
};

/// Errors: FileError with all that these say, in their order; nothing if there are none.
void throw_joined(const std::vector<FileError>& errors);

/// FileError for a complaint about a file as a whole: "scene.toml: cannot be read: Is a directory".
[[noreturn]] void throw_file_error(const std::string& file, const std::string& what);

}  // namespace shearfront::detail
