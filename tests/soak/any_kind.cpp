// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "shearfront/io/scene_file.hpp"
#include "shearfront/io/scene_text.hpp"
#include "shearfront/scene/chute.hpp"
#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "soak/laws.hpp"
#include "support/any_scene.hpp"
#include "support/options.hpp"
#include "support/refinement_scenes.hpp"
#include "support/scene_units.hpp"
#include "support/smooth_starts.hpp"

namespace shearfront::soak {
namespace {

constexpr double kStatedError = 1e-6;        ///< --tolerance of the exact method
constexpr double kMostUpdatesOfAKind = 4e5;  ///< of one run, so that no scene takes long

struct KindTrial {
  SceneSpec<double> spec;
  std::string text_of_chute;  ///< of the scene whose bed this is; empty for other beds
  double early = 0, late = 0;
  support::OptionNumbers options;
};

double most(const SceneSpec<double>& spec, double StateRange<double>::*end, double sign) {
  double x = -infinity<double>();
  for (const auto& flux : spec.fluxes) x = std::max(x, sign * (flux.range().*end));
  return sign * x;
}

class KindDraw {
 public:
  explicit KindDraw(std::uint64_t seed) : make_(seed ^ 0xa11ULL) {}

  KindTrial trial() {
    KindTrial trial;
    do {
      trial.spec = scene();
    } while (!find_complaints(trial.spec).empty());
    trial.text_of_chute = turned_into_bed(trial.spec);
    const double span = std::pow(10.0, make_.uniform(-2, 1));
    trial.late = span;
    trial.early = span * make_.uniform(0.05, 0.95);
    if (make_.integer(0, 2) == 0) {
      const double L = std::pow(10.0, make_.uniform(-6, 6)), T = std::pow(10.0, make_.uniform(-6, 6));
      trial.spec = support::in_units(trial.spec, L, T);
      trial.early *= T, trial.late *= T;
    }
    trial.options = {{"resolution", std::pow(10.0, make_.uniform(-2, 0))},
                     {"cells", double(make_.integer(2, 150))},
                     {"cfl", make_.uniform(0.1, 1)},
                     {"limiter", double(make_.integer(0, int(kLimiterNames.size()) - 1))},
                     {"max-collisions", 20'000}};
    return trial;
  }

 private:
  SceneSpec<double> scene() {
    if (make_.integer(0, 2) == 0) return support::any_scene(make_, 8);
    const auto& kinds = support::kSceneKinds;
    SceneSpec<double> spec =
        kinds[static_cast<std::size_t>(make_.integer(0, int(kinds.size()) - 1))].draw(make_);
    if (make_.integer(0, 3) == 0 && !spec.initial_state) {
      spec.initial_breaks.clear(), spec.initial_values.clear();
      spec.initial_state = support::random_start(make_, most(spec, &StateRange<double>::lowest, 1),
                                                 most(spec, &StateRange<double>::highest, -1));
    }
    if (make_.integer(0, 5) == 0) any_model_of(spec);
    if (make_.integer(0, 8) == 0) spec.velocity = sample_of<VelocityList<double>, Velocity<double>>();
    if (make_.integer(0, 3) == 0 && !spec.diffusion) {
      // Of the same shape, so that every engine meets steep and rising tables between any ends.
      Table<double> rate;
      rate.z = support::kinds::wide_heights(make_, make_.integer(0, 3));
      rate.z.insert(rate.z.begin(), 0);
      rate.z.push_back(1);
      for (std::size_t i = 0; i < rate.z.size(); ++i)
        rate.values.push_back(std::pow(10.0, make_.uniform(-1.5, 0.5)));
      spec.shear_rate = std::move(rate);
    }
    return spec;
  }

  template <class List, class Variant>
  Variant sample_of() {
    std::vector<Variant> all;
    List::for_each([&]<class M>() {
      for (const M& model : M::samples()) all.push_back(model);
    });
    return all[static_cast<std::size_t>(make_.integer(0, int(all.size()) - 1))];
  }

  /// A shear rate of any model, those from rheology among them, whose numbers differ by powers of ten: the scale takes that.
  void any_model_of(SceneSpec<double>& spec) {
    spec.shear_rate = sample_of<DepthFunctionList<double>, DepthFunction<double>>();
    if (!find_complaints(spec).empty()) return;
    const Scene<double> scene(spec);
    double most = 0;
    for (int i = 0; i <= 32; ++i) most = std::max(most, scene.shear_rate_at(i / 32.0));
    spec.scale = std::pow(10.0, make_.uniform(-1, 0.5)) / most;
  }

  /// The bed that a chute amounts to, in place of it; the text of the chute, if it was one.
  static std::string turned_into_bed(SceneSpec<double>& spec) {
    if (!spec.velocity) return {};
    std::string text = scene_text(spec);
    spec = SteadyChute<double>(Scene<double>(spec)).bed().spec();
    return text;
  }

  support::SceneMaker make_;
};

/// Largest |f'| times the largest s a(z), by samples: no wave is faster by much.
double fastest_wave(const Scene<double>& scene) {
  double rate = 0, slope = 0;
  for (int i = 0; i <= 200; ++i) {
    const double z = scene.bottom() + (scene.top() - scene.bottom()) * (i / 200.0);
    rate = std::max(rate, scene.scale() * scene.rate_at(z));
  }
  for (const auto& flux : scene.spec().fluxes) {
    const auto [lowest, highest] = flux.range();
    for (int i = 0; i <= 200; ++i)
      slope = std::max(slope, std::abs(flux.derivative(lowest + (highest - lowest) * (i / 200.0))));
  }
  return rate * slope;
}

class KindLaws {
 public:
  KindLaws(const KindTrial& trial, Findings& findings)
      : trial_(trial),
        scene_(trial.spec),
        findings_(findings),
        height_(scene_.top() - scene_.bottom()),
        size_(std::max(std::abs(scene_.top()), std::abs(scene_.bottom()))),
        wave_(fastest_wave(scene_)) {
    lowest_ = most(trial.spec, &StateRange<double>::lowest, -1);
    highest_ = most(trial.spec, &StateRange<double>::highest, 1);
    largest_ = std::max(std::abs(lowest_), std::abs(highest_));
    for (int j = 0; j <= 16; ++j)
      heights_.push_back(j == 16 ? scene_.top() : scene_.bottom() + height_ * (j / 16.0));
    for (const auto& own : {scene_.initial_breaks(), scene_.knots(), scene_.initial_knots()})
      heights_.insert(heights_.end(), own.begin(), own.end());
    std::sort(heights_.begin(), heights_.end());
    heights_.erase(std::unique(heights_.begin(), heights_.end()), heights_.end());
  }

  void check() {
    check_text();
    SolverList::for_each([&]<class S>() { check_solver<S>(); });
    if (M_exact_ && M_godunov_) check_roads();
  }

 private:
  template <class S>
  SolverRequest request(const typename S::Options& options) const {
    SolverRequest request{{trial_.early, trial_.late}, heights_};
    if (S::guarantees().exact || S::guarantees().has_fronts) return request;
    const double n = trial_.options.at("cells");
    const double most_time = kMostUpdatesOfAKind / (n * n) * trial_.options.at("cfl") * height_ / wave_;
    const double factor = S::guarantees().diffusion ? 1 : std::min(1.0, most_time / trial_.late);
    static_cast<void>(options);
    for (double& t : request.times) t *= factor;
    return request;
  }

  template <class S>
  void check_solver() {
    const auto options = support::options_of<S>(trial_.options);
    if (!S::refusal(scene_, options).empty()) return;
    const Guarantees promised = S::guarantees();
    const SolverRequest asked = request<S>(options);
    const SolverResult result = solve<S>(scene_, asked, options);
    findings_.count(result.summary);
    const std::string name(S::kName);
    if (!result.summary.usable()) {
      const Status status = result.summary.status;
      const bool is_documented = status == Status::budget_reached || status == Status::not_converged ||
                                 (status == Status::diverged && !promised.bounded);
      findings_.expect(is_documented && !result.summary.message.empty(), name + ": runs",
                       [&] { return std::string(name_of(status)) + ": " + result.summary.message; });
      return;
    }
    check_samples(name, promised, asked, result);
    check_scaling<S>(name, asked, options, result);
    if (promised.exact && !promised.diffusion) M_exact_ = result;
    if (name == GodunovSolver::kName && asked.times[1] == trial_.late) M_godunov_ = result;
  }

  void check_samples(const std::string& name, const Guarantees& promised, const SolverRequest& asked,
                     const SolverResult& result) {
    const std::size_t n = heights_.size();
    // What is stated where it approximates; to rounding elsewhere.
    const bool is_approximate =
        promised.exact && !promised.diffusion && !ExactSolution<double>(scene_).is_exact();
    const double slack = (is_approximate ? kStatedError * height_ : 1e-12 * size_) * largest_;
    for (std::size_t i = 0; i < asked.times.size(); ++i) {
      const double t = asked.times[i];
      double largest = largest_;
      for (std::size_t j = 0; j < n; ++j) largest = std::max(largest, std::abs(result.phi(i, j)));
      for (std::size_t j = 0; j < n; ++j) {
        const double phi = result.phi(i, j), M = result.M(i, j);
        const auto where = [&] { return at(heights_[j], t); };
        findings_.expect(std::isfinite(phi) && std::isfinite(M), name + ": numbers", where);
        if (promised.bounded)
          findings_.expect_between(phi, std::min(lowest_, 0.0), highest_, 1e-9 * largest_,
                                   name + ": phi in the range of the fluxes", where);
        if (promised.bounded && j > 0)
          findings_.expect_between(result.M(i, j) - result.M(i, j - 1),
                                   std::min(lowest_, 0.0) * (heights_[j] - heights_[j - 1]),
                                   highest_ * (heights_[j] - heights_[j - 1]), slack,
                                   name + ": M monotone and Lipschitz in z", where);
      }
      findings_.expect_near(result.M(i, 0), 0, slack, name + ": no mass below the bottom",
                            [&] { return at(t); });
      if (promised.conservative && (scene_.has_walls() || scene_.spec().is_periodic))
        findings_.expect_near(result.M(i, n - 1), scene_.mass(), slack * largest / largest_, name + ": mass",
                              [&] { return at(t); });
    }
  }

  template <class S>
  void check_scaling(const std::string& name, const SolverRequest& asked, const typename S::Options& options,
                     const SolverResult& result) {
    SceneSpec<double> spec = support::in_units(trial_.spec, 1, 0x1p-7);
    SolverRequest scaled = asked;
    for (double& t : scaled.times) t *= 0x1p-7;
    const SolverResult fast = solve<S>(Scene<double>(std::move(spec)), scaled, options);
    findings_.count(fast.summary);
    bool same = fast.samples.size() == result.samples.size();
    for (std::size_t i = 0; same && i < fast.samples.size(); ++i)
      same = fast.samples[i].phi == result.samples[i].phi && fast.samples[i].M == result.samples[i].M;
    findings_.expect(same, name + ": scaling by powers of two", [] { return std::string("times / 128"); });
  }

  /// Monotone schemes are off in M by O(sqrt(t dz)); the constant is generous, for only gross errors are meant.
  void check_roads() {
    const double dz = height_ / trial_.options.at("cells"), range = highest_ - lowest_;
    for (std::size_t i = 0; i < 2; ++i) {
      const double t = i == 0 ? trial_.early : trial_.late;
      const double bound = range * (2 * dz + 2 * std::sqrt(wave_ * t * dz));
      for (std::size_t j = 0; j < heights_.size(); ++j)
        findings_.expect_near(M_exact_->M(i, j), M_godunov_->M(i, j), bound, "exact: M near Godunov's",
                              [&] { return at(heights_[j], t); });
    }
  }

  void check_text() {
    if (!trial_.text_of_chute.empty())
      findings_.expect(
          scene_text(parse_scene<double>(trial_.text_of_chute, "soak.toml").spec()) == trial_.text_of_chute,
          "io: any chute reads back to the same text", [] { return std::string("text"); });
    const std::string text = scene_text(trial_.spec);
    findings_.expect(scene_text(parse_scene<double>(text, "soak.toml").spec()) == text,
                     "io: any scene reads back to the same text", [] { return std::string("text"); });
  }

  const KindTrial& trial_;
  const Scene<double> scene_;
  Findings& findings_;
  double height_, size_, wave_, lowest_ = 0, highest_ = 0, largest_ = 0;
  std::vector<double> heights_;
  std::optional<SolverResult> M_exact_, M_godunov_;
};

}  // namespace

Findings check_any_kind(std::uint64_t seed) {
  const KindTrial trial = KindDraw(seed).trial();
  Findings findings;
  findings.n_scenes = 1;
  KindLaws(trial, findings).check();
  return findings;
}

std::string text_of_any_kind(std::uint64_t seed) {
  const KindTrial trial = KindDraw(seed).trial();
  std::string text = "# any kind, seed " + std::to_string(seed) + ": times " + number_text(trial.early) +
                     ", " + number_text(trial.late);
  for (const auto& [name, x] : trial.options) text += "; " + std::string(name) + " " + number_text(x);
  return text + "\n" + scene_text(trial.spec);
}

}  // namespace shearfront::soak
