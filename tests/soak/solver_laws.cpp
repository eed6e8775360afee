// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "shearfront/solver/all.hpp"
#include "shearfront/solver/solve.hpp"
#include "soak/laws.hpp"

namespace shearfront::soak {
namespace {

constexpr double kMassSlack = 1e-13;
// Cells whose rates times widths are further apart than this may be stopped by rounding (fv/run.hpp: not_converged).
constexpr double kLeastUnconverged = 1e3;
constexpr double kMostUpdates = 4e5;  ///< of one run, so that no scene takes long

/// Schemes on a grid have neither fronts nor exact values.
template <class Solver>
bool is_on_grid() {
  const Guarantees g = Solver::guarantees();
  return !g.exact && !g.has_fronts;
}
/// First-order schemes are monotone: u <= v stays so, and no two solutions move apart.
template <class Solver>
bool is_monotone() {
  return Solver::kName == std::string_view("engquist-osher") || Solver::kName == std::string_view("godunov");
}

/// Of the times that waves take across cells: rates, and widths where cells are aligned with thin layers.
double contrast_of(const Bed& bed) {
  double least = infinity<double>(), largest = 0, thinnest = bed.trial.height();
  for (std::size_t k = 0; k < bed.stack.n_layers(); ++k) {
    least = std::min(least, bed.stack.rate(k));
    largest = std::max(largest, bed.stack.rate(k));
    thinnest = std::min(thinnest, bed.stack.boundary(k + 1) - bed.stack.boundary(k));
  }
  const bool is_aligned = bed.trial.options.at("align-cells") != 0;
  return largest / least * (is_aligned ? bed.trial.height() / thinnest : 1);
}

double fastest_of(const Bed& bed) {
  double largest = 0;
  for (const double z : bed.stack.boundaries())
    largest = std::max(largest, bed.scene.scale() * bed.scene.shear_rate_at(z));
  for (std::size_t k = 0; k < bed.stack.n_layers(); ++k) largest = std::max(largest, bed.stack.rate(k));
  return largest;
}

/// Times early, infinity, 0, late: in no order; for grids no later than they can pay for.
SolverRequest request_of(const Bed& bed, bool is_on_grid) {
  double early = bed.trial.early, late = bed.trial.late;
  if (is_on_grid) {
    const double n = bed.trial.options.at("cells");
    const double most =
        kMostUpdates / (n * n) * bed.trial.options.at("cfl") * bed.trial.height() / fastest_of(bed);
    const double factor = std::min(1.0, most / late);
    early *= factor, late *= factor;
  }
  SolverRequest request{{early, infinity<double>(), 0, late}, bed.heights};
  if (request.heights.size() > 3) std::swap(request.heights[1], request.heights[3]);
  request.profiles = true;
  return request;
}

template <class Solver>
SolverResult run(const SceneSpec<double>& spec, const SolverRequest& request,
                 const typename Solver::Options& options, Findings& findings) {
  SolverResult result = solve<Solver>(Scene<double>(spec), request, options);
  findings.count(result.summary);
  return result;
}

template <class Solver>
class SolverLaws {
 public:
  SolverLaws(const Bed& bed, Findings& findings)
      : bed_(bed),
        findings_(findings),
        options_(support::options_of<Solver>(bed.trial.options)),
        request_(request_of(bed, is_on_grid<Solver>())) {
    request_.timeline = kPromised.has_timeline;
  }

  void check() {
    const SolverResult result = run<Solver>(bed_.scene.spec(), request_, options_, findings_);
    const Summary& summary = result.summary;
    if (!summary.usable()) {
      // Curved fronts say what rounding has lost of the amount where heights know too little of the rate.
      const bool has_lost = Solver::guarantees().has_fronts && !bed_.scene.is_layered();
      const bool is_documented =
          summary.status == Status::budget_reached ||
          (summary.status == Status::not_converged &&
           (has_lost || (is_on_grid<Solver>() && contrast_of(bed_) > kLeastUnconverged)));
      findings_.expect(is_documented && !summary.message.empty(), name("runs"),
                       [&] { return std::string(name_of(summary.status)) + ": " + summary.message; });
      return;
    }
    check_shape(result);
    check_samples(result);
    check_profiles(result);
    if (is_on_grid<Solver>()) check_grid(result);
  }

 private:
  static inline const Guarantees kPromised = Solver::guarantees();

