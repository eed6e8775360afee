// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shearfront/io/detail/named_columns.hpp"
#include "shearfront/io/detail/number_literal.hpp"
#include "shearfront/io/detail/toml_source.hpp"
#include "shearfront/io/file_error.hpp"
#include "shearfront/scene/scene_spec.hpp"

namespace shearfront::detail {

/// The arrays of a scene that stand in other files: `file = "shear.csv", z = "height (mm)", values = "rate"`.
class SceneColumns {
 public:
  enum class Meaning { number, height, time, state, rate };
  /// An array of the scene and the column that holds it.
  struct Wanted {
    std::string key;     ///< "shear_rate.values"
    std::string column;  ///< "rate"
    Meaning meaning;
    bool are_breaks = false;  ///< where the piece of each row begins; that of the first row is no break
  };
  /// One column as read. Its numbers are those of the cells times numerator / denominator.
  struct Numbers {
    std::vector<std::string> cells;  ///< with decimal points
    double numerator = 1, denominator = 1;
  };

  explicit SceneColumns(const SceneUnits& units) : units_(units) {}

  /// The columns, in their order; nothing if anything was wrong, which is then in errors(). `lowest` is what the first of
  /// the breaks may be at most, in the units of the scene. Errors: FileError if the file cannot be read.
  [[nodiscard]] std::optional<std::vector<Numbers>> read(const std::string& path,
                                                         const std::vector<Wanted>& wanted, double lowest);
  /// Takes a complaint about a number that came from a file; false if it did not.
  [[nodiscard]] bool take(const Complaint& complaint);
  /// What is wrong with the files, one after the other.
  [[nodiscard]] std::vector<FileError> errors() const;
  /// A line per file that needed more than the names of its columns.
  [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  struct Origin {
    std::string key;
    NamedColumns* file;
    std::size_t column, first_row;
  };
  [[nodiscard]] bool convert(const NamedColumns::Column& column, Meaning meaning, Numbers& numbers) const;
  [[nodiscard]] static bool check_first_break(NamedColumns& file, std::size_t column, const Wanted& wanted,
                                              const Numbers& numbers, double lowest);

  SceneUnits units_;
  std::vector<std::unique_ptr<NamedColumns>> files_;
  std::vector<Origin> origins_;
  std::vector<std::string> remarks_;
};

/// A number of such a column. Precondition: the cell came from Numbers.
template <Real S>
[[nodiscard]] S number_of_cell(const std::string& cell, const SceneColumns::Numbers& column) {
  const auto decimal = parse_decimal(cell);
  const S number = decimal ? value_of<S>(*decimal) : S(parse_number(cell).value_or(0));
  return column.numerator == column.denominator ? number
                                                : number * S(column.numerator) / S(column.denominator);
}

/// z and t (of a chute x) of [units]. Any name is taken but that of a unit of something else.
void read_units(TableReader& table, SceneUnits& units);

}  // namespace shearfront::detail
