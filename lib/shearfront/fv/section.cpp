// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/section.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "shearfront/fv/special_faces.hpp"

namespace shearfront::fv {
namespace {

// States and coefficients of one block take 2 * 8 * 1024 bytes: they stay in any first-level cache.
constexpr std::size_t kBlock = 1024;
// Each step of a block lies kLanes cells lower than the one before, so a block can take so many at once.
static_assert(Section::kDepth * kLanes < kBlock);

/// Changes of v per flux in cell j, relative to those of a cell of reference width in the shortest step.
double unit_of(const CellData& data, std::size_t j) {
  const double narrowness = data.narrowness.empty() ? 1 : data.narrowness[j];
  return data.octaves.empty() ? narrowness : std::ldexp(narrowness, data.octaves[j]);
}
int octave_of(const CellData& data, std::size_t j) { return data.octaves.empty() ? 0 : data.octaves[j]; }

}  // namespace

double speed_of(const CellData& data, std::size_t j) {
  const bool is_per_cell = data.rates.size() == data.phi.size();
  const double rate = is_per_cell ? data.rates[j] : std::max(data.rates[j], data.rates[j + 1]);
  return data.narrowness.empty() ? rate : rate * data.narrowness[j];
}

Section::Section(const Kernel& kernel, const CellData& data, std::size_t first, std::size_t n, double lo,
                 double hi, std::array<double, 2> walls)
    : octave_(octave_of(data, first)), first_(first), n_(n) {
  const std::size_t end = first + n;
  copies_below_ = first > 0 && octave_of(data, first - 1) > octave_ ? kLanes : 0;
  copies_above_ = end < data.phi.size() && octave_of(data, end) > octave_ ? kLanes : 0;
  const std::size_t begin = first - copies_below_, n_all = copies_below_ + n + copies_above_;
  n_padded_ = (n_all + kLanes - 1) / kLanes * kLanes;
  const KernelNumbers numbers = kernel.numbers();
  bottom_ = {numbers.rest, numbers.rest, walls[0], walls[0]};
  // Cells beyond the ends have coefficient 0: the walls, and a number of cells that is a multiple of kLanes.
  // Their states are those of the walls: what collects there.
  const std::size_t size = kLanes + n_padded_ + kReadAhead;
  v_.assign(size, walls[1]);
  std::fill_n(v_.begin(), kLanes, walls[0]);
  c_.assign(size, 0.0);
  const bool is_per_cell = data.rates.size() == data.phi.size();
  bool has_ratio = false;
  for (std::size_t i = 0; i < n_all; ++i) {
    const std::size_t j = begin + i;
    const double v = 2 * ((data.phi[j] - lo) / (hi - lo)) - 1;
    v_[kLanes + i] = std::nearbyint(v / numbers.quantum) * numbers.quantum;
    if (i > 0 && unit_of(data, j) != unit_of(data, j - 1)) has_ratio = true;
    if (data.fastest > 0 && (is_per_cell || i > 0))
      c_[kLanes + i] =
          data.coefficient * (data.rates[j] * unit_of(data, is_per_cell ? j : j - 1) / data.fastest);
  }
  if (has_ratio) {
    ratio_.assign(n_padded_ + kReadAhead, 1.0);
    remainder_.assign(n_padded_ + kReadAhead, 0.0);
    carry_.assign(n_padded_ + kReadAhead, 0.0);
    faster_side_.assign(n_padded_ + kReadAhead, FasterSide::none);
    for (std::size_t i = 1; i < n_all; ++i)
      ratio_[i] = unit_of(data, begin + i) / unit_of(data, begin + i - 1);
    if (copies_below_ > 0) faster_side_[copies_below_] = FasterSide::above;
    if (copies_above_ > 0) faster_side_[copies_below_ + n] = FasterSide::below;
  }
  is_per_cell_ = is_per_cell;
  is_special_.assign((n_padded_ + kReadAhead) / kLanes, 0);
  const Faces all = faces(0);
  for (std::size_t i = 1; i < n_all; ++i)
    if (all.below[i] != all.above[i] || (has_ratio && ratio_[i] != 1))
      is_special_[i / kLanes] = is_special_[(i - 1) / kLanes] = 1;
}

Faces Section::faces(std::size_t first) {
  const double* above = c_.data() + kLanes + first;
  Faces faces{is_per_cell_ ? above - 1 : above, above, is_special_.data() + first / kLanes};
  if (!ratio_.empty()) {
    faces.ratio = ratio_.data() + first;
    faces.remainder = remainder_.data() + first;
    faces.faster_side = faster_side_.data() + first;
    faces.carry = carry_.data() + first;
  }
  return faces;
}

void Section::shorten(double fraction) {
  for (double& c : c_) c *= fraction;
}

void Section::sweep(const Kernel& kernel, std::size_t steps) {
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
      below[k] = kernel.step(v_.data() + kLanes + begin, faces(begin), below[k], end - begin);
    }
  }
}

