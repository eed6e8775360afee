// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <boost/sort/pdqsort/pdqsort.hpp>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shearfront/numeric/scalar.hpp"

namespace shearfront {

/// A predicted meeting of node `id` with its upper neighbour, to be handled in the order of `key`. Valid as
/// long as the node's stamp equals `stamp`: stamps of a slot only ever grow, also when the slot is given to a
/// new front, so (id, stamp) names one prediction for ever.
template <Real Scalar>
struct Meeting {
  Scalar key;
  std::uint32_t id;
  std::uint32_t stamp;

  /// Total order (key, id).
  friend bool operator<(const Meeting& a, const Meeting& b) {
    if constexpr (std::same_as<Scalar, double>) {
      // Which of two meetings comes first is a coin toss to a branch predictor: computed without a branch.
      return bool(int(a.key < b.key) | (int(a.key == b.key) & int(a.id < b.id)));
    } else {
      return a.key < b.key || (a.key == b.key && a.id < b.id);
    }
  }
};

/// Priority queue of meetings with the total order (key, id), so that runs are reproducible to the bit.
///
/// A ladder queue (after Tang, Goh & Thng 2005): meetings of the near future are a sorted run that is read
/// from front to back, plus a small heap for those predicted meanwhile; later ones lie unordered in buckets
/// of later and later times, and the latest in a rest that is cut into buckets when its turn comes. Besides
/// being cheap, the run tells which meetings come next, so that what they touch can be fetched from memory in
/// time (upcoming()). Cost: push and pop O(log 1024) amortised, whatever the size.
template <Real Scalar>
class EventQueue {
 public:
  using Entry = Meeting<Scalar>;

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// The earliest meeting. Precondition: not empty.
  [[nodiscard]] const Entry& first() {
    if (run_empty() && heap_.empty()) refill();
    return heap_first() ? heap_.front() : run_[next_in_run_];
  }
  /// Removes first().
  void pop() {
    --size_;
    if (heap_first()) {
      std::pop_heap(heap_.begin(), heap_.end(), Later{});
      heap_.pop_back();
    } else {
      ++next_in_run_;
    }
  }
  void push(const Entry& entry) {
    ++size_;
    if (entry.key < near_end_) {
      heap_.push_back(entry);
      std::push_heap(heap_.begin(), heap_.end(), Later{});
      if (heap_.size() > kLargestHeap && next_bucket_ == ends_.size()) spill();
    } else if (next_bucket_ < ends_.size()) {
      buckets_[bucket_of(entry.key)].push_back(entry);
    } else {
      rest_.push_back(entry);
    }
  }
  /// Drops every entry for which is_valid is false: O(size).
  template <class IsValid>
  void compact(IsValid&& is_valid) {
    const auto drop = [&](std::vector<Entry>& entries) {
      entries.erase(
          std::remove_if(entries.begin(), entries.end(), [&](const Entry& e) { return !is_valid(e); }),
          entries.end());
      size_ += entries.size();
    };
    size_ = 0;
    run_.erase(run_.begin(), run_.begin() + static_cast<std::ptrdiff_t>(next_in_run_));
    next_in_run_ = 0;
    drop(run_);
    drop(heap_);
    std::make_heap(heap_.begin(), heap_.end(), Later{});
    drop(rest_);
    for (std::size_t b = next_bucket_; b < ends_.size(); ++b) drop(buckets_[b]);
  }

  /// Takes everything out: take(entry) in no particular order.
  template <class Take>
  void drain(Take&& take) {
    for (std::size_t i = next_in_run_; i < run_.size(); ++i) take(run_[i]);
    for (const Entry& e : heap_) take(e);
    for (std::size_t b = next_bucket_; b < ends_.size(); ++b)
      for (const Entry& e : buckets_[b]) take(e);
    for (const Entry& e : rest_) take(e);
    *this = EventQueue();
  }

 private:
  struct Later {
    bool operator()(const Entry& a, const Entry& b) const { return b < a; }
  };
  static constexpr std::size_t kRun = 512;               // meetings wanted in a bucket
  static constexpr std::size_t kLargestHeap = 2 * kRun;  // a larger heap is cut up
  static constexpr std::size_t kBuckets = 256;
  static constexpr std::size_t kSample = 16;  // sampled times per bucket

  [[nodiscard]] bool run_empty() const { return next_in_run_ == run_.size(); }
  [[nodiscard]] bool heap_first() const {
    return !heap_.empty() && (run_empty() || heap_.front() < run_[next_in_run_]);
  }
  [[nodiscard]] std::size_t bucket_of(const Scalar& key) const {
    const auto first = ends_.begin() + static_cast<std::ptrdiff_t>(next_bucket_);
    return static_cast<std::size_t>(std::upper_bound(first, ends_.end(), key) - ends_.begin());
  }

  /// Takes the next bucket, or the rest, as the run. Precondition: run and heap are empty, size_ > 0.
  void refill() {
    run_.clear();
    next_in_run_ = 0;
    while (run_.empty()) {
      if (next_bucket_ < ends_.size()) {
        run_.swap(buckets_[next_bucket_]);
        near_end_ = ends_[next_bucket_++];
      } else if (rest_.size() <= kLargestHeap) {
        run_.swap(rest_);
        near_end_ = infinity<Scalar>();
      } else {
        cut_rest();
      }
    }
    boost::sort::pdqsort_branchless(run_.begin(), run_.end());
  }
  /// Cuts the rest into buckets of about kRun meetings (at most kBuckets) at sampled quantiles of time.
  void cut_rest() {
    const std::size_t n = std::min(kBuckets, rest_.size() / kRun + 1);
    const std::size_t stride = std::max<std::size_t>(1, rest_.size() / (n * kSample));
    std::vector<Scalar> sample;
    for (std::size_t i = 0; i < rest_.size(); i += stride) sample.push_back(rest_[i].key);
    std::sort(sample.begin(), sample.end());
    ends_.clear();
    next_bucket_ = 0;
    for (std::size_t b = 1; b < n; ++b) {
      const Scalar& end = sample[b * sample.size() / n];
      if (ends_.empty() || ends_.back() < end) ends_.push_back(end);
    }
    ends_.push_back(infinity<Scalar>());
    buckets_.resize(std::max(buckets_.size(), ends_.size()));
    for (const Entry& e : rest_) buckets_[bucket_of(e.key)].push_back(e);
    rest_.clear();
  }
  /// A heap that has grown too large goes back to the rest, with the run, to be cut.
  void spill() {
    rest_.insert(rest_.end(), heap_.begin(), heap_.end());
    heap_.clear();
    rest_.insert(rest_.end(), run_.begin() + static_cast<std::ptrdiff_t>(next_in_run_), run_.end());
    run_.clear();
    next_in_run_ = 0;
    near_end_ = Scalar(0);
  }

  std::vector<Entry> run_;  // sorted; entries before next_in_run_ are used up
  std::size_t next_in_run_ = 0;
  std::vector<Entry> heap_;  // meetings before near_end_ that came after the run was sorted
  Scalar near_end_{0};
  std::vector<std::vector<Entry>> buckets_;
  std::vector<Scalar> ends_;     // bucket b holds times in [ends_[b - 1], ends_[b])
  std::size_t next_bucket_ = 0;  // first bucket that is not used up
  std::vector<Entry> rest_;
  std::size_t size_ = 0;
};

}  // namespace shearfront
