// SPDX-License-Identifier: BSD-3-Clause
#include "threads/work_crew.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <barrier>
#include <chrono>
#include <mutex>
#include <set>
#include <thread>
#include <vector>

namespace swept::detail {
namespace {

TEST(WorkCrew, DoesAllThatItIsGivenOnce) {
  for (const unsigned threads : {0U, 1U, 2U, 5U})
    for (const std::size_t count : {0U, 1U, 3U, 1000U}) {
      std::vector<std::atomic<int>> done(count);
      {
        WorkCrew crew(threads);
        for (std::atomic<int>& one : done) crew.give([&one] { ++one; });
      }
      for (const std::atomic<int>& one : done) EXPECT_EQ(one, 1);
    }
}

TEST(WorkCrew, OfOneThreadWorksAtOnce) {
  WorkCrew crew(1);
  std::vector<int> order;
  for (int i = 0; i < 3; ++i) {
    crew.give([&order, i] { order.push_back(i); });
    EXPECT_EQ(order.back(), i);
  }
}

/// Each of them waits for the others: with fewer threads it would never end.
TEST(WorkCrew, WorksOnAsManyThreadsAsAreAsked) {
  constexpr unsigned kThreads = 4;
  std::barrier all(kThreads);
  std::mutex mutex;
  std::set<std::thread::id> who;
  {
    WorkCrew crew(kThreads);
    for (unsigned i = 0; i < kThreads; ++i)
      crew.give([&] {
        all.arrive_and_wait();
        const std::lock_guard lock(mutex);
        who.insert(std::this_thread::get_id());
      });
  }
  EXPECT_EQ(who.size(), kThreads);
}

/// What waits holds the content of a file each.
TEST(WorkCrew, LetsLittleWait) {
  constexpr int kMost = 4 + 1 + 1;  // waiting, in work, just given
  std::atomic<int> held = 0;
  int most = 0;
  {
    WorkCrew crew(2);
    for (int i = 0; i < 40; ++i) {
      most = std::max(most, ++held);
      crew.give([&held] {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        --held;
      });
    }
  }
  EXPECT_LE(most, kMost);
  EXPECT_EQ(held, 0);
}

}  // namespace
}  // namespace swept::detail
