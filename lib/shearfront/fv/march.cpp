// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/march.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/fv/vectorised.hpp"
#include "shearfront/model/flux/all.hpp"
#include "shearfront/numeric/sum.hpp"

namespace shearfront::fv {
namespace {

/// To a multiple of March::kQuantum, for |amount| <= 1: the digits of 3 + amount end there.
SHEARFRONT_FV_INLINE double whole(double amount) { return (amount + 3) - 3; }

/// v of the cells, at most `limit` in size.
SHEARFRONT_FV_VECTORISED
void read_states(const double* __restrict amounts, const double* __restrict inverses, double limit,
                 double* __restrict v, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) {
    double x = amounts[j] * inverses[j];
    x = x < limit ? x : limit;
    v[j] = x > -limit ? x : -limit;
  }
}

/// crossing[j] is what comes into cell j from below.
SHEARFRONT_FV_VECTORISED
void move_amounts(double* __restrict amounts, const double* __restrict crossing, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) amounts[j] -= crossing[j + 1] - crossing[j];
}

SHEARFRONT_FV_VECTORISED
void average_stages(double* __restrict crossing, const double* __restrict second, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) crossing[j] = whole(0.5 * (crossing[j] + second[j]));
}

SHEARFRONT_FV_VECTORISED
void edge_states(const double* __restrict v, const double* __restrict rises, double* __restrict bottoms,
                 double* __restrict tops, std::size_t n) {
  for (std::size_t j = 0; j < n; ++j) bottoms[j] = v[j] - rises[j], tops[j] = v[j] + rises[j];
}

// The faces between cells of one flux with one extremum, seen as a minimum (FluxShape): upward(l) = f(max(l, m)),
// downward(r) = f(min(r, m)), both(l, r) = upward(l) + downward(r) - f(m).

/// f = v^2 - 1. The extremum is no constant: GCC 12 would make branches of a comparison with 0.
struct ParabolaSides {
  double extremum;

  SHEARFRONT_FV_INLINE double square_above(double l) const { return square(l > extremum ? l : extremum); }
  SHEARFRONT_FV_INLINE double square_below(double r) const { return square(r < extremum ? r : extremum); }
  SHEARFRONT_FV_INLINE double upward(double l) const { return square_above(l) - 1; }
  SHEARFRONT_FV_INLINE double downward(double r) const { return square_below(r) - 1; }
  SHEARFRONT_FV_INLINE double both(double l, double r) const { return upward(l) + square_below(r); }
  SHEARFRONT_FV_INLINE static double square(double x) { return x * x; }
};

template <class Model>
struct Sides {
  const Model& f;
  const FluxShape& shape;
  double extremum = shape.state(shape.extremum()), at_extremum = value(extremum);

  [[nodiscard]] double value(double v) const { return shape.sign * f.value(shape.share(v)); }
  [[nodiscard]] double upward(double l) const { return value(std::max(l, extremum)); }
  [[nodiscard]] double downward(double r) const { return value(std::min(r, extremum)); }
  [[nodiscard]] double both(double l, double r) const { return upward(l) + (downward(r) - at_extremum); }
};

struct Faces {
  const double *below, *above;      ///< states
  const double *k_below, *k_above;  ///< coefficients
  double scale;
  std::size_t n;
};

template <class Flux>
SHEARFRONT_FV_INLINE void cross_by_godunov(const Flux& f, const Faces& faces, double* __restrict crossing) {
  const double* __restrict below = faces.below, * __restrict above = faces.above;
  const double* __restrict k_below = faces.k_below, * __restrict k_above = faces.k_above;
  const double scale = faces.scale;
  for (std::size_t i = 0; i < faces.n; ++i) {
    const double from_below = k_below[i] * f.upward(below[i]), from_above = k_above[i] * f.downward(above[i]);
    crossing[i] = whole(scale * (from_below > from_above ? from_below : from_above));
  }
}
template <class Flux>
SHEARFRONT_FV_INLINE void cross_by_engquist_osher(const Flux& f, const Faces& faces,
                                                  double* __restrict crossing) {
  const double* __restrict below = faces.below, * __restrict above = faces.above;
  const double* __restrict k = faces.k_below;
  const double scale = faces.scale;
  for (std::size_t i = 0; i < faces.n; ++i) crossing[i] = whole(scale * (k[i] * f.both(below[i], above[i])));
}

