// SPDX-License-Identifier: BSD-3-Clause
#include "soak/trial.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "shearfront/numeric/number_text.hpp"
#include "shearfront/scene/entries.hpp"
#include "shearfront/scene/layer_stack.hpp"
#include "shearfront/solver/all.hpp"

namespace shearfront::soak {
namespace {

using support::SceneMaker;

constexpr double kMostAlignedUpdates = 2e7;  // of cells in a run, about 0.1 s

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : make_(seed) {}

  Trial trial(std::uint64_t seed) {
    Trial trial;
    trial.seed = seed;
    trial.is_generic = chance(0.4);
    is_generic_ = trial.is_generic;
    SceneSpec<double>& spec = trial.spec;
    spec.name = "soak " + std::to_string(seed);
    domain(spec);
    const double kind = make_.uniform(0, 1);
    if (kind < 0.75) {
      layers(spec);
    } else if (kind < 0.9) {
      exponential(spec);
    } else {
      table(spec);
    }
    scale(spec);
    initial(spec);
    times(trial);
    options(trial);
    return trial;
  }

 private:
  bool chance(double p) { return make_.uniform(0, 1) < p; }
  double power(double lo, double hi) { return std::pow(10.0, make_.uniform(lo, hi)); }

  void domain(SceneSpec<double>& spec) {
    if (chance(0.6)) return;
    const double height = power(-6, 6);
    spec.bottom = chance(0.5) ? make_.uniform(-2, 2) * height : make_.uniform(-1, 1) * height * power(0, 6);
    spec.top = spec.bottom + height;
  }

  int count(int few, int many) {
    const double x = make_.uniform(0, 1);
    if (x < 0.15) return 1;
    return x < 0.85 ? make_.integer(2, few) : make_.integer(few + 1, many);
  }

  /// Up to n heights inside the domain, some of them very near to the one before or to one of `others`.
  std::vector<double> heights(const SceneSpec<double>& spec, int n, const std::vector<double>& others) {
    const double height = spec.top - spec.bottom;
    std::vector<double> z;
    const bool equal_spacing = !is_generic_ && chance(0.15);
    for (int i = 1; i <= n; ++i) {
      double x = spec.bottom + height * (equal_spacing ? double(i) / (n + 1) : make_.uniform(0, 1));
      if (!is_generic_ && !z.empty() && chance(0.15)) x = near(z.back(), height);
      if (!is_generic_ && !others.empty() && chance(0.3)) {
        x = others[static_cast<std::size_t>(make_.integer(0, static_cast<int>(others.size()) - 1))];
        if (chance(0.3)) x = near(x, height);
      }
      if (x > spec.bottom && x < spec.top) z.push_back(x);
    }
    std::sort(z.begin(), z.end());
    z.erase(std::unique(z.begin(), z.end()), z.end());
    return z;
  }
  double near(double x, double height) {
    if (chance(0.2)) return std::nextafter(x, chance(0.5) ? 1e300 : -1e300);
    return x + (chance(0.5) ? 1 : -1) * height * power(-13, -1);
  }

  void layers(SceneSpec<double>& spec) {
    Piecewise<double> a;
    a.breaks = heights(spec, count(6, 60) - 1, {});
    const double contrast = chance(0.5) ? power(0, 1) : power(0, 8);
    for (std::size_t i = 0; i <= a.breaks.size(); ++i) {
      a.values.push_back(std::pow(contrast, make_.uniform(0, 1)));
      if (i == 0 || is_generic_ || !chance(0.2)) continue;
      const double below = a.values[i - 1];
      a.values[i] = chance(0.5) ? below : below * (1 + make_.uniform(-1, 1) * power(-15, -8));
    }
    if (chance(0.3)) std::sort(a.values.begin(), a.values.end());
    if (chance(0.3)) std::sort(a.values.rbegin(), a.values.rend());
    spec.shear_rate = std::move(a);
  }

