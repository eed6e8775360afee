// SPDX-License-Identifier: BSD-3-Clause
#include "cli/prediction_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "bed_course.hpp"
#include "cli/command.hpp"
#include "cli/fit_text.hpp"
#include "cli/progress.hpp"
#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/solution/bed_height.hpp"

namespace shearfront::tools {
namespace {

/// work(Progress) with a line of how many of the drawn scenes are done.
template <class Work>
auto with_drawn_scenes(const fit::DrawnScenes& draws, Work&& work) {
  ProgressLine line;
  return work([&](std::size_t done, double) {
    line.show_part(done, draws.scenes.size());
    return true;
  });
}

/// Rows of one number each.
class PredictionRows {
 public:
  PredictionRows(OutputFile& file, const SceneUnits& units) : file_(&file), units_(units) {
    std::string header = "quantity";
    for (const auto& [name, unit] : {std::pair(std::string(units.symbol()), units.t), {"z", units.z}})
      header += "," + detail::csv_field(detail::heading_text(name, unit));
    file_->write(header + ",value,lower,upper,std_error,unit\n");
  }

  void add(std::string_view quantity, std::optional<double> t, std::optional<double> z,
           const fit::PredictedNumber& number, const std::string& unit) {
    std::string row(quantity);
    const auto field = [&](std::optional<double> x) {
      row += "," + (!x ? "" : *x == fit::kNever ? "never" : std::isfinite(*x) ? number_text(*x) : "");
    };
    field(t);
    field(z);
    field(number.value);
    field(number.band ? std::optional(number.band->low) : std::nullopt);
    field(number.band ? std::optional(number.band->high) : std::nullopt);
    field(number.std_error);
    file_->write(row + "," + detail::csv_field(unit) + "\n");
    ++n_;
    if (!number.std_error) ++n_by_draws_;
  }
  [[nodiscard]] const SceneUnits& units() const { return units_; }
  [[nodiscard]] std::size_t size() const { return n_; }
  [[nodiscard]] std::size_t n_by_draws() const { return n_by_draws_; }