SHEARFRONT_FV_VECTORISED
void parabola_by_godunov(const Faces& faces, double extremum, double* crossing) {
  cross_by_godunov(ParabolaSides{extremum}, faces, crossing);
}
SHEARFRONT_FV_VECTORISED
void parabola_by_engquist_osher(const Faces& faces, double extremum, double* crossing) {
  cross_by_engquist_osher(ParabolaSides{extremum}, faces, crossing);
}

/// What the lower one of the two mixed cells of an Engquist-Osher shock holds (above v = -1) of their `amount`.
double lower_of_pair(const FluxShape& flux, double amount, double capacity_below, double capacity_above) {
  const double extremum = flux.state(flux.extremum());
  const auto value = [&](double v) { return flux.sign * flux.value(flux.share(std::clamp(v, -1.0, 1.0))); };
  double low = (1 + extremum) * capacity_below, high = 2 * capacity_below;
  constexpr int kHalvings = 60;  // beyond the digits of a double
  for (int i = 0; i < kHalvings; ++i) {
    const double here = low + (high - low) / 2;
    const double alpha = here / capacity_below - 1, beta = (amount - here) / capacity_above - 1;
    const bool is_low = beta > extremum || (beta > -1 && value(alpha) + value(beta) < value(extremum));
    (is_low ? low : high) = here;
  }
  return low + (high - low) / 2;
}

}  // namespace

March::March(const Scheme& scheme, const Scene<double>& scene, const Grid& grid)
    : scheme_(scheme),
      rates_(cell_rates(scene, grid)),
      limit_(is_monotone(scheme.rule) ? 1 : infinity<double>()),
      is_periodic_(scene.spec().is_periodic),
      outside_{std::nan(""), std::nan("")} {
  const std::size_t n = grid.n_cells();
  for (std::size_t j = 0; j < n; ++j) {  // the middle of a cell says which flux it has
    const Flux<double>& flux = scene.flux_at(grid.middle(j));
    if (j == 0 || &flux != &scene.flux_at(grid.middle(j - 1))) parts_.push_back({FluxShape(flux), j, n});
    if (parts_.size() > 1) parts_[parts_.size() - 2].end = parts_.back().first;
  }
  set_face_rates(scene, grid);
  if (scheme.limiter) {
    muscl_.emplace(*scheme.limiter, scene.is_layered() ? rates_ : std::vector<double>{});
    stages_.emplace(n);
  }
  const std::vector<double> contents = fv::capacities(scene, grid), x = initial_shares(scene, grid);
  double fastest = 0;
  for (const Part& part : parts_)
    for (std::size_t j = part.first; j < part.end; ++j) {
      capacities_.push_back(contents[j] * ((part.flux.hi - part.flux.lo) / 2));
      const double k = face_rates_.empty() ? rates_[j] : std::max(face_rates_[j], face_rates_[j + 1]);
      fastest = std::max(fastest, k * part.flux.largest_slope / contents[j]);
      crossing_time_ += contents[j] / (rates_[j] * part.flux.largest_slope);
    }
  largest_step_ = (limit_ == 1 && !scheme.limiter ? 1 : 0.5) / fastest;
  unit_ = *std::max_element(capacities_.begin(), capacities_.end());
  for (const Part& part : parts_)
    for (std::size_t j = part.first; j < part.end; ++j) {
      const double capacity = capacities_[j] = std::max(whole(capacities_[j] / unit_), kQuantum);
      amounts_.push_back(whole(capacity * part.flux.state(x[j])));
      inverses_.push_back(1 / capacity);
      if (capacity * inverses_[j] < 1) inverses_[j] = std::nextafter(inverses_[j], infinity<double>());
      if (limit_ != 1) solid_fractions_.push_back(contents[j] / grid.widths[j]);
    }
  has_steady_state_ =
      scene.has_walls() && limit_ == 1 && std::all_of(parts_.begin(), parts_.end(), [](const Part& part) {
        return part.flux.has_one_extremum() && part.flux.vanishes;
      });
}