  /// a of about 1 at the bottom, wherever that is.
  void exponential(SceneSpec<double>& spec) {
    const double height = spec.top - spec.bottom, decay = height * power(-1.3, 2);
    if (std::abs(spec.bottom / decay) > 200) spec.bottom = 0, spec.top = height;
    spec.shear_rate = Exponential<double>{power(-1, 1) * std::exp(spec.bottom / decay), decay};
  }

  void table(SceneSpec<double>& spec) {
    Table<double> a;
    a.z = heights(spec, make_.integer(0, 10), {});
    a.z.insert(a.z.begin(), spec.bottom);
    a.z.push_back(spec.top);
    const double contrast = power(0, 3);
    for (std::size_t i = 0; i < a.z.size(); ++i) a.values.push_back(std::pow(contrast, make_.uniform(0, 1)));
    spec.shear_rate = std::move(a);
  }

  void scale(SceneSpec<double>& spec) {
    if (chance(0.4)) return;
    if (chance(0.6)) {
      spec.scale = power(-3, 3);
      return;
    }
    // s, s a, times and heights must all be numbers that doubles hold without loss.
    spec.scale = power(-280, 280);
  }

  double state() {
    const double x = make_.uniform(0, 1);
    if (is_generic_ ? x < 0.3 : x < 0.35) return chance(0.5) ? 0 : 1;
    if (is_generic_) return make_.uniform(0, 1);
    if (x < 0.4) return 0.5;
    if (x < 0.45) return power(-18, -3);
    if (x < 0.5) return 1 - power(-16, -3);
    if (x < 0.55) return 0.5 + make_.uniform(-1, 1) * power(-16, -3);
    return make_.uniform(0, 1);
  }

  void initial(SceneSpec<double>& spec) {
    const auto knots = std::visit([](const auto& a) { return a.knots(); }, spec.shear_rate);
    std::vector<double> others;
    for (const double z : knots)
      if (z > spec.bottom && z < spec.top) others.push_back(z);
    const double kind = make_.uniform(0, 1);
    if (kind < 0.3) {
      while (spec.initial_breaks.empty()) spec.initial_breaks = heights(spec, 1, others);
      spec.initial_values = {0, 1};
      if (chance(0.1)) spec.initial_values = {1, 0};
      return;
    }
    spec.initial_breaks = heights(spec,
                                  kind < 0.4    ? 0
                                  : kind < 0.93 ? make_.integer(1, 12)
                                                : make_.integer(13, 200),
                                  others);
    for (std::size_t i = 0; i <= spec.initial_breaks.size(); ++i) {
      spec.initial_values.push_back(state());
      if (i > 0 && !is_generic_ && chance(0.1)) {
        const double below = spec.initial_values[i - 1];
        spec.initial_values[i] =
            chance(0.5) ? below : std::clamp(below + make_.uniform(-1, 1) * power(-16, -6), 0.0, 1.0);
      }
    }
  }

  void times(Trial& trial) {
    const TimeScales scales = time_scales(trial.spec);
    const double unit = chance(0.7) ? scales.bed : scales.fastest;
    const double t = unit * power(-1, 1) * (chance(0.2) ? power(-8, 2) : 1.0);
    trial.late = t;
    trial.early = t * make_.uniform(0.05, 0.95);
  }

  void options(Trial& trial) {
    support::OptionNumbers& options = trial.options;
    options["resolution"] = chance(0.1) ? 1.0 : power(-2.5, 0);
    if (chance(0.05)) options["resolution"] = power(-4, -2.5);
    options["layers"] = make_.integer(4, 48);
    options["reconstruct"] = chance(0.5) ? 1 : 0;
    options["cells"] = chance(0.1) ? make_.integer(1, 8) : make_.integer(9, 200);
    options["cfl"] = chance(0.5) ? 1.0 : make_.uniform(0.1, 1);
    options["max-collisions"] = 20'000;
    options["limiter"] = make_.integer(0, static_cast<int>(kLimiterNames.size()) - 1);
    options["align-cells"] = chance(0.3) && aligned_updates(trial) < kMostAlignedUpdates ? 1 : 0;
  }

