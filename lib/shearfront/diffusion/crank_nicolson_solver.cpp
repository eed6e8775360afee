// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/crank_nicolson_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "shearfront/diffusion/cell_choice.hpp"
#include "shearfront/diffusion/crank_nicolson.hpp"
#include "shearfront/diffusion/problem_tangents.hpp"
#include "shearfront/diffusion/refinement.hpp"
#include "shearfront/diffusion/setup.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront {
namespace {

/// Fixed steps; some minutes, and a gigabyte if they are kept.
constexpr std::uint64_t kMostDiffusionSteps = 100'000'000;

diffusion::Options engine_options(const CrankNicolsonSolver::Options& options, const Progress& progress) {
  diffusion::Options own;
  own.dt = options.time_step;
  own.tolerance = options.tolerance;
  own.max_steps = kMostDiffusionSteps;
  // Cells that follow fronts resolve them, and are wide where nothing bends.
  own.scheme = options.monotone             ? diffusion::Scheme::fitted
               : options.cell_tolerance > 0 ? diffusion::Scheme::central
                                            : diffusion::Scheme::raised;
  own.progress = progress;
  return own;
}

std::size_t cells_of(const CrankNicolsonSolver::Options& options, const Scene<double>& scene) {
  if (options.cells > 0) return static_cast<std::size_t>(options.cells);
  return options.cell_tolerance > 0 ? diffusion::kUsualCells : diffusion::chosen_cells(scene);
}

/// On to time t, or until the bed is at rest.
Status march(diffusion::CrankNicolson& engine, double t) {
  if (std::isfinite(t)) return engine.advance_to(t);
  constexpr double kLongest = 1e150;
  for (double next = std::max(engine.time(), 1.0); next < kLongest; next *= 4) {
    const Status status = engine.advance_to(next);
    if (status != Status::ok) return status;
    if (engine.is_steady()) return Status::steady;
  }
  return Status::not_converged;
}

/// Lets the engine change its grid, and stop where that fails.
void follow(diffusion::Refinement& refinement, diffusion::Options& options) {
  options.regrid = [&](const diffusion::Problem& present, std::span<const double> states) {
    return refinement.next(present, states);
  };
  options.progress = [&refinement, ask = options.progress](double t, std::uint64_t n_steps) {
    return !refinement.is_exhausted() && (!ask || ask(t, n_steps));
  };
}

class CrankNicolsonRun final : public Run {
 public:
  CrankNicolsonRun(const Scene<double>& scene, const CrankNicolsonSolver::Options& options,
                   const Watch& watch)
      : scene_(scene), time_step_(options.time_step), last_time_(watch.last_time) {
    diffusion::Options own = engine_options(options, watch.progress);
    own.keeps_steps = false;
    const std::size_t cells = cells_of(options, scene);
    if (options.cell_tolerance > 0) follow(refinement_.emplace(scene, cells, options.cell_tolerance), own);
    engine_.emplace(refinement_ ? refinement_->start() : diffusion::problem_of(scene, cells), own);
    if (own.scheme == diffusion::Scheme::raised) remark_ = diffusion::raised_remark(engine_->problem());
  }

  Status advance(double t) override {
    field_.reset();
    if (time_step_ > 0 && std::max(t, last_time_) == std::numeric_limits<double>::infinity()) {
      refused_ = "fixed steps do not reach the steady state: leave time_step out";
      return status_ = Status::unsupported;
    }
    if (time_step_ > 0) refused_ = diffusion::too_many_steps(last_time_, time_step_, kMostDiffusionSteps);
    if (!refused_.empty()) return status_ = Status::budget_reached;
    status_ = march(*engine_, t);
    if (is_exhausted()) status_ = Status::budget_reached;
    return status_;
  }
  [[nodiscard]] const Field& field() override {
    if (!field_) field_.emplace(scene_, diffusion::profile_of(engine_->problem(), engine_->states()));
    return *field_;
  }
  [[nodiscard]] Summary summary() const override {
    Summary summary;
    summary.status = status_;
    summary.message = refused_.empty() ? message() : refused_;
    summary.remark = remark_;
    summary.cell_updates = engine_->n_cell_updates();
    if (engine_->is_steady()) summary.rest_time = engine_->rest_time();
    return summary;
  }

