// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/function.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <functional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "fit.hpp"
#include "outcome.hpp"
#include "shearfront/fit/posterior.hpp"

namespace shearfront::python {
namespace {

using fit::LogDensity;
using fit::Posterior;
using fit::Prior;

/// Of a prior that is written in Python: log density and its derivative.
using OwnDensity = std::function<std::pair<double, double>(double)>;
/// Name of the unknown or field, kind, its numbers, a density of its own or none.
using GivenPrior = std::tuple<std::string, std::string, double, double, OwnDensity>;

Prior prior_of(std::string name, const std::string& kind, double first, double second) {
  const auto known = std::find(fit::kPriorNames.begin(), fit::kPriorNames.end(), kind);
  if (known == fit::kPriorNames.end()) throw InputError("prior", kind, "must be a kind of prior");
  return {std::move(name), static_cast<fit::PriorKind>(known - fit::kPriorNames.begin()), first, second};
}

/// The fit with these priors in place of its own. Densities written in Python take the interpreter's lock when they are asked.
fit::FitSpec with_priors(const FitProblem& problem, const std::vector<GivenPrior>& given) {
  fit::FitSpec spec = *problem.spec;
  spec.priors.clear();
  for (const auto& [name, kind, first, second, own] : given) {
    spec.priors.push_back(prior_of(name, kind, first, second));
    if (own)
      spec.priors.back().own = [own = own](double p) {
        const auto [log, slope] = own(p);
        return fit::PriorDensity{log, slope};
      };
  }
  return spec;
}

template <class Compute>
auto released(Compute&& compute) {
  const nb::gil_scoped_release release;
  return compute();
}

template <class T>
const T& expect_room(const std::optional<T>& found) {
  if (!found) throw Unusable(Status::unsupported, "no solution at these coordinates");
  return *found;
}

}  // namespace

void bind_posterior(nb::module_& m) {
  nb::class_<Prior>(m, "Prior")
      .def("__init__", [](Prior* self, const std::string& kind, double first,
                          double second) { new (self) Prior(prior_of("", kind, first, second)); })
      .def_prop_ro("low", &Prior::low)
      .def_prop_ro("high", &Prior::high)
      .def("log_density", [](const Prior& self, double p) {
        const fit::PriorDensity at = self.log_density(p);
        return std::pair(at.log, at.slope);
      });
  nb::class_<Posterior>(m, "Posterior")
      .def("__init__",
           [](Posterior* self, const FitProblem& problem, const std::vector<GivenPrior>& priors) {
             new (self) Posterior(with_priors(problem, priors));
           })
      .def_prop_ro("names", &Posterior::names)
      .def_prop_ro("n_residuals", &Posterior::n_residuals)
      .def_prop_ro("sigma_is_given", &Posterior::sigma_is_given)
      .def_prop_ro("has_steps", &Posterior::has_steps)
      .def("log_density",
           [](const Posterior& self, const Numbers& p) {
             return released([&] { return self.log_density(eigen_of(p)); });
           })
      .def("gradient",
           [](const Posterior& self, const Numbers& p) {
             const LogDensity at = released([&] { return self.at(eigen_of(p)); });
             if (!at.failure.empty()) throw Unusable(Status::unsupported, at.failure);
             return array_of(at.gradient);
           })
      .def("unbounded",
           [](const Posterior& self, const Numbers& x) {
             const LogDensity at = released([&] { return self.at_coordinates(eigen_of(x)); });
             return std::pair(at.value, array_of(at.gradient));
           })
      .def("log_density_of",
           [](const Posterior& self, const Numbers& x) {
             return released([&] { return self.at_coordinates(eigen_of(x), false).value; });
           })
      .def("values", [](const Posterior& self,
                        const Numbers& x) { return array_of(expect_room(self.values(eigen_of(x)))); })
      .def("coordinates",
           [](const Posterior& self, const Numbers& p) { return array_of(self.coordinates(eigen_of(p))); })
      .def("curvature", [](const Posterior& self, const Numbers& x) {
        const auto found = released([&] { return self.curvature(eigen_of(x)); });
        return matrix_of(expect_room(found));
      });
}

}  // namespace shearfront::python
