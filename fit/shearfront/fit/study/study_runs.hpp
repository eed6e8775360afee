// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/noise_covariance.hpp"
#include "shearfront/fit/study/study_spec.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront::fit {

/// One run of a study.
struct StudyRow {
  std::size_t run = 0;
  std::vector<double> values;   ///< of the entries that vary
  std::vector<double> outputs;  ///< infinity: an event that never comes; all NaN after a failure
  std::string failure;          ///< why there is no result; empty if there is one
};

/// The runs of a study, prepared once.
class StudyRuns {
 public:
  /// Errors: InputError if a design fit has no usable estimate or an unknown without error bar.
  explicit StudyRuns(StudySpec spec);

  [[nodiscard]] const StudySpec& spec() const { return spec_; }
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  /// Names of the entries that vary, in the order of StudyRow::values.
  [[nodiscard]] const std::vector<std::string>& entries() const { return entries_; }
  /// `goes_on` is asked now and then; once it returns false the row means nothing.
  [[nodiscard]] StudyRow run(std::size_t i, const std::function<bool()>& goes_on = {}) const;

  /// Runs these, on `threads` threads (0: all cores), and hands the rows on in their order, one at a time, whatever the
  /// threads, as soon as those before them are done. It ends when goes_on(), asked in each run, returns false. Errors: those
  /// of take(). Cost: the runs; rows that wait for one before them, at most 4096.
  void run_all(const std::vector<std::size_t>& which, std::size_t threads,
               const std::function<void(const StudyRow&)>& take,
               const std::function<bool()>& goes_on = {}) const;

 private:
  void prepare_replicates();
  [[nodiscard]] StudyRow run_replicate(std::size_t i, const std::function<bool()>& goes_on) const;
  /// Fills the outputs that are numbers of the scene.
  void solve_outputs(const Scene<double>& scene, const std::function<bool()>& goes_on, StudyRow& row) const;

  StudySpec spec_;
  std::optional<FitSpec> replicate_;  ///< of design replicates, and the fit whose predictions get noise
  std::optional<Estimate> estimate_;
  std::shared_ptr<const NoiseCovariance> noise_;  ///< of the draws; null: independent
  std::vector<std::vector<double>> points_;
  std::vector<std::string> entries_;
  std::vector<std::size_t> places_;  ///< of the entries among entry_places()
  SolverRequest samples_;            ///< what the outputs need at times and heights
  SolverRequest heights_;            ///< of the bed
  bool needs_timeline_ = false;
};

}  // namespace shearfront::fit
