// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/scene/scene.hpp"

namespace shearfront::fit {

/// One unknown: an entry of the scene with its start value and bounds, in the unit of the entry.
struct Parameter {
  Entry entry;
  double start = 0, lower = 0, upper = 0;
  /// What a change of it is small or large beside, > 0: its start value if it must be positive, otherwise by its
  /// Measure the height of the bed, the width of the range of states, the span of the flux, or 1.
  double unit = 1;
  double origin = 0;  ///< where it is counted from: the bottom, the least state, or 0
  [[nodiscard]] std::string name() const { return entry.name(); }
  /// By its own name or that of its field.
  [[nodiscard]] bool is_named(const std::string& name) const {
    return entry.field == name || entry.name() == name;
  }
};

/// The unknowns of a fit, resolved against a scene.
///
/// A name is a field ("shear_rate.values": all its entries) or one entry ("shear_rate.values[1]"). Start
/// values default to those of the scene, bounds to kWidest times smaller and larger than the start for
/// entries that must be positive, to the domain for breaks, to the states that all fluxes allow for states at the
/// start and beyond the ends, and to none (infinite) otherwise. Guaranteed: lower <= start <= upper, lower < upper, the scene is valid at the start,
/// no entry twice; with a shape all entries of shear_rate.values are unknown and their start values have that
/// shape. Errors: InputError with the keys of a fit file (unknown.parameters[0], unknown.start[2], ...).
class Parameters {
 public:
  static constexpr double kWidest = 1e3;

  Parameters(const Scene<double>& scene, const UnknownSpec& unknown);

  [[nodiscard]] std::size_t size() const { return parameters_.size(); }
  [[nodiscard]] const Parameter& operator[](std::size_t i) const { return parameters_[i]; }
  [[nodiscard]] auto begin() const { return parameters_.begin(); }
  [[nodiscard]] auto end() const { return parameters_.end(); }
  [[nodiscard]] Shape shape() const { return shape_; }
  [[nodiscard]] const Scene<double>& scene() const { return scene_; }
  /// The scene at the start values.
  [[nodiscard]] const Scene<double>& start_scene() const { return start_scene_; }
  /// Place of each parameter among entries(scene().spec()).
  [[nodiscard]] const std::vector<std::size_t>& entries() const { return places_; }
  /// Height of the bed and width of the range of states at the start: what phi, and M in heights, are numbers of.
  [[nodiscard]] double height() const { return start_scene_.top() - start_scene_.bottom(); }
  [[nodiscard]] double states() const;
  [[nodiscard]] Eigen::VectorXd start() const;
  /// Why this is the name of none of them, nor of the field of one; empty if it is.
  [[nodiscard]] std::string refusal_of_name(const std::string& name) const;
  /// For each the place of the last of these names that is its own or that of its field; none where no name is.
  /// Errors: InputError (key "prior") for a name that refusal_of_name() refuses.
  [[nodiscard]] std::vector<std::optional<std::size_t>> last_named_by(
      const std::vector<std::string>& names) const;
  /// Whether all values keep their bounds.
  [[nodiscard]] bool within_bounds(const Eigen::VectorXd& values) const;
  /// The scene with these values in place of its own; it may be invalid (breaks out of order).
  [[nodiscard]] SceneSpec<double> scene_with(const Eigen::VectorXd& values) const;
  /// The same as a scene; none, and the first complaint as the failure, if it is invalid.
  [[nodiscard]] std::optional<Scene<double>> scene_at(const Eigen::VectorXd& values,
                                                      std::string& failure) const;

 private:
  void resolve(const UnknownSpec& unknown, Complaints& complaints);
  void set_defaults();
  void set_numbers(const UnknownSpec& unknown, Complaints& complaints);
  void check_shape(Complaints& complaints) const;
  void make_start_scene(Complaints& complaints);
  void set_units();

  Scene<double> scene_, start_scene_;
  std::vector<Parameter> parameters_;
  std::vector<std::size_t> places_;  ///< of each parameter in entries(scene)
  Shape shape_ = Shape::none;
};

}  // namespace shearfront::fit
