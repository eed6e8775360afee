// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// A predicted meeting of node `id` with its upper neighbour. Valid as long as the node's stamp equals
/// `stamp`: stamps of a slot only ever grow, also when the slot is given to a new front, so (id, stamp) names
/// one prediction for ever.
template <Real Scalar>
struct Meeting {
  Scalar time;
  std::uint32_t id;
  std::uint32_t stamp;
};

/// Priority queue of meetings with a total order (time, id), so that runs are reproducible to the bit.
/// Implicit 4-ary heap: half the depth of a binary one, and the four children of a node share a cache line.
/// Cost: push and pop O(log n); n_stale entries are dropped by compact().
template <Real Scalar>
class EventQueue {
 public:
  using Entry = Meeting<Scalar>;

  [[nodiscard]] bool empty() const { return heap_.empty(); }
  [[nodiscard]] std::size_t size() const { return heap_.size(); }
  [[nodiscard]] const Entry& first() const { return heap_.front(); }

  void push(const Entry& entry) {
    std::size_t hole = heap_.size();
    heap_.push_back(entry);
    while (hole > 0) {
      const std::size_t parent = (hole - 1) / kArity;
      if (!before(entry, heap_[parent])) break;
      heap_[hole] = heap_[parent];
      hole = parent;
    }
    heap_[hole] = entry;
  }
  void pop() {
    const Entry last = heap_.back();
    heap_.pop_back();
    if (!heap_.empty()) sift_down(0, last);
  }
  /// Adds without ordering; order() must follow before anything else.
  void append(const Entry& entry) { heap_.push_back(entry); }
  /// Restores the heap after append(): O(n).
  void order() {
    if (heap_.size() < 2) return;
    for (std::size_t i = (heap_.size() - 2) / kArity + 1; i-- > 0;) sift_down(i, Entry(heap_[i]));
  }
  /// Drops every entry for which is_valid is false: O(n).
  template <class IsValid>
  void compact(IsValid&& is_valid) {
    heap_.erase(std::remove_if(heap_.begin(), heap_.end(), [&](const Entry& e) { return !is_valid(e); }),
                heap_.end());
    order();
  }

 private:
  static constexpr std::size_t kArity = 4;
  static bool before(const Entry& a, const Entry& b) {
    return a.time < b.time || (a.time == b.time && a.id < b.id);
  }

  void sift_down(std::size_t hole, const Entry& entry) {
    const std::size_t n = heap_.size();
    for (;;) {
      const std::size_t child = kArity * hole + 1;
      if (child >= n) break;
      const std::size_t end = std::min(child + kArity, n);
      std::size_t best = child;
      for (std::size_t c = child + 1; c < end; ++c)
        if (before(heap_[c], heap_[best])) best = c;
      if (!before(heap_[best], entry)) break;
      heap_[hole] = heap_[best];
      hole = best;
    }
    heap_[hole] = entry;
  }

  std::vector<Entry> heap_;
};

}  // namespace shearfront
