// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/study/study_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>

#include "shearfront/fit.hpp"
#include "shearfront/fit/prediction.hpp"
#include "shearfront/fit/study/study_design.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"

namespace shearfront::fit {
namespace {

using Kind = StudyOutput::Kind;

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kBlock = 64;  // runs a thread takes at once

bool is_sample(Kind kind) { return kind == Kind::phi || kind == Kind::M; }
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
  if (spec_.design == DesignKind::fit) {
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
    } else {
      needs_timeline_ = true;
    }
  }
  samples_.timeline = needs_timeline_;
}

StudyRow StudyRuns::run(std::size_t i) const {
  StudyRow row{i, points_[i], std::vector<double>(spec_.outputs.size(), kNothing), ""};
  const auto fail = [&](const std::string& why) {
    std::fill(row.outputs.begin(), row.outputs.end(), kNothing);
    row.failure = why;
    return row;
  };
  SceneSpec<double> changed = spec_.scene->spec();
  const std::vector<double*> places = entry_places(changed);
  for (std::size_t j = 0; j < places_.size(); ++j) *places[places_[j]] = points_[i][j];
  std::variant<Scene<double>, Complaints> made = Scene<double>::make(std::move(changed));
  if (const auto* complaints = std::get_if<Complaints>(&made)) return fail(complaints->front().text());
  const Scene<double>& scene = std::get<Scene<double>>(made);
  try {
    SolverResult result;
    if (needs_timeline_ || !samples_.times.empty()) {
      result = solve(scene, spec_.method, samples_);
      if (!result.summary.usable()) return fail(result.summary.message);
    }
    const auto integrals = [&](Kind kind, const ShareFunction& integrand, std::string& why) {
      std::vector<double> none;
      const auto is_kind = [kind](const StudyOutput& o) { return o.kind == kind; };
      if (std::none_of(spec_.outputs.begin(), spec_.outputs.end(), is_kind)) return none;
      SolverRequest request = heights_;
      request.integrand = integrand;
      SolverResult bed = solve(scene, spec_.method, request);
      if (!bed.summary.usable()) why = bed.summary.message;
      return bed.summary.usable() ? std::move(bed.integrals) : none;
    };
    const BedHeight bed(scene);
    std::string why = heights_.times.empty() ? "" : BedHeight::refusal(scene);
    if (!why.empty()) return fail(why);
    const std::vector<double> heights = integrals(Kind::height, bed.integrand(), why),
                              entropies = integrals(Kind::mixing, entropy_function(), why);
    if (!why.empty()) return fail(why);
    for (std::size_t k = 0; k < spec_.outputs.size(); ++k) {
      const StudyOutput& output = spec_.outputs[k];
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
        if (!t) return fail(std::string(spec_.method.name()) + " gives no " + output.name + " here");
        row.outputs[k] = *t;
      }
    }
  } catch (const InputError& error) {
    return fail(error.what());
  }
  return row;
}

void StudyRuns::run_all(const std::vector<std::size_t>& which, std::size_t threads,
                        const std::function<bool(const StudyRow&)>& take) const {
  if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
  const std::size_t round = kBlock * threads * 16;  // rows kept until they are handed on
  for (std::size_t begin = 0; begin < which.size(); begin += round) {
    const std::size_t end = std::min(begin + round, which.size());
    std::vector<StudyRow> rows(end - begin);
    std::atomic<std::size_t> next{begin};
    const auto work = [&] {
      for (std::size_t first = next.fetch_add(kBlock); first < end; first = next.fetch_add(kBlock))
        for (std::size_t k = first; k < std::min(first + kBlock, end); ++k) rows[k - begin] = run(which[k]);
    };
    std::vector<std::thread> helpers;
    for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back(work);
    work();
    for (std::thread& helper : helpers) helper.join();
    for (const StudyRow& row : rows)
      if (!take(row)) return;
  }
}

}  // namespace shearfront::fit
