// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "fit.hpp"
#include "outcome.hpp"
#include "shearfront/fit/residual_function.hpp"

namespace shearfront::python {
namespace {

using fit::ResidualFunction;

/// In one run without the interpreter's lock. Errors: Unusable where the model has no solution.
ResidualFunction::Value run_residuals(const ResidualFunction& self, const Numbers& p, bool with_jacobian) {
  ResidualFunction::Value at = [&] {
    const nb::gil_scoped_release release;
    return self.at(eigen_of(p), with_jacobian);
  }();
  if (!at.is_valid()) throw Unusable(Status::unsupported, at.failure);
  return at;
}

nb::object numbers_of(const ResidualFunction& self, double fit::Parameter::*member) {
  std::vector<double> all;
  for (const fit::Parameter& p : self.parameters()) all.push_back(p.*member);
  return array_of(std::move(all));
}

}  // namespace

void bind_misfit(nb::module_& m) {
  nb::class_<ResidualFunction>(m, "Misfit")
      .def("__init__", [](ResidualFunction* self,
                          const FitProblem& problem) { new (self) ResidualFunction(*problem.spec); })
      .def("residuals", [](const ResidualFunction& self,
                           const Numbers& p) { return array_of(run_residuals(self, p, false).residuals); })
      .def("jacobian", [](const ResidualFunction& self,
                          const Numbers& p) { return matrix_of(run_residuals(self, p, true).jacobian); })
      .def("misfit", [](const ResidualFunction& self,
                        const Numbers& p) { return self.misfit(run_residuals(self, p, false).residuals); })
      .def_prop_ro("names",
                   [](const ResidualFunction& self) {
                     std::vector<std::string> all;
                     for (const fit::Parameter& p : self.parameters()) all.push_back(p.name());
                     return all;
                   })
      .def_prop_ro("start",
                   [](const ResidualFunction& self) { return numbers_of(self, &fit::Parameter::start); })
      .def_prop_ro("lower",
                   [](const ResidualFunction& self) { return numbers_of(self, &fit::Parameter::lower); })
      .def_prop_ro("upper",
                   [](const ResidualFunction& self) { return numbers_of(self, &fit::Parameter::upper); });
}

}  // namespace shearfront::python