  [[nodiscard]] std::string name(const char* law) const { return std::string(Solver::kName) + ": " + law; }
  [[nodiscard]] std::size_t index(std::size_t i, std::size_t j) const {
    return i * request_.heights.size() + j;
  }

  void check_shape(const SolverResult& result) {
    findings_.expect(result.samples.size() == request_.times.size() * request_.heights.size() &&
                         result.profiles.size() == (kPromised.has_profiles ? request_.times.size() : 0) &&
                         result.timeline.has_value() == kPromised.has_timeline && result.fronts.empty(),
                     name("gives what was asked for"), [] { return std::string("sizes"); });
  }

  void check_samples(const SolverResult& result) {
    const double top = bed_.scene.top(), bottom = bed_.scene.bottom(), mass = bed_.scene.mass();
    const double slack = kMassSlack * bed_.trial.largest_height() + bed_.M_rounding();
    std::vector<std::size_t> upwards(request_.heights.size());
    for (std::size_t j = 0; j < upwards.size(); ++j) upwards[j] = j;
    std::sort(upwards.begin(), upwards.end(),
              [&](std::size_t a, std::size_t b) { return request_.heights[a] < request_.heights[b]; });
    for (std::size_t i = 0; i < request_.times.size(); ++i) {
      double z0 = bottom, M0 = 0;
      for (const std::size_t j : upwards) {
        const Sample& s = result.samples[index(i, j)];
        const double z = request_.heights[j];
        const auto where = [&] { return at(z, request_.times[i]); };
        if (kPromised.bounded) {
          findings_.expect(s.phi >= 0 && s.phi <= 1, name("phi in [0, 1]"),
                           [&] { return number_text(s.phi) + " at " + where(); });
          findings_.expect_between(s.M - M0, 0, z - z0, slack, name("M monotone and 1-Lipschitz in z"),
                                   where);
        }
        if (kPromised.conservative && z == top) findings_.expect_near(s.M, mass, slack, name("mass"), where);
        if (z == bottom) findings_.expect_near(s.M, 0, slack, name("no mass below the bottom"), where);
        z0 = z, M0 = s.M;
      }
    }
  }

  /// How far phi of a profile may be from that of the solution: not at all, but where lines stand for what is curved between fronts, a
  /// thousandth of R.
  [[nodiscard]] double line_slack(double z) const {
    if (!Solver::guarantees().has_fronts || bed_.scene.is_layered()) return 0;
    constexpr double kShareOfResolution = 1e-3;
    return kShareOfResolution * bed_.trial.options.at("resolution") *
           std::max(1.0, bed_.scene.range_at(z).highest);
  }
  /// Whether phi is that of a profile at z; with lines a front at z may lie on either side, and a piece be a few roundings high.
  [[nodiscard]] bool is_of(const Profile<double>& profile, double z, double phi) const {
    const double slack = line_slack(z);
    if (slack == 0) return profile.at(z).phi == phi;
    constexpr double kRoundings = 16;
    const double beside = kRoundings * 0x1p-53 * bed_.trial.largest_height();
    double least = profile.at(z).phi, most = least;
    for (const double side : {-1.0, 1.0}) {
      const double there =
          profile.at(std::clamp(z + side * beside, bed_.scene.bottom(), bed_.scene.top())).phi;
      least = std::min(least, there);
      most = std::max(most, there);
    }
    return phi >= least - slack && phi <= most + slack;
  }

  void check_profiles(const SolverResult& result) {
    for (std::size_t i = 0; i < result.profiles.size(); ++i)
      for (std::size_t j = 0; j < request_.heights.size(); ++j) {
        const auto value = result.profiles[i].at(request_.heights[j]);
        const Sample& s = result.samples[index(i, j)];
        findings_.expect(
            is_of(result.profiles[i], request_.heights[j], s.phi) &&
                std::abs(value.M - s.M) <= kMassSlack * bed_.trial.largest_height() + bed_.M_rounding() +
                                               line_slack(request_.heights[j]) * bed_.trial.height(),
            name("samples are values of the profile"),
            [&] { return at(request_.heights[j], request_.times[i]); });
      }
  }

  void check_grid(const SolverResult& result) {
    check_scaling(result);
    SolverRequest alone = request_;
    alone.times = {request_.times[0]};
    const SolverResult single = run<Solver>(bed_.scene.spec(), alone, options_, findings_);
    bool same = single.summary.usable() && single.samples.size() == request_.heights.size();
    for (std::size_t j = 0; same && j < request_.heights.size(); ++j)
      same = single.samples[j].phi == result.samples[index(0, j)].phi;
    findings_.expect(same, name("other times change nothing"), [&] { return at(0, request_.times[0]); });
    if (is_monotone<Solver>()) check_pair(result);
  }

