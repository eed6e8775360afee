// SPDX-License-Identifier: BSD-3-Clause
#include "slab.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "bed_course.hpp"
#include "cli/arguments.hpp"
#include "cli/command.hpp"
#include "cli/progress.hpp"
#include "plot/pictures.hpp"
#include "shearfront/io/results.hpp"
#include "shearfront/numeric/number_text.hpp"

namespace shearfront::tools {
namespace {

constexpr double kMostSlabSamples = 1e8;
// Finer than a panel can show; most panels that are large enough.
constexpr std::size_t kFramePoints = 201, kMostFrames = 12;

/// phi of each time, and where it was taken.
struct Frames {
  std::vector<double> x;
  std::vector<std::vector<double>> phi, pictures;
  Summary summary;
};

Frames run_frames(const SlabTask& task, const Progress& progress) {
  Frames frames;
  const auto run = task.method.start(task.scene, {false, false, progress, last_time(task.times)});
  const double length = task.scene.spec().slab->length;
  if (!task.positions.empty())
    frames.x = list_option("--positions", task.positions, {0, length},
                           fmt::format("between 0 and {}", number_text(length)), Steady::refused);
  const std::vector<double> fine_x = equally_spaced(0, length, kFramePoints),
                            fine_z = equally_spaced(task.scene.bottom(), task.scene.top(), kFramePoints);
  frames.phi.resize(task.times.size()), frames.pictures.resize(task.times.size());
  std::vector<std::size_t> order(task.times.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return task.times[a] < task.times[b]; });
  for (const std::size_t i : order) {
    const Status status = run->advance(task.times[i]);
    frames.summary = run->summary();
    if (status != Status::ok) return frames;
    const SlabField& field = *run->field().slab();
    if (frames.x.empty()) frames.x = field.middles();
    const double n = static_cast<double>(task.times.size()) * static_cast<double>(frames.x.size()) *
                     static_cast<double>(task.heights.size());
    if (n > kMostSlabSamples)
      refuse("--times", fmt::format("({} times)", task.times.size()),
             "must give at most 1e8 places of time, x and z; --positions and --heights choose some");
    frames.phi[i] = field.section(frames.x, task.heights);
    if (!task.map.empty()) frames.pictures[i] = field.section(fine_x, fine_z);
  }
  return frames;
}

}  // namespace

int solve_slab(const SlabTask& task) {
  if (!task.map.empty() && task.times.size() > kMostFrames)
    refuse("--map", task.map, fmt::format("must have at most {} times, a panel each", kMostFrames));
  if (const std::string why = task.method.refusal(task.scene); !why.empty()) {
    Summary refused;
    refused.status = Status::unsupported;
    refused.message = why;
    return report_unusable(refused);
  }
  OutputFile output(task.output.empty() ? "-" : task.output);
  check_picture_target(task.map);
  const Frames frames = with_progress([&](const Progress& progress) { return run_frames(task, progress); },
                                      last_time(task.times));
  if (!frames.summary.usable()) return report_unusable(frames.summary);
  const SlabSamples samples{task.times, frames.x, task.heights, frames.phi};
  if (task.json)
    write_slab_json(output, task.scene.name(), task.method.name(), samples, frames.summary,
                    task.scene.spec().units);
  else
    write_slab_csv(output, samples, task.scene.spec().units);
  output.commit();
  if (task.map.empty()) return kDone;
  const double length = task.scene.spec().slab->length;
  return draw_slab(task.map, task.scene, task.method,
                   {task.times, equally_spaced(0, length, kFramePoints),
                    equally_spaced(task.scene.bottom(), task.scene.top(), kFramePoints), frames.pictures});
}

}  // namespace shearfront::tools
