// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <any>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "outcome.hpp"
#include "scene.hpp"
#include "shearfront/exact/exact_solution.hpp"
#include "shearfront/exact/l1_error.hpp"
#include "shearfront/exact/refusal.hpp"
#include "shearfront/io/method_text.hpp"
#include "shearfront/solution/bed_height.hpp"
#include "shearfront/solution/mixing.hpp"
#include "shearfront/solver/solve.hpp"

namespace shearfront::python {
namespace {

using Options = std::vector<std::pair<std::string, std::string>>;

/// By name, with options as text; keys of complaints are the names as Python spells them.
Method method_of(const std::string& name, const Options& options) {
  Method method(name);
  for (const auto& [option, text] : options) {
    std::string key = option, known;
    for (char& c : key) c = c == '-' ? '_' : c;
    if (!method.has_option(option)) {
      for (const Option& other : method.options()) (known += known.empty() ? "" : ", ") += other.info.name;
      for (char& c : known) c = c == '-' ? '_' : c;
      throw InputError(
          key, text, "is no option of " + name + (known.empty() ? ", which has none" : "; it has: " + known));
    }
    set_option(method, option, text, key);
  }
  return method;
}

nb::object time_or_none(const std::optional<double>& t) {
  return t && std::isfinite(*t) ? nb::cast(*t) : nb::none();
}

nb::dict dict_of_timeline(const Timeline<double>& timeline) {
  nb::dict all;
  all["mass"] = timeline.mass;
  all["steady_height"] = timeline.steady_height;
  all["t0"] = time_or_none(timeline.t0);
  all["t1"] = time_or_none(timeline.t1);
  all["t_star"] = time_or_none(timeline.t_star);
  nb::list interfaces;
  for (const auto& at : timeline.interfaces)
    interfaces.append(nb::make_tuple(at.z, time_or_none(at.first), time_or_none(at.last)));
  all["interfaces"] = interfaces;
  return all;
}

SolverResult run(const SharedScene& shared, const Method& method, const SolverRequest& request) {
  SolverResult result =
      without_lock([&](const Progress& progress) { return solve(*shared.scene, method, request, progress); });
  expect_usable(result.summary);
  return result;
}

nb::dict solve_scene(const SharedScene& scene, const Method& method, const Numbers& times,
                     const Numbers& heights, bool with_fronts) {
  SolverRequest request;
  request.times = vector_of(times);
  request.heights = vector_of(heights);
  request.fronts = with_fronts;
  bool has_steady = false;
  for (const double t : request.times) has_steady = has_steady || std::isinf(t);
  request.timeline = has_steady && method.guarantees().has_timeline && scene.scene->has_walls();
  SolverResult result = run(scene, method, request);
  nb::dict all;
  const nb::tuple views = views_of(std::move(result.samples), times.size(), heights.size());
  all["phi"] = views[0];
  all["M"] = views[1];
  if (with_fronts) all["fronts"] = bytes_of(std::move(result.fronts));
  if (result.timeline && result.timeline->t_star) all["t_star"] = *result.timeline->t_star;
  all["summary"] = dict_of(result.summary);
  return all;
}

/// (t[i], z[i]), checked.
std::vector<Place> places_of(const Scene<double>& scene, const Numbers& t, const Numbers& z) {
  std::vector<Place> places(t.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    places[i] = {t.data()[i], z.data()[i]};
    check_place(scene, places[i].t, places[i].z);
  }
  return places;
}

/// phi and M at places.
nb::tuple sample_places(const SharedScene& shared, const Method& method, const Numbers& t, const Numbers& z) {
  const std::vector<Place> places = places_of(*shared.scene, t, z);
  PlaceSamples result =
      without_lock([&](const Progress& progress) { return sample(*shared.scene, method, places, progress); });
  expect_usable(result.summary);
  const nb::tuple views = views_of(std::move(result.samples), 1, places.size());
  return nb::make_tuple(views[0], views[1]);
}

/// One place by a method that takes microseconds: no arrays, and no lock let go, which would cost more than the answer.
std::pair<double, double> sample_place(const SharedScene& shared, const Method& method, double t, double z) {
  check_place(*shared.scene, t, z);
  const PlaceSamples result = sample(*shared.scene, method, {{t, z}});
  expect_usable(result.summary);
  return {result.samples[0].phi, result.samples[0].M};
}

nb::tuple linearise(const SharedScene& shared, const Method& method, const Numbers& t, const Numbers& z,
                    const std::vector<std::string>& wanted) {
  const Scene<double>& scene = *shared.scene;
  const std::vector<Entry> all = entries(scene.spec());
  std::vector<std::size_t> chosen;
  std::vector<std::string> names;
  if (const std::string reason = method.refusal(scene); !reason.empty())
    throw Unusable(Status::unsupported, reason);
  for (std::size_t i = 0; i < all.size(); ++i) {
    bool is_wanted = wanted.empty() && method.has_derivative(scene, all[i]);
    for (const std::string& name : wanted)
      is_wanted = is_wanted || name == all[i].name() || name == all[i].field;
    if (!is_wanted) continue;
    if (!method.has_derivative(scene, all[i]))
      throw InputError("entries", all[i].name(),
                       "has no derivative by the method " + std::string(method.name()));
    chosen.push_back(i);
    names.push_back(all[i].name());
  }
  for (const std::string& name : wanted) {
    bool is_known = false;
    for (const Entry& entry : all) is_known = is_known || name == entry.name() || name == entry.field;
    if (!is_known) throw InputError("entries", "\"" + name + "\"", "is no entry of the scene");
  }
  if (chosen.empty())
    throw InputError("method", std::string(method.name()),
                     "has no derivatives with respect to entries of this scene");
  const std::vector<Place> places = places_of(scene, t, z);
  Linearisation result = without_lock([&](const auto&) {
    std::any memory;
    return method.linearise(scene, places, chosen, memory);
  });
  expect_usable(result.summary);
  const nb::tuple values = views_of(std::move(result.samples), 1, places.size());
  const nb::tuple derivatives = views_of(std::move(result.derivatives), places.size(), chosen.size());
  return nb::make_tuple(names, values[0], values[1], derivatives[0], derivatives[1]);
}

nb::dict events(const SharedScene& shared, const Method& method) {
  SolverRequest request;
  request.timeline = true;
  const SolverResult result = run(shared, method, request);
  if (!result.timeline)
    throw InputError("method", std::string(method.name()), "gives no event times of this scene");
  nb::dict all = dict_of_timeline(*result.timeline);
  all["summary"] = dict_of(result.summary);
  return all;
}

/// Columns of mixing and bed height at these times.
nb::dict course(const SharedScene& shared, const Method& method, const Numbers& times) {
  const Scene<double>& scene = *shared.scene;
  SolverRequest request;
  request.times = vector_of(times);
  request.heights = {scene.top()};
  request.integrand = entropy_function();
  const SolverResult mixed = run(shared, method, request);
  const double solid = scene.solid(scene.bottom(), scene.top());
  std::vector<double> entropy, parameter, height;
  for (std::size_t i = 0; i < request.times.size(); ++i) {
    entropy.push_back(mixed.integrals[i]);
    parameter.push_back(mixing(mixed.integrals[i], mixed.M(i, 0), solid).parameter);
  }
  nb::dict all;
  all["entropy"] = array_of(std::move(entropy));
  all["mixing"] = array_of(std::move(parameter));
  if (BedHeight::refusal(scene).empty()) {
    const BedHeight bed(scene);
    request.integrand = bed.integrand();
    const SolverResult packed = run(shared, method, request);
    for (const double g : packed.integrals) height.push_back(bed.height(g));
    all["height"] = array_of(std::move(height));
  }
  return all;
}

/// int |phi - exact phi| dz of a method's profile at each time, with the time each took.
nb::list l1_errors(const SharedScene& shared, const Method& method, const Numbers& times) {
  const Scene<double>& scene = *shared.scene;
  if (const std::string reason = exact::refusal(scene); !reason.empty())
    throw InputError("scene", scene.name(), "has no exact solution to compare with: " + reason);
  if (!method.guarantees().has_profiles)
    throw InputError("method", std::string(method.name()), "has no profiles to be compared");
  nb::list rows;
  for (const double t : vector_of(times)) {
    SolverRequest request;
    request.times = {t};
    request.profiles = true;
    const auto begin = std::chrono::steady_clock::now();
    const SolverResult result = run(shared, method, request);
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    const double error = without_lock(
        [&](const auto&) { return errors_against(ExactSolution<double>(scene), result.profiles[0], t).l1; });
    rows.append(nb::make_tuple(t, error, wall, result.summary.collisions + result.summary.cell_updates));
  }
  return rows;
}

}  // namespace

void bind_solve(nb::module_& m) {
  nb::class_<Method>(m, "Method")
      .def("__init__", [](Method* self, const std::string& name,
                          const Options& options) { new (self) Method(method_of(name, options)); })
      .def_prop_ro("name", [](const Method& self) { return std::string(self.name()); })
      .def_prop_ro("settings", [](const Method& self) { return settings(self); })
      .def("refusal",
           [](const Method& self, const SharedScene& scene) { return self.refusal(*scene.scene); });
  m.def("solve", &solve_scene);
  m.def("sample", &sample_places);
  m.def("sample_place", &sample_place);
  m.def("linearise", &linearise);
  m.def("events", &events);
  m.def("course", &course);
  m.def("l1_errors", &l1_errors);
}

}  // namespace shearfront::python
