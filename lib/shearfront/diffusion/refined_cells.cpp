// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/diffusion/refined_cells.hpp"

#include <algorithm>
#include <cmath>

#include "shearfront/numeric/contract.hpp"

namespace shearfront::diffusion {

RefinedCells::RefinedCells(double bottom, double top, std::size_t n) : bottom_(bottom), top_(top) {
  SHEARFRONT_EXPECTS(n >= 2 && bottom < top, "at least two cells");
  for (int level = 0; level <= kMostHalvings; ++level)
    shares_[static_cast<std::size_t>(level)] = std::ldexp(1 / static_cast<double>(n), -level);
  const double narrowest = 0x1p-40 * std::max(std::abs(bottom), std::abs(top));
  while (most_halvings_ < kMostHalvings &&
         (top - bottom) * shares_[static_cast<std::size_t>(most_halvings_) + 1] >= narrowest)
    ++most_halvings_;
  for (std::size_t j = 0; j < n; ++j) cells_.push_back({0, j});
}

bool RefinedCells::are_too_wide_for(std::span<const double> wanted_widths) const {
  for (std::size_t j = 0; j < cells_.size(); ++j)
    if (cells_[j].level == most_halvings_ && (top_ - bottom_) * share(cells_[j]) > 2 * wanted_widths[j])
      return true;
  return false;
}

std::vector<double> RefinedCells::faces() const {
  std::vector<double> faces;
  faces.reserve(cells_.size() + 1);
  for (const Cell& cell : cells_)
    faces.push_back(bottom_ + (top_ - bottom_) * (static_cast<double>(cell.index) * share(cell)));
  faces.push_back(top_);
  return faces;
}

bool RefinedCells::are_halves(std::size_t j) const {
  return j + 1 < cells_.size() && cells_[j].level > 0 && cells_[j].index % 2 == 0 &&
         cells_[j + 1].level == cells_[j].level;
}

std::vector<CellChange> RefinedCells::changes_towards(std::span<const double> wanted_widths) const {
  // The halves of a cell want a little less than it did: without a margin they would merge again at once.
  constexpr double kMergeAbove = 2.2;
  SHEARFRONT_EXPECTS(wanted_widths.size() == cells_.size(), "a width for each cell");
  std::vector<CellChange> changes(cells_.size(), CellChange::keep);
  for (std::size_t j = 0; j < cells_.size(); ++j) {
    const double own = (top_ - bottom_) * share(cells_[j]);
    if (own > wanted_widths[j] && cells_[j].level < most_halvings_) {
      changes[j] = CellChange::split;
    } else if (are_halves(j) && std::min(wanted_widths[j], wanted_widths[j + 1]) >= kMergeAbove * own) {
      changes[j] = changes[j + 1] = CellChange::merge;
      ++j;
    }
  }
  return changes;
}

void RefinedCells::apply(std::span<const CellChange> changes) {
  SHEARFRONT_EXPECTS(changes.size() == cells_.size(), "a change for each cell");
  std::vector<Cell> next;
  next.reserve(cells_.size());
  for (std::size_t j = 0; j < cells_.size(); ++j) {
    const auto [level, index] = cells_[j];
    switch (changes[j]) {
      case CellChange::keep:
        next.push_back({level, index});
        break;
      case CellChange::split:
        next.push_back({level + 1, 2 * index});
        next.push_back({level + 1, 2 * index + 1});
        break;
      case CellChange::merge:
        SHEARFRONT_EXPECTS(are_halves(j) && changes[j + 1] == CellChange::merge, "two halves");
        next.push_back({level - 1, index / 2});
        ++j;
        break;
    }
  }
  cells_ = std::move(next);
}

}  // namespace shearfront::diffusion
