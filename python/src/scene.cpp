// SPDX-License-Identifier: BSD-3-Clause
#include "scene.hpp"

#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "outcome.hpp"
#include "shearfront/io/scene_text.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"

namespace shearfront::python {
namespace {

nb::list entries_of(const SharedScene& shared) {
  const SceneSpec<double>& spec = shared.scene->spec();
  nb::list all;
  visit_fields(spec, [&]<class Member>(const std::string& field, const FieldInfo&, const Member& member) {
    if constexpr (std::is_same_v<Member, double>) {
      all.append(nb::make_tuple(field, member));
    } else {
      for (std::size_t i = 0; i < member.size(); ++i)
        all.append(nb::make_tuple(field + "[" + std::to_string(i) + "]", member[i]));
    }
  });
  return all;
}

/// A function of height at many heights.
template <class Function>
nb::object at_heights(const Numbers& z, Function&& f) {
  std::vector<double> values(z.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = f(z.data()[i]);
  return array_of(std::move(values));
}

template <class Function>
auto function_of_height(Function f) {
  return [f](const SharedScene& self, const Numbers& z) {
    return at_heights(z, [&](double height) { return f(*self.scene, height); });
  };
}

std::vector<std::string> names_of_fluxes(const SharedScene& self) {
  std::vector<std::string> names;
  for (const auto& flux : self.scene->fluxes()) names.emplace_back(flux.name());
  return names;
}

}  // namespace

void check_height(const Scene<double>& scene, double z) {
  if (z >= scene.bottom() && z <= scene.top()) return;
  throw InputError(
      "z", number_text(z),
      "must be inside the domain [" + number_text(scene.bottom()) + ", " + number_text(scene.top()) + "]");
}

void check_place(const Scene<double>& scene, double t, double z) {
  check_height(scene, z);
  if (!(t >= 0)) throw InputError("t", number_text(t), "must be >= 0");
}

void bind_scene(nb::module_& m) {
  nb::class_<SharedScene>(m, "Scene")
      .def_prop_ro("name", [](const SharedScene& self) { return self.scene->name(); })
      .def_prop_ro("text", [](const SharedScene& self) { return scene_text(self.scene->spec()); })
      .def_prop_ro("remarks", [](const SharedScene& self) { return self.scene->spec().remarks; })
      .def_prop_ro("entries", &entries_of)
      .def_prop_ro("bottom", [](const SharedScene& self) { return self.scene->bottom(); })
      .def_prop_ro("top", [](const SharedScene& self) { return self.scene->top(); })
      .def_prop_ro("mass", [](const SharedScene& self) { return self.scene->mass(); })
      .def_prop_ro("has_walls", [](const SharedScene& self) { return self.scene->has_walls(); })
      .def_prop_ro("has_diffusion", [](const SharedScene& self) { return self.scene->has_diffusion(); })
      .def_prop_ro("has_height",
                   [](const SharedScene& self) { return BedHeight::refusal(*self.scene).empty(); })
      .def_prop_ro("units",
                   [](const SharedScene& self) {
                     return std::pair(self.scene->spec().units.z, self.scene->spec().units.t);
                   })
      .def_prop_ro("scale", [](const SharedScene& self) { return self.scene->scale(); })
      .def_prop_ro("knots", [](const SharedScene& self) { return array_of(self.scene->knots()); })
      .def_prop_ro("initial_knots",
                   [](const SharedScene& self) { return array_of(self.scene->initial_knots()); })
      .def_prop_ro("fluxes", &names_of_fluxes)
      .def("flux_value",
           [](const SharedScene& self, double z, const Numbers& phi) {
             const auto& flux = self.scene->flux_at(z);
             return at_heights(phi, [&](double x) { return flux.value(x); });
           })
      .def("range_at",
           [](const SharedScene& self, double z) {
             const auto range = self.scene->range_at(z);
             return std::pair(range.lowest, range.highest);
           })
      .def("shear_rate",
           function_of_height([](const Scene<double>& s, double z) { return s.shear_rate_at(z); }))
      .def("solid_fraction",
           function_of_height([](const Scene<double>& s, double z) { return s.solid_fraction_at(z); }))
      .def("initial_phi",
           function_of_height([](const Scene<double>& s, double z) { return s.initial_phi(z); }));
  m.def("parse_scene", [](std::string text, const std::string& file, const Changes& changes) {
    return SharedScene(parse_scene<double>(std::move(text), file, changes_of(changes)));
  });
  m.def("flux_table", [](const Numbers& phi, const Numbers& values, const Numbers& at) {
    const FluxTable<double> table{vector_of(phi), vector_of(values)};
    return at_heights(at, [&](double x) { return table.value(x); });
  });
  m.def("read_scene", [](const std::string& path, const Changes& changes) {
    return SharedScene(read_scene<double>(path, changes_of(changes)));
  });
}

}  // namespace shearfront::python
