// SPDX-License-Identifier: BSD-3-Clause
// All engines on random scenes, every law checked, for as long as wanted:
//     shearfront_soak --minutes 60 [--seed S] [--threads T]
//     shearfront_soak --seed S --scenes 1       replays the scene of a violation
#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "soak/curved.hpp"
#include "soak/laws.hpp"

namespace {

using namespace shearfront;
using Clock = std::chrono::steady_clock;

volatile std::sig_atomic_t interrupted = 0;
extern "C" void remember_interrupt(int /*signal*/) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
}

struct Settings {
  double minutes = 1;
  std::uint64_t seed = 1, scenes = UINT64_MAX;
  unsigned threads = 1;
  double seconds_per_scene = 120;
  bool print = false, curved_only = false;
};

class Soak {
 public:
  explicit Soak(const Settings& settings)
      : settings_(settings), next_(settings.seed), workers_(settings.threads) {}

  /// True if no law was violated.
  bool run() {
    std::vector<std::thread> threads;
    for (Worker& worker : workers_) threads.emplace_back([this, &worker] { work(worker); });
    std::thread watch([this] { watch_for_hangs(); });
    for (std::thread& thread : threads) thread.join();
    is_done_ = true;
    watch.join();
    print_summary();
    return total_.n_violations == 0;
  }

 private:
  struct Worker {
    std::atomic<std::uint64_t> seed{0};
    std::atomic<Clock::rep> begin{0};  // 0: at rest
  };

  [[nodiscard]] bool is_over() const {
    return interrupted ||
           std::chrono::duration<double>(Clock::now() - begin_).count() > 60 * settings_.minutes;
  }

  void work(Worker& worker) {
    while (!is_over()) {
      const std::uint64_t seed = next_++;
      if (seed - settings_.seed >= settings_.scenes) return;
      worker.seed = seed;
      if (!settings_.curved_only) {
        worker.begin = Clock::now().time_since_epoch().count();
        check(
            seed, [&] { return soak::check_trial(soak::draw_trial(seed)); },
            [&] { return soak::text_of(soak::draw_trial(seed)); });
        worker.begin = Clock::now().time_since_epoch().count();
        check(
            seed, [&] { return soak::check_any_kind(seed); }, [&] { return soak::text_of_any_kind(seed); });
      }
      worker.begin = Clock::now().time_since_epoch().count();
      check(
          seed, [&] { return soak::check_curved(soak::draw_curved(seed)); },
          [&] { return soak::text_of(soak::draw_curved(seed)); });
      worker.begin = 0;
    }
  }

  template <class Check, class Text>
  void check(std::uint64_t seed, Check&& laws, Text&& text) {
    if (settings_.print) std::printf("%s\n", text().c_str());
    soak::Findings findings;
    try {
      findings = laws();
    } catch (const std::exception& error) {
      findings.n_scenes = 1;
      findings.complain("no engine throws", error.what());
    }
    const std::lock_guard lock(mutex_);
    total_.add(findings);
    for (const auto& [law, places] : findings.violations()) {
      std::printf("VIOLATED  %s\n", law.c_str());
      for (const std::string& place : places) std::printf("    %s\n", place.c_str());
    }
    if (!findings.violations().empty()) {
      std::printf("    replay: --seed %llu --scenes 1\n%s\n", static_cast<unsigned long long>(seed),
                  text().c_str());
      std::fflush(stdout);
    }
  }

  /// A computation cannot be stopped from outside: a scene that takes too long is reported and ends the run.
  void watch_for_hangs() {
    while (!is_done_) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      for (const Worker& worker : workers_) {
        const Clock::rep begin = worker.begin;
        if (begin == 0) continue;
        const Clock::duration time = Clock::now().time_since_epoch() - Clock::duration(begin);
        if (std::chrono::duration<double>(time).count() < settings_.seconds_per_scene) continue;
        const std::lock_guard lock(mutex_);
        std::printf(
            "VIOLATED  every scene ends within %g s\n%s\n", settings_.seconds_per_scene,
            (soak::text_of(soak::draw_trial(worker.seed)) + "or\n" + soak::text_of_any_kind(worker.seed) +
             "or\n" + soak::text_of(soak::draw_curved(worker.seed)))
                .c_str());
        ++total_.n_violations;
        print_summary();
        std::_Exit(1);
      }
    }
  }

  void print_summary() const {
    const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
    std::printf(
        "soak: %llu scenes, %llu runs (%llu cut short), %llu collisions, %llu cell updates, %llu laws "
        "checked, "
        "%llu violations, %.0f s, seeds from %llu\n",
        number(total_.n_scenes), number(total_.n_runs), number(total_.n_cut_short),
        number(total_.n_collisions), number(total_.n_cell_updates), number(total_.n_checked),
        number(total_.n_violations), std::chrono::duration<double>(Clock::now() - begin_).count(),
        number(settings_.seed));
    std::fflush(stdout);
  }

  const Settings settings_;
  const Clock::time_point begin_ = Clock::now();
  std::atomic<std::uint64_t> next_;
  std::vector<Worker> workers_;
  std::atomic<bool> is_done_{false};
  std::mutex mutex_;
  soak::Findings total_;
};

}  // namespace

int main(int argc, char** argv) {
  Settings settings;
  CLI::App app("Random scenes through all engines of shearfront; every law is checked.");
  app.add_option("--minutes", settings.minutes, "How long")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--seed", settings.seed, "Seed of the first scene; each next one has the next seed")
      ->capture_default_str();
  app.add_option("--scenes", settings.scenes, "Stop after so many scenes")->check(CLI::PositiveNumber);
  app.add_option("--threads", settings.threads, "Scenes at the same time")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  app.add_option("--seconds-per-scene", settings.seconds_per_scene,
                 "A scene that takes longer is a violation")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_flag("--curved", settings.curved_only, "Only the laws of curved fronts");
  app.add_flag("--print", settings.print, "Print every scene");
  CLI11_PARSE(app, argc, argv);
  std::signal(SIGINT, remember_interrupt);
  return Soak(settings).run() ? 0 : 1;
}
