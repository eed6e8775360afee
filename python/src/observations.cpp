// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "fit.hpp"
#include "outcome.hpp"
#include "scene.hpp"
#include "shearfront/io/observations_csv.hpp"
#include "shearfront/solution/observe.hpp"

namespace shearfront::python {
namespace {

/// Where a name stands among those that are known. Errors: InputError.
template <class Names>
std::size_t index_of(const std::string& key, const std::string& name, const Names& names) {
  const auto it = std::find(names.begin(), names.end(), name);
  if (it != names.end()) return static_cast<std::size_t>(it - names.begin());
  std::string all;
  for (const std::string_view known : names) (all += all.empty() ? "" : ", ") += known;
  throw InputError(key, "\"" + name + "\"", "must be one of: " + all);
}

Quantity quantity_named(const std::string& name) {
  for (const Quantity q : {Quantity::point, Quantity::bin, Quantity::cumulative, Quantity::bed_height})
    if (name_of(q) == name) return q;
  throw InputError("quantity", name, "must be one of: point, bin, cumulative, bed-height");
}

/// Checked as those of a file are: by the reader of files.
Observations observations_of(const SharedScene& scene, const std::string& quantity, const Numbers& t,
                             const Numbers& z, const Numbers& values, const std::optional<Numbers>& width,
                             const std::optional<Numbers>& sigma, const std::string& replicates) {
  Observations all;
  all.quantity = quantity_named(quantity);
  all.rows.resize(t.size());
  for (std::size_t i = 0; i < all.rows.size(); ++i) {
    Observation& row = all.rows[i];
    row.t = t.data()[i];
    row.z = z.data()[i];
    row.value = values.data()[i];
    if (width) row.width = width->data()[i];
    if (!sigma) continue;
    row.sigma = sigma->data()[i];
    if (!(row.sigma > 0))
      throw InputError("sigma[" + std::to_string(i) + "]", number_text(row.sigma), "must be > 0");
  }
  ObservationFormat format;
  format.replicates = static_cast<Replicates>(index_of("replicates", replicates, kReplicatesNames));
  return parse_observations(observations_text(all), "data", *scene.scene, format);
}

nb::tuple columns_of(const Observations& all) {
  std::vector<double> t, z, values, width, sigma;
  for (const Observation& row : all.rows) {
    t.push_back(row.t);
    z.push_back(row.z);
    values.push_back(row.value);
    width.push_back(row.width);
    sigma.push_back(row.sigma);
  }
  return nb::make_tuple(std::string(name_of(all.quantity)), array_of(std::move(t)), array_of(std::move(z)),
                        array_of(std::move(values)), array_of(std::move(width)), array_of(std::move(sigma)));
}

Observations made(const SharedScene& scene, const Method& method, const Numbers& times,
                  const Numbers& heights, const std::string& quantity, double width, double sigma,
                  std::uint64_t seed) {
  const ObservationPlan plan{vector_of(times), vector_of(heights), quantity_named(quantity), width};
  const SolverRequest request = request_of(plan, *scene.scene);
  const SolverResult result =
      without_lock([&](const Progress& progress) { return solve(*scene.scene, method, request, progress); });
  expect_usable(result.summary);
  Observations all = observe(plan, *scene.scene, result);
  add_noise(all, sigma, seed);
  return all;
}

using Pairs = std::vector<std::pair<std::string, std::string>>;

Observations read(const std::string& path, const SharedScene& scene, const Pairs& columns, const Pairs& units,
                  const std::string& separator, const std::string& decimal,
                  const std::vector<std::string>& missing, const std::string& layout,
                  const std::string& replicates, std::optional<double> width,
                  std::optional<double> time_step) {
  ObservationFormat format;
  for (const auto& [column, name] : columns)
    format.columns[index_of("columns", column, kColumnNames)].name = name;
  for (const auto& [column, unit] : units)
    format.columns[index_of("units", column, kColumnNames)].unit = unit;
  if (!separator.empty())
    format.separator =
        ",;\t"[index_of("separator", separator, std::array<std::string_view, 3>{",", ";", "tab"})];
  if (!decimal.empty())
    format.decimal = ".,"[index_of("decimal", decimal, std::array<std::string_view, 2>{".", ","})];
  format.missing = missing;
  if (!layout.empty())
    format.layout = static_cast<TableLayout>(index_of("layout", layout, kTableLayoutNames));
  format.replicates = static_cast<Replicates>(index_of("replicates", replicates, kReplicatesNames));
  for (const auto& [key, value] : {std::pair("width", width), std::pair("time_step", time_step)})
    if (value && !(*value > 0 && std::isfinite(*value)))
      throw InputError(key, number_text(*value), "must be > 0");
  format.width = width;
  format.time_step = time_step;
  return read_observations(path, *scene.scene, format);
}

}  // namespace

void bind_observations(nb::module_& m) {
  nb::class_<Observations> observations(m, "Observations");
  observations.def_prop_ro("columns", &columns_of)
      .def_prop_ro("text", &observations_text)
      .def_prop_ro("notes", [](const Observations& self) { return self.notes; })
      .def_prop_ro("n_missing", [](const Observations& self) { return self.n_missing; })
      .def_prop_ro("understood", [](const Observations& self) { return self.understood; });
  bind_state(m, observations);
  m.def("observations", &observations_of, nb::arg("scene"), nb::arg("quantity"), nb::arg("t"), nb::arg("z"),
        nb::arg("values"), nb::arg("width").none(), nb::arg("sigma").none(), nb::arg("replicates"));
  m.def("read_observations", &read, nb::arg("path"), nb::arg("scene"), nb::arg("columns"), nb::arg("units"),
        nb::arg("separator"), nb::arg("decimal"), nb::arg("missing"), nb::arg("layout"),
        nb::arg("replicates"), nb::arg("width").none(), nb::arg("time_step").none());
  m.def("observe", &made);
}

}  // namespace shearfront::python
