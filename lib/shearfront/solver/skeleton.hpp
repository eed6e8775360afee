// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "shearfront/solver/solver.hpp"

namespace shearfront {

/// Copy this file to <module>/<name>_solver.hpp, rename the struct, and add one line to solver/all.hpp. Program,
/// help, fit files and cross tests follow from the list. Say here: the scheme, its domain, errors, cost, source. This
/// copy leaves the initial state unchanged.
struct SkeletonSolver {
  static constexpr std::string_view kName = "skeleton";  ///< --method name
  static constexpr std::string_view kDescription = "the initial state, unchanged";
  static constexpr std::string_view kScenes = "all scenes";  ///< for `shearfront list`

  struct Options {
    double slowness = 1;

    template <class Self, class Visit>
    static void fields(Self& self, Visit&& visit) {
      visit(OptionInfo{"slowness", "how little happens", {0, 10}}, self.slowness);
    }
  };

  static Guarantees guarantees() { return {}; }
  static std::string refusal(const Scene<double>&, const Options&) { return ""; }
  static std::unique_ptr<Run> start(const Scene<double>& scene, const Options&, const Watch&) {
    return std::make_unique<Still>(scene);
  }

 private:
  class Still final : public Run {
   public:
    explicit Still(const Scene<double>& scene) : field_(scene) {}
    Status advance(double) override { return Status::ok; }
    [[nodiscard]] const Field& field() override { return field_; }
    [[nodiscard]] Summary summary() const override {
      Summary summary;
      summary.status = Status::ok;
      summary.message = "nothing moves";
      return summary;
    }

   private:
    struct InitialField final : Field {
      explicit InitialField(const Scene<double>& of) : scene(of) {}
      [[nodiscard]] Sample at(double z) const override {
        return {scene.initial_phi(z), scene.initial_amount(scene.bottom(), z)};
      }
      [[nodiscard]] double integral(const ShareFunction&) const override { return 0; }
      const Scene<double>& scene;
    };
    InitialField field_;
  };
};
static_assert(Solver<SkeletonSolver>);

}  // namespace shearfront
