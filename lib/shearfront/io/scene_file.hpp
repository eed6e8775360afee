// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "shearfront/io/file_error.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront {

/// A number put in the place of one of a scene file, by the name of its entry: "shear_rate.values[1]", "0.4".
struct SceneChange {
  std::string key, value;
};
using SceneChanges = std::vector<SceneChange>;

/// Reads a scene file (TOML; the format is described in docs/reference/formats).
///
/// Models are looked up in FluxList and DepthFunctionList and their entries read through fields(), so a new
/// model needs no change here. Guaranteed:
///   (1) numbers are read in the scalar from their text in the file: in Real110, 0.31 is the decimal 0.31;
///   (2) every complaint is reported, one line each in the order of the file, with line and column; of more than
///       1000 the number of the others;
///   (3) a file is valid or not whatever the scalar, except for what rounding to the scalar decides.
/// A scene without a name gets that of the file; "-" is standard input. The changes take the place of numbers the file
/// has, before these are checked; complaints about them name no line.
/// Errors: FileError (an InputError). Cost: O(size of the file); 1e6 numbers take about a second.
template <Real S = double>
[[nodiscard]] Scene<S> read_scene(const std::string& path, const SceneChanges& changes = {});

/// The same from a text; `file` is the name used in messages.
template <Real S = double>
[[nodiscard]] Scene<S> parse_scene(std::string text, const std::string& file,
                                   const SceneChanges& changes = {});

/// Whether the text of a scene file takes tables from other files, without which it says nothing. Errors: FileError for
/// what is no TOML.
[[nodiscard]] bool names_tables_in_files(const std::string& text);

extern template Scene<double> read_scene(const std::string&, const SceneChanges&);
extern template Scene<double> parse_scene(std::string, const std::string&, const SceneChanges&);

}  // namespace shearfront
