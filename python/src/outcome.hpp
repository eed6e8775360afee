// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <nanobind/nanobind.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "shearfront/solution/summary.hpp"
#include "shearfront/solver/solver.hpp"

/// How a computation ended, as Python hears of it.
namespace shearfront::python {

namespace nb = nanobind;

/// Becomes shearfront.NoResult.
class Unusable : public std::runtime_error {
 public:
  Unusable(Status status, const std::string& message) : std::runtime_error(message), status_(status) {}
  [[nodiscard]] Status status() const { return status_; }

 private:
  Status status_;
};

inline void expect_usable(const Summary& summary) {
  if (!summary.usable()) throw Unusable(summary.status, summary.message);
}

/// Lets Ctrl-C end a computation that runs without the interpreter's lock: asks twenty times a second. Where it is called every
/// microsecond it looks at the clock only once in kMostUnlooked calls.
class SignalWatch {
 public:
  /// For what calls it with whatever arguments; false to stop.
  template <class... Ignored>
  bool operator()(Ignored...) {
    if (++n_calls_ < n_between_looks_) return true;
    n_calls_ = 0;
    const auto now = std::chrono::steady_clock::now();
    const bool is_fast = now - looked_ < std::chrono::milliseconds(1);
    n_between_looks_ = is_fast ? std::min<std::size_t>(2 * n_between_looks_, kMostUnlooked) : 1;
    looked_ = now;
    if (now - last_ < std::chrono::milliseconds(50)) return true;
    last_ = now;
    const nb::gil_scoped_acquire lock;
    is_interrupted_ = is_interrupted_ || PyErr_CheckSignals() != 0;
    return !is_interrupted_;
  }
  /// Precondition: the lock is held.
  void raise_if_interrupted() const {
    if (is_interrupted_) throw nb::python_error();
  }

 private:
  static constexpr std::size_t kMostUnlooked = 64;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now(), looked_ = last_;
  std::size_t n_calls_ = 0, n_between_looks_ = 1;
  bool is_interrupted_ = false;
};

/// Runs without the interpreter's lock; Ctrl-C raises KeyboardInterrupt. `compute(progress)` takes a Progress.
template <class Compute>
auto without_lock(Compute&& compute) {
  SignalWatch watch;
  auto result = [&] {
    const nb::gil_scoped_release release;
    return compute([&watch](auto... values) { return watch(values...); });
  }();
  watch.raise_if_interrupted();
  return result;
}

[[nodiscard]] nb::dict dict_of(const Summary& summary);

void bind_models(nb::module_& m);
void bind_scene(nb::module_& m);
void bind_solve(nb::module_& m);
void bind_tracking(nb::module_& m);
void bind_observations(nb::module_& m);
void bind_fit(nb::module_& m);
void bind_estimate(nb::module_& m);
void bind_misfit(nb::module_& m);
void bind_posterior(nb::module_& m);

}  // namespace shearfront::python
