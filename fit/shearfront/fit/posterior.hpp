// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "shearfront/fit/estimate.hpp"
#include "shearfront/fit/fit_spec.hpp"
#include "shearfront/fit/prior.hpp"

namespace shearfront::fit {

/// The logarithm of a density up to a constant, with its gradient.
struct LogDensity {
  double value = -std::numeric_limits<double>::infinity();
  Eigen::VectorXd gradient;  ///< zeros where the value is not finite; empty unless asked for
  std::string
      failure;  ///< outside the bounds, or why there is no solution: the value is -infinity; otherwise empty
};

/// What data and priors together say about the n unknowns p of a fit, in the units of the entries: their posterior density,
/// for samplers of others.
///
///     log density(p) = log L(p) + sum_i log prior_i(p_i) + constant,   r = r(p) the m residuals,
///     log L = -sum r^2 / 2           where the data give sigma: Gaussian noise, r in units of sigma
///     log L = -m / 2 log sum r^2     where they do not: sigma has the density 1 / sigma and is integrated out;
///                                    +infinity where all r are 0.
///
/// r are those of all observations; the loss of the fit plays no part. Correlated noise of [noise] whitens r. Priors are those
/// of FitSpec::priors, of several for one unknown the last; flat within the bounds where there is none. Their ends narrow the
/// bounds of the unknowns, l <= p <= h. Within them breaks ascend and the values of a(z) keep the shape.
///
/// Samplers want no bounds, so there are coordinates x, one for each unknown, of which any numbers are allowed:
///
///     p = l + (h - l) / (1 + exp(-x)), of log p where 0 < 10 l < h;   p = l + exp(x), h - exp(x), x without the other end, or both
///     log density(x) = log density(p(x)) + log |det dp/dx|
///
/// where l of a break is the one below it, and l of a value of a(z) with a shape is what the values above it leave
/// (unbounded_coordinates.hpp).
///
///   (1) p(x) is inside the bounds; layers do not cross, shapes hold
///   (2) coordinates(values(x)) == x up to rounding, |x| < 13
///   (3) gradients are exact up to rounding where the method has derivatives, else by differences; what is measured at points
///       makes steps where shocks pass (has_steps()), which no gradient sees
///
/// Errors: InputError for what holds between entries of the specification (keys as in a fit file); for priors of what is no
/// unknown, with numbers that make no distribution, or that leave no room between the bounds (key "prior"); for vectors of
/// another length than n (keys "p", "x"). Threads may share one, but wait for each other; each its own is faster.
/// Cost: one run of the forward model, with derivatives if the gradient is asked for (of many unknowns by front tracking: one pass
/// backwards, about two runs whatever their number); the rest is m n + n^3. Example 4, 1980 bins, five rates: 0.33 ms, with
/// gradient 0.42 ms.
class Posterior {
 public:
  explicit Posterior(const FitSpec& spec);
  /// With the correlation of the noise as a fit of the same specification found it.
  Posterior(const FitSpec& spec, const Estimate& found);
  ~Posterior();
  Posterior(Posterior&& other) noexcept;
  Posterior& operator=(Posterior&& other) noexcept;

  [[nodiscard]] std::size_t size() const { return names().size(); }
  [[nodiscard]] const std::vector<std::string>& names() const;  ///< of the unknowns, "shear_rate.values[0]"
  /// One for each unknown.
  [[nodiscard]] const std::vector<Prior>& priors() const;
  /// Bounds of the unknowns, narrowed by the ends of the priors; what orders them among each other comes on top.
  [[nodiscard]] const Eigen::VectorXd& lower() const;
  [[nodiscard]] const Eigen::VectorXd& upper() const;
  [[nodiscard]] std::size_t n_residuals() const;  ///< m
  [[nodiscard]] bool sigma_is_given() const;
  [[nodiscard]] bool has_steps() const;

  [[nodiscard]] double log_density(const Eigen::VectorXd& p) const { return at(p, false).value; }
  /// The same, and its gradient in p.
  [[nodiscard]] LogDensity at(const Eigen::VectorXd& p, bool with_gradient = true) const;
  /// log density(x), and its gradient in x.
  [[nodiscard]] LogDensity at_coordinates(const Eigen::VectorXd& x, bool with_gradient = true) const;
  /// p(x); none where rounding leaves no room between the bounds, or x is not finite.
  [[nodiscard]] std::optional<Eigen::VectorXd> values(const Eigen::VectorXd& x) const;
  /// x(p); what is at a bound is moved inside by a millionth of the way.
  [[nodiscard]] Eigen::VectorXd coordinates(const Eigen::VectorXd& p) const;
  /// J^T J of the Jacobian J = dr/dx in units of sigma, or of its estimate sqrt(sum r^2 / m): about the curvature of -log L
  /// near the estimate, for what sets out from there. None where there is no solution.
  [[nodiscard]] std::optional<Eigen::MatrixXd> curvature(const Eigen::VectorXd& x) const;

 private:
  struct Parts;
  std::unique_ptr<const Parts> parts_;
};

}  // namespace shearfront::fit
