// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/grid.hpp"

#include <cmath>

#include "shearfront/numeric/sum.hpp"

namespace shearfront::fv {
namespace {

/// Means over intervals that knots may cut.
class Means {
 public:
  explicit Means(const Scene<double>& scene) : scene_(scene), knots_(scene.knots()) {}

  /// Of c; 1 in a scene without.
  [[nodiscard]] double solid_fraction(double begin, double end) const {
    if (!scene_.spec().solid_fraction) return 1;
    double solid = 0, mean = 0;
    std::size_t n_pieces = 0;
    for_pieces(knots_, begin, end, [&](double lo, double hi) {
      mean = scene_.mean_solid_fraction(lo, hi);
      solid += (hi - lo) * mean;
      ++n_pieces;
    });
    return n_pieces == 1 ? mean : solid / (end - begin);
  }
  /// s (end - begin) / int dz / a, times the mean of c.
  [[nodiscard]] double rate(double begin, double end) const {
    double travel_time = 0, rate = 0;
    std::size_t n_pieces = 0;
    for_pieces(knots_, begin, end, [&](double lo, double hi) {
      rate = scene_.mean_rate(lo, hi);
      travel_time += (hi - lo) / rate;
      ++n_pieces;
    });
    // One piece: without the rounding of a division and its inverse, cells of a layer are equal to the bit.
    if (n_pieces > 1) rate = (end - begin) / travel_time;
    return scene_.scale() * rate * solid_fraction(begin, end);
  }

 private:
  const Scene<double>& scene_;
  std::vector<double> knots_;
};

}  // namespace

Grid equal_cells(const Scene<double>& scene, std::size_t n_cells) {
  const double height = scene.top() - scene.bottom(), n = static_cast<double>(n_cells);
  Grid grid{{}, std::vector<double>(n_cells, height / n)};
  for (std::size_t j = 0; j < n_cells; ++j)
    grid.edges.push_back(scene.bottom() + height * (static_cast<double>(j) / n));
  grid.edges.push_back(scene.top());
  return grid;
}

Grid aligned_cells(const Scene<double>& scene, std::size_t n_cells) {
  const double bottom = scene.bottom(), top = scene.top();
  std::vector<double> cuts = scene.knots();
  cuts.push_back(top);
  Grid grid{{bottom}, {}};
  const auto cells_below = [&](double z) {
    return std::round((z - bottom) / (top - bottom) * static_cast<double>(n_cells));
  };
  for (const double end : cuts) {
    const double begin = grid.edges.back(), n = std::max(1.0, cells_below(end) - cells_below(begin));
    for (double i = 1; i < n; ++i) grid.edges.push_back(begin + (end - begin) * (i / n));
    grid.edges.push_back(end);
    grid.widths.resize(grid.edges.size() - 1, (end - begin) / n);
  }
  return grid;
}

std::vector<double> capacities(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> result = grid.widths;
  const Means means(scene);
  for (std::size_t j = 0; j < result.size(); ++j)
    result[j] *= means.solid_fraction(grid.edges[j], grid.edges[j + 1]);
  return result;
}

std::vector<double> initial_shares(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> shares(grid.n_cells());
  if (scene.has_smooth_start()) {
    for (std::size_t j = 0; j < shares.size(); ++j) {
      const double lo = grid.edges[j], hi = grid.edges[j + 1];
      const StateRange<double> range = scene.flux_at(lo).range();
      shares[j] = std::clamp(scene.initial_amount(lo, hi) / scene.solid(lo, hi), range.lowest, range.highest);
    }
    return shares;
  }
  const Means means(scene);
  for (std::size_t j = 0; j < shares.size(); ++j) {
    CompensatedSum<double> sum, solid;
    double least = scene.initial_share(grid.edges[j]), most = least;
    for_pieces(scene.initial_breaks(), grid.edges[j], grid.edges[j + 1], [&](double lo, double hi) {
      const double share = scene.initial_share(lo), weight = (hi - lo) * means.solid_fraction(lo, hi);
      sum += weight * share;
      solid += weight;
      least = std::min(least, share), most = std::max(most, share);
    });
    shares[j] =
        std::clamp(sum.value() / solid.value(), least, most);  // exact where the cell is all one state
  }
  return shares;
}

std::vector<double> cell_rates(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> rates(grid.n_cells());
  const Means means(scene);
  for (std::size_t j = 0; j < rates.size(); ++j) rates[j] = means.rate(grid.edges[j], grid.edges[j + 1]);
  return rates;
}

std::vector<double> face_rates(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> rates(grid.n_cells() + 1, 0.0);
  const Means means(scene);
  for (std::size_t j = 1; j < grid.n_cells(); ++j) rates[j] = means.rate(grid.middle(j - 1), grid.middle(j));
  return rates;
}

std::vector<double> face_values(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> rates(grid.n_cells() + 1, 0.0);
  for (std::size_t j = 1; j < grid.n_cells(); ++j) {
    const double z = grid.edges[j];
    rates[j] = scene.scale() * scene.rate_at(z) * scene.solid_fraction_at(z);
  }
  return rates;
}

}  // namespace shearfront::fv
