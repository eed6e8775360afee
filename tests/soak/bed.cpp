// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "shearfront/io/scene_file.hpp"
#include "soak/laws.hpp"

namespace shearfront::soak {
namespace {

// Layers of the exact solution of a table for each one of the staircase.
constexpr std::size_t kFiner = 4;

LayerStack<double> stack_of(const Scene<double>& scene, std::size_t layers) {
  return scene.is_layered() ? exact_layers(scene) : staircase(scene, layers);
}

SceneSpec<double> on_stack(const SceneSpec<double>& spec, const LayerStack<double>& stack) {
  SceneSpec<double> layered = spec;
  Piecewise<double> a;
  for (std::size_t k = 0; k < stack.n_layers(); ++k) {
    if (k > 0) a.breaks.push_back(stack.boundary(k));
    a.values.push_back(stack.shear_rate(k));
  }
  layered.shear_rate = std::move(a);
  return layered;
}

/// a(z) is monotone between knots, so its ends tell the range in a layer.
double rate_error_of(const Scene<double>& scene, const LayerStack<double>& stack) {
  if (scene.is_layered()) return 0;
  double error = 0;
  for (std::size_t k = 0; k < stack.n_layers(); ++k)
    for (const double z : {stack.boundary(k), stack.boundary(k + 1)})
      error = std::max(error, std::abs(stack.shear_rate(k) / scene.shear_rate_at(z) - 1));
  return error;
}

std::vector<double> heights_of(const Trial& trial) {
  const SceneSpec<double>& spec = trial.spec;
  support::SceneMaker make(trial.seed ^ 0x5eed);
  std::vector<double> z{spec.bottom, spec.top};
  for (int i = 0; i < 8; ++i) z.push_back(make.uniform(spec.bottom, spec.top));
  std::vector<double> marks = std::visit([](const auto& a) { return a.knots(); }, spec.shear_rate);
  marks.insert(marks.end(), spec.initial_breaks.begin(), spec.initial_breaks.end());
  for (int i = 0; i < 5 && !marks.empty(); ++i) {
    const double x = marks[static_cast<std::size_t>(make.integer(0, static_cast<int>(marks.size()) - 1))];
    z.push_back(x);
    z.push_back(std::nextafter(x, make.integer(0, 1) == 0 ? spec.bottom : spec.top));
  }
  for (double& x : z) x = std::clamp(x, spec.bottom, spec.top);
  std::sort(z.begin(), z.end());
  z.erase(std::unique(z.begin(), z.end()), z.end());
  return z;
}

}  // namespace

Bed::Bed(const Trial& t)
    : trial(t),
      scene(t.spec),
      stack(stack_of(scene, t.count("layers"))),
      layered(on_stack(t.spec, stack)),
      exact(scene, {kFiner * t.count("layers")}),
      layered_exact(layered),
      heights(heights_of(t)),
      times{0, t.early, t.late, infinity<double>()} {
  const double error = rate_error_of(scene, stack);
  slower = std::max(0.0, 1 - error);
  faster = 1 + error;
}

double Bed::M_rounding() const {
  return unit_roundoff<double>() *
         (trial.height() * (16 + 8 * static_cast<double>(stack.n_layers())) + 4 * trial.largest_height());
}

double Bed::t_rounding() const {
  double units = 16 + 8 * static_cast<double>(stack.n_layers());
  if (const auto* a = std::get_if<Exponential<double>>(&scene.shear_rate()))
    units += 8 * trial.largest_height() / a->decay;  // exp(x) is right to |x| units
  return unit_roundoff<double>() * units;
}

void check_text(const Trial& trial, Findings& findings) {
  const Scene<double> back = parse_scene<double>(text_of(trial.spec), "soak.toml");
  findings.expect(
      text_of(back.spec()) == text_of(trial.spec) &&
          std::visit([](const auto& a) { return std::string(a.kName); }, back.shear_rate()) ==
              std::visit([](const auto& a) { return std::string(a.kName); }, trial.spec.shear_rate),
      "io: a scene file reads back to the same bits", [] { return std::string("text"); });
}

Findings check_trial(const Trial& trial) {
  Findings findings;
  findings.n_scenes = 1;
  check_text(trial, findings);
  const Bed bed(trial);
  check_exact(bed, findings);
  check_exact_in_50_digits(bed, findings);
  check_tracker(bed, findings);
  check_tracker_pair(bed, findings);
  check_solvers(bed, findings);
  return findings;
}

}  // namespace shearfront::soak