 private:
  [[nodiscard]] bool is_exhausted() const { return refinement_ && refinement_->is_exhausted(); }
  [[nodiscard]] std::string message() const {
    const bool is_usable = status_ == Status::ok || status_ == Status::steady;
    return (is_exhausted() ? "more than " + std::to_string(diffusion::Refinement::kMostCells) +
                                 " cells wanted, or narrower ones than heights can tell apart, at t = " +
                                 number_text(engine_->time()) + "; take a larger cell_tolerance"
            : !is_usable           ? engine_->message()
            : engine_->is_steady() ? "steady state reached"
                                   : "reached the last time") +
           ", " + std::to_string(engine_->n_steps()) + " steps, " +
           std::to_string(engine_->problem().n_cells) + " cells";
  }

  const Scene<double>& scene_;
  double time_step_, last_time_;
  std::optional<diffusion::Refinement> refinement_;
  std::optional<diffusion::CrankNicolson> engine_;
  Status status_ = Status::ok;
  std::string refused_, remark_;
  std::optional<ProfileField> field_;
};

/// The steps from each time to the next, and the numbers of the scene they were chosen for.
struct Plan {
  std::vector<double> numbers;
  std::vector<std::vector<diffusion::TimeStep>> parts;
};

/// The places of one time.
struct Row {
  std::vector<double> heights;
  std::vector<std::size_t> places;
};

/// One run through all rows, by the steps of `repeated` if there are some.
Linearisation run_through(const std::map<double, Row>& rows, std::size_t n_places,
                          const diffusion::Problem& problem, const std::vector<diffusion::Tangent>& tangents,
                          const CrankNicolsonSolver::Options& options, const Plan* repeated, Plan& made,
                          const Progress& progress) {
  const diffusion::Options own = engine_options(options, progress);
  diffusion::CrankNicolson engine(problem, own, tangents);
  Linearisation result;
  if (own.scheme == diffusion::Scheme::raised) result.summary.remark = diffusion::raised_remark(problem);
  result.samples.resize(n_places);
  result.derivatives.resize(n_places * tangents.size());
  for (const auto& [t, row] : rows) {
    const std::size_t before = engine.steps().size();
    const Status status = repeated ? engine.repeat(repeated->parts[made.parts.size()]) : march(engine, t);
    result.summary.status = status;
    result.summary.message =
        repeated && status == Status::not_converged ? "the iteration does not converge" : engine.message();
    if (status != Status::ok && status != Status::steady) return result;
    const auto& steps = engine.steps();
    made.parts.emplace_back(steps.begin() + static_cast<std::ptrdiff_t>(before), steps.end());
    const auto values = diffusion::profile_of(problem, engine.states()).at(row.heights);
    for (std::size_t i = 0; i < values.size(); ++i)
      result.samples[row.places[i]] = {values[i].phi, values[i].M};
    for (std::size_t k = 0; k < tangents.size(); ++k) {
      const auto slopes =
          diffusion::profile_tangent(problem, engine.states(), engine.tangent(k)).at(row.heights);
      for (std::size_t i = 0; i < slopes.size(); ++i)
        result.derivatives[row.places[i] * tangents.size() + k] = {slopes[i].phi, slopes[i].M};
    }
  }
  result.summary.status = Status::ok;
  return result;
}

bool is_near(const std::vector<double>& xs, const std::vector<double>& ys) {
  return std::equal(xs.begin(), xs.end(), ys.begin(), ys.end(), [](double x, double y) {
    return std::abs(x - y) <= CrankNicolsonSolver::kReach * std::abs(y);
  });
}

}  // namespace

