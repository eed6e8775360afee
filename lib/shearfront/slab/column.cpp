// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/slab/column.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/diffusion/extended_flux.hpp"
#include "shearfront/diffusion/setup.hpp"
#include "shearfront/fv/cell_profile.hpp"
#include "shearfront/fv/march.hpp"
#include "shearfront/fv/run.hpp"

namespace shearfront::slab {
namespace {

class DiffusingColumn final : public Column {
 public:
  DiffusingColumn(const Scene<double>& scene, std::size_t n_cells)
      : problem_(diffusion::problem_of(scene, n_cells)), engine_(problem_, options()) {
    // The explicit half of a step is monotone up to 1 / rate.
    const double width = problem_.width(), fastest = diffusion::fastest_slope(problem_.flux);
    const auto conductance = [&](std::size_t i) {
      if (i == 0 || i == n_cells) return 0.0;
      const double d = problem_.diffusivity[i], p = std::abs(problem_.rate[i]) * fastest * width / (2 * d);
      return d * diffusion::raised_share(p) / width;
    };
    double rate = 0;
    for (std::size_t j = 0; j < n_cells; ++j) {
      const double below = j == 0 ? 0 : problem_.rate[j], above = j + 1 == n_cells ? 0 : problem_.rate[j + 1];
      rate = std::max(rate,
                      (std::abs(above - below) * fastest / 2 + conductance(j) + conductance(j + 1)) / width);
    }
    explicit_rate_ = rate;
  }
  bool advance(std::span<double> states, double dt) override {
    engine_.restart(states);
    const std::array step{diffusion::TimeStep{dt, std::max(0.5, 1 - 1 / (dt * explicit_rate_))}};
    if (engine_.repeat(step) != Status::ok) return false;
    std::copy(engine_.states().begin(), engine_.states().end(), states.begin());
    return true;
  }
  [[nodiscard]] double largest_step() const override { return 2 / explicit_rate_; }
  [[nodiscard]] Profile<double> profile(std::span<const double> states) const override {
    return diffusion::profile_of(problem_, states);
  }

 private:
  static diffusion::Options options() {
    diffusion::Options own;
    own.dt = 1;  // fixed steps, whose lengths are given one by one
    own.scheme = diffusion::Scheme::raised;
    own.iteration_tolerance = 1e-14;  // to rounding: a column must not show by what its steps began
    own.smoothed_steps = 0;
    own.keeps_steps = false;
    return own;
  }

  diffusion::Problem problem_;
  diffusion::CrankNicolson engine_;
  double explicit_rate_ = 0;
};

fv::Scheme column_scheme(const Scene<double>& scene, std::size_t n_cells) {
  fv::GridOptions grid;
  grid.cells = n_cells;
  const fv::Scheme second{fv::Rule::godunov, {}, Limiter::mc};
  return fv::refusal(second, scene, grid).empty() ? second : fv::Scheme{};
}

class SharpColumn final : public Column {
 public:
  SharpColumn(const Scene<double>& scene, std::size_t n_cells)
      : scene_(scene),
        grid_(fv::equal_cells(scene, n_cells)),
        march_(column_scheme(scene, n_cells), scene, grid_) {}
  bool advance(std::span<double> states, double dt) override {
    march_.restart(states);
    const double n = std::max(1.0, std::ceil(dt / march_.largest_step()));
    for (double k = 0; k < n; ++k) march_.step(dt / n);
    const std::vector<double> shares = march_.shares().x;
    std::copy(shares.begin(), shares.end(), states.begin());
    return true;
  }
  [[nodiscard]] double largest_step() const override { return infinity<double>(); }
  [[nodiscard]] Profile<double> profile(std::span<const double> states) const override {
    return fv::cell_profile(scene_, grid_, {{states.begin(), states.end()}, {}});
  }

 private:
  const Scene<double>& scene_;
  fv::Grid grid_;
  fv::March march_;
};

}  // namespace

std::string column_refusal(const Scene<double>& scene, std::size_t n_cells) {
  if (scene.has_diffusion()) return diffusion::refusal(scene);
  fv::GridOptions grid;
  grid.cells = n_cells;
  return fv::refusal(column_scheme(scene, n_cells), scene, grid);
}

std::unique_ptr<Column> make_column(const Scene<double>& scene, std::size_t n_cells) {
  if (scene.has_diffusion()) return std::make_unique<DiffusingColumn>(scene, n_cells);
  return std::make_unique<SharpColumn>(scene, n_cells);
}

}  // namespace shearfront::slab
