// SPDX-License-Identifier: BSD-3-Clause
#include "shearfront/slab/slab_march.hpp"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <cmath>
#include <span>
#include <thread>
#include <utility>
#include <variant>

#include "shearfront/diffusion/extended_flux.hpp"
#include "shearfront/numeric/contract.hpp"
#include "shearfront/slab/rows.hpp"

namespace shearfront::slab {
namespace {

/// Fewer cells, a tenth of a millisecond of work, are not worth a thread: all wait for each other twice a step.
constexpr std::size_t kLeastCells = 8192;

/// The part of [from, to] that lies in [lo, hi].
double overlap(double from, double to, double lo, double hi) {
  return std::max(0.0, std::min(to, hi) - std::max(from, lo)) / (to - from);
}

std::size_t n_threads(const Settings& settings) {
  if (settings.threads > 0) return std::min(settings.threads, settings.cells_x);
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  return std::clamp<std::size_t>(settings.cells * settings.cells_x / kLeastCells, 1, cores);
}

}  // namespace

SlabMarch::SlabMarch(const Scene<double>& scene, const Settings& settings)
    : n_x_(settings.cells_x),
      n_z_(settings.cells),
      bottom_(scene.bottom()),
      height_(scene.top() - scene.bottom()),
      length_(scene.spec().slab->length) {
  SHEARFRONT_EXPECTS(scene.is_slab() && n_x_ >= 3 && n_z_ >= 2, "a slab and its grid");
  for (std::size_t k = 0; k < n_threads(settings); ++k) columns_.push_back(make_column(scene, n_z_));
  const double dz = height_ / static_cast<double>(n_z_);
  for (std::size_t j = 0; j < n_z_; ++j) {
    const double lo = bottom_ + static_cast<double>(j) * dz, hi = j + 1 == n_z_ ? scene.top() : lo + dz;
    const auto& u = scene.spec().velocity;
    velocities_.push_back(
        u ? std::visit([&](const auto& model) { return model.flow(lo, hi); }, *u) / (hi - lo) : 0);
    diffusivities_.push_back(scene.diffusivity_at(lo + (hi - lo) / 2));
  }
  set_start(scene);
  choose_step(scene, settings.time_step);
}

void SlabMarch::set_start(const Scene<double>& scene) {
  states_.resize(n_x_ * n_z_);
  const double dz = height_ / static_cast<double>(n_z_), dx = width_x();
  for (std::size_t i = 0; i < n_x_; ++i)
    for (std::size_t j = 0; j < n_z_; ++j) {
      const double x = static_cast<double>(i) * dx, z = bottom_ + static_cast<double>(j) * dz;
      double& phi = states_[i * n_z_ + j];
      if (const auto& block = scene.spec().initial_block) {
        const double inside =
            overlap(x, x + dx, block->x[0], block->x[1]) * overlap(z, z + dz, block->z[0], block->z[1]);
        phi = block->outside + inside * (block->inside - block->outside);
      } else {
        const double top = j + 1 == n_z_ ? scene.top() : z + dz;
        phi = scene.initial_amount(z, top) / (top - z);
      }
    }
}

void SlabMarch::choose_step(const Scene<double>& scene, double wanted) {
  const double dz = height_ / static_cast<double>(n_z_), dx = width_x();
  const auto [slowest, fastest] = std::minmax_element(velocities_.begin(), velocities_.end());
  const double largest_d = *std::max_element(diffusivities_.begin(), diffusivities_.end());
  double fastest_wave = 0;
  for (const Flux<double>& flux : scene.fluxes())
    fastest_wave = std::max(fastest_wave, diffusion::fastest_slope(flux));
  double largest_rate = 0;
  for (std::size_t j = 0; j < n_z_; ++j)
    largest_rate =
        std::max(largest_rate, scene.scale() * scene.rate_at(bottom_ + (static_cast<double>(j) + 0.5) * dz));
  longest_step_ = std::min({columns_.front()->largest_step(), dz / (largest_rate * fastest_wave),
                            *fastest > *slowest ? dx / (*fastest - *slowest) : infinity<double>(),
                            largest_d > 0 ? dx * dx / largest_d : infinity<double>()});
  if (wanted > 0) longest_step_ = wanted;
}

Status SlabMarch::advance_to(double t, const Progress& progress) {
  SHEARFRONT_EXPECTS(t >= time_ && std::isfinite(t), "forward in time");
  if (!(t > time_)) return Status::ok;
  const double n = std::max(1.0, std::ceil((t - time_) / longest_step_ * (1 - 1e-12)));
  const Status status = march(static_cast<std::size_t>(n), (t - time_) / n, progress);
  if (status == Status::ok) time_ = t;
  return status;
}

Status SlabMarch::march(std::size_t n, double h, const Progress& progress) {
  std::vector<double> shift, spread;
  for (std::size_t j = 0; j < n_z_; ++j) {
    shift.push_back(velocities_[j] * h / width_x());
    spread.push_back(diffusivities_[j] * h / (width_x() * width_x()));
  }
  const Rows rows(n_x_, std::move(shift), spread);
  const std::size_t n_workers = columns_.size(), block = 8, n_blocks = (n_z_ + block - 1) / block;
  std::atomic<bool> has_failed = false, is_asked_to_stop = false;
  std::barrier wait(static_cast<std::ptrdiff_t>(n_workers));
  const auto work = [&](std::size_t k) {
    const auto advance_columns = [&](double dt) {
      for (std::size_t i = k * n_x_ / n_workers; i < (k + 1) * n_x_ / n_workers; ++i)
        if (!columns_[k]->advance(std::span<double>(&states_[i * n_z_], n_z_), dt)) has_failed = true;
    };
    advance_columns(h / 2);
    for (std::size_t s = 1; s <= n; ++s) {
      if (k == 0 && progress &&
          !progress(time_ + static_cast<double>(s) * h, n_cell_updates_ + s * n_x_ * n_z_))
        is_asked_to_stop = true;
      wait.arrive_and_wait();
      // Both are set between the other barrier and this one: all workers read the same.
      if (has_failed || is_asked_to_stop) return;
      rows.advance(states_.data(), n_z_, std::min(n_z_, k * n_blocks / n_workers * block),
                   std::min(n_z_, (k + 1) * n_blocks / n_workers * block));
      wait.arrive_and_wait();
      advance_columns(s == n ? h / 2 : h);
    }
  };
  std::vector<std::thread> others;
  for (std::size_t k = 1; k < n_workers; ++k) others.emplace_back(work, k);
  work(0);
  for (std::thread& other : others) other.join();
  n_steps_ += n;
  n_cell_updates_ += n * n_x_ * n_z_;
  return has_failed ? Status::not_converged : is_asked_to_stop ? Status::interrupted : Status::ok;
}

Profile<double> SlabMarch::profile(std::size_t i) const {
  return columns_.front()->profile(std::span<const double>(&states_[i * n_z_], n_z_));
}

Profile<double> SlabMarch::mean_profile() const {
  std::vector<double> mean(n_z_);
  for (std::size_t i = 0; i < n_x_; ++i)
    for (std::size_t j = 0; j < n_z_; ++j) mean[j] += states_[i * n_z_ + j];
  for (double& phi : mean) phi /= static_cast<double>(n_x_);
  return columns_.front()->profile(mean);
}

}  // namespace shearfront::slab
