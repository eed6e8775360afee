// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <toml++/toml.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "shearfront/io/detail/number_literal.hpp"
#include "shearfront/io/detail/text_source.hpp"

namespace shearfront::detail {

/// A parsed TOML file that remembers its text.
class TomlSource {
 public:
  /// Errors: FileError for a syntax error.
  explicit TomlSource(TextSource text);

  [[nodiscard]] const std::string& name() const { return text_.name(); }
  [[nodiscard]] const toml::table& root() const { return root_; }
  [[nodiscard]] static Position position(const toml::node& node) { return position(node.source()); }
  [[nodiscard]] static Position position(const toml::source_region& region);
  /// Where a message points to: the value; for an element on the line where its array opens, the array.
  [[nodiscard]] static Position shown_position(const toml::node& node, const toml::node* around);
  /// The text of a number as it stands in the file; it ends at a blank, comma, bracket or comment.
  [[nodiscard]] std::string_view literal(const toml::node& node) const;
  /// The value of an entry for a message: a number as written, text quoted and shortened, "(an array)", ...
  [[nodiscard]] std::string shown(const toml::node& node) const;
  /// The entry with this path ("initial.values[2]"), or the nearest existing table or array around it.
  struct Found {
    const toml::node* node;
    const toml::node* around;  ///< the array or table that contains it
    bool is_exact;
  };
  [[nodiscard]] Found find(std::string_view path) const;

 private:
  TextSource text_;
  toml::table root_;
};

/// One table of a TOML file while it is read. Every request for an entry notes in the report what is wrong
/// with it; finish() notes the entries nobody asked for.
class TableReader {
 public:
  TableReader(const TomlSource& source, ComplaintReport& report, std::string path, const toml::table& table)
      : source_(&source), report_(&report), path_(std::move(path)), table_(&table) {}

  enum class Need { optional, required };

  /// A table inside this one; `what` tells what it must be, for the message.
  [[nodiscard]] std::optional<TableReader> table(std::string_view key, Need need, std::string_view what);
  /// One table, or each of an array of tables ([[key]]), which then are called key[0], key[1], ...
  [[nodiscard]] std::vector<TableReader> tables(std::string_view key, Need need, std::string_view what);
  [[nodiscard]] std::optional<std::string> text(std::string_view key, Need need, std::string_view what);
  /// One of these names; nothing if it is missing or wrong.
  [[nodiscard]] std::optional<std::string> choice(std::string_view key, Need need,
                                                  const std::vector<std::string>& names);
  /// The same as its place among them: for enumerators in the order of their names.
  template <class Names>
  [[nodiscard]] std::optional<std::size_t> place(std::string_view key, Need need, const Names& names) {
    const std::vector<std::string> all(names.begin(), names.end());
    const auto name = choice(key, need, all);
    if (!name) return std::nullopt;
    return static_cast<std::size_t>(std::find(all.begin(), all.end(), *name) - all.begin());
  }
  [[nodiscard]] std::optional<bool> boolean(std::string_view key, Need need);
  /// A whole number from `low` to `high`; 1e6 is one, too. Nothing if it is missing or wrong.
  [[nodiscard]] std::optional<unsigned long long> count(std::string_view key, Need need,
                                                        unsigned long long low, unsigned long long high);
  /// An array of text, with "" for each element that is wrong.
  [[nodiscard]] std::vector<std::string> texts(std::string_view key, Need need, std::string_view what);
  /// A number; NaN if it is missing or wrong (the report then has its key), untouched if optional and
  /// missing.
  template <Real S>
  void number(std::string_view key, Need need, S& value) {
    if (const toml::node* node = request(key, need, "must be a number"))
      value = read_number<S>(*node, path(key), "must be a number");
    else if (need == Need::required)
      value = std::numeric_limits<S>::quiet_NaN();
  }
  /// An array of numbers, with NaN for each element that is wrong.
  template <Real S>
  void number(std::string_view key, Need need, std::vector<S>& values) {
    constexpr std::string_view kWhat = "must be an array of numbers";
    const toml::node* node = request(key, need, kWhat);
    const toml::array* array = node ? node->as_array() : nullptr;
    if (!array || is_array_of_tables(*array)) {
      if (node) wrong_type(*node, path(key), kWhat);
      if (node || need == Need::required) report_->spoil(lengths(path_));
      return;
    }
    values.clear();
    values.reserve(array->size());
    const std::string array_path = path(key);
    for (const toml::node& element : *array)
      values.push_back(read_number<S>(element, array_path, "must be a number", array, values.size()));
  }
  /// Reports unknown keys.
  void finish();

  /// What is spoiled when the lengths of the arrays of a table cannot be compared.
  [[nodiscard]] static std::string lengths(const std::string& table) { return table + "()"; }
  [[nodiscard]] std::string path(std::string_view key) const;
  [[nodiscard]] Position position() const { return TomlSource::position(*table_); }
  /// `around` is the array if the node is an element of one.
  void add(const toml::node& node, const std::string& key, std::string_view constraint,
           const toml::node* around = nullptr, Complaint::Kind kind = Complaint::Kind::out_of_range);
  [[nodiscard]] const toml::node* node(std::string_view key) const { return table_->get(key); }
  /// Whether the entry is there and nothing was wrong with it so far.
  [[nodiscard]] bool is_good(std::string_view key) const {
    return node(key) && !report_->is_spoiled(path(key));
  }

 private:
  static bool is_array_of_tables(const toml::array& array);
  const toml::node* request(std::string_view key, Need need, std::string_view what);
  void wrong_type(const toml::node& node, const std::string& key, std::string_view what,
                  const toml::node* around = nullptr);

  template <Real S>
  S read_number(const toml::node& node, const std::string& key, std::string_view what,
                const toml::node* array = nullptr, std::size_t index = 0) {
    const auto full_key = [&] { return !array ? key : key + "[" + std::to_string(index) + "]"; };
    const S kWrong = std::numeric_limits<S>::quiet_NaN();
    if (!node.is_number()) {
      wrong_type(node, full_key(), what, array);
      return kWrong;
    }
    if (const auto decimal = parse_decimal(source_->literal(node))) {
      if (fits_double(*decimal)) return value_of<S>(*decimal);
      add(node, full_key(), "must be 0 or between 5e-324 and 1.7976931348623157e308 in size", array);
      report_->spoil(full_key());
      return kWrong;
    }
    if (const auto* integer = node.as_integer()) return S(static_cast<long long>(integer->get()));  // 0x1f
    return S(node.as_floating_point()->get());  // inf, nan
  }

  const TomlSource* source_;
  ComplaintReport* report_;
  std::string path_;
  const toml::table* table_;
  std::vector<std::string> known_;
};

}  // namespace shearfront::detail
