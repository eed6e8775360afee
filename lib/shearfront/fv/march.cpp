// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/march.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/numeric/contract.hpp"

namespace shearfront::fv {
namespace {

// States and coefficients of one block take 2 * 8 * 1024 bytes: they stay in any first-level cache.
constexpr std::size_t kBlock = 1024;
// Each step of a block lies kLanes cells lower than the one before, so a block can take so many at once.
constexpr std::size_t kDepth = 64;
static_assert(kDepth * kLanes < kBlock);

}  // namespace

March::March(const Kernel& kernel, const UnimodalFlux& flux, const std::vector<double>& phi,
             const std::vector<double>& rates, double cfl)
    : kernel_(kernel),
      lo_(flux.lo),
      hi_(flux.hi),
      n_cells_(phi.size()),
      n_padded_((n_cells_ + kLanes - 1) / kLanes * kLanes),
      per_cell_(rates.size() == n_cells_) {
  SHEARFRONT_EXPECTS(per_cell_ || rates.size() == n_cells_ + 1, "one rate per cell or face");
  const double fastest = *std::max_element(rates.begin(), rates.end());
  const KernelNumbers numbers = kernel.numbers();
  speed_ = flux.largest_slope * fastest / numbers.largest_courant;
  const std::size_t size = kLanes + n_padded_ + kReadAhead;
  // Cells beyond the top have coefficient 0: the wall, and a number of cells that is a multiple of kLanes.
  // Their states are those of the walls: what collects there.
  c_.assign(size, 0.0);
  if (fastest > 0)
    for (std::size_t j = 0; j < rates.size(); ++j)
      c_[kLanes + j] = (cfl * numbers.largest_courant * numbers.coefficient_weight) * (rates[j] / fastest);
  const double at_bottom = flux.is_minimum ? 1 : -1;
  bottom_ = {numbers.rest, numbers.rest, at_bottom, at_bottom};
  v_.assign(size, -at_bottom);
  std::fill_n(v_.begin(), kLanes, at_bottom);
  for (std::size_t j = 0; j < n_cells_; ++j) {
    const double v = 2 * ((phi[j] - lo_) / (hi_ - lo_)) - 1;
    v_[kLanes + j] = std::nearbyint(v / numbers.quantum) * numbers.quantum;
  }
  find_special_faces();
}

void March::find_special_faces() {
  is_special_.assign((n_padded_ + kReadAhead) / kLanes, 0);
  const Faces all = faces(c_, 0);
  for (std::size_t i = 1; i < n_cells_; ++i)
    if (all.below[i] != all.above[i]) is_special_[i / kLanes] = is_special_[(i - 1) / kLanes] = 1;
}

Faces March::faces(const std::vector<double>& c, std::size_t first) const {
  const double* above = c.data() + kLanes + first;
  return {per_cell_ ? above - 1 : above, above, is_special_.data() + first / kLanes};
}

void March::sweep(std::vector<double>& v, const std::vector<double>& c, std::size_t steps) {
  // A block's k-th step takes the cells [begin - k kLanes, end - k kLanes). Their neighbours above are at
  // step k already, thanks to the block's own last step; of the neighbours below, one step ahead by now, what
  // is needed at the common face was kept when the block below took this step.
  FaceBelow below[kDepth];
  std::fill_n(below, steps, bottom_);
  const std::size_t n_blocks = std::max<std::size_t>(1, n_padded_ / kBlock);
  for (std::size_t block = 0; block < n_blocks; ++block) {
    const bool is_last = block + 1 == n_blocks;
    for (std::size_t k = 0; k < steps; ++k) {
      const std::size_t begin = block == 0 ? 0 : block * kBlock - k * kLanes;
      const std::size_t end = is_last ? n_padded_ : (block + 1) * kBlock - k * kLanes;
      below[k] = kernel_.step(v.data() + kLanes + begin, faces(c, begin), below[k], end - begin);
    }
  }
}

void March::advance(std::uint64_t steps) {
  n_steps_ += steps;
  for (; steps > kDepth; steps -= kDepth) sweep(v_, c_, kDepth);
  sweep(v_, c_, static_cast<std::size_t>(steps));
}

bool March::is_at_rest() {
  side_v_ = v_;
  sweep(side_v_, c_, 1);
  return side_v_ == v_;
}

CellStates March::states(double fraction) {
  side_v_ = v_;
  if (fraction > 0) {
    side_c_.resize(c_.size());
    std::transform(c_.begin(), c_.end(), side_c_.begin(), [&](double c) { return c * fraction; });
    sweep(side_v_, side_c_, 1);
  }
  double* v = side_v_.data() + kLanes;
  if (kernel_.numbers().has_slopes) {
    rises_.resize(n_padded_);
    kernel_.half_rises(v, faces(c_, 0), rises_.data(), n_padded_);
    for (double& rise : rises_) rise *= (hi_ - lo_) / 2;
  }
  for (std::size_t j = 0; j < n_cells_; ++j) v[j] = lo_ + (hi_ - lo_) * ((1 + v[j]) / 2);
  return {{v, n_cells_}, {rises_.data(), rises_.empty() ? 0 : n_cells_}};
}

namespace {

/// alpha >= m of the two mixed cells of an Engquist-Osher shock that hold `amount` together.
double upper_mixed_state(const UnimodalFlux& flux, double amount) {
  const double m = flux.extremum - flux.lo, width = flux.hi - flux.lo;
  const double sign = flux.is_minimum ? 1 : -1;
  const auto value = [&](double x) { return sign * flux.value(flux.lo + x); };
  double below = std::max(m, amount - m), above = std::min(width, amount);
  constexpr int kHalvings = 60;  // beyond the digits of a double
  for (int i = 0; i < kHalvings; ++i) {
    const double alpha = below + (above - below) / 2;
    (value(alpha) + value(amount - alpha) < value(m) ? below : above) = alpha;
  }
  return below + (above - below) / 2;
}

}  // namespace

std::vector<double> steady_state(Scheme scheme, const UnimodalFlux& flux, double total, std::size_t n_cells) {
  const double width = flux.hi - flux.lo, n = static_cast<double>(n_cells);
  std::vector<double> phi(n_cells, flux.lo);
  double amount = std::clamp(total - n * flux.lo, 0.0, n * width);
  // With the top wall next to it the last cell holds what is left.
  const double m = scheme == Scheme::engquist_osher ? flux.extremum - flux.lo : 0;
  const double full = std::clamp(std::floor((amount - m) / width), 0.0, n - 1);
  const auto n_full = static_cast<std::size_t>(full);
  std::fill_n(phi.begin(), n_full, flux.hi);
  amount = std::max(0.0, amount - full * width);
  const bool has_two = scheme == Scheme::engquist_osher && amount > m && n_full + 1 < n_cells;
  const double alpha = has_two ? upper_mixed_state(flux, amount) : std::min(amount, width);
  phi[n_full] = flux.lo + alpha;
  if (has_two) phi[n_full + 1] = flux.lo + (amount - alpha);
  if (!flux.is_minimum) std::reverse(phi.begin(), phi.end());
  return phi;
}

}  // namespace shearfront::fv
