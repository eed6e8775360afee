// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/march.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "shearfront/numeric/contract.hpp"

namespace shearfront::fv {

March::March(const Kernel& kernel, const UnimodalFlux& flux, CellData data, double cfl)
    : kernel_(kernel), lo_(flux.lo), hi_(flux.hi), quantum_(kernel.numbers().quantum) {
  // The fast kernel knows a minimum only: a parabola with a maximum is one for the share of the other grains.
  const bool is_reflected = kernel.numbers().is_for_minima && !flux.is_minimum;
  if (is_reflected) std::swap(lo_, hi_);
  const std::size_t n = data.phi.size();
  SHEARFRONT_EXPECTS(data.rates.size() == n || data.rates.size() == n + 1, "one rate per cell or face");
  const KernelNumbers numbers = kernel.numbers();
  data.coefficient = cfl * numbers.largest_courant * numbers.coefficient_weight;
  data.fastest = 0;
  for (std::size_t j = 0; j < n; ++j) data.fastest = std::max(data.fastest, speed_of(data, j));
  for (const int octave : data.octaves) slowest_octave_ = std::max(slowest_octave_, octave);
  speed_ = flux.largest_slope * data.fastest / numbers.largest_courant / std::ldexp(1.0, slowest_octave_);
  const double at_bottom = flux.is_minimum || is_reflected ? 1 : -1;
  for (std::size_t first = 0, end = 0; first < n; first = end) {
    end = first + 1;
    if (data.octaves.empty()) end = n;
    while (end < n && data.octaves[end] == data.octaves[first]) ++end;
    const auto& section = bed_.sections.emplace_back(kernel, data, first, end - first, lo_, hi_,
                                                     std::array<double, 2>{at_bottom, -at_bottom});
    updates_per_step_ += (end - first) << (slowest_octave_ - section.octave());
    if (end < n) bed_.borders.emplace_back(data.octaves[first] < data.octaves[end]);
  }
  phi_.resize(n);
}

void March::step(Bed& bed, int octave) const {
  if (octave > 0) {
    step(bed, octave - 1);
    step(bed, octave - 1);
  }
  for (std::size_t i = 0; i < bed.sections.size(); ++i) {
    Section& section = bed.sections[i];
    if (section.octave() != octave) continue;
    section.sweep(kernel_, 1);
    if (i > 0) {
      Border& border = bed.borders[i - 1];
      border.is_faster_below() ? border.deliver(bed.sections[i - 1], section, quantum_)
                               : border.collect(bed.sections[i - 1], section, quantum_);
    }
    if (i + 1 < bed.sections.size()) {
      Border& border = bed.borders[i];
      border.is_faster_below() ? border.collect(section, bed.sections[i + 1], quantum_)
                               : border.deliver(section, bed.sections[i + 1], quantum_);
    }
  }
}

void March::advance(std::uint64_t steps) {
  n_steps_ += steps;
  if (bed_.sections.size() > 1) {
    for (; steps > 0; --steps) step(bed_, slowest_octave_);
    return;
  }
  for (; steps > Section::kDepth; steps -= Section::kDepth) bed_.sections[0].sweep(kernel_, Section::kDepth);
  bed_.sections[0].sweep(kernel_, static_cast<std::size_t>(steps));
}

bool March::is_at_rest() {
  side_ = bed_;
  const auto is_back = [&] {
    for (std::size_t i = 0; i < bed_.sections.size(); ++i)
      if (!side_.sections[i].has_states_of(bed_.sections[i])) return false;
    return true;
  };
  // The two mixed cells of an Engquist-Osher shock may hand a quantum to and fro for ever.
  constexpr int kLongestCycle = 4;
  for (int n = 0; n < kLongestCycle; ++n) {
    step(side_, slowest_octave_);
    if (is_back()) return true;
  }
  return false;
}

CellStates March::states(double fraction) {
  side_ = bed_;
  if (fraction > 0) {
    for (Section& section : side_.sections) section.shorten(fraction);
    step(side_, slowest_octave_);
  }
  const bool has_slopes = kernel_.numbers().has_slopes;
  if (has_slopes) half_rises_.resize(phi_.size());
  for (Section& section : side_.sections) {
    const double* v = section.states();
    if (has_slopes) section.half_rises(kernel_, section_rises_);
    for (std::size_t j = 0; j < section.n_cells(); ++j) {
      phi_[section.first() + j] = lo_ + (hi_ - lo_) * ((1 + v[j]) / 2);
      if (has_slopes) half_rises_[section.first() + j] = section_rises_[j] * ((hi_ - lo_) / 2);
    }
  }
  return {phi_, half_rises_};
}

namespace {

/// alpha >= m of the two mixed cells of an Engquist-Osher shock that hold `amount` together.
double upper_mixed_state(const UnimodalFlux& flux, double amount, double width_below, double width_above) {
  const double m = flux.extremum - flux.lo, width = flux.hi - flux.lo;
  const double sign = flux.is_minimum ? 1 : -1;
  const auto value = [&](double x) { return sign * flux.value(flux.lo + std::clamp(x, 0.0, width)); };
  double below = m, above = width;
  constexpr int kHalvings = 60;  // beyond the digits of a double
  for (int i = 0; i < kHalvings; ++i) {
    const double alpha = below + (above - below) / 2, beta = (amount - width_below * alpha) / width_above;
    // beta > m: too little in the first; beta < 0: too much.
    const bool is_low = beta > m || (beta > 0 && value(alpha) + value(beta) < value(m));
    (is_low ? below : above) = alpha;
  }
  return below + (above - below) / 2;
}

}  // namespace

std::vector<double> steady_state(Scheme scheme, const UnimodalFlux& flux, double total,
                                 const std::vector<double>& widths) {
  const std::size_t n = widths.size();
  const double range = flux.hi - flux.lo;
  std::vector<double> phi(n, flux.lo);
  const auto cell = [&](std::size_t i) { return flux.is_minimum ? i : n - 1 - i; };
  double height = 0;
  for (const double width : widths) height += width;
  double amount = std::clamp(total - height * flux.lo, 0.0, height * range);
  const double m = scheme == Scheme::engquist_osher ? flux.extremum - flux.lo : 0;
  // With the wall next to it the last cell holds what is left.
  std::size_t i = 0;
  for (; i + 1 < n; ++i) {
    const double width = widths[cell(i)];
    if (amount < width * range + m * widths[cell(i + 1)]) break;
    phi[cell(i)] = flux.hi;
    amount = std::max(0.0, amount - width * range);
  }
  const double width = widths[cell(i)];
  if (scheme == Scheme::engquist_osher && i + 1 < n && amount > m * width) {
    const double above = widths[cell(i + 1)], alpha = upper_mixed_state(flux, amount, width, above);
    phi[cell(i)] = flux.lo + alpha;
    phi[cell(i + 1)] = flux.lo + std::clamp((amount - width * alpha) / above, 0.0, range);
  } else {
    phi[cell(i)] = flux.lo + std::min(amount / width, range);
  }
  return phi;
}

}  // namespace shearfront::fv
