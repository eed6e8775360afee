// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/fv/octaves.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace shearfront::fv {
namespace {

constexpr std::size_t kLeastCells = 2 * kLanes;

struct Stretch {
  std::size_t n_cells;
  int octave;
};

/// Joins stretches of the same octave, and short ones to a faster neighbour. One pass from the bottom: what
/// has been passed is in order; a stretch that changes is looked at again together with the one below it.
std::vector<Stretch> joined(const std::vector<Stretch>& stretches) {
  std::vector<Stretch> out;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    out.push_back(stretches[i]);
    for (bool changes = true; changes;) {
      changes = false;
      const std::size_t n = out.size();
      if (n > 1 && out[n - 2].octave == out[n - 1].octave) {
        out[n - 2].n_cells += out[n - 1].n_cells;
        out.pop_back();
        changes = true;
        continue;
      }
      // The last but one has both its neighbours.
      if (n > 1 && out[n - 2].n_cells < kLeastCells) {
        Stretch& middle = out[n - 2];
        int faster = middle.octave;
        if (out[n - 1].octave < middle.octave) faster = out[n - 1].octave;
        if (n > 2 && out[n - 3].octave < middle.octave)
          faster = faster < middle.octave ? std::max(faster, out[n - 3].octave) : out[n - 3].octave;
        if (faster < middle.octave) {
          middle.octave = faster;
          changes = true;
          if (n > 2 && out[n - 3].octave == faster) {
            out[n - 3].n_cells += middle.n_cells;
            out.erase(out.end() - 2);
          }
        }
      }
    }
  }
  return out;
}

}  // namespace

std::vector<int> octaves_of(const CellData& data) {
  constexpr double kMostUpdates = 0x1p28;
  const std::size_t n = data.phi.size();
  double fastest = 0;
  for (std::size_t j = 0; j < n; ++j) fastest = std::max(fastest, speed_of(data, j));
  const int most = std::max(0, std::ilogb(kMostUpdates / static_cast<double>(n)));
  std::vector<Stretch> stretches;
  for (std::size_t j = 0; j < n; ++j) {
    const double speed = speed_of(data, j);
    const int octave = speed > 0 ? std::min(most, std::ilogb(fastest / speed)) : 0;
    if (stretches.empty() || stretches.back().octave != octave) stretches.push_back({0, octave});
    ++stretches.back().n_cells;
  }
  for (std::size_t size = stretches.size() + 1; stretches.size() < size;) {
    size = stretches.size();
    stretches = joined(stretches);
    // The last stretch has no neighbour above that would have looked at it.
    if (stretches.size() > 1 && stretches.back().n_cells < kLeastCells &&
        stretches[stretches.size() - 2].octave < stretches.back().octave)
      stretches.back().octave = stretches[stretches.size() - 2].octave;
  }
  if (stretches.size() == 1) return {};
  std::vector<int> octaves;
  octaves.reserve(n);
  for (const Stretch& stretch : stretches) octaves.insert(octaves.end(), stretch.n_cells, stretch.octave);
  return octaves;
}

}  // namespace shearfront::fv
