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
#include "shearfront/fit/misfit_function.hpp"

namespace shearfront::python {
namespace {

using fit::MisfitFunction;

/// In one run without the interpreter's lock. Errors: Unusable where the model has no solution.
MisfitFunction::Value run_residuals(const MisfitFunction& self, const Numbers& p, bool with_jacobian) {
  MisfitFunction::Value at = [&] {
    const nb::gil_scoped_release release;
    return self.at(eigen_of(p), with_jacobian);
  }();
  if (!at.is_valid()) throw Unusable(Status::unsupported, at.failure);
  return at;
}

nb::object numbers_of(const MisfitFunction& self, double fit::Parameter::*member) {
  std::vector<double> all;
  for (const fit::Parameter& p : self.parameters()) all.push_back(p.*member);
  return array_of(std::move(all));
}

}  // namespace

void bind_misfit(nb::module_& m) {
  nb::class_<MisfitFunction>(m, "Misfit")
      .def("__init__",
           [](MisfitFunction* self, const FitProblem& problem) { new (self) MisfitFunction(*problem.spec); })
      .def("residuals", [](const MisfitFunction& self,
                           const Numbers& p) { return array_of(run_residuals(self, p, false).residuals); })
      .def("jacobian", [](const MisfitFunction& self,
                          const Numbers& p) { return matrix_of(run_residuals(self, p, true).jacobian); })
      .def("misfit", [](const MisfitFunction& self,
                        const Numbers& p) { return self.misfit(run_residuals(self, p, false).residuals); })
      .def_prop_ro("names",
                   [](const MisfitFunction& self) {
                     std::vector<std::string> all;
                     for (const fit::Parameter& p : self.parameters()) all.push_back(p.name());
                     return all;
                   })
      .def_prop_ro("start",
                   [](const MisfitFunction& self) { return numbers_of(self, &fit::Parameter::start); })
      .def_prop_ro("lower",
                   [](const MisfitFunction& self) { return numbers_of(self, &fit::Parameter::lower); })
      .def_prop_ro("upper",
                   [](const MisfitFunction& self) { return numbers_of(self, &fit::Parameter::upper); });
}

}  // namespace shearfront::python
