// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/coordinates.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/loss/loss.hpp"
#include "shearfront/fit/noise_reml.hpp"
#include "shearfront/fit/objective.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/fit/residual_rows.hpp"
#include "shearfront/fit/run_control.hpp"
#include "shearfront/fit/search/search.hpp"

namespace shearfront::fit {

/// From the start of a fit to the minimum of its misfit: through stages whose misfits vary more smoothly with the unknowns
/// (sums, wider bins, means), then by the misfit asked for, until the rows it leaves out and the noise it takes stay what
/// they are. Errors: InputError for names that are in no list and misfits that the observations do not allow.
class StagedSearch {
 public:
  StagedSearch(const FitSpec& spec, const Progress& progress);
  StagedSearch(const StagedSearch&) = delete;  // the objective refers to members
  StagedSearch& operator=(const StagedSearch&) = delete;

  /// The whole search, from all starts.
  void find();
  /// Goes on from the minimum with another forward model.
  void go_on_with(const Method& method);
  /// The values found; nothing if the search did not end at a minimum. Precondition: find() was called.
  [[nodiscard]] std::optional<Eigen::VectorXd> values() const;

  [[nodiscard]] const FitSpec& spec() const { return spec_; }  ///< with the forward model used last
  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] const Objective& objective() const { return *objective_; }
  [[nodiscard]] const SearchResult& result() const { return result_; }
  [[nodiscard]] const std::string& quantity() const { return quantity_; }
  [[nodiscard]] const std::string& loss() const { return loss_name_; }
  [[nodiscard]] std::size_t iterations() const { return iterations_; }
  [[nodiscard]] std::size_t left_out() const { return left_out_; }
  [[nodiscard]] bool must_stop() const { return control_.must_stop(); }
  /// Of correlated noise; empty while it is independent.
  [[nodiscard]] std::optional<NoiseEstimate> noise() const;
  /// What is to be said of it; empty if nothing.
  [[nodiscard]] const std::string& noise_warning() const { return noise_warning_; }

 private:
  void find_from(const Eigen::VectorXd& start);

  /// Every start goes through all stages: what is best in an early one need not be in the last.
  void find_from_many(const Eigen::VectorXd& start);

  [[nodiscard]] bool has_diffusion() const { return parameters_.start_scene().has_diffusion(); }
  /// Whether a jump of phi can be near an observation: with diffusion phi is continuous.
  [[nodiscard]] bool has_jumps() const;

  /// Searches once more from where a coordinate at a bound, or far from its start, is as at the start: on the way to a rate of almost 0 the misfit is level in
  /// its logarithm, and a search does not come back from there.
  void leave_bounds(const Eigen::VectorXd& start);

  /// Compares estimates whose last stages left out other rows or took another noise: all rows, with a loss of
  /// fixed scale.
  [[nodiscard]] double forgiving_misfit();

  [[nodiscard]] std::unique_ptr<Objective> make_objective(ResidualRows rows, const Loss& loss);

  /// The search asked for the first time, afterwards only its local part from where it ended.
  void search_from_here(Objective& objective, double tolerance);

  /// Comes near the minimum through misfits that vary more smoothly with the parameters than the one asked
  /// for.
  void approach();

  /// Means over fewer and fewer bins at once. The misfit has a kink wherever a shock enters a bin, and so
  /// many local minima; each width locates the shocks within the valley of the next.
  void narrow_bins();

  /// The misfit asked for. What it depends on besides the parameters, the rows without a jump and the noise
  /// that tells a robust loss what is gross, is taken from the estimate and renewed, with searches as rough
  /// as that, until it stays; the last search is fine.
  void settle(bool leaves_out_jumps);

  /// Estimates the correlation of the noise from what the fit leaves and refits, until both stand still.
  void settle_noise();
  /// Whitened residuals change at once where a shock enters an observation: there are many valleys, and that of independent noise
  /// is often a wrong one. Searches from where least squares would have ended with other noise of this covariance as well, and
  /// keeps the best.
  void search_other_valleys(const NoiseData& data);
  [[nodiscard]] NoiseData noise_data() const;
  void whiten(NoiseNumbers numbers);

  /// Whether other rows than before have no jump near them.
  bool renew_rows(std::vector<bool>& keep);

  /// Whether the noise is another than before; never for data that come with theirs.
  bool renew_scale();
  [[nodiscard]] Loss scaled_loss() const;

  FitSpec spec_;  ///< its forward model may become finer
  Parameters parameters_;
  Coordinates coordinates_;
  RunControl control_;
  std::string quantity_, loss_name_;
  Loss loss_;
  ResidualRows rows_;  ///< of the misfit asked for, made once
  std::unique_ptr<Objective> objective_;
  Eigen::VectorXd u_, start_;
  SearchResult result_;
  bool has_stages_ = false, has_searched_ = false;
  std::size_t share_ = std::numeric_limits<std::size_t>::max();  ///< of the evaluations left, for one start
  std::size_t iterations_ = 0, left_out_ = 0;
  double noise_ = 0;  ///< of the residuals, for a robust loss
  int n_scales_ = 0;
  std::shared_ptr<const NoisePlaces> places_;  ///< of correlated noise
  std::optional<NoiseNumbers> correlation_;
  std::string noise_warning_;
};

}  // namespace shearfront::fit
