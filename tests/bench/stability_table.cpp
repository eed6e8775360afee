// SPDX-License-Identifier: BSD-3-Clause
// Prints the tables of docs/evidence/stability.md: every hard case in double and in 50 digits, side by side. Each cell
// is the largest error and, in brackets, how far the 50-digit result moves when the numbers of the scene are
// moved by up to their own rounding (s among them, which moves every t): what no computation in double can
// avoid.
//   shearfront_stability_table [scenes [text]]     number of random scenes, default 10000; only rows whose
//                                                  name, "tracker: ..." or "exact: ...", contains the text
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "shearfront/digits/real110.hpp"
#include "support/hard_points.hpp"
#include "support/side_by_side.hpp"

namespace shearfront {
namespace {

using support::Differences;
using support::ExactDifferences;
using support::ExactRun;
using support::HardCase;
using support::HardPoints;
using support::Point;

/// Digits lost: how many powers of ten an error exceeds the rounding of one double.
double digits(double error) { return error > 0x1p-53 ? std::log10(error / 0x1p-53) : 0; }

/// One quantity of one case.
struct Cell {
  double error, moved;

  [[nodiscard]] double lost() const { return digits(error); }
  /// Digits lost beyond what the data's own rounding costs.
  [[nodiscard]] double unexplained() const { return digits(error / std::max(1.0, moved / 0x1p-53)); }
};

void print_row(const std::string& name, const std::string& counts, const std::vector<Cell>& cells,
               bool has_moved) {
  std::printf("| %s | %s |", name.c_str(), counts.c_str());
  double lost = 0, unexplained = 0;
  for (const Cell& c : cells) {
    lost = std::max(lost, c.lost());
    unexplained = std::max(unexplained, c.unexplained());
    if (has_moved) {
      std::printf(" %.1e (%.0e) |", c.error, c.moved);
    } else {
      std::printf(" %.1e |", c.error);
    }
  }
  has_moved ? std::printf(" %.1f | %.1f |\n", lost, unexplained) : std::printf(" %.1f | |\n", lost);
  std::fflush(stdout);
}

void print(const std::string& name, const Differences& error, const Differences& moved, bool has_moved) {
  // Collisions that carry other names after the move cannot be compared one by one.
  const bool same = moved.unmatched == 0;
  const std::string counts = std::to_string(error.events) + " | " + std::to_string(error.unmatched) + " | " +
                             std::to_string(error.displaced);
  print_row(name, counts,
            {{error.time, same ? moved.time : 0},
             {error.place, same ? moved.place : 0},
             {error.position, moved.position},
             {error.M, moved.M},
             {error.t_star, moved.t_star}},
            has_moved);
}

void print(const std::string& name, const ExactDifferences& error, const ExactDifferences& moved,
           bool has_moved) {
  print_row(name, std::to_string(error.points) + " | " + std::to_string(error.other_path),
            {{error.M, moved.M},
             {error.phi, moved.phi},
             {error.H, moved.H},
             {error.first, moved.first},
             {error.last, moved.last},
             {error.dM, moved.dM},
             {error.dphi, moved.dphi}},
            has_moved);
}

void track(const Scene<double>& scene, double resolution, const std::vector<double>& times, int n_moves,
           Differences& error, Differences& moved) {
  const auto oracle = support::run(scene_cast<Real110>(scene), resolution, times);
  error.add(compare(support::run(scene, resolution, times), oracle));
  for (int i = 1; i <= n_moves; ++i) {
    const auto other =
        support::run(support::perturbed(scene, static_cast<std::uint64_t>(i)), resolution, times);
    moved.add(compare(other, oracle));
  }
}

void evaluate(const Scene<double>& scene, const std::vector<Point>& points, bool with_timeline, int n_moves,
              ExactDifferences& error, ExactDifferences& moved) {
  const ExactRun<Real110> oracle(scene_cast<Real110>(scene), points, with_timeline);
  error.add(compare(ExactRun<double>(scene, points, with_timeline), oracle));
  for (int i = 1; i <= n_moves; ++i)
    moved.add(compare(
        ExactRun<Real110>(support::perturbed(scene, static_cast<std::uint64_t>(i)), points, with_timeline),
        oracle));
}

/// Which rows are asked for.
struct Rows {
  int n_scenes = 10000;
  std::string text;

  [[nodiscard]] bool wanted(const std::string& name) const { return name.find(text) != std::string::npos; }
};

void tracker_table(const Rows& rows) {
  std::printf(
      "| case | collisions | unmatched | out of order | time | place | fronts | M | t* | digits lost | "
      "of them not by the data |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const bool slow : {false, true}) {
    for (const HardCase& c : slow ? support::slow_hard_cases() : support::hard_cases()) {
      if (!rows.wanted("tracker: " + c.name)) continue;
      Differences error, moved;
      track(c.scene, c.resolution, c.times, c.n_moves, error, moved);
      print(c.name, error, moved, c.n_moves > 0);
    }
  }
  Differences error, moved;
  const std::string random = std::to_string(rows.n_scenes) + " random scenes";
  if (!rows.wanted("tracker: " + random)) return;
  for (int n = 0; n < rows.n_scenes; ++n)
    track(support::random_scene(static_cast<std::uint64_t>(n)), 0.1,
          {support::random_time(static_cast<std::uint64_t>(n))}, 1, error, moved);
  print(random, error, moved, true);
}

void exact_table(const Rows& rows) {
  std::printf(
      "| case | points | other path | M | phi | H | first times | last times | dM | dphi | digits lost | "
      "of them not by the data |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const bool slow : {false, true}) {
    for (const HardPoints& c : slow ? support::slow_hard_points() : support::hard_points()) {
      if (!rows.wanted("exact: " + c.name)) continue;
      ExactDifferences error, moved;
      evaluate(c.scene, c.points, c.with_timeline, c.n_moves, error, moved);
      print(c.name, error, moved, c.n_moves > 0);
    }
  }
  ExactDifferences error, moved;
  const std::string random = std::to_string(rows.n_scenes) + " random scenes";
  if (!rows.wanted("exact: " + random)) return;
  for (int n = 0; n < rows.n_scenes; ++n) {
    const Scene<double> scene = support::random_scene(static_cast<std::uint64_t>(n));
    evaluate(scene, support::random_points(scene, 10, static_cast<std::uint64_t>(n)), true, 1, error, moved);
  }
  print(random, error, moved, true);
}

}  // namespace
}  // namespace shearfront

int main(int argc, char** argv) {
  shearfront::Rows rows;
  if (argc > 1) rows.n_scenes = std::atoi(argv[1]);
  if (argc > 2) rows.text = argv[2];
  shearfront::tracker_table(rows);
  std::printf("\n");
  shearfront::exact_table(rows);
}