  /// Cell updates of a run on aligned cells with equal steps: a thin layer gets a cell of its own, and that
  /// cell sets the step of all.
  static double aligned_updates(const Trial& trial) {
    const SceneSpec<double>& spec = trial.spec;
    const Scene<double> scene(spec);
    std::vector<double> cuts = std::visit([](const auto& a) { return a.knots(); }, spec.shear_rate);
    cuts.insert(cuts.begin(), spec.bottom);
    cuts.push_back(spec.top);
    const double cells = trial.options.at("cells");
    double thinnest = (spec.top - spec.bottom) / cells, fastest = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      if (cuts[i + 1] > cuts[i]) thinnest = std::min(thinnest, cuts[i + 1] - cuts[i]);
      for (const double z : {cuts[i], cuts[i + 1]}) fastest = std::max(fastest, scene.shear_rate_at(z));
    }
    return cells * (trial.late * (spec.scale * fastest) / (thinnest * trial.options.at("cfl")));
  }

  SceneMaker make_;
  bool is_generic_ = false;
};

std::string array_text(const std::vector<double>& xs) {
  std::string text = "[";
  for (const double x : xs) text += (text.size() > 1 ? ", " : "") + number_text(x);
  return text + "]";
}

}  // namespace

Trial draw_trial(std::uint64_t seed) { return Draw(seed).trial(seed); }

TimeScales time_scales(const SceneSpec<double>& spec) {
  constexpr std::size_t kLayers = 64;
  const Scene<double> scene(spec);
  const LayerStack<double> stack = scene.is_layered() ? exact_layers(scene) : staircase(scene, kLayers);
  TimeScales scales{0, std::numeric_limits<double>::infinity()};
  for (std::size_t k = 0; k < stack.n_layers(); ++k) {
    scales.bed += (stack.boundary(k + 1) - stack.boundary(k)) / stack.rate(k);
    scales.fastest = std::min(scales.fastest, (spec.top - spec.bottom) / stack.rate(k));
  }
  return scales;
}

std::string text_of(const SceneSpec<double>& spec) {
  std::string text = "name = \"" + spec.name + "\"\n", table;
  visit_fields(spec, [&](const std::string& key, const FieldInfo&, const auto& member) {
    const std::size_t dot = key.find('.');
    if (key.substr(0, dot) != table) {
      table = key.substr(0, dot);
      text += "[" + table + "]\n";
      if (table == "shear_rate")
        text += "model = \"" +
                std::string(std::visit([](const auto& rate) { return rate.kName; }, spec.shear_rate)) +
                "\"\n";
    }
    text += key.substr(dot + 1) + " = ";
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>) {
      text += number_text(member) + "\n";
    } else {
      text += array_text(member) + "\n";
    }
  });
  return text;
}

std::string text_of(const Trial& trial) {
  std::string text = "# seed " + std::to_string(trial.seed) + ": times " + number_text(trial.early) + ", " +
                     number_text(trial.late);
  for (const auto& [name, x] : trial.options) text += "; " + std::string(name) + " " + number_text(x);
  return text + "\n" + text_of(trial.spec);
}

SceneSpec<double> upside_down(const SceneSpec<double>& spec) {
  SceneSpec<double> mirror = spec;
  const auto turn = [&](std::vector<double>& z) {
    std::reverse(z.begin(), z.end());
    for (double& x : z) x = spec.bottom + (spec.top - x);
  };
  auto& rate = std::get<Piecewise<double>>(mirror.shear_rate);
  turn(rate.breaks), turn(mirror.initial_breaks);
  std::reverse(rate.values.begin(), rate.values.end());
  std::reverse(mirror.initial_values.begin(), mirror.initial_values.end());
  for (double& phi : mirror.initial_values) phi = 1 - phi;
  return mirror;
}

}  // namespace shearfront::soak
