// SPDX-License-Identifier: BSD-3-Clause
#include "cli/fitted.hpp"

#include <fmt/format.h>

#include <cmath>
#include <csignal>
#include <utility>
#include <variant>

#include "cli/command.hpp"
#include "cli/fit_text.hpp"
#include "cli/progress.hpp"
#include "shearfront/fit.hpp"
#include "shearfront/io/detail/csv.hpp"
#include "shearfront/io/detail/table_lines.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::tools {
bool is_fit_file(const std::string& path) {
  if (path == "-") return false;
  return fit::is_fit_file(path);
}

namespace {

/// work(progress) of a fit under a line of its own; Ctrl-C ends it, a refusal gets its place in the file.
template <class Work>
auto with_search_line(const std::string& path, Work&& work) {
  ProgressLine line;
  try {
    return work([&](std::size_t evaluations, double misfit) {
      line.show_search(evaluations, misfit);
      return !InterruptGuard::is_interrupted();
    });
  } catch (const FileError&) {
    throw;
  } catch (const InputError& error) {
    throw fit::located(error, path);
  }
}

}  // namespace

fit::Estimate run_fit(const fit::FitSpec& spec, const std::string& path) {
  return with_search_line(path, [&](const fit::Progress& progress) { return fit::fit(spec, progress); });
}

FittedModels run_models(const fit::FitFile& file, const std::string& path) {
  FittedModels result{with_search_line(path,
                                       [&](const fit::Progress& progress) {
                                         return fit::fit_models(file.spec, *file.choice, progress);
                                       }),
                      std::nullopt, file.choice->criterion};
  for (std::size_t i = 0; i < result.all.estimates.size(); ++i)
    result.n_searched.push_back(fit::n_searched(*file.choice, file.choice->models[i]));
  const std::vector<fit::Estimate>& estimates = result.all.estimates;
  const auto key = [&](std::size_t i) {
    const fit::Estimate& e = estimates[i];
    return std::pair(fit::value_of(result.criterion, e, result.n_searched[i]).value_or(HUGE_VAL), e.misfit);
  };
  for (std::size_t i = 0; i < estimates.size(); ++i)
    if (estimates[i].usable() && (!result.best || key(i) < key(*result.best))) result.best = i;
  return result;
}

Fitted fitted(const std::string& path, const SceneChanges& changes) {
  fit::FitFile file = fit::read_fit_file(path, changes);
  print_remarks(file.remarks);
  print_remarks(file.spec.observations.notes);
  fit::Estimate estimate;
  bool is_interrupted = false;
  {
    const InterruptGuard guard;
    if (file.choice) {
      FittedModels models = run_models(file, path);
      const std::size_t i = models.best.value_or(0);
      note("the best model: " + models.all.specs[i].name);
      file.spec = std::move(models.all.specs[i]);
      estimate = std::move(models.all.estimates[i]);
    } else {
      estimate = run_fit(file.spec, path);
    }
    is_interrupted = InterruptGuard::is_interrupted();
  }
  if (is_interrupted) (void)std::raise(SIGINT);  // the fit is not what was asked for
  if (!estimate.usable())
    throw InputError(printable(path), "",
                     fmt::format("has no estimate ({}): {}", name_of(estimate.status), estimate.message));
  for (const fit::ParameterEstimate& p : estimate.parameters)
    note(fmt::format("{} = {}{}", p.name, number_text(p.estimate, 6),
                     p.std_error ? " +- " + number_text(*p.std_error, 2) : ""));
  for (const std::string& warning : estimate.warnings) note(printable(warning, 500));
  const fit::Parameters parameters(file.spec.scene, file.spec.unknown);
  fit::DrawnScenes draws = fit::scenes_behind(parameters, estimate, kPredictionDraws, file.spec.search.seed);
  return {std::move(file), std::move(estimate), std::move(draws)};
}

void write_band_csv(OutputFile& file, const fit::RateBand& band, const SceneUnits& units) {
  constexpr fit::Interval kNone{HUGE_VAL, HUGE_VAL};
  const std::string unit = units.z.empty() || units.t.empty() ? "" : units.z + "/" + units.t;
  std::string header = detail::csv_field(detail::heading_text("z", units.z));
  for (const char* name : {"a", "lower", "upper", "lower_all", "upper_all"})
    header += "," + detail::csv_field(detail::heading_text(name, unit));
  file.write(header + "\n");
  for (const fit::RateRow& row : band.rows) {
    const fit::Interval here = row.band.value_or(kNone), all = row.everywhere.value_or(kNone);
    file.write(csv_row({row.z, row.a, here.low, here.high, all.low, all.high}));
  }
}

void note_rate_band(const fit::RateBand& band) {
  const std::string source =
      band.n_replicates > 0 ? fmt::format(", both from the {} replicates of the bootstrap", band.n_replicates)
                            : "";
  note(
      fmt::format("the band from lower to upper holds at each height with 95 %, that from lower_all to "
                  "upper_all at all heights at once{}",
                  source));
}

void note_bands(const fit::DrawnScenes& draws, std::size_t n_by_draws, std::size_t n) {
  if (!draws.why_none.empty()) return;
  if (draws.are_replicates)
    note(fmt::format("95 % bands from the {} replicates of the bootstrap", draws.scenes.size()));
  else if (n_by_draws == 0)
    note("95 % bands by derivatives");
  else
    note(
        fmt::format("95 % bands of {} of {} numbers by derivatives, of {}, which do not follow a straight "
                    "line, by {} draws",
                    n - n_by_draws, n, n_by_draws, kPredictionDraws));
}

void note_draws(const fit::DrawnScenes& draws, std::size_t n_failed) {
  if (!draws.why_none.empty()) note("no bands: " + printable(draws.why_none));
  if (n_failed > 0)
    note(fmt::format("{} of {} scenes {} have no solution and are left out of the bands", n_failed,
                     draws.scenes.size(),
                     draws.are_replicates ? "of the bootstrap" : "drawn from the error bars"));
}

}  // namespace shearfront::tools
