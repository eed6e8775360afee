// SPDX-License-Identifier: BSD-3-Clause
// The ladder queue against a sorted set, under the patterns of use that make it cut, spill and compact.
#include "shearfront/track/event_queue.hpp"

#include <gtest/gtest.h>

#include <set>
#include <utility>

#include "support/random_scene.hpp"

namespace shearfront {
namespace {

using Queue = EventQueue<double>;

/// The reference: correct by construction, slow.
class Reference {
 public:
  void push(const Meeting<double>& m) { set_.insert({m.key, m.id}); }
  std::pair<double, std::uint32_t> pop() {
    const auto first = *set_.begin();
    set_.erase(set_.begin());
    return first;
  }
  [[nodiscard]] bool empty() const { return set_.empty(); }

 private:
  std::set<std::pair<double, std::uint32_t>> set_;
};

/// Pops everything, pushing up to `children` later meetings for each: what a tracker does.
void run(std::size_t n, int children, double spread, std::uint64_t seed) {
  support::SceneMaker maker(support::seed_of(seed));
  Queue queue;
  Reference reference;
  std::uint32_t id = 0;
  const auto push = [&](double time) {
    queue.push({time, id, 0});
    reference.push({time, id, 0});
    ++id;
  };
  for (std::size_t i = 0; i < n; ++i) push(maker.uniform(0, 1));
  std::size_t budget = 2 * n;
  while (!queue.empty()) {
    ASSERT_FALSE(reference.empty());
    const auto expected = reference.pop();
    const Meeting<double> first = queue.first();
    queue.pop();
    ASSERT_EQ(first.key, expected.first);
    ASSERT_EQ(first.id, expected.second);
    for (int c = 0; c < children && budget > 0; ++c, --budget)
      push(first.key + spread * (maker.integer(0, 3) == 0 ? 0.0 : maker.uniform(0, 1)));
  }
  EXPECT_TRUE(reference.empty());
}

TEST(EventQueue, PopsInTotalOrderWhateverTheSize) {
  for (const std::size_t n : {1u, 2u, 100u, 3000u, 40000u}) run(n, 0, 0, n);
}
TEST(EventQueue, TakesNewMeetingsWhileItIsRead) {
  for (const double spread : {1e-9, 1e-3, 0.1, 10.0}) run(20000, 2, spread, 7);
}
TEST(EventQueue, GrowsFromNothing) { run(1, 3, 1.0, 3); }

TEST(EventQueue, ManyMeetingsAtOneTime) {
  Queue queue;
  for (std::uint32_t id = 50000; id-- > 0;) queue.push({1.0, id, 0});
  for (std::uint32_t id = 0; id < 50000; ++id) {
    ASSERT_EQ(queue.first().id, id);
    queue.pop();
  }
  EXPECT_TRUE(queue.empty());
}

TEST(EventQueue, CompactDropsOnlyWhatIsStale) {
  for (const std::size_t read : {0u, 10u, 5000u}) {
    Queue queue;
    support::SceneMaker maker(support::seed_of(5));
    for (std::uint32_t id = 0; id < 20000; ++id) queue.push({maker.uniform(0, 1), id, id % 3});
    for (std::size_t i = 0; i < read; ++i) {
      (void)queue.first();
      queue.pop();
    }
    queue.compact([](const Meeting<double>& m) { return m.stamp == 0; });
    double last = 0;
    std::size_t count = 0;
    while (!queue.empty()) {
      const Meeting<double> m = queue.first();
      queue.pop();
      ASSERT_EQ(m.stamp, 0u);
      ASSERT_GE(m.key, last);
      last = m.key;
      ++count;
    }
    EXPECT_LE(count, 6667u);
    EXPECT_GE(count + read, 6667u);
  }
}

}  // namespace
}  // namespace shearfront
