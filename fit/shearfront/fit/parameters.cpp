// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/parameters.hpp"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <variant>

#include "shearfront/io/text.hpp"
#include "shearfront/numeric/scalar.hpp"
#include "shearfront/scene/state_range.hpp"

namespace shearfront::fit {
namespace {

std::string element(const char* key, std::size_t i) {
  return std::string(key) + "[" + std::to_string(i) + "]";
}

std::string joined(const std::vector<std::string>& names) {
  std::string all;
  for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
  return all;
}

std::vector<std::string> field_names(const std::vector<Entry>& all) {
  std::vector<std::string> names;
  for (const Entry& entry : all)
    if (names.empty() || names.back() != entry.field) names.push_back(entry.field);
  return names;
}

/// "2.5" or "(3 entries)" for the length of an array.
std::string count_text(std::size_t n) { return "(" + std::to_string(n) + " entries)"; }

/// A state, of the start or of what lies beyond an end, not the size of a wave.
bool is_state(const Entry& entry) {
  return entry.measure == Measure::state && entry.field != "initial.amplitude" &&
         (entry.field.starts_with("initial.") || entry.field.starts_with("boundary."));
}

}  // namespace

Parameters::Parameters(const Scene<double>& scene, const UnknownSpec& unknown)
    : scene_(scene), start_scene_(scene), shape_(unknown.shape) {
  Complaints complaints;
  resolve(unknown, complaints);
  if (complaints.empty()) set_defaults();
  if (complaints.empty()) set_numbers(unknown, complaints);
  if (complaints.empty()) check_shape(complaints);
  if (complaints.empty()) make_start_scene(complaints);
  if (!complaints.empty()) throw InputError(std::move(complaints));
  set_units();
}

double Parameters::states() const {
  const StateRange<double> all = state_range(start_scene_.spec());
  return all.highest - all.lowest;
}

void Parameters::set_units() {
  const Scene<double>& scene = start_scene_;
  const StateRange<double> states = state_range(scene.spec());
  double least = infinity<double>(), most = -infinity<double>();  // of the fluxes
  for (const Flux<double>& flux : scene.spec().fluxes) {
    std::vector<double> places = flux.extrema();
    places.push_back(flux.range().lowest);
    places.push_back(flux.range().highest);
    for (const double phi : places) {
      least = std::min(least, flux.value(phi));
      most = std::max(most, flux.value(phi));
    }
  }
  for (Parameter& p : parameters_) {
    const bool is_positive = p.entry.range == Range::positive;
    const auto set = [&](double origin, double unit) { p.origin = origin, p.unit = unit > 0 ? unit : 1; };
    if (is_positive)
      set(0, p.start);
    else if (p.entry.measure == Measure::height)
      set(scene.bottom(), scene.top() - scene.bottom());
    else if (p.entry.measure == Measure::state)
      set(states.lowest, states.highest - states.lowest);
    else if (p.entry.measure == Measure::flux)
      set(0, most - least);
  }
}

void Parameters::make_start_scene(Complaints& complaints) {
  auto made = Scene<double>::make(scene_with(start()));
  if (auto* scene = std::get_if<Scene<double>>(&made))
    start_scene_ = std::move(*scene);
  else
    for (const Complaint& complaint : std::get<Complaints>(made))
      complaints.push_back({"unknown.start", "", "makes an invalid scene: " + complaint.text()});
}

void Parameters::resolve(const UnknownSpec& unknown, Complaints& complaints) {
  const std::vector<Entry> all = shearfront::entries(scene_.spec());
  std::set<std::size_t> taken;
  if (unknown.parameters.empty())
    complaints.push_back({"unknown.parameters", count_text(0),
                          "must name at least one entry of the scene: " + joined(field_names(all))});
  for (std::size_t i = 0; i < unknown.parameters.size(); ++i) {
    const std::string& name = unknown.parameters[i];
    bool found = false, twice = false;
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (all[k].field != name && all[k].name() != name) continue;
      found = true;
      twice = twice || !taken.insert(k).second;
      places_.push_back(k);
      parameters_.push_back({all[k]});
      // A scene may say D = 0; what is to be found is a D > 0, by its logarithm.
      if (all[k].field == "diffusion.D") parameters_.back().entry.range = Range::positive;
    }
    const std::string key = element("unknown.parameters", i);
    if (twice) complaints.push_back({key, quoted_text(name), "must not name an entry twice"});
    if (found) continue;
    std::string constraint = "must be one of: " + joined(field_names(all)) + ", or one entry such as " +
                             (all.empty() ? "" : all[0].name());
    if (const auto meant = nearest_name(name, field_names(all)))
      constraint += " (did you mean " + *meant + "?)";
    complaints.push_back({key, quoted_text(name), constraint});
  }
}

void Parameters::set_defaults() {
  SceneSpec<double> spec = scene_.spec();
  const std::vector<double*> places = entry_places(spec);
  for (std::size_t i = 0; i < size(); ++i) {
    Parameter& p = parameters_[i];
    p.start = *places[places_[i]];
    p.lower = -infinity<double>();
    p.upper = infinity<double>();
    if (is_state(p.entry)) {
      const StateRange<double> states = common_states(spec);
      p.lower = states.lowest, p.upper = states.highest;
    }
    if (p.entry.field == "initial.breaks" || p.entry.field == "shear_rate.breaks")
      p.lower = scene_.bottom(), p.upper = scene_.top();
  }
}

