// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/nanobind.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "outcome.hpp"
#include "scene.hpp"
#include "shearfront/io/method_text.hpp"
#include "shearfront/track/track.hpp"

namespace shearfront::python {
namespace {

using OptionTexts = std::vector<std::pair<std::string, std::string>>;

/// A bed under way, with the scene it refers to.
struct TrackedBed {
  std::shared_ptr<const Scene<double>> scene;
  Tracking tracking;
};

/// As numpy views it: boundary -1 inside a layer.
struct FlatCollision {
  double t, z;
  std::int64_t boundary, incoming, outgoing;
};
static_assert(sizeof(FrontSegment<double>) == 56 && sizeof(FlatCollision) == 40);

/// The options of the solver of this name, which are those of the tracker.
TrackOptions options_of(const OptionTexts& texts, bool history) {
  TrackOptions options;
  Method method("front-tracking");
  for (const auto& [name, text] : texts) {
    std::string key = name;
    for (char& c : key) c = c == '-' ? '_' : c;
    if (!method.has_option(name)) throw InputError(key, text, "is no option of front-tracking");
    set_option(method, name, text, key);
  }
  const std::vector<Option> values = method.options();
  TrackOptions::fields(options, [&]<class Member>(const OptionInfo& info, Member& member) {
    for (const Option& option : values) {
      if (option.info.name != info.name) continue;
      if constexpr (std::is_enum_v<Member>)
        member = static_cast<Member>(std::get<OptionChoice>(option.value).index);
      else
        member = std::get<Member>(option.value);
    }
  });
  options.history = history;
  return options;
}

TrackedBed track_scene(const SharedScene& shared, const OptionTexts& texts, bool history) {
  const TrackOptions options = options_of(texts, history);
  // Asked by the tracker where no Python code runs: signals are looked at there.
  return {shared.scene, Tracking(*shared.scene, options, SignalWatch())};
}

std::string advance(TrackedBed& self, double t) {
  if (!(t >= self.tracking.time()))
    throw InputError("t", number_text(t),
                     "must not be before the time reached (" + number_text(self.tracking.time()) + ")");
  Status status = Status::ok;
  {
    const nb::gil_scoped_release release;
    status = self.tracking.advance(t);
  }
  if (status == Status::interrupted && PyErr_Occurred() != nullptr) throw nb::python_error();
  expect_usable(self.tracking.summary());
  return std::string(name_of(status));
}

nb::tuple profile(const TrackedBed& self) {
  const Profile<double> all = self.tracking.profile();
  return nb::make_tuple(array_of(all.z()), array_of(all.below()), array_of(all.above()));
}

nb::tuple at(const TrackedBed& self, const Numbers& z) {
  const std::vector<double> heights = vector_of(z);
  for (const double height : heights) check_height(*self.scene, height);
  const auto field = self.tracking.field(*self.scene);
  const nb::tuple views = views_of(field->at(heights), 1, z.size());
  return nb::make_tuple(views[0], views[1]);
}

nb::object collisions(const TrackedBed& self) {
  std::vector<FlatCollision> flat;
  for (const Collision& c : self.tracking.collisions())
    flat.push_back({c.t, c.z, c.boundary ? static_cast<std::int64_t>(*c.boundary) : -1,
                    static_cast<std::int64_t>(c.incoming), static_cast<std::int64_t>(c.outgoing)});
  return bytes_of(std::move(flat));
}

}  // namespace

void bind_tracking(nb::module_& m) {
  nb::class_<TrackedBed>(m, "Tracking")
      .def("advance", &advance)
      .def("copy", [](const TrackedBed& self) { return TrackedBed(self); })
      .def_prop_ro("time", [](const TrackedBed& self) { return self.tracking.time(); })
      .def_prop_ro("summary", [](const TrackedBed& self) { return dict_of(self.tracking.summary()); })
      .def("profile", &profile)
      .def("at", &at)
      .def("fronts", [](const TrackedBed& self) { return bytes_of(self.tracking.fronts()); })
      .def("collisions", &collisions);
  m.def("track", &track_scene);
}

}  // namespace shearfront::python