  void check_scaling(const SolverResult& result) {
    SceneSpec<double> spec = bed_.scene.spec();
    const double factor = std::ldexp(1.0, static_cast<int>(bed_.trial.seed % 41) - 20);
    spec.scale *= factor;
    SolverRequest scaled = request_;
    for (double& t : scaled.times) t /= factor;
    const SolverResult fast = run<Solver>(spec, scaled, options_, findings_);
    bool same = fast.samples.size() == result.samples.size();
    for (std::size_t i = 0; same && i < fast.samples.size(); ++i)
      same = fast.samples[i].phi == result.samples[i].phi && fast.samples[i].M == result.samples[i].M;
    findings_.expect(same, name("scaling by powers of two"), [&] { return "factor " + number_text(factor); });
  }

  void check_pair(const SolverResult& result) {
    support::SceneMaker make(bed_.trial.seed + 4);
    SceneSpec<double> larger = bed_.scene.spec(), other = larger;
    for (double& phi : larger.initial_values) phi += (1 - phi) * make.uniform(0, 1);
    for (double& phi : other.initial_values) phi = make.uniform(0, 1);
    const SolverResult v = run<Solver>(larger, request_, options_, findings_),
                       w = run<Solver>(other, request_, options_, findings_);
    if (!v.summary.usable() || !w.summary.usable()) return;
    // Cells are as wide as their rounded edges say, not as the scheme has it.
    const double size = std::max(std::abs(bed_.scene.bottom()), std::abs(bed_.scene.top()));
    const double height = bed_.trial.height(), slack = 1e-12 * height + rounding_of_crossings(result) +
                                                       2 * std::numeric_limits<double>::epsilon() * size *
                                                           static_cast<double>(result.profiles[0].n_cells());
    const double mass_gap = Scene<double>(larger).mass() - bed_.scene.mass();
    // A time between two steps is reached by a shorter step from the one before: S_f = (1 - f) I + f S_1
    // contracts like a step, but dist(n + f) may lie below dist(n + 1). All lie below dist(0).
    const double first = distance(result.profiles[2], w.profiles[2]);
    for (const std::size_t i : {0u, 3u}) {  // early, late
      findings_.expect_between(distance(result.profiles[i], w.profiles[i]), 0, first, slack,
                               name("L1 contraction"), [&] { return at(0, request_.times[i]); });
      findings_.expect_near(distance(result.profiles[i], v.profiles[i]), mass_gap,
                            slack + kMassSlack * bed_.trial.largest_height(), name("comparison"),
                            [&] { return at(0, request_.times[i]); });
    }
  }
  /// What crosses a face in a step is rounded to March::kQuantum = 2^-51 of what half the widest cell holds, in both
  /// solutions, and is missed or gained by the cells on both sides: twice that per cell update (fv/march.hpp).
  [[nodiscard]] static double rounding_of_crossings(const SolverResult& result) {
    double widest = 0;
    const std::vector<double>& z = result.profiles[0].z();
    for (std::size_t j = 1; j < z.size(); ++j) widest = std::max(widest, z[j] - z[j - 1]);
    return static_cast<double>(result.summary.cell_updates) * 2 * 0x1p-51 * (widest / 2);
  }
  /// The scheme's own distance where its cells are equal: the edges of a profile are rounded.
  [[nodiscard]] double distance(const Profile<double>& a, const Profile<double>& b) const {
    if (bed_.trial.options.at("align-cells") != 0) return l1_distance(a, b);
    CompensatedSum<double> sum;
    for (std::size_t j = 0; j < a.n_cells(); ++j) sum += std::abs(a.below()[j] - b.below()[j]);
    return sum.value() * (bed_.trial.height() / static_cast<double>(a.n_cells()));
  }

  const Bed& bed_;
  Findings& findings_;
  typename Solver::Options options_;
  SolverRequest request_;
};

}  // namespace

void check_solvers(const Bed& bed, Findings& findings) {
  SolverList::for_each([&]<class Solver>() {
    const Guarantees promised = Solver::guarantees();
    if (promised.diffusion || promised.has_slab) return;  // the beds of the soak have neither
    if (promised.exact || promised.order_M > 0) SolverLaws<Solver>(bed, findings).check();
  });
}

}  // namespace shearfront::soak
