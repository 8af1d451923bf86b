// SPDX-License-Identifier: BSD-3-Clause
#include "threads/for_each_index.hpp"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <barrier>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace swept::detail {
namespace {

TEST(ForEachIndex, CallsForEachOnce) {
  for (const std::size_t count : {0U, 1U, 3U, 1000U})
    for (const unsigned threads : {0U, 1U, 2U, 5U, 64U}) {
      std::vector<int> calls(count, 0);
      std::mutex mutex;
      std::set<std::thread::id> who;
      forEachIndex(count, threads, [&](std::size_t i) {
        const std::lock_guard lock(mutex);
        ++calls.at(i);
        who.insert(std::this_thread::get_id());
      });
      EXPECT_EQ(std::ranges::count(calls, 1), static_cast<std::ptrdiff_t>(count));
      EXPECT_LE(who.size(), threads > 0
                                ? threads
                                : std::max<std::size_t>(1, std::thread::hardware_concurrency()));
    }
}

/// Each of them waits for the others: with fewer threads it would never end.
TEST(ForEachIndex, RunsOnAsManyThreadsAsAreAsked) {
  constexpr unsigned kThreads = 4;
  std::barrier all(kThreads);
  forEachIndex(kThreads, kThreads, [&](std::size_t) { all.arrive_and_wait(); });
}

TEST(ForEachIndex, CallsForAllAndThrowsTheFirst) {
  for (const unsigned threads : {1U, 4U}) {
    std::vector<int> calls(100, 0);
    try {
      forEachIndex(calls.size(), threads, [&](std::size_t i) {
        calls[i] = 1;
        if (i % 20 == 17) throw std::runtime_error(std::to_string(i));
      });
      FAIL() << "nothing thrown";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "17");
    }
    EXPECT_EQ(std::ranges::count(calls, 1), 100);
  }
}

#if defined(__GLIBC__)
/// New threads get stacks for which there is no address space.
class NoThreads {
 public:
  NoThreads() {
    pthread_getattr_default_np(&before_);
    pthread_attr_t huge;
    pthread_attr_init(&huge);
    pthread_attr_setstacksize(&huge, std::size_t{1} << 60);
    pthread_setattr_default_np(&huge);
    pthread_attr_destroy(&huge);
  }
  ~NoThreads() {
    pthread_setattr_default_np(&before_);
    pthread_attr_destroy(&before_);
  }
  NoThreads(const NoThreads&) = delete;
  NoThreads& operator=(const NoThreads&) = delete;

 private:
  pthread_attr_t before_;
};

TEST(ForEachIndex, DoesItAllWhereNoThreadIsToBeHad) {
  std::vector<int> calls(100, 0);
  {
    const NoThreads none;
    ASSERT_THROW(std::jthread([] {}), std::system_error);
    forEachIndex(calls.size(), 4, [&](std::size_t i) { ++calls[i]; });
  }
  EXPECT_EQ(std::ranges::count(calls, 1), 100);
}
#endif

}  // namespace
}  // namespace swept::detail