void Parameters::set_numbers(const UnknownSpec& unknown, Complaints& complaints) {
  const auto take = [&](const char* key, const std::vector<double>& numbers, double Parameter::*member) {
    if (numbers.empty()) return;
    if (numbers.size() != size()) {
      complaints.push_back({key, count_text(numbers.size()),
                            "must have one number per unknown (" + std::to_string(size()) + ")"});
      return;
    }
    for (std::size_t i = 0; i < size(); ++i) parameters_[i].*member = numbers[i];
  };
  take("unknown.start", unknown.start, &Parameter::start);
  for (Parameter& p : parameters_) {
    if (p.entry.range != Range::positive || !(p.start > 0)) continue;
    p.lower = p.start / kWidest;
    p.upper = p.start * kWidest;
  }
  take("unknown.lower", unknown.lower, &Parameter::lower);
  take("unknown.upper", unknown.upper, &Parameter::upper);
  if (!complaints.empty()) return;
  for (std::size_t i = 0; i < size(); ++i) {
    const Parameter& p = parameters_[i];
    if (p.entry.range == Range::positive && !(p.start > 0))
      complaints.push_back(
          {element("unknown.start", i), number_text(p.start), "must be > 0 (" + p.name() + ")"});
    else if (p.entry.range == Range::positive && !(p.lower > 0))
      complaints.push_back(
          {element("unknown.lower", i), number_text(p.lower), "must be > 0 (" + p.name() + ")"});
    else if (!(p.lower < p.upper))
      complaints.push_back({element("unknown.lower", i), number_text(p.lower),
                            "must be less than upper (" + number_text(p.upper) + ")"});
    else if (!(p.start >= p.lower && p.start <= p.upper))
      complaints.push_back(
          {element("unknown.start", i), number_text(p.start),
           "must be between lower (" + number_text(p.lower) + ") and upper (" + number_text(p.upper) + ")"});
  }
}

void Parameters::check_shape(Complaints& complaints) const {
  if (shape_ == Shape::none) return;
  const std::string name = shape_ == Shape::decreasing ? "\"decreasing\"" : "\"convex\"";
  std::size_t n_values = 0;
  for (const Entry& entry : shearfront::entries(scene_.spec()))
    n_values += entry.field == "shear_rate.values" ? 1 : 0;
  std::vector<double> values;
  for (const Parameter& p : parameters_)
    if (p.entry.field == "shear_rate.values") {
      if (p.entry.index != values.size()) {
        complaints.push_back({"unknown.shape", name, "needs shear_rate.values in the order of the scene"});
        return;
      }
      values.push_back(p.start);
    }
  if (n_values == 0 || values.size() != n_values) {
    complaints.push_back({"unknown.shape", name, "needs all of shear_rate.values among the unknowns"});
    return;
  }
  // Decimal start values with equal steps (3.3, 2.5, 1.7) are not exactly so in binary.
  const double slack = 1e-12 * values.front();
  for (std::size_t i = 1; i < values.size(); ++i) {
    const double step = values[i - 1] - values[i];
    const bool shrinks = shape_ != Shape::convex || i < 2 || step <= values[i - 2] - values[i - 1] + slack;
    if (!(step >= -slack) || !shrinks) {
      complaints.push_back(
          {"unknown.start", "", "must have the shape " + name + " (value " + std::to_string(i) + ")"});
      return;
    }
  }
}

Eigen::VectorXd Parameters::start() const {
  Eigen::VectorXd values(static_cast<Eigen::Index>(size()));
  for (std::size_t i = 0; i < size(); ++i) values[static_cast<Eigen::Index>(i)] = parameters_[i].start;
  return values;
}

std::string Parameters::refusal_of_name(const std::string& name) const {
  std::vector<std::string> names;
  for (const Parameter& p : parameters_) {
    if (p.is_named(name)) return "";
    names.push_back(p.name());
  }
  std::string constraint = "must be an unknown of the fit: " + joined(names);
  if (const auto meant = nearest_name(name, names)) constraint += " (did you mean " + *meant + "?)";
  return constraint;
}

std::vector<std::optional<std::size_t>> Parameters::last_named_by(
    const std::vector<std::string>& names) const {
  std::vector<std::optional<std::size_t>> places(size());
  Complaints complaints;
  for (std::size_t k = 0; k < names.size(); ++k) {
    if (std::string why = refusal_of_name(names[k]); !why.empty())
      complaints.push_back({"prior", names[k], std::move(why)});
    for (std::size_t i = 0; i < size(); ++i)
      if (parameters_[i].is_named(names[k])) places[i] = k;
  }
  if (!complaints.empty()) throw InputError(std::move(complaints));
  return places;
}

bool Parameters::within_bounds(const Eigen::VectorXd& values) const {
  for (std::size_t i = 0; i < size(); ++i) {
    const double x = values[static_cast<Eigen::Index>(i)];
    // A coordinate at its bound may come back one rounding error beyond it.
    const double slack = 1e-14 * std::max(std::abs(x), 1e-300);
    if (!(x >= parameters_[i].lower - slack && x <= parameters_[i].upper + slack)) return false;
  }
  return true;
}

SceneSpec<double> Parameters::scene_with(const Eigen::VectorXd& values) const {
  SceneSpec<double> spec = scene_.spec();
  const std::vector<double*> places = entry_places(spec);
  for (std::size_t i = 0; i < size(); ++i) *places[places_[i]] = values[static_cast<Eigen::Index>(i)];
  return spec;
}

std::optional<Scene<double>> Parameters::scene_at(const Eigen::VectorXd& values, std::string& failure) const {
  auto made = Scene<double>::make(scene_with(values));
  if (auto* scene = std::get_if<Scene<double>>(&made)) return std::move(*scene);
  failure = std::get<Complaints>(made).front().text();
  return std::nullopt;
}

}  // namespace shearfront::fit
