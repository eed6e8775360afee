// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/study/study_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>

#include "shearfront/fit.hpp"
#include "shearfront/fit/bootstrap.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/prediction.hpp"
#include "shearfront/fit/study/study_design.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solution/observe.hpp"

namespace shearfront::fit {
namespace {

using Kind = StudyOutput::Kind;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBlock = 64;          // runs a thread takes at once
constexpr std::size_t kMostWaiting = 4096;  // rows that wait for one before them

bool is_sample(Kind kind) { return kind == Kind::phi || kind == Kind::M; }
bool is_of_fit(Kind kind) {
  return kind == Kind::estimate || kind == Kind::std_error || kind == Kind::misfit;
}
bool is_of_bed(Kind kind) { return kind == Kind::height || kind == Kind::mixing; }

void add_once(std::vector<double>& values, double x) {
  if (std::find(values.begin(), values.end(), x) == values.end()) values.push_back(x);
}
std::size_t place_of(const std::vector<double>& values, double x) {
  return static_cast<std::size_t>(std::find(values.begin(), values.end(), x) - values.begin());
}

/// The event an output asks for; nothing if the scene has no such interface.
std::optional<double> event_of(const Timeline<double>& timeline, const StudyOutput& output) {
  const auto time = [](const std::optional<double>& t) { return t.value_or(kNever); };
  switch (output.kind) {
    case Kind::t0:
      return time(timeline.t0);
    case Kind::t1:
      return time(timeline.t1);
    case Kind::t_star:
      return time(timeline.t_star);
    default:
      break;
  }
  if (output.interface >= timeline.interfaces.size()) return std::nullopt;
  const auto& at = timeline.interfaces[output.interface];
  return time(output.kind == Kind::first ? at.first : at.last);
}

/// Fits the file of a study of estimates: its scene becomes the estimate, and points are drawn from the error bars.
std::vector<std::vector<double>> drawn_points(StudySpec& spec, std::vector<std::string>& entries) {
  const FitSpec& fit_spec = spec.fit_file->spec;
  const Estimate estimate = fit(fit_spec);
  if (!estimate.usable()) throw InputError("fit", "", "has no estimate: " + estimate.message);
  const Parameters parameters(fit_spec.scene, fit_spec.unknown);
  const DrawnScenes draws = draw_scenes(parameters, estimate, spec.runs, spec.seed);
  if (!draws.why_none.empty()) throw InputError("fit", "", "gives no draws: " + draws.why_none);
  spec.scene = estimate.scene;
  for (const Parameter& p : parameters) entries.push_back(p.name());
  std::vector<std::vector<double>> points;
  for (const Scene<double>& scene : draws.scenes) {
    SceneSpec<double> drawn = scene.spec();
    const auto places = entry_places(drawn);
    std::vector<double>& point = points.emplace_back();
    for (const std::size_t place : parameters.entries()) point.push_back(*places[place]);
  }
  return points;
}

}  // namespace

StudyRuns::StudyRuns(StudySpec spec) : spec_(std::move(spec)) {
  if (spec_.design == DesignKind::replicates) {
    prepare_replicates();
  } else if (spec_.design == DesignKind::fit) {
    points_ = drawn_points(spec_, entries_);
  } else {
    points_ = study_points(spec_);
    for (const Variation& v : spec_.variations) entries_.push_back(v.entry);
  }
  const std::vector<Entry> all = shearfront::entries(spec_.scene->spec());
  for (const std::string& name : entries_)
    places_.push_back(static_cast<std::size_t>(
        std::find_if(all.begin(), all.end(), [&](const Entry& e) { return e.name() == name; }) -
        all.begin()));
  for (const StudyOutput& output : spec_.outputs) {
    if (is_sample(output.kind)) {
      add_once(samples_.times, output.t);
      add_once(samples_.heights, output.z);
    } else if (is_of_bed(output.kind)) {
      add_once(heights_.times, output.t);
    } else if (!is_of_fit(output.kind)) {
      needs_timeline_ = true;
    }
  }
  samples_.timeline = needs_timeline_;
}

void StudyRuns::prepare_replicates() {
  const FitSpec& fit_spec = spec_.fit_file->spec;
  estimate_ = fit(fit_spec);
  if (!estimate_->usable()) throw InputError("fit", "", "has no estimate: " + estimate_->message);
  const auto is_known = [](double x) { return std::isfinite(x); };
  if (!(estimate_->sigma > 0) ||
      !std::all_of(estimate_->predicted.begin(), estimate_->predicted.end(), is_known))
    throw InputError("fit", "", "gives no replicates: the noise of its data is not known");
  replicate_ = replicate_of(fit_spec, Parameters(fit_spec.scene, fit_spec.unknown), *estimate_);
  noise_ = noise_of_draws(fit_spec.observations, *estimate_);
  spec_.scene = estimate_->scene;
  points_.resize(spec_.runs);
}

namespace {

void fail_row(StudyRow& row, const std::string& why) {
  std::fill(row.outputs.begin(), row.outputs.end(), kNothing);
  row.failure = why;
}

}  // namespace

StudyRow StudyRuns::run_replicate(std::size_t i, const std::function<bool()>& goes_on) const {
  StudyRow row{i, {}, std::vector<double>(spec_.outputs.size(), kNothing), ""};
  FitSpec spec = *replicate_;
  draw_observations(spec.observations, *estimate_, noise_.get(), stream_seed(spec_.seed, i));
  try {
    const Estimate found = fit(spec, [&](std::size_t, double) { return !goes_on || goes_on(); });
    if (!found.usable()) {
      fail_row(row, found.message);
      return row;
    }
    for (std::size_t k = 0; k < spec_.outputs.size(); ++k) {
      const StudyOutput& output = spec_.outputs[k];
      if (output.kind == Kind::misfit) row.outputs[k] = found.misfit;
      if (output.kind != Kind::estimate && output.kind != Kind::std_error) continue;
      const ParameterEstimate& p = found.parameters[output.interface];
      row.outputs[k] = output.kind == Kind::estimate ? p.estimate : p.std_error.value_or(kNothing);
    }
    solve_outputs(*found.scene, goes_on, row);
  } catch (const InputError& error) {
    fail_row(row, error.what());
  }
  return row;
}

StudyRow StudyRuns::run(std::size_t i, const std::function<bool()>& goes_on) const {
  if (replicate_) return run_replicate(i, goes_on);
  StudyRow row{i, points_[i], std::vector<double>(spec_.outputs.size(), kNothing), ""};
  SceneSpec<double> changed = spec_.scene->spec();
  const std::vector<double*> places = entry_places(changed);
  for (std::size_t j = 0; j < places_.size(); ++j) *places[places_[j]] = points_[i][j];
  std::variant<Scene<double>, Complaints> made = Scene<double>::make(std::move(changed));
  if (const auto* complaints = std::get_if<Complaints>(&made))
    fail_row(row, complaints->front().text());
  else
    solve_outputs(std::get<Scene<double>>(made), goes_on, row);
  return row;
}

void StudyRuns::solve_outputs(const Scene<double>& scene, const std::function<bool()>& goes_on,
                              StudyRow& row) const {
  const auto is_done = [](const StudyOutput& o) { return is_of_fit(o.kind); };
  if (std::all_of(spec_.outputs.begin(), spec_.outputs.end(), is_done)) return;
  shearfront::Progress progress;
  if (goes_on) progress = [&](double, std::uint64_t) { return goes_on(); };
  try {
    SolverResult result;
    if (needs_timeline_ || !samples_.times.empty()) {
      result = solve(scene, spec_.method, samples_, progress);
      if (!result.summary.usable()) return fail_row(row, result.summary.message);
    }
    const auto integrals = [&](Kind kind, const ShareFunction& integrand, std::string& why) {
      std::vector<double> none;
      const auto is_kind = [kind](const StudyOutput& o) { return o.kind == kind; };
      if (std::none_of(spec_.outputs.begin(), spec_.outputs.end(), is_kind)) return none;
      SolverRequest request = heights_;
      request.integrand = integrand;
      SolverResult bed = solve(scene, spec_.method, request, progress);
      if (!bed.summary.usable()) why = bed.summary.message;
      return bed.summary.usable() ? std::move(bed.integrals) : none;
    };
    const BedHeight bed(scene);
    std::string why = heights_.times.empty() ? "" : BedHeight::refusal(scene);
    if (!why.empty()) return fail_row(row, why);
    const std::vector<double> heights = integrals(Kind::height, bed.integrand(), why),
                              entropies = integrals(Kind::mixing, entropy_function(), why);
    if (!why.empty()) return fail_row(row, why);
    for (std::size_t k = 0; k < spec_.outputs.size(); ++k) {
      const StudyOutput& output = spec_.outputs[k];
      if (is_of_fit(output.kind)) continue;
      if (is_sample(output.kind)) {
        const Sample& s = result.at(place_of(samples_.times, output.t), place_of(samples_.heights, output.z));
        row.outputs[k] = output.kind == Kind::phi ? s.phi : s.M;
      } else if (output.kind == Kind::height) {
        row.outputs[k] = bed.height(heights[place_of(heights_.times, output.t)]);
      } else if (output.kind == Kind::mixing) {
        row.outputs[k] = mixing(entropies[place_of(heights_.times, output.t)], scene.mass(),
                                scene.solid(scene.bottom(), scene.top()))
                             .parameter;
      } else {
        const auto t = result.timeline ? event_of(*result.timeline, output) : std::nullopt;
        if (!t) return fail_row(row, std::string(spec_.method.name()) + " gives no " + output.name + " here");
        row.outputs[k] = *t;
      }
    }
  } catch (const InputError& error) {
    fail_row(row, error.what());
  }
}

namespace {

/// Hands rows on in their order while they come in any.
class RowQueue {
 public:
  RowQueue(std::size_t n, std::size_t block, const std::function<void(const StudyRow&)>& take,
           const std::function<bool()>& goes_on)
      : n_(n), block_(block), take_(take), goes_on_(goes_on), waiting_(kMostWaiting) {}

