// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include "outcome.hpp"
#include "shearfront/model/complaint.hpp"

namespace shearfront::python {
namespace {

/// Raises shearfront.InputError and NoResult, which are written in Python.
void raise_in_python(const char* type, const std::string& message, const nb::object& detail) {
  const nb::object error = nb::module_::import_("shearfront._errors").attr(type)(message, detail);
  PyErr_SetObject(error.type().ptr(), error.ptr());
}

void translate(const std::exception_ptr& thrown, void*) {
  try {
    std::rethrow_exception(thrown);
  } catch (const InputError& error) {
    nb::list complaints;
    for (const Complaint& c : error.complaints())
      complaints.append(nb::make_tuple(c.key, c.value, c.constraint, c.text()));
    raise_in_python("InputError", error.what(), complaints);
  } catch (const Unusable& error) {
    raise_in_python("NoResult", error.what(), nb::cast(std::string(name_of(error.status()))));
  }
}

}  // namespace

nb::dict dict_of(const Summary& summary) {
  nb::dict all;
  all["status"] = std::string(name_of(summary.status));
  all["message"] = summary.message;
  all["remark"] = summary.remark;
  all["collisions"] = summary.collisions;
  all["fronts_max"] = summary.fronts_max;
  all["levels"] = summary.levels;
  all["cell_updates"] = summary.cell_updates;
  all["layers"] = summary.layers;
  all["wall_s"] = summary.wall_s;
  if (summary.rest_time) all["rest_time"] = *summary.rest_time;
  return all;
}

}  // namespace shearfront::python

NB_MODULE(_core, m) {
  using namespace shearfront::python;
  m.doc() = "The engines of shearfront; what users call is written in Python around this module.";
  nb::register_exception_translator(translate);
  bind_models(m);
  bind_scene(m);
  bind_solve(m);
  bind_tracking(m);
  bind_observations(m);
  bind_fit(m);
  bind_estimate(m);
  bind_misfit(m);
  bind_posterior(m);
}
