// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/solver/chute_volume.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <cstddef>

#include "shearfront/numeric/sum.hpp"

namespace shearfront {
namespace {

using VolumeRule = boost::math::quadrature::gauss_kronrod<double, 15>;
using VolumeCheck = boost::math::quadrature::gauss<double, 7>;

/// Heights of the rule on [-1, 1], ascending, with its weights and those of the coarser rule in it, 0 where that has none.
struct VolumeNodes {
  std::vector<double> x, weight, coarse;
  VolumeNodes() {
    const auto& at = VolumeRule::abscissa();
    const auto& weights = VolumeRule::weights();
    const std::size_t half = at.size() - 1;
    for (std::size_t i = 0; i <= 2 * half; ++i) {
      const std::size_t k = i < half ? half - i : i - half;
      x.push_back(i < half ? -at[k] : at[k]);
      weight.push_back(weights[k]);
      coarse.push_back(k % 2 == 0 ? VolumeCheck::weights()[k / 2] : 0);
    }
  }
  [[nodiscard]] std::size_t middle() const { return x.size() / 2; }
};

/// A part of the chute; `target` is the interval between two heights it belongs to.
struct VolumePart {
  double lo, hi, M_lo, M_hi;
  std::size_t target;
};

class VolumeQuadrature {
 public:
  VolumeQuadrature(const SteadyChute<double>& chute, const Field& bed) : chute_(chute), bed_(bed) {}

  /// Of the intervals between neighbouring `edges`, ascending.
  std::vector<double> between(const std::vector<double>& edges) {
    start(edges);
    sums_.resize(edges.size() - 1);
    for (int n = 0; !parts_.empty(); ++n) halve(n == ChuteVolume::kMostHalvings);
    std::vector<double> volumes;
    for (const CompensatedSum<double>& sum : sums_) volumes.push_back(sum.value());
    return volumes;
  }

 private:
  [[nodiscard]] std::vector<Sample> samples(const std::vector<double>& z) const {
    std::vector<Sample> all = bed_.at(chute_.bed_heights(z));
    for (Sample& sample : all) sample.M *= chute_.mean_velocity();
    return all;
  }

  /// Parts between the edges, the knots of u and the cells of the field.
  void start(const std::vector<double>& edges) {
    std::vector<double> cuts = chute_.velocity_knots();
    if (const auto profile = bed_.profile())
      for (const double zeta : profile->z()) cuts.push_back(chute_.height(zeta));
    cuts.insert(cuts.end(), edges.begin(), edges.end());
    std::sort(cuts.begin(), cuts.end());
    cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
    std::erase_if(cuts, [&](double z) { return z < edges.front() || z > edges.back(); });
    const std::vector<Sample> at = samples(cuts);
    std::size_t target = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
      while (cuts[i] >= edges[target + 1]) ++target;
      parts_.push_back({cuts[i], cuts[i + 1], at[i].M, at[i + 1].M, target});
    }
  }

  /// All parts by the rule; what is not good enough becomes two.
  void halve(bool is_last) {
    const double tolerance = ChuteVolume::kTolerance * (chute_.bed().top() - chute_.bed().bottom());
    const std::size_t n = nodes_.x.size();
    std::vector<double> z;
    for (const VolumePart& part : parts_)
      for (const double x : nodes_.x) z.push_back(part.lo + (part.hi - part.lo) * ((1 + x) / 2));
    const std::vector<Sample> at = samples(z);
    std::vector<VolumePart> left;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const VolumePart& part = parts_[i];
      const double height = part.hi - part.lo, mean = chute_.flow(part.lo, part.hi) / height;
      double fine = 0, coarse = 0;
      for (std::size_t k = 0; k < n; ++k) {
        const double value = at[i * n + k].phi * (mean > 0 ? 1 - chute_.velocity(z[i * n + k]) / mean : 1);
        fine += nodes_.weight[k] * value;
        coarse += nodes_.coarse[k] * value;
      }
      const double middle = z[i * n + nodes_.middle()];
      if (is_last || height / 2 * std::abs(fine - coarse) <= tolerance ||
          !(middle > part.lo && middle < part.hi)) {
        sums_[part.target] += height / 2 * fine;
        if (mean > 0) sums_[part.target] += (part.M_hi - part.M_lo) / mean;
        continue;
      }
      const double M = at[i * n + nodes_.middle()].M;
      left.push_back({part.lo, middle, part.M_lo, M, part.target});
      left.push_back({middle, part.hi, M, part.M_hi, part.target});
    }
    parts_ = std::move(left);
  }

  const SteadyChute<double>& chute_;
  const Field& bed_;
  const VolumeNodes nodes_;
  std::vector<VolumePart> parts_;
  std::vector<CompensatedSum<double>> sums_;
};

}  // namespace

std::vector<double> chute_volumes(const SteadyChute<double>& chute, const Field& bed,
                                  const std::vector<double>& heights) {
  std::vector<double> edges = heights;
  edges.push_back(chute.bed().bottom());
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<double> below(edges.size(), 0);
  if (edges.size() > 1) {
    const std::vector<double> parts = VolumeQuadrature(chute, bed).between(edges);
    CompensatedSum<double> sum;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      sum += parts[i];
      below[i + 1] = sum.value();
    }
  }
  std::vector<double> volumes;
  for (const double z : heights)
    volumes.push_back(
        below[static_cast<std::size_t>(std::lower_bound(edges.begin(), edges.end(), z) - edges.begin())]);
  return volumes;
}

}  // namespace shearfront
