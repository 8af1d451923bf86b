// SPDX-License-Identifier: BSD-3-Clause
// A child that ends its pipe and stays: the clock holds for it, too. It was waited for as long as
// it lived.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <string>

#include "run_in_child.hpp"

namespace swept::detail {
namespace {

using Seconds = std::chrono::duration<double>;

void closeAll() {
  for (int descriptor = 3; descriptor < 256; ++descriptor) close(descriptor);
}

/// How it ended, and after how long.
std::pair<std::string, double> endingOf(const std::function<std::string()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  std::string ending = "none";
  try {
    test::runInChild(work, {.seconds = 1, .bytes = std::uint64_t{1} << 30});
  } catch (const ChildError& error) {
    ending = error.what();
  }
  return {ending, Seconds(std::chrono::steady_clock::now() - begin).count()};
}

TEST(ChildProcessWait, OneThatSaysNoMoreAndSleepsIsEnded) {
  const auto [ending, seconds] = endingOf([]() -> std::string {
    closeAll();
    sleep(40);
    std::_Exit(0);
  });
  EXPECT_EQ(ending, "took more than 10 s");
  EXPECT_GE(seconds, 10.0);
}

TEST(ChildProcessWait, OneThatSaysNoMoreMayTakeItsTimeToEnd) {
  const auto [ending, seconds] = endingOf([]() -> std::string {
    closeAll();
    usleep(300'000);
    std::abort();
  });
  EXPECT_EQ(ending, "crashed (signal 6)");
  EXPECT_GE(seconds, 0.3);
}

}  // namespace
}  // namespace swept::detail
