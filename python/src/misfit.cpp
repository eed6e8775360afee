// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <Eigen/LU>
#include <limits>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "fit.hpp"
#include "outcome.hpp"
#include "shearfront/fit.hpp"
#include "shearfront/fit/coordinates.hpp"
#include "shearfront/fit/misfit_rows.hpp"
#include "shearfront/fit/noise_reml.hpp"
#include "shearfront/fit/objective.hpp"

namespace shearfront::python {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The rows of a misfit; with correlated noise that is known, whitened.
fit::ResidualRows whitened_rows(const fit::FitSpec& spec, const fit::Parameters& parameters) {
  fit::ResidualRows rows = fit::rows_of(fit::quantity_of(spec), spec, parameters);
  if (spec.noise.model == fit::NoiseModel::independent) return rows;
  if (const std::string refusal = fit::noise_refusal(spec, rows); !refusal.empty())
    throw InputError("noise.model", "", refusal);
  const auto places = fit::noise_places(spec, rows);
  const auto numbers = fit::given_noise(spec.noise, *places);
  if (!numbers)
    throw InputError("noise", "estimated", "must have numbers for the misfit alone: a fit finds them");
  rows.noise = std::make_shared<fit::NoiseCovariance>(places, numbers->shape);
  return rows;
}

/// The misfit of a fit's last stage as a function of its unknowns p: F(p) = sum rho(r_i(p)^2) / 2, for searches and
/// samplers of others. All observations are in it: none is left out for being near a shock.
class CallableMisfit {
 public:
  explicit CallableMisfit(const FitProblem& problem)
      : spec_(problem.spec),
        parameters_(spec_->scene, spec_->unknown),
        coordinates_(parameters_),
        control_(std::numeric_limits<std::size_t>::max()),
        loss_(fit::find_loss(fit::loss_of(*spec_), spec_->misfit.loss_scale.value_or(0))),
        rows_(whitened_rows(*spec_, parameters_)),
        forward_(parameters_, spec_->forward, rows_.field, rows_.points),
        objective_(parameters_, coordinates_, spec_->forward, rows_, loss_, control_) {}
  CallableMisfit(const CallableMisfit&) = delete;
  CallableMisfit& operator=(const CallableMisfit&) = delete;

  [[nodiscard]] nb::object residuals(const Numbers& p) {
    const VectorXd r = run(p, false).first;
    return array_of({r.data(), r.data() + r.size()});
  }
  [[nodiscard]] nb::object jacobian(const Numbers& p) {
    const MatrixXd jacobian = run(p, true).second;
    std::vector<double> values;
    for (Eigen::Index i = 0; i < jacobian.rows(); ++i)
      for (Eigen::Index j = 0; j < jacobian.cols(); ++j) values.push_back(jacobian(i, j));
    return matrix_of(std::move(values), static_cast<std::size_t>(jacobian.rows()), parameters_.size());
  }
  [[nodiscard]] double misfit(const Numbers& p) {
    const VectorXd r = run(p, false).first;
    double sum = 0;
    for (const double x : r) sum += loss_(x * x).rho;
    return sum / 2;
  }
  /// sum r^2 and its gradient 2 J^T r, in one run of the model: what a Gaussian likelihood is made of, whatever the loss.
  [[nodiscard]] std::pair<double, nb::object> squares(const Numbers& p) {
    const auto [r, jacobian] = run(p, true);
    const VectorXd gradient = 2 * (jacobian.transpose() * r);
    return {r.squaredNorm(), array_of({gradient.data(), gradient.data() + gradient.size()})};
  }
  /// The order among the values of a(z): "none", "decreasing" or "convex".
  [[nodiscard]] std::string shape() const {
    switch (parameters_.shape()) {
      case fit::Shape::decreasing:
        return "decreasing";
      case fit::Shape::convex:
        return "convex";
      case fit::Shape::none:
        break;
    }
    return "none";
  }
  [[nodiscard]] std::size_t n_rows() const { return rows_.rows.size(); }
  [[nodiscard]] bool has_exact_derivatives() const { return forward_.has_derivatives(); }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const fit::Parameter& p : parameters_) all.push_back(p.name());
    return all;
  }
  [[nodiscard]] nb::object numbers(double fit::Parameter::*member) const {
    std::vector<double> all;
    for (const fit::Parameter& p : parameters_) all.push_back(p.*member);
    return array_of(std::move(all));
  }

 private:
  /// Residuals and, if asked for, dr/dp. Errors: Unusable where the model has no solution.
  [[nodiscard]] std::pair<VectorXd, MatrixXd> run(const Numbers& numbers, bool with_jacobian) {
    if (numbers.size() != parameters_.size())
      throw InputError("p", "(" + std::to_string(numbers.size()) + " entries)",
                       "must have one number per unknown (" + std::to_string(parameters_.size()) + ")");
    VectorXd p(static_cast<Eigen::Index>(numbers.size()));
    for (Eigen::Index i = 0; i < p.size(); ++i) p[i] = numbers.data()[i];
    const nb::gil_scoped_release release;
    const std::scoped_lock one_at_a_time(mutex_);
    const bool is_exact = forward_.has_derivatives();
    const fit::Prediction at = forward_.predict(p, with_jacobian && is_exact);
    if (!at.is_valid()) throw Unusable(Status::unsupported, at.failure);
    std::pair<VectorXd, MatrixXd> all{rows_.residuals(at.values), {}};
    if (!with_jacobian) return all;
    if (is_exact) {
      all.second = rows_.jacobian(at.derivatives);
      return all;
    }
    // Differences are taken in the coordinates of a search: dr/dp = dr/du (dp/du)^-1.
    const VectorXd u = coordinates_.unbounded(p);
    const auto differences = objective_.inspect(u, true);
    if (!differences.is_valid) throw Unusable(Status::unsupported, differences.failure);
    all.second = coordinates_.derivative(u)
                     .transpose()
                     .fullPivLu()
                     .solve(differences.jacobian.transpose())
                     .transpose();
    return all;
  }

  std::shared_ptr<const fit::FitSpec> spec_;
  fit::Parameters parameters_;
  fit::Coordinates coordinates_;
  fit::RunControl control_;
  fit::Loss loss_;
  fit::ResidualRows rows_;
  fit::Forward forward_;
  fit::Objective objective_;
  std::mutex mutex_;  ///< of the forward model, which remembers its last run
};

}  // namespace

void bind_misfit(nb::module_& m) {
  nb::class_<CallableMisfit>(m, "Misfit")
      .def(nb::init<const FitProblem&>())
      .def("residuals", &CallableMisfit::residuals)
      .def("jacobian", &CallableMisfit::jacobian)
      .def("misfit", &CallableMisfit::misfit)
      .def("squares", &CallableMisfit::squares)
      .def_prop_ro("shape", &CallableMisfit::shape)
      .def_prop_ro("n_rows", &CallableMisfit::n_rows)
      .def_prop_ro("has_exact_derivatives", &CallableMisfit::has_exact_derivatives)
      .def_prop_ro("names", &CallableMisfit::names)
      .def_prop_ro("start", [](const CallableMisfit& self) { return self.numbers(&fit::Parameter::start); })
      .def_prop_ro("lower", [](const CallableMisfit& self) { return self.numbers(&fit::Parameter::lower); })
      .def_prop_ro("upper", [](const CallableMisfit& self) { return self.numbers(&fit::Parameter::upper); });
}

}  // namespace shearfront::python
