// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/objective.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

#include "shearfront/fit/loss/all.hpp"
#include "shearfront/fit/numeric_step.hpp"
#include "shearfront/io/text.hpp"

namespace shearfront::fit {

using Eigen::Index;
using Eigen::VectorXd;

Loss find_loss(std::string_view name, double scale) {
  Loss loss;
  LossList::for_each([&]<class L>() {
    if (name == L::kName) loss = {&L::value, scale > 0 ? scale : L::kDefaultScale, L::kIsRobust};
  });
  if (!loss.function)
    throw InputError("misfit.loss", quoted_text(name), "must be one of: " + LossList::names());
  return loss;
}

Objective::Objective(const Parameters& parameters, const Coordinates& coordinates, const ForwardSpec& forward,
                     ResidualRows rows, Loss loss, RunControl& control)
    : parameters_(&parameters),
      coordinates_(&coordinates),
      rows_(std::move(rows)),
      loss_(loss),
      control_(&control),
      forward_(parameters, forward, rows_.field, rows_.points) {
  constexpr double kUlps = 4;
  const double size = (rows_.field == Observable::phi ? 1 : parameters.height()) *
                      (rows_.field == Observable::bed_height ? 1 : parameters.states());
  std::size_t n = 0;
  for (std::size_t i = 0; i < rows_.rows.size(); ++i) {
    const ResidualRows::Row& row = rows_.rows[i];
    double terms = 0;
    for (const Term& term : rows_.model(i)) terms += std::abs(term.coefficient);
    n = (row.continues ? n : 0) + rows_.data(i).size();
    terms *= 1 + static_cast<double>(n);
    const double error = kUlps * std::numeric_limits<double>::epsilon() * row.weight * size * terms *
                         (rows_.noise ? rows_.noise->gain() : 1);
    rounding_misfit_ += error * error / 2;
  }
}

void Objective::set_loss(Loss loss) {
  loss_ = loss;
  last_u_.resize(0);
  best_ = {};
}

void Objective::set_tether(VectorXd centre, double tether) {
  centre_ = std::move(centre);
  tether_ = tether;
  last_u_.resize(0);
  best_ = {};
}

Objective::Evaluation Objective::run(const VectorXd& u, Derivatives derivatives) const {
  Evaluation at;
  at.misfit = std::numeric_limits<double>::infinity();
  if (!u.allFinite()) return at;
  const VectorXd values = coordinates_->values(u);
  if (!values.allFinite() || !parameters_->within_bounds(values)) return at;
  if (!control_->may_run()) {
    at.failure = "interrupted";
    return at;
  }
  const bool with_jacobian = derivatives == Derivatives::jacobian,
             with_gradient = derivatives == Derivatives::gradient;
  const auto progress = [this](double, std::uint64_t) { return control_->may_run(); };
  const Prediction prediction =
      with_gradient
          ? forward_.predict_gradient(
                values, [this](const VectorXd& X) { return rows_.slopes(slopes(rows_.residuals(X))); },
                progress)
          : forward_.predict(values, with_jacobian, progress);
  at.failure = prediction.failure;
  if (!prediction.is_valid()) return at;
  at.residuals = rows_.residuals(prediction.values);
  const char* const kTooLarge = "the misfit is beyond the largest number (is sigma too small?)";
  if (!at.residuals.allFinite()) {
    at.failure = kTooLarge;
    return at;
  }
  at.is_valid = true;
  at.rounding = std::sqrt(2 * rounding_misfit_);
  at.misfit = 0;
  for (Index i = 0; i < at.residuals.size(); ++i)
    at.misfit += loss_(at.residuals[i] * at.residuals[i]).rho / 2;
  if (!std::isfinite(at.misfit)) {
    at = {};
    at.misfit = std::numeric_limits<double>::infinity();
    at.failure = kTooLarge;
    return at;
  }
  if (with_jacobian) at.jacobian = coordinates_->turned(u, rows_.jacobian(prediction.derivatives));
  if (with_gradient) at.gradient = coordinates_->turned(u, prediction.gradient.transpose()).transpose();
  at.order_holds = prediction.order_holds;
  at.order = prediction.order;
  if (centre_.size() > 0) add_tether(u, at);
  return at;
}

void Objective::add_tether(const VectorXd& u, Evaluation& at) const {
  const Index n = rows_.size(), p = u.size();
  at.residuals.conservativeResize(n + p);
  at.residuals.tail(p) = tether_ * (u - centre_);
  at.misfit += at.residuals.tail(p).squaredNorm() / 2;
  if (at.gradient.size() > 0) at.gradient += tether_ * at.residuals.tail(p);
  if (at.jacobian.size() == 0) return;
  at.jacobian.conservativeResize(n + p, p);
  at.jacobian.bottomRows(p) = tether_ * Eigen::MatrixXd::Identity(p, p);
}

void Objective::differentiate(const VectorXd& u, Evaluation& at, RunControl* control) const {
  const auto residuals = [&](const VectorXd& v) {
    Evaluation there = run(v, Derivatives::none);
    if (control) control->count(std::numeric_limits<double>::infinity());
    return there.is_valid ? there.residuals : VectorXd();
  };
  if (step_.size() == 0)
    step_ = numeric_steps(residuals, u, at.residuals, forward_.smallest_step(), rows_.unit);
  at.jacobian.resize(at.residuals.size(), u.size());
  if (!control) at.column_error = VectorXd::Zero(u.size());
  for (Index j = 0; j < u.size(); ++j) {
    if (control) {
      at.jacobian.col(j) = difference(residuals, u, at.residuals, j, step_[j]);
      continue;
    }
    const Difference best = best_difference(residuals, u, at.residuals, j, step_[j]);
    at.jacobian.col(j) = best.column;
    at.column_error[j] = best.error;
  }
  at.is_valid = at.jacobian.allFinite();
  for (Index j = 0; j < u.size() && !at.is_valid; ++j)
    if (!at.jacobian.col(j).allFinite())
      at.failure = "there is none a small step to either side in " + coordinates_->name(j);
}

VectorXd Objective::slopes(const VectorXd& residuals) const {
  VectorXd weighted = residuals;
  for (double& r : weighted.head(rows_.size())) r *= loss_(r * r).first;
  return weighted;
}

VectorXd Objective::gradient(const Evaluation& at) const {
  return at.gradient.size() > 0 ? at.gradient : VectorXd(at.jacobian.transpose() * slopes(at.residuals));
}

void Objective::go_to(const VectorXd& u, Derivatives derivatives) {
  last_ = run(u, derivatives);
  last_u_ = u;
  if (last_.order != 0) {
    if (last_order_ != 0 && last_.order != last_order_) ++n_order_changes_;
    last_order_ = last_.order;
  }
  control_->count(last_.misfit);
}

const Objective::Evaluation& Objective::evaluate(const VectorXd& u, bool with_jacobian) {
  const bool is_last = last_u_.size() == u.size() && last_u_ == u;
  const bool lacks_jacobian = with_jacobian && last_.is_valid && last_.jacobian.size() == 0;
  const bool is_new = !is_last || (lacks_jacobian && has_derivatives());
  // Exact derivatives cost less than coming back for them.
  if (is_new) go_to(u, has_derivatives() ? Derivatives::jacobian : Derivatives::none);
  const bool is_to_differentiate = with_jacobian && last_.is_valid && last_.jacobian.size() == 0;
  if ((is_new || is_to_differentiate) && last_.is_valid && !(best_.is_valid && best_.misfit < last_.misfit))
    best_ = last_, best_u_ = u;
  if (!is_to_differentiate) return last_;
  differentiate(u, last_, control_);
  if (last_.is_valid && best_u_ == u) best_ = last_;
  return last_;
}

const Objective::Evaluation& Objective::evaluate_misfit(const VectorXd& u, bool with_gradient) {
  if (!forward_.has_gradient()) return evaluate(u, with_gradient);
  const bool is_last = last_u_.size() == u.size() && last_u_ == u;
  const bool has_slope = last_.gradient.size() > 0 || last_.jacobian.size() > 0;
  if (is_last && (has_slope || !with_gradient || !last_.is_valid)) return last_;
  go_to(u, with_gradient ? Derivatives::gradient : Derivatives::none);
  if (last_.is_valid && !(best_.is_valid && best_.misfit < last_.misfit)) best_ = last_, best_u_ = u;
  return last_;
}

Objective::Evaluation Objective::inspect(const VectorXd& u, bool with_jacobian) const {
  Evaluation at = run(u, with_jacobian && has_derivatives() ? Derivatives::jacobian : Derivatives::none);
  if (with_jacobian && at.is_valid && at.jacobian.size() == 0) differentiate(u, at, nullptr);
  return at;
}

}  // namespace shearfront::fit