void March::set_face_rates(const Scene<double>& scene, const Grid& grid) {
  if (parts_.front().flux.is_monotone()) return;  // each cell has its own
  const bool is_smooth = scheme_.limiter && !scene.is_layered();
  if (scheme_.rule != Rule::engquist_osher && !is_smooth) return;
  const bool is_value = is_smooth || scheme_.face_coefficient == FaceCoefficient::value;
  face_rates_ = is_value ? face_values(scene, grid) : fv::face_rates(scene, grid);
  if (is_periodic_) face_rates_.front() = face_rates_.back() = 2 / (1 / rates_.front() + 1 / rates_.back());
  if (scene.spec().outside_bottom) face_rates_.front() = rates_.front();
  if (scene.spec().outside_top) face_rates_.back() = rates_.back();
  // Between different fluxes Godunov's flux counts, with the coefficients of both cells.
  for (std::size_t i = 1; i < parts_.size(); ++i) {
    const std::size_t j = parts_[i].first;
    face_rates_[j] = std::max(rates_[j - 1], rates_[j]);
  }
}

double March::state(std::size_t j) const { return std::clamp(amounts_[j] * inverses_[j], -limit_, limit_); }

double March::end_flux(std::size_t end) const {
  if (!is_periodic_ && std::isnan(outside_[end])) return 0;
  const Part &lowest = parts_.front(), &highest = parts_.back();
  const std::size_t last = n_cells() - 1;
  const double sign = lowest.flux.sign;
  const FaceSide bottom = side(lowest, 0, state(0)), top = side(highest, last, state(last));
  if (is_periodic_)
    return sign * face_flux(scheme_.rule, top, bottom, face_rates_.empty() ? 0 : face_rates_.front());
  const Rule rule = limit_ == 1 ? Rule::godunov : scheme_.rule;
  FaceSide outside = end == 0 ? bottom : top;
  outside.x = outside_[end];
  return sign * (end == 0 ? face_flux(rule, outside, bottom, 0) : face_flux(rule, top, outside, 0));
}

void March::step(double dt) { muscl_ ? second_order_step(dt / unit_) : first_order_step(dt / unit_); }

void March::restart(std::span<const double> shares) {
  for (const Part& part : parts_)
    for (std::size_t j = part.first; j < part.end; ++j)
      amounts_[j] = whole(capacities_[j] * part.flux.state(shares[j]));
}

void March::first_order_step(double scale) {
  constexpr std::size_t kBlock = 256;  // small enough for the first cache
  // v[i + 1] belongs to cell first + i, crossing[i + 1] to the face below it; what is at 0 the last block has left.
  alignas(64) std::array<double, kBlock + 1> v, crossing;
  v[0] = crossing[0] = 0;
  const double at_bottom = whole(scale * end_flux(0)), at_top = whole(scale * end_flux(1));
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const Part& part = parts_[p];
    for (std::size_t first = part.first; first < part.end; first += kBlock) {
      const std::size_t n = std::min(kBlock, part.end - first), begin = first == part.first ? 1 : 0;
      read_states(&amounts_[first], &inverses_[first], limit_, &v[1], n);
      if (first == 0) {
        crossing[1] = at_bottom;
      } else if (begin == 1) {
        const FaceSide below = side(parts_[p - 1], first - 1, v[0]), above = side(part, first, v[1]);
        crossing[1] = whole(scale * part.flux.sign * face_flux(scheme_.rule, below, above, 0));
      }
      cross_faces(part, first + begin, first + n, &v[begin], &v[begin + 1], scale, &crossing[begin + 1]);
      const std::size_t skip = first == 0 ? 1 : 0;  // there is no cell below the first
      move_amounts(amounts_.data() + (first + skip - 1), &crossing[skip], n - skip);
      v[0] = v[n];
      crossing[0] = crossing[n];
    }
  }
  amounts_.back() -= at_top - crossing[0];
  inflow_ += at_bottom - at_top;
}

void March::second_order_step(double scale) {
  const std::size_t n = n_cells();
  Stages& s = *stages_;
  const auto cross = [&](const std::vector<double>& amounts, std::vector<double>& crossing) {
    read_states(amounts.data(), inverses_.data(), limit_, &s.v[1], n);
    muscl_->half_rises(parts_[0].flux, &s.v[1], s.rises.data(), n);
    edge_states(&s.v[1], s.rises.data(), s.bottoms.data(), s.tops.data(), n);
    if (n > 1) cross_faces(parts_[0], 1, n, &s.tops[0], &s.bottoms[1], scale, &crossing[1]);
  };
  cross(amounts_, s.crossing);
  s.amounts = amounts_;
  move_amounts(s.amounts.data(), s.crossing.data(), n);
  cross(s.amounts, s.second_crossing);
  average_stages(s.crossing.data(), s.second_crossing.data(), n + 1);
  move_amounts(amounts_.data(), s.crossing.data(), n);
}