void Section::half_rises(const Kernel& kernel, std::vector<double>& rises) {
  rises.resize(n_padded_);
  kernel.half_rises(v_.data() + kLanes, faces(0), rises.data(), n_padded_);
  rises.erase(rises.begin(), rises.begin() + static_cast<std::ptrdiff_t>(copies_below_));
}

double& Border::slow(Section& below, Section& above, std::size_t i) const {
  return is_faster_below_ ? above.states()[i] : below.states()[below.n_ - 1 - i];
}

double& Border::copy(Section& below, Section& above, std::size_t i) const {
  return is_faster_below_ ? below.states()[below.n_ + i] : *(above.states() - 1 - i);
}

void Border::collect(Section& below, Section& above, double quantum) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    double& moved = copy(below, above, i);
    const double state = slow(below, above, i);
    if (i < kCells) sums_[i] += static_cast<Sum>((moved - state) / quantum);
    moved = state;
  }
}

bool Border::has_equal_cells(const Section& fast) const {
  if (fast.ratio_.empty()) return true;
  const std::size_t n = fast.copies_below_ + (is_faster_below_ ? fast.n_ : 0);  // cells below the border
  for (std::size_t i = 1; i < kCells; ++i)
    if (fast.ratio_[is_faster_below_ ? n + i : n - i] != 1) return false;
  return true;
}

void Border::deliver(Section& below, Section& above, double quantum) {
  Section& fast = is_faster_below_ ? below : above;
  const int halvings = std::abs(below.octave_ - above.octave_);
  const double n_steps = std::ldexp(1.0, halvings);
  const std::size_t face = fast.copies_below_ + (is_faster_below_ ? fast.n_ : 0);
  // What has not come through the border yet.
  owed_[0] += (is_faster_below_ ? 1 : -1) * fast.remainder_[face] / n_steps;
  fast.remainder_[face] = fast.carry_[face] = 0;
  // Means from the innermost cell outwards: the flux through its inner face is the same in all steps. Between
  // cells of equal width every other face gets a whole number of quanta; a quantum is not the same amount in
  // cells of unequal width, so there each keeps what it is owed.
  const bool is_equal = has_equal_cells(fast);
  std::array<double, kCells> states{};
  Sum sum = 0, delivered = 0;
  for (std::size_t i = kCells; i-- > 0;) {
    sum = sums_[i] + (is_equal ? sum : 0);
    delivered = is_equal ? delivered : 0;
    const Sum mean = (sum + (Sum{1} << halvings) / 2) >> halvings;
    states[i] = copy(below, above, i) + static_cast<double>(mean - delivered) * quantum;
    delivered = mean;
    sums_[i] = 0;
    if (!is_equal || i == 0)
      owed_[i] += static_cast<double>(sum - (delivered << halvings)) / n_steps * quantum;
  }
  for (std::size_t i = 0; i < kCells; ++i) {
    const double due = std::nearbyint(owed_[i] / quantum) * quantum;
    owed_[i] -= due;
    states[i] += due;
  }
  // Roundings may leave a cell that is all but pure a quantum beyond its bounds: there is room beside it, or,
  // where cells are unequal, in time.
  double excess = 0;
  const auto pass_on = [&](std::size_t i) {
    const double wanted = states[i] + excess;
    states[i] = std::clamp(wanted, -1.0, 1.0);
    excess = wanted - states[i];
    if (!is_equal) owed_[i] += std::exchange(excess, 0);
  };
  for (std::size_t i = kCells; i-- > 0;) pass_on(i);
  for (std::size_t i = 0; i < kCells; ++i) pass_on(i);
  owed_[0] += excess;
  for (std::size_t i = 0; i < kCells; ++i) slow(below, above, i) = states[i];
  for (std::size_t i = 0; i < kLanes; ++i) copy(below, above, i) = slow(below, above, i);
}

}  // namespace shearfront::fv
