// SPDX-License-Identifier: BSD-3-Clause
#include "cli/table.hpp"

#include <algorithm>

namespace shearfront::tools {

std::string TextTable::text() const {
  const std::size_t n_columns = rows_.front().size();
  std::vector<std::size_t> widths(n_columns);
  for (std::size_t c = 0; c < n_columns; ++c) {
    const bool is_used =
        std::any_of(rows_.begin() + 1, rows_.end(), [&](const auto& r) { return !r[c].empty(); });
    if (!is_used) continue;
    for (const auto& row : rows_) widths[c] = std::max(widths[c], row[c].size());
  }
  std::string all;
  for (const auto& row : rows_) {
    std::string line;
    for (std::size_t c = 0; c < n_columns; ++c) {
      if (widths[c] == 0) continue;
      line += row[c] + std::string(widths[c] - row[c].size() + 2, ' ');
    }
    line.erase(line.find_last_not_of(' ') + 1);
    all += line + '\n';
  }
  return all;
}

}  // namespace shearfront::tools