void March::cross_faces(const Part& part, std::size_t first, std::size_t end, const double* below,
                        const double* above, double scale, double* crossing) const {
  const bool is_godunov = scheme_.rule == Rule::godunov || part.flux.is_monotone();
  if (limit_ != 1 || !part.flux.has_two_branches()) {
    for (std::size_t j = first; j < end; ++j) {
      const double flux =
          face_flux(scheme_.rule, side(part, j - 1, below[j - first]), side(part, j, above[j - first]),
                    face_rates_.empty() ? 0 : face_rates_[j]);
      crossing[j - first] = whole(scale * part.flux.sign * flux);
    }
    return;
  }
  const double* k = face_rates_.empty() ? rates_.data() + first : face_rates_.data() + first;
  Faces faces{below, above, face_rates_.empty() ? k - 1 : k, k, scale, end - first};
  if (part.flux.is_parabola) {
    faces.scale *= std::abs(part.flux.turn_values[1]);
    const double extremum = part.flux.state(part.flux.extremum());  // 0
    is_godunov ? parabola_by_godunov(faces, extremum, crossing)
               : parabola_by_engquist_osher(faces, extremum, crossing);
    return;
  }
  with_model(part.flux.flux, [&]<class Model>(const Model& f) {
    const Sides<Model> sides{f, part.flux};
    is_godunov ? cross_by_godunov(sides, faces, crossing) : cross_by_engquist_osher(sides, faces, crossing);
  });
}

CellShares March::shares() const {
  CellShares cells;
  std::vector<double> v(n_cells() + 2, 1.0), rises;
  read_states(amounts_.data(), inverses_.data(), limit_, &v[1], n_cells());
  for (const Part& part : parts_)
    for (std::size_t j = part.first; j < part.end; ++j) cells.x.push_back(part.flux.share(v[j + 1]));
  if (!scheme_.limiter) return cells;
  v.back() = -1;
  cells.half_rise.resize(n_cells());
  const FluxShape& flux = parts_[0].flux;
  muscl_->half_rises(flux, &v[1], cells.half_rise.data(), n_cells());
  for (std::size_t j = 0; j < n_cells(); ++j) {
    const double room = std::min(cells.x[j] - flux.lo, flux.hi - cells.x[j]);
    const double rise = flux.sign * ((flux.hi - flux.lo) / 2) * cells.half_rise[j];
    cells.half_rise[j] = std::clamp(rise, -room, room);
  }
  return cells;
}

CellShares March::shares_after(double dt) {
  if (!(dt > 0)) return shares();
  const std::vector<double> amounts = amounts_;
  const double inflow = inflow_;
  step(dt);
  CellShares cells = shares();
  amounts_ = amounts;
  inflow_ = inflow;
  return cells;
}

std::vector<double> March::settled_amounts() const {
  const std::size_t n = n_cells();
  CompensatedSum<double> spare;
  for (std::size_t j = 0; j < n; ++j) spare += amounts_[j] + capacities_[j];
  std::vector<double> settled(n);
  for (std::size_t j = 0; j < n; ++j) settled[j] = -capacities_[j];
  for (const Part& part : parts_) {
    const double extremum = part.flux.state(part.flux.extremum());
    for (std::size_t j = part.first; j < part.end; ++j) {
      const bool is_pair = scheme_.rule == Rule::engquist_osher && j + 1 < part.end;
      const double room = 2 * capacities_[j], amount = spare.value();
      if (j + 1 < n && amount >= room + (is_pair ? (1 + extremum) * capacities_[j + 1] : 0)) {
        settled[j] = capacities_[j];
        spare += -room;
        continue;
      }
      double here = std::clamp(amount, 0.0, room);
      if (is_pair && amount > (1 + extremum) * capacities_[j])
        here = lower_of_pair(part.flux, amount, capacities_[j], capacities_[j + 1]);
      settled[j] = whole(here - capacities_[j]);
      if (is_pair) settled[j + 1] = whole((amount - capacities_[j] - settled[j]) - capacities_[j + 1]);
      return settled;
    }
  }
  return settled;
}

}  // namespace shearfront::fv
