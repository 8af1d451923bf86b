// SPDX-License-Identifier: BSD-3-Clause
#include "threads/crew.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

namespace swept::detail {
namespace {

TEST(Crew, DoesEachPieceOnce) {
  for (const unsigned threads : {0U, 1U, 2U, 5U}) {
    Crew crew(threads);
    for (const std::size_t count : {0U, 1U, 7U, 8U, 1000U}) {
      std::vector<std::atomic<int>> done(count);
      crew.forPieces(count, 8, [&](std::size_t first, std::size_t last) {
        EXPECT_LE(last - first, 8U);
        for (std::size_t i = first; i < last; ++i) ++done[i];
      });
      for (const std::atomic<int>& one : done) EXPECT_EQ(one, 1);
    }
  }
}

/// Each piece of a stage reads what all pieces of the stage before have written.
TEST(Crew, EndsAStageBeforeTheNext) {
  constexpr std::size_t kCount = 512;
  Crew crew(4);
  std::vector<int> numbers(kCount, 1), sums(kCount, 0);
  for (int stage = 1; stage <= 200; ++stage) {
    crew.forPieces(kCount, 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i)
        sums[i] = std::accumulate(numbers.begin(), numbers.end(), 0);
    });
    crew.forPieces(kCount, 16, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) numbers[i] = stage + 1;
    });
    for (const int sum : sums) ASSERT_EQ(sum, stage * static_cast<int>(kCount));
  }
}

/// Each piece waits for the others: with fewer threads it would never end.
TEST(Crew, WorksOnAsManyThreadsAsAreAsked) {
  constexpr unsigned kThreads = 4;
  std::atomic<unsigned> arrived = 0;
  std::mutex mutex;
  std::set<std::thread::id> who;
  Crew crew(kThreads);
  crew.forPieces(kThreads, 1, [&](std::size_t, std::size_t) {
    // std::barrier of MinGW may wait for ever.
    for (++arrived; arrived < kThreads;) std::this_thread::yield();
    const std::lock_guard lock(mutex);
    who.insert(std::this_thread::get_id());
  });
  EXPECT_EQ(who.size(), kThreads);
}

TEST(Crew, HandsAnExceptionToTheCallerAndGoesOn) {
  for (const unsigned threads : {1U, 4U}) {
    Crew crew(threads);
    const auto fail = [](std::size_t first, std::size_t) {
      if (first >= 64) throw std::runtime_error("of a piece");
    };
    EXPECT_THROW(crew.forPieces(1000, 8, fail), std::runtime_error);
    std::atomic<int> done = 0;
    crew.forPieces(1000, 8, [&](std::size_t first, std::size_t last) {
      done += static_cast<int>(last - first);
    });
    EXPECT_EQ(done, 1000);
  }
}

TEST(Crew, UsesNoThreadsForLittleWork) {
  EXPECT_EQ(threadsFor(0, 100), 1U);
  EXPECT_EQ(threadsFor(199, 100), 1U);
  EXPECT_LE(threadsFor(200, 100), 2U);
  EXPECT_EQ(threadsFor(1'000'000, 1), std::max(std::thread::hardware_concurrency(), 1U));
}

}  // namespace
}  // namespace swept::detail
