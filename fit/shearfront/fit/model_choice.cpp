// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fit/model_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <type_traits>
#include <utility>

#include "shearfront/fit.hpp"
#include "shearfront/fit/layer_path.hpp"
#include "shearfront/fit/parameters.hpp"
#include "shearfront/model/depth/all.hpp"

namespace shearfront::fit {
namespace {

constexpr int kMostRounds = 50;      // of a search along the axes with one step
constexpr std::size_t kPlaces = 20;  // of the heights where two shear rates are compared

template <class Member>
constexpr bool is_array = !std::is_same_v<std::decay_t<Member>, double>;

bool has_arrays(const DepthFunction<double>& function) {
  bool has = false;
  std::visit(
      [&](const auto& model) {
        model.fields(model,
                     [&](const FieldInfo&, const auto& member) { has = has || is_array<decltype(member)>; });
      },
      function);
  return has;
}

/// The depth function of this name with the entries a new one has; nothing for another name.
std::optional<DepthFunction<double>> new_function(std::string_view name) {
  std::optional<DepthFunction<double>> function;
  DepthFunctionList<double>::for_each([&]<class Model>() {
    if (Model::kName == name) function = Model{};
  });
  return function;
}

/// Harmonic mean of a over [lo, hi], by the middles of equal parts: it is a start.
double harmonic_mean_of(const Scene<double>& scene, double lo, double hi) {
  double sum = 0;
  for (std::size_t i = 0; i < kPlaces; ++i)
    sum += 1 / scene.shear_rate_at(lo + (hi - lo) * (static_cast<double>(i) + 0.5) / kPlaces);
  return kPlaces / sum;
}

/// Arrays of n pieces between n - 1 breaks, or of n points from the bottom to the top. `breaks`: known ones.
template <class Model>
void fill_arrays(Model& model, std::size_t n, const std::vector<double>& breaks, const Scene<double>& scene,
                 bool is_constant) {
  const double bottom = scene.bottom(), height = scene.top() - scene.bottom();
  const auto part = [&](double i, double of) {
    if (breaks.empty() || i == 0 || i == of) return bottom + height * (i / of);
    return breaks[static_cast<std::size_t>(i) - 1];
  };
  const double all = harmonic_mean_of(scene, bottom, scene.top());
  Model::fields(model, [&](const FieldInfo& info, auto& member) {
    if constexpr (is_array<decltype(member)>) {
      member.clear();
      const bool are_heights = info.measure == Measure::height;
      const std::size_t size = are_heights && Model::kIsLayered ? n - 1 : n;
      const auto pieces = static_cast<double>(Model::kIsLayered ? n : n - 1);
      for (std::size_t i = 0; i < size; ++i) {
        const auto k = static_cast<double>(i);
        if (are_heights)
          member.push_back(Model::kIsLayered ? part(k + 1, pieces)
                           : i + 1 == n      ? scene.top()
                                             : part(k, pieces));
        else if (is_constant)
          member.push_back(all);
        else if (Model::kIsLayered)
          member.push_back(harmonic_mean_of(scene, part(k, pieces), part(k + 1, pieces)));
        else
          member.push_back(harmonic_mean_of(scene, part(std::max(k - 0.5, 0.0), pieces),
                                            part(std::min(k + 0.5, pieces), pieces)));
      }
    }
  });
}

/// The entries that must be positive and given come closest to log a of the scene, from any of their possible sizes: that
/// of a, that of the bed.
template <class Model>
void fit_numbers(Model& model, const Scene<double>& scene) {
  std::vector<double*> numbers;
  Model::fields(model, [&](const FieldInfo& info, auto& member) {
    if constexpr (!is_array<decltype(member)>)
      if (info.range == Range::positive && !info.is_optional) numbers.push_back(&member);
  });
  const double bottom = scene.bottom(), height = scene.top() - scene.bottom();
  const auto distance = [&](const std::vector<double>& logs) {
    for (std::size_t k = 0; k < numbers.size(); ++k) *numbers[k] = std::exp(logs[k]);
    double sum = 0;
    for (std::size_t i = 0; i < kPlaces; ++i) {
      const double z = bottom + height * (static_cast<double>(i) + 0.5) / kPlaces;
      const double d = std::log(model.value(z) / scene.shear_rate_at(z));
      sum += d * d;
    }
    return std::isfinite(sum) ? sum : 1e300;
  };
  const double sizes[] = {std::log(harmonic_mean_of(scene, bottom, scene.top())), std::log(height)};
  std::vector<double> best;
  double least = HUGE_VAL;
  for (std::size_t start = 0; start < (std::size_t{1} << numbers.size()); ++start) {
    std::vector<double> logs;
    for (std::size_t k = 0; k < numbers.size(); ++k) logs.push_back(sizes[(start >> k) & 1]);
    double found = distance(logs);
    for (double step = 1; step > 1e-4; step /= 2)
      for (int round = 0; round < kMostRounds; ++round) {
        const double before = found;
        for (double& x : logs)
          for (const double by : {step, -step}) {
            const double old = std::exchange(x, x + by);
            const double now = distance(logs);
            now < found ? void(found = now) : void(x = old);
          }
        if (found == before) break;
      }
    if (found < least) least = found, best = logs;
  }
  (void)distance(best);
  // A constant a has any large decay: one that a search can still change.
  for (double* number : numbers) *number = std::clamp(*number, 1e-12, std::max(1e3 * height, 1e6));
}

/// Names of the unknowns of a function.
std::vector<std::string> unknowns_of(const DepthFunction<double>& function, bool has_free_breaks) {
  std::vector<std::string> names;
  std::visit(
      [&](const auto& model) {
        model.fields(model, [&](const FieldInfo& info, const auto& member) {
          const bool is_height = info.measure == Measure::height;
          const bool is_free_break = has_free_breaks && std::decay_t<decltype(model)>::kIsLayered;
          if constexpr (is_array<decltype(member)>) {
            if (!member.empty() && (!is_height || is_free_break))
              names.push_back("shear_rate." + std::string(info.key));
          } else if (!info.is_optional) {
            names.push_back("shear_rate." + std::string(info.key));
          }
        });
      },
      function);
  return names;
}

bool has_unknown_breaks(const ModelChoice& choice, const ModelChoice::Model& model) {
  if (!choice.has_free_breaks || !model.breaks.empty()) return false;
  const auto function = new_function(model.name);
  return function &&
         std::visit([](const auto& m) { return std::decay_t<decltype(m)>::kIsLayered; }, *function);
}

void append(UnknownSpec& to, const Parameters& parameters) {
  for (const Parameter& p : parameters) {
    to.parameters.push_back(p.name());
    to.start.push_back(p.start);
    to.lower.push_back(p.lower);
    to.upper.push_back(p.upper);
  }
}

}  // namespace

std::string ModelChoice::text(const Model& model) {
  const auto function = new_function(model.name);
  const bool is_layered =
      function && std::visit([](const auto& m) { return std::decay_t<decltype(m)>::kIsLayered; }, *function);
  if (is_layered)
    return fmt::format("{}{} layer{}", model.n, model.breaks.empty() ? "" : " known",
                       model.n == 1 ? "" : "s");
  return model.n == 0 ? model.name : fmt::format("{}:{}", model.name, model.n);
}

std::string layered_name() {
  std::string name;
  DepthFunctionList<double>::for_each([&]<class Model>() {
    if (name.empty() && Model::kIsLayered) name = Model::kName;
  });
  return name;
}

std::string refusal(const ModelChoice::Model& model) {
  const auto function = new_function(model.name);
  if (!function) return "must be one of: " + DepthFunctionList<double>::names();
  if (!std::visit([](const auto& m) { return is_guessable(m); }, *function))
    return "must be one whose numbers data can tell, not those of a flow and its grains";
  const bool needs_number = has_arrays(*function);
  if (needs_number && model.n < 2)
    return "must say of how many numbers, at least 2, such as " + model.name + ":6";
  return !needs_number && model.n > 0 ? "must be without a number" : "";
}

FitSpec with_model(const FitSpec& base, const ModelChoice& choice, const ModelChoice::Model& model,
                   const Scene<double>& resembled, const std::vector<double>& first_breaks) {
  FitSpec spec = base;
  DepthFunction<double> function = new_function(model.name).value();
  const bool arrays = has_arrays(function);
  if (!arrays) spec.unknown.shape = Shape::none;
  std::visit(
      [&](auto& m) {
        if (arrays)
          fill_arrays(m, model.n, model.breaks.empty() ? first_breaks : model.breaks, resembled,
                      base.unknown.shape != Shape::none);
        else
          fit_numbers(m, resembled);
      },
      function);
  SceneSpec<double> scene = resembled.spec();
  scene.shear_rate = function;
  auto made = Scene<double>::make(std::move(scene));
  if (auto* complaints = std::get_if<Complaints>(&made)) throw InputError(std::move(*complaints));
  spec.scene = std::get<Scene<double>>(std::move(made));
  UnknownSpec unknown;
  unknown.shape = spec.unknown.shape;
  UnknownSpec own;
  own.parameters = unknowns_of(function, choice.has_free_breaks && model.breaks.empty());
  append(unknown, Parameters(spec.scene, own));
  UnknownSpec others = base.unknown;
  others.shape = Shape::none;
  if (!others.parameters.empty()) append(unknown, Parameters(base.scene, others));
  spec.unknown = std::move(unknown);
  spec.name = ModelChoice::text(model);
  return spec;
}

std::size_t n_searched(const ModelChoice& choice, const ModelChoice::Model& model) {
  return has_unknown_breaks(choice, model) ? model.n - 1 : 0;
}

ChosenModels fit_models(const FitSpec& base, const ModelChoice& choice, const Progress& progress) {
  ChosenModels result;
  std::optional<std::size_t> best;
  std::size_t most_layers = 0;
  for (const ModelChoice::Model& model : choice.models)
    if (has_unknown_breaks(choice, model)) most_layers = std::max(most_layers, model.n);
  std::map<std::size_t, FitSpec> built;
  if (most_layers > 1 && base.unknown.shape == Shape::none && has_layer_path(base, choice))
    built = layer_path(base, choice, most_layers, progress);
  for (const ModelChoice::Model& model : choice.models) {
    const auto start = has_unknown_breaks(choice, model) ? built.find(model.n) : built.end();
    const bool is_built = start != built.end();
    FitSpec spec = is_built ? start->second : with_model(base, choice, model, base.scene);
    Estimate estimate = fit(spec, progress);
    bool is_interrupted = estimate.status == Status::interrupted;
    if (best && !is_built && !is_interrupted) {
      FitSpec again = with_model(base, choice, model, *result.estimates[*best].scene);
      Estimate other = fit(again, progress);
      is_interrupted = other.status == Status::interrupted;
      if (other.usable() && (!estimate.usable() || other.misfit < estimate.misfit)) {
        spec = std::move(again);
        estimate = std::move(other);
      }
    }
    if (estimate.usable() && (!best || estimate.misfit < result.estimates[*best].misfit))
      best = result.specs.size();
    result.specs.push_back(std::move(spec));
    result.estimates.push_back(std::move(estimate));
    if (is_interrupted) break;
  }
  return result;
}

}  // namespace shearfront::fit
