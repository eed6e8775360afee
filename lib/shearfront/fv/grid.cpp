// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/grid.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/numeric/sum.hpp"

namespace shearfront::fv {
namespace {

/// Calls visit(lo, hi) for the pieces into which the cuts (ascending) divide [begin, end], bottom to top.
/// `next` is the first cut that may lie above begin; it moves on with ascending intervals.
template <class Visit>
void for_pieces(const std::vector<double>& cuts, std::size_t& next, double begin, double end, Visit&& visit) {
  while (next < cuts.size() && cuts[next] <= begin) ++next;
  double lo = begin;
  for (; next < cuts.size() && cuts[next] < end; ++next) {
    visit(lo, cuts[next]);
    lo = cuts[next];
  }
  visit(lo, end);
}

/// s (end - begin) / int dz / a.
class MeanRate {
 public:
  explicit MeanRate(const Scene<double>& scene) : scene_(scene), knots_(scene.knots()) {}

  double operator()(double begin, double end) {
    double travel_time = 0;
    double rate = 0;
    std::size_t n_pieces = 0;
    for_pieces(knots_, next_, begin, end, [&](double lo, double hi) {
      rate = scene_.mean_rate(lo, hi);
      travel_time += (hi - lo) / rate;
      ++n_pieces;
    });
    // One piece: without the rounding of a division and its inverse, cells of a layer are equal to the bit.
    return scene_.scale() * (n_pieces == 1 ? rate : (end - begin) / travel_time);
  }

 private:
  const Scene<double>& scene_;
  std::vector<double> knots_;
  std::size_t next_ = 0;
};

/// Mean of c over intervals, ascending as above; 1 in a scene without solid fraction.
class MeanPacking {
 public:
  explicit MeanPacking(const Scene<double>& scene) : scene_(scene) {
    if (scene.spec().solid_fraction) knots_ = scene.knots();
  }

  double operator()(double begin, double end) {
    if (!scene_.spec().solid_fraction) return 1;
    double solid = 0, mean = 0;
    std::size_t n_pieces = 0;
    for_pieces(knots_, next_, begin, end, [&](double lo, double hi) {
      mean = scene_.mean_packing(lo, hi);
      solid += (hi - lo) * mean;
      ++n_pieces;
    });
    return n_pieces == 1 ? mean : solid / (end - begin);
  }

 private:
  const Scene<double>& scene_;
  std::vector<double> knots_;
  std::size_t next_ = 0;
};

}  // namespace

Grid aligned_grid(const Scene<double>& scene, std::size_t n_cells) {
  const double bottom = scene.bottom(), top = scene.top();
  std::vector<double> cuts{bottom};
  for (const double z : scene.knots()) cuts.push_back(z);
  cuts.push_back(top);
  Grid grid{bottom, top, 0, {bottom}, {}};
  const auto cells_below = [&](double z) {
    return std::round((z - bottom) / (top - bottom) * static_cast<double>(n_cells));
  };
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k) {
    const double n = std::max(1.0, cells_below(cuts[k + 1]) - cells_below(cuts[k]));
    const double thickness = cuts[k + 1] - cuts[k];
    for (double i = 1; i < n; ++i) grid.edges.push_back(cuts[k] + thickness * (i / n));
    grid.edges.push_back(cuts[k + 1]);
    grid.widths.resize(grid.edges.size() - 1, thickness / n);
  }
  grid.n_cells = grid.widths.size();
  return grid;
}

std::vector<double> initial_averages(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> averages(grid.n_cells);
  MeanPacking solid_fraction(scene);
  std::size_t next = 0;
  for (std::size_t j = 0; j < grid.n_cells; ++j) {
    const double begin = grid.edge(j), end = grid.edge(j + 1);
    CompensatedSum<double> sum, solid;
    double least = scene.initial_share(begin), most = least;
    for_pieces(scene.initial_breaks(), next, begin, end, [&](double lo, double hi) {
      const double share = scene.initial_share(lo), weight = (hi - lo) * solid_fraction(lo, hi);
      sum += weight * share;
      solid += weight;
      least = std::min(least, share), most = std::max(most, share);
    });
    const double weight = scene.spec().solid_fraction ? solid.value() : end - begin;
    averages[j] = std::clamp(sum.value() / weight, least, most);  // exact where the cell is all one state
  }
  return averages;
}

std::vector<double> cell_packings(const Scene<double>& scene, const Grid& grid) {
  if (!scene.spec().solid_fraction) return {};
  std::vector<double> packings(grid.n_cells);
  MeanPacking mean(scene);
  for (std::size_t j = 0; j < grid.n_cells; ++j) packings[j] = mean(grid.edge(j), grid.edge(j + 1));
  return packings;
}

std::vector<double> capacities(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> capacities = cell_packings(scene, grid);
  if (capacities.empty()) return grid.widths;
  for (std::size_t j = 0; j < grid.n_cells; ++j)
    capacities[j] *= grid.widths.empty() ? grid.cell_width() : grid.widths[j];
  return capacities;
}

std::vector<double> cell_rates(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> rates(grid.n_cells);
  MeanRate mean(scene);
  MeanPacking solid_fraction(scene);
  for (std::size_t j = 0; j < grid.n_cells; ++j)
    rates[j] = mean(grid.edge(j), grid.edge(j + 1)) * solid_fraction(grid.edge(j), grid.edge(j + 1));
  return rates;
}

std::vector<double> face_rates(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> rates(grid.n_cells + 1, 0.0);
  MeanRate mean(scene);
  MeanPacking solid_fraction(scene);
  for (std::size_t j = 1; j < grid.n_cells; ++j)
    rates[j] = mean(grid.middle(j - 1), grid.middle(j)) * solid_fraction(grid.middle(j - 1), grid.middle(j));
  return rates;
}

std::vector<double> face_values(const Scene<double>& scene, const Grid& grid) {
  std::vector<double> rates(grid.n_cells + 1, 0.0);
  for (std::size_t j = 1; j < grid.n_cells; ++j)
    rates[j] = scene.scale() * scene.rate_at(grid.edge(j)) * scene.solid_fraction_at(grid.edge(j));
  return rates;
}

}  // namespace shearfront::fv