 private:
  OutputFile* file_;
  SceneUnits units_;
  std::size_t n_ = 0, n_by_draws_ = 0;
};

/// These and what follows return how many of the drawn scenes had no solution.
std::size_t add_samples(PredictionRows& rows, const PredictionPlan& plan, const Scene<double>& estimated,
                        const fit::DrawnScenes& draws, const Method& method) {
  const fit::PredictedSamples samples = with_drawn_scenes(draws, [&](const fit::Progress& progress) {
    return fit::predict_samples(estimated, draws, method, plan.times, plan.heights, progress);
  });
  const auto add = [&](const char* name, const std::vector<fit::PredictedNumber>& numbers,
                       const std::string& unit) {
    auto number = numbers.begin();
    for (const double t : plan.times)
      for (const double z : plan.heights) rows.add(name, t, z, *number++, unit);
  };
  add("phi", samples.phi, "");
  add("M", samples.M, rows.units().z);
  return samples.n_failed;
}

std::size_t add_heights_of_bed(PredictionRows& rows, const PredictionPlan& plan,
                               const Scene<double>& estimated, const fit::DrawnScenes& draws,
                               const Method& method) {
  if (const std::string why = BedHeight::refusal(estimated); !why.empty()) {
    note("no height of the bed: " + why);
    return 0;
  }
  const fit::PredictedNumbers predicted = with_drawn_scenes(draws, [&](const fit::Progress& progress) {
    return fit::predict_bed(estimated, draws, method, fit::bed_height_function(estimated), plan.times,
                            progress);
  });
  for (std::size_t i = 0; i < predicted.numbers.size(); ++i)
    rows.add("H", plan.times[i], {}, predicted.numbers[i], rows.units().z);
  return predicted.n_failed;
}

/// The method if it knows event times, else the first that does here; why there is none.
std::pair<std::optional<Method>, std::string> method_of_events(const Scene<double>& scene,
                                                               const Method& method) {
  if (method.guarantees().has_timeline) return {method, ""};
  std::string why;
  for (const std::string& name : Method::names(&Guarantees::has_timeline)) {
    const Method other(name);
    const std::string refusal = other.refusal(scene);
    if (refusal.empty()) return {other, ""};
    if (why.empty()) why = refusal.substr(0, refusal.find("; use "));
  }
  return {std::nullopt, why};
}

std::size_t add_event_times(PredictionRows& rows, const Scene<double>& estimated,
                            const fit::DrawnScenes& draws, const Method& method) {
  const auto found = method_of_events(estimated, method);
  if (!found.first) {
    note("no event times: " + found.second);
    return 0;
  }
  const Method& by = *found.first;
  std::optional<fit::PredictedEvents> events;
  try {
    events = with_drawn_scenes(draws, [&](const fit::Progress& progress) {
      return fit::predict_events(estimated, draws, by, progress);
    });
  } catch (const InputError& error) {
    note("no event times: " + std::string(error.what()));
    return 0;
  }
  if (by.name() != method.name()) note(fmt::format("event times by {}", by.name()));
  const std::string along = rows.units().symbol(), unit = rows.units().t;
  const auto add_interfaces = [&](const std::string& name,
                                  fit::PredictedNumber fit::PredictedEvents::AtInterface::*member) {
    for (std::size_t i = 0; i < events->interfaces.size(); ++i) {
      const double z = events->at_estimate.interfaces[i].z;
      if (estimated.jumps_at(z)) rows.add(along + name, {}, z, events->interfaces[i].*member, unit);
    }
  };
  add_interfaces("_c", &fit::PredictedEvents::AtInterface::first);
  rows.add(along + "_0", {}, {}, events->t0, unit);
  rows.add(along + "_1", {}, {}, events->t1, unit);
  add_interfaces("^_c", &fit::PredictedEvents::AtInterface::last);
  rows.add(along + "*", {}, {}, events->t_star, unit);
  return events->n_failed;
}

}  // namespace

void write_predictions_csv(OutputFile& file, const PredictionPlan& plan, const Scene<double>& estimated,
                           const fit::DrawnScenes& draws, const Method& method) {
  PredictionRows rows(file, estimated.spec().units);
  std::size_t n_failed = add_samples(rows, plan, estimated, draws, method);
  n_failed = std::max(n_failed, add_heights_of_bed(rows, plan, estimated, draws, method));
  n_failed = std::max(n_failed, add_event_times(rows, estimated, draws, method));
  note_draws(draws, n_failed);
  note_bands(draws, rows.n_by_draws(), rows.size());
}

void write_sample_bands_csv(OutputFile& file, const std::vector<double>& times,
                            const std::vector<double>& heights, const fit::PredictedSamples& samples,
                            const SceneUnits& units) {
  file.write(csv_header({"t", "z", "phi", "lower", "upper", "M", "M_lower", "M_upper"}, units));
  const auto low = [](const fit::PredictedNumber& n) { return n.band ? n.band->low : HUGE_VAL; };
  const auto high = [](const fit::PredictedNumber& n) { return n.band ? n.band->high : HUGE_VAL; };
  for (std::size_t i = 0; i < times.size(); ++i)
    for (std::size_t j = 0; j < heights.size(); ++j) {
      const fit::PredictedNumber &phi = samples.phi[i * heights.size() + j],
                                 &M = samples.M[i * heights.size() + j];
      file.write(csv_row({times[i], heights[j], phi.value, low(phi), high(phi), M.value, low(M), high(M)}));
    }
}

ResultBand result_band(const fit::PredictedNumber& number) {
  return {number.band ? std::optional(std::pair(number.band->low, number.band->high)) : std::nullopt,
          number.std_error};
}

SampleBands sample_bands(const fit::PredictedSamples& samples) {
  SampleBands bands;
  for (const fit::PredictedNumber& number : samples.phi) bands.phi.push_back(result_band(number));
  for (const fit::PredictedNumber& number : samples.M) bands.M.push_back(result_band(number));
  return bands;
}

}  // namespace shearfront::tools