std::string CrankNicolsonSolver::refusal(const Scene<double>& scene, const Options& options) {
  constexpr std::uint64_t kMostCells = 10'000'000;
  if (std::string why = diffusion::refusal(scene); !why.empty()) return why;
  if (options.cells != 0 && (options.cells < 2 || options.cells > kMostCells))
    return "cells = " + std::to_string(options.cells) + "; must be >= 2 and <= " + std::to_string(kMostCells);
  if (!(options.time_step >= 0 && std::isfinite(options.time_step)))
    return "time_step = " + number_text(options.time_step) + "; must be >= 0";
  if (!(options.tolerance > 0 && options.tolerance <= 1))
    return "tolerance = " + number_text(options.tolerance) + "; must be > 0 and <= 1";
  if (options.cell_tolerance != 0 && !(options.cell_tolerance >= 1e-6 && options.cell_tolerance <= 0.1))
    return "cell_tolerance = " + number_text(options.cell_tolerance) + "; must be >= 1e-6 and <= 0.1, or 0";
  if (options.cell_tolerance > 0 && options.cells > diffusion::Refinement::kMostCells)
    return "cells = " + std::to_string(options.cells) +
           "; must be <= " + std::to_string(diffusion::Refinement::kMostCells) + " with a cell_tolerance";
  return "";
}

std::unique_ptr<Run> CrankNicolsonSolver::start(const Scene<double>& scene, const Options& options,
                                                const Watch& watch) {
  return std::make_unique<CrankNicolsonRun>(scene, options, watch);
}

void CrankNicolsonSolver::prefer_smooth(const Scene<double>& scene, Options& options) {
  const bool is_free = options.cells == 0 && options.cell_tolerance == 0;
  if (is_free && diffusion::refusal(scene).empty()) options.cells = cells_of(options, scene);
}

std::string CrankNicolsonSolver::derivative_refusal(const Scene<double>&, const Options& options,
                                                    const Entry& entry) {
  if (options.cell_tolerance > 0) return "cells that follow the fronts have no derivatives";
  return diffusion::has_problem_tangent(entry) ? "" : entry.name() + " changes the flux or the grid";
}

Linearisation CrankNicolsonSolver::linearise(const Scene<double>& scene, const Options& options,
                                             const std::vector<Place>& places,
                                             const std::vector<std::size_t>& wanted, std::any& memory,
                                             const Progress& progress) {
  std::map<double, Row> rows;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Row& row = rows[places[i].t];
    row.heights.push_back(places[i].z);
    row.places.push_back(i);
  }
  if (!rows.empty() && options.time_step > 0) {
    Linearisation refused;
    refused.summary.message =
        diffusion::too_many_steps(rows.rbegin()->first, options.time_step, kMostDiffusionSteps);
    refused.summary.status = Status::budget_reached;
    if (!refused.summary.message.empty()) return refused;
  }
  const std::size_t cells = cells_of(options, scene);
  const diffusion::Problem problem = diffusion::problem_of(scene, cells);
  const std::vector<diffusion::Tangent> tangents = diffusion::problem_tangents(scene, wanted, cells);
  Plan made;
  SceneSpec<double> spec = scene.spec();
  for (const double* number : entry_places(spec)) made.numbers.push_back(*number);
  if (const Plan* plan = std::any_cast<Plan>(&memory);
      plan && plan->parts.size() == rows.size() && is_near(made.numbers, plan->numbers)) {
    Plan same;
    Linearisation result = run_through(rows, places.size(), problem, tangents, options, plan, same, progress);
    if (result.summary.usable() || result.summary.status == Status::interrupted) return result;
  }
  Linearisation result =
      run_through(rows, places.size(), problem, tangents, options, nullptr, made, progress);
  if (result.summary.usable()) memory = std::move(made);
  return result;
}

}  // namespace shearfront