  struct Block {
    std::size_t begin, end;
  };
  /// What is to be run next; empty at the end.
  Block next() {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return stopped_ || begin_ >= n_ || begin_ + block_ <= done_ + kMostWaiting; });
    if (stopped_ || begin_ >= n_) return {n_, n_};
    const std::size_t from = begin_;
    begin_ = std::min(begin_ + block_, n_);
    return {from, begin_};
  }
  void put(std::size_t first, std::vector<StudyRow> rows) {
    const std::lock_guard lock(mutex_);
    if (stopped_) return;
    for (std::size_t k = 0; k < rows.size(); ++k) waiting_[(first + k) % kMostWaiting] = std::move(rows[k]);
    try {
      for (auto* row = &waiting_[done_ % kMostWaiting]; done_ < n_ && *row;
           row = &waiting_[done_ % kMostWaiting]) {
        take_(**row);
        row->reset();
        ++done_;
      }
    } catch (...) {
      error_ = std::current_exception();
      stopped_ = true;
    }
    room_.notify_all();
  }
  /// Also asked by the runs themselves.
  bool goes_on() {
    if (stopped_) return false;
    if (!goes_on_ || goes_on_()) return true;
    {
      const std::lock_guard lock(mutex_);
      stopped_ = true;
    }
    room_.notify_all();
    return false;
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  const std::size_t n_, block_;
  const std::function<void(const StudyRow&)>& take_;
  const std::function<bool()>& goes_on_;
  std::mutex mutex_;
  std::condition_variable room_;
  std::vector<std::optional<StudyRow>> waiting_;  ///< by their number modulo kMostWaiting
  std::size_t begin_ = 0, done_ = 0;              ///< the next to be run, and to be handed on
  std::atomic<bool> stopped_ = false;
  std::exception_ptr error_;
};

}  // namespace

void StudyRuns::run_all(const std::vector<std::size_t>& which, std::size_t threads,
                        const std::function<void(const StudyRow&)>& take,
                        const std::function<bool()>& goes_on) const {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  RowQueue queue(which.size(), replicate_ ? 1 : kBlock, take, goes_on);
  const auto work = [&] {
    for (auto block = queue.next(); block.begin < block.end; block = queue.next()) {
      std::vector<StudyRow> rows;
      for (std::size_t k = block.begin; k < block.end; ++k) {
        if (!queue.goes_on()) return;
        rows.push_back(run(which[k], [&] { return queue.goes_on(); }));
      }
      if (!queue.goes_on()) return;  // the last one may have been broken off
      queue.put(block.begin, std::move(rows));
    }
  };
  std::vector<std::thread> helpers;
  for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(work);
  work();
  for (std::thread& helper : helpers) helper.join();
  queue.rethrow();
}

}  // namespace shearfront::fit
