// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "shearfront/scene/scene.hpp"
#include "shearfront/solution/profile.hpp"

namespace shearfront {

/// A function g of the share x = phi / c of the grains, to be integrated over a bed: int c g(x) dz. Entropy
/// of mixing and height of a bed are such integrals.
struct ShareFunction {
  std::function<double(double)> value;    ///< g(x), continuous for x in [0, 1]
  std::vector<double> kinks;              ///< shares where its slope jumps, ascending
  std::function<double(double)> slope{};  ///< g'(x); empty where it is not known

  [[nodiscard]] explicit operator bool() const { return bool(value); }
};

struct Sample {
  double phi = 0;  ///< concentration; at a jump the value above it, at the top wall the value below
  double M = 0;    ///< int_bottom^z phi
};

/// phi of a slab at one time, over x, which repeats with the length of the slab, and z.
class SlabField {
 public:
  virtual ~SlabField() = default;

  /// Middles of the cells along x, ascending.
  [[nodiscard]] virtual std::vector<double> middles() const = 0;
  /// phi(x[i], z[j]) at [i * z.size() + j], linear between the middles of cells; x in [0, length].
  [[nodiscard]] virtual std::vector<double> section(const std::vector<double>& x,
                                                    const std::vector<double>& z) const = 0;
};

/// The solution at one time, as a function of height.
class Field {
 public:
  virtual ~Field() = default;

  /// phi and M at one height of the domain.
  [[nodiscard]] virtual Sample at(double z) const = 0;
  /// The same at many heights, in any order.
  [[nodiscard]] virtual std::vector<Sample> at(const std::vector<double>& heights) const {
    std::vector<Sample> samples;
    samples.reserve(heights.size());
    for (const double z : heights) samples.push_back(at(z));
    return samples;
  }
  /// int c g(phi / c) dz over the bed.
  [[nodiscard]] virtual double integral(const ShareFunction& g) const = 0;
  /// phi over the whole domain, where the solver's solution is linear in pieces (Guarantees::has_profiles).
  [[nodiscard]] virtual std::optional<Profile<double>> profile() const { return std::nullopt; }
  /// Where phi depends on x as well (Guarantees::has_slab): all of it, of which the others are means over x. Valid as long as
  /// this. Null otherwise.
  [[nodiscard]] virtual const SlabField* slab() const { return nullptr; }
  /// int_bottom^z phi dz at many heights, in any order: the volume of the grains that lie below z. It is M but in a steady
  /// chute, where M is what passes below z.
  [[nodiscard]] virtual std::vector<double> volumes(const std::vector<double>& heights) const {
    std::vector<double> all;
    all.reserve(heights.size());
    for (const Sample& sample : at(heights)) all.push_back(sample.M);
    return all;
  }
};

/// A solution that is linear in pieces.
class ProfileField final : public Field {
 public:
  /// `scene` must outlive this: its solid fraction enters integral().
  ProfileField(const Scene<double>& scene, Profile<double> profile)
      : scene_(&scene), profile_(std::move(profile)) {}

  [[nodiscard]] Sample at(double z) const override {
    const auto value = profile_.at(z);
    return {value.phi, value.M};
  }
  [[nodiscard]] std::vector<Sample> at(const std::vector<double>& heights) const override;
  [[nodiscard]] double integral(const ShareFunction& g) const override;
  [[nodiscard]] std::optional<Profile<double>> profile() const override { return profile_; }

 private:
  const Scene<double>* scene_;
  Profile<double> profile_;
};

}  // namespace shearfront
