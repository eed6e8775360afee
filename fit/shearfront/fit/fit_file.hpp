// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/io/file_error.hpp"
#include "shearfront/io/scene_file.hpp"

/// Fit files (TOML; the format is described in docs/reference/formats).
namespace shearfront::fit {

/// By which the best of several models is chosen; the least is the best. With p parameters, of which b are places that were looked
/// for among all there are, n data and their Gaussian likelihood L:
///
///     AIC = -2 log L + 2 p,   BIC = -2 log L + p log n,   mBIC = BIC + b log n.
///
/// A break that fits noise best of all places gains more than a parameter does, about as much as two. Source of mBIC: Zhang &
/// Siegmund (2007), Biometrics 63, 22-32, but for its term in the lengths of the segments, which has no meaning for layers.
enum class ModelCriterion { aic, bic, mbic };

/// [compare]: shear rates that are fitted to the same observations in place of the scene's own. The entries of each are
/// unknown, beside those of [unknown]; the scene's a(z) is where all of them start.
struct ModelChoice {
  struct Model {
    std::string name;                 ///< of a depth function
    std::size_t n;                    ///< pieces or points of one with arrays; 0: it has none
    std::vector<double> breaks = {};  ///< of n layers, where they are known
  };
  std::vector<Model> models;
  bool has_free_breaks = false;  ///< of layers whose breaks are not known; else they are equally thick
  ModelCriterion criterion = ModelCriterion::aic;  ///< by which the best is chosen

  /// "1 layer", "3 layers", "3 known layers", "exponential", "table:6".
  [[nodiscard]] static std::string text(const Model& model);
};

/// A fit file with the names of the files it refers to, as they are opened.
struct FitFile {
  FitSpec spec;
  std::string scene, observations;
  std::vector<std::string> remarks;  ///< on old names in this file and in the scene
  std::optional<ModelChoice> choice;
};

/// Reads a fit file, its scene and its observations; their names are relative to the fit file.
///
/// Guaranteed:
///   (1) every complaint is reported, one line each: those of the fit file in its order, then those of the
///       scene and of the observations, each with the name of its file, line and column;
///   (2) what holds between the files is checked as well: unknowns exist in the scene, start values lie
///       between their bounds and make a valid scene, the observations can be compared as asked.
/// A fit without a name gets that of the file. The changes are those of its scene, as in read_scene(). Errors: FileError (an
/// InputError). Cost: that of the files.
[[nodiscard]] FitFile read_fit_file(const std::string& path, const SceneChanges& changes = {});
[[nodiscard]] FitSpec read_fit(const std::string& path);

/// The same from a text; `file` is the name used in messages, its folder that of the other files.
[[nodiscard]] FitFile parse_fit(std::string text, const std::string& file);
/// The same of a text that names no other files: of this scene, from these observations, which were read for it.
[[nodiscard]] FitFile parse_fit(std::string text, const std::string& file, Scene<double> scene,
                                Observations observations);

/// A scene file or a fit file, told apart by the keys at the top: only a fit file has scene, observations or
/// unknown. Errors: FileError.
[[nodiscard]] std::variant<Scene<double>, FitFile> read_scene_or_fit(const std::string& path,
                                                                     const SceneChanges& changes = {});

/// Which of the two a file is. Errors: FileError.
[[nodiscard]] bool is_fit_file(const std::string& path);

/// A refusal of fit() with the places of its entries in the fit file it was read from.
[[nodiscard]] FileError located(const InputError& error, const std::string& path);

}  // namespace shearfront::fit
