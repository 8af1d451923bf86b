// SPDX-License-Identifier: BSD-3-Clause
#include "io/child_process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "run_in_child.hpp"
#include "sanitizers.hpp"

namespace swept::detail {
namespace {

using test::runInChild;

constexpr ChildLimits kAmple{.seconds = 20, .bytes = std::uint64_t{1} << 30};

std::string endingOf(const std::function<std::string()>& work, const ChildLimits& limits = kAmple) {
  try {
    runInChild(work, limits);
  } catch (const ChildError& error) {
    return error.what();
  }
  return "none";
}

[[noreturn]] void spin() {
  for (std::atomic<int> i = 0;; ++i) continue;
}

TEST(ChildProcess, SaysWhatItsWorkReturned) {
  EXPECT_EQ(runInChild([] { return std::string(); }, kAmple), "");
  std::string large;
  for (int i = 0; i < 3'000'000; ++i) large += static_cast<char>(i % 251);
  EXPECT_EQ(runInChild([&] { return large; }, kAmple), large);
}

TEST(ChildProcess, NothingOfItComesBackButThat) {
  int value = 1;
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  runInChild(
      [&] {
        value = 2;
        std::fputs("noise", stderr);
        std::puts("noise");
        std::fflush(stdout);
        return std::string();
      },
      kAmple);
  EXPECT_EQ(value, 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(ChildProcess, HowItEndedIsSaid) {
  EXPECT_EQ(endingOf([]() -> std::string { std::abort(); }), "crashed (signal 6)");
  EXPECT_EQ(endingOf([]() -> std::string { std::_Exit(0); }), "ended too soon");
  EXPECT_EQ(endingOf([]() -> std::string { throw std::runtime_error("x"); }), "ended too soon");
  EXPECT_EQ(endingOf([]() -> std::string { spin(); }, {.seconds = 1, .bytes = 1 << 30}),
            "took too much time or memory");
}

TEST(ChildProcess, HandlersOfTheHostDoNotRunInIt) {
  const auto before = std::signal(SIGABRT, [](int) { std::_Exit(0); });
  EXPECT_EQ(endingOf([]() -> std::string { std::abort(); }), "crashed (signal 6)");
  std::signal(SIGABRT, before);
}

TEST(ChildProcess, MemoryIsBounded) {
#if defined(SWEPT_TEST_ADDRESS_SANITIZER) || defined(SWEPT_TEST_THREAD_SANITIZER)
  GTEST_SKIP() << "a sanitizer takes all addresses there are";
#endif
  const auto take = [](std::size_t bytes) {
    return [bytes] {
      try {
        return std::string(std::vector<char>(bytes, 'x').back() == 'x' ? "got it" : "");
      } catch (const std::bad_alloc&) {
        return std::string("none left");
      }
    };
  };
  const ChildLimits limits{.seconds = 20, .bytes = 64 << 20};
  EXPECT_EQ(runInChild(take(16 << 20), limits), "got it");
  EXPECT_EQ(runInChild(take(128 << 20), limits), "none left");
}

TEST(ChildProcess, WhatItSaysIsBounded) {
  const std::string text(1 << 20, 'x');
  EXPECT_EQ(runInChild([&] { return std::string(text); }, {.seconds = 20, .bytes = 256 << 20}),
            text);
  // It has the text already, and so needs no memory for it.
  std::string large(8 << 20, 'x');
  const auto give = [&] { return std::move(large); };
  EXPECT_EQ(endingOf(give, {.seconds = 20, .bytes = 4 << 20}), "said too much");
}

/// A child inherits the pipes of others, which must not keep it from being seen to end.
TEST(ChildProcess, ManyAtOnceFromSeveralThreads) {
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      for (int i = 0; i < 25; ++i) {
        if (i % 5 == 4)
          right += endingOf([]() -> std::string { std::abort(); }) == "crashed (signal 6)" ? 1 : 0;
        else
          right += runInChild([&] { return std::to_string(100 * t + i); }, kAmple) ==
                           std::to_string(100 * t + i)
                       ? 1
                       : 0;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 100);
}

/// Hosts may let the system reap their children.
TEST(ChildProcess, WorksWhereTheHostIgnoresItsChildren) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(runInChild([] { return std::string("done"); }, kAmple), "done");
  EXPECT_EQ(endingOf([]() -> std::string { std::abort(); }), "ended too soon");
  std::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace swept::detail
