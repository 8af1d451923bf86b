// SPDX-License-Identifier: BSD-3-Clause
// One child that answers many requests: what bounds one bounds each, and what ends one is said of
// that one.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <ctime>
#include <new>
#include <set>
#include <string>
#include <vector>

#include "io/child_process.hpp"
#include "sanitizers.hpp"

namespace swept::detail {
namespace {

constexpr ChildLimits kAmple{.seconds = 20, .bytes = std::uint64_t{1} << 30};

/// For so long, in seconds of the processor.
void spin(double seconds) {
  timespec begin{}, now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
  do {
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  } while (static_cast<double>(now.tv_sec - begin.tv_sec) +
               1e-9 * static_cast<double>(now.tv_nsec - begin.tv_nsec) <
           seconds);
}

std::string take(std::size_t bytes) {
  try {
    return std::vector<char>(bytes, 'x').back() == 'x' ? "got it" : "";
  } catch (const std::bad_alloc&) {
    return "none left";
  }
}

/// `pid`, `crash`, `hang`, `spin SECONDS`, `take BYTES`, or else the size of the request.
std::string obey(std::string_view request) {
  const std::string text(request);
  if (text == "pid") return std::to_string(getpid());
  if (text == "crash") std::abort();
  if (text == "hang") spin(1e9);
  if (text.starts_with("spin ")) spin(std::stod(text.substr(5)));
  if (text.starts_with("take ")) return take(std::stoul(text.substr(5)));
  return std::to_string(text.size());
}

class ChildRequests : public testing::Test {
 protected:
  std::string ask(std::string_view request, const ChildLimits& limits = kAmple) {
    try {
      return child_.ask(std::array{request}, limits);
    } catch (const ChildError& error) {
      return error.what();
    }
  }
  pid_t pid() { return std::stoi(ask("pid")); }

  ChildProcess child_{obey};
};

TEST_F(ChildRequests, OneProcessAnswersThem) {
  EXPECT_FALSE(child_.hasAnswered());
  const pid_t first = pid();
  EXPECT_NE(first, getpid());
  EXPECT_TRUE(child_.hasAnswered());
  const std::string large(3'000'000, 'x');
  EXPECT_EQ(child_.ask(std::array<std::string_view, 4>{"ab", "", large, "c"}, kAmple), "3000003");
  EXPECT_EQ(child_.ask({}, kAmple), "0");
  EXPECT_EQ(pid(), first);
  child_.end();
  EXPECT_FALSE(child_.hasAnswered());
  EXPECT_NE(pid(), first);
}

TEST_F(ChildRequests, OneThatCrashesIsFollowedByAnother) {
  const pid_t first = pid();
  EXPECT_EQ(ask("crash"), "crashed (signal 6)");
  EXPECT_FALSE(child_.hasAnswered());
  const pid_t second = pid();
  EXPECT_NE(second, first);
  EXPECT_EQ(pid(), second);
}

/// Together they take two and a half times what each may.
TEST_F(ChildRequests, TimeIsBoundedForEach) {
  const ChildLimits second{.seconds = 1, .bytes = kAmple.bytes};
  const std::string first = ask("pid", second);
  for (int i = 0; i < 8; ++i) EXPECT_EQ(ask("spin 0.3", second), "8") << i;
  EXPECT_EQ(ask("pid", second), first);
  EXPECT_EQ(ask("hang", second), "took too much time or memory");
}

/// It is the host that may block or catch what ends a child in time.
TEST_F(ChildRequests, TimeIsBoundedWhateverTheHostDoesWithSignals) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_BLOCK, &all, &before);
  const auto handler = std::signal(SIGPROF, SIG_IGN);
  EXPECT_EQ(ask("hang", {.seconds = 1, .bytes = kAmple.bytes}), "took too much time or memory");
  std::signal(SIGPROF, handler);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

TEST_F(ChildRequests, MemoryIsBoundedForEach) {
#if defined(SWEPT_TEST_ADDRESS_SANITIZER) || defined(SWEPT_TEST_THREAD_SANITIZER)
  GTEST_SKIP() << "a sanitizer takes all addresses there are";
#endif
  const ChildLimits small{.seconds = 20, .bytes = 96 << 20};
  const ChildLimits large{.seconds = 20, .bytes = 256 << 20};
  const std::string some = "take " + std::to_string(64 << 20);
  const std::string more = "take " + std::to_string(160 << 20);
  const pid_t first = pid();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(ask(some, small), "got it") << i;
  EXPECT_EQ(ask(more, small), "none left");
  EXPECT_EQ(ask(more, large), "got it");
  EXPECT_EQ(ask(more, small), "none left") << "a limit goes down again, too";
  EXPECT_EQ(pid(), first);
}

TEST_F(ChildRequests, ARequestThatFindsNoMemoryIsRefused) {
#if defined(SWEPT_TEST_ADDRESS_SANITIZER) || defined(SWEPT_TEST_THREAD_SANITIZER)
  GTEST_SKIP() << "a sanitizer takes all addresses there are";
#endif
  EXPECT_EQ(ask(std::string(64 << 20, 'x'), {.seconds = 20, .bytes = 32 << 20}),
            "ran out of memory");
}

/// Of a request to one that is gone nobody reads a byte, and a signal would end the host.
TEST_F(ChildRequests, OneThatWasKilledBetweenTwoIsNoDanger) {
  for (const std::size_t size : {std::size_t{1}, std::size_t{3'000'000}}) {
    kill(pid(), SIGKILL);
    EXPECT_EQ(ask(std::string(size, 'x')), "took too much time or memory");
    EXPECT_EQ(ask(std::string(size, 'x')), std::to_string(size));
  }
}

/// One that stands still with a request half read is waited for as long as the clock allows.
TEST_F(ChildRequests, OneThatReadsNoMoreIsEnded) {
  kill(pid(), SIGSTOP);
  EXPECT_EQ(ask(std::string(3'000'000, 'x'), {.seconds = 0, .bytes = kAmple.bytes}),
            "took more than 0 s");
}

/// The socket was one of the streams that the child silences, and that the host writes to.
TEST_F(ChildRequests, StandardStreamsMayBeClosed) {
  std::array<int, 3> saved{};
  for (int stream = 0; stream < 3; ++stream) {
    saved[static_cast<std::size_t>(stream)] = fcntl(stream, F_DUPFD_CLOEXEC, 10);
    close(stream);
  }
  const std::string first = ask("1234");
  std::set<int> open;
  for (int stream = 0; stream < 3; ++stream)
    if (fcntl(stream, F_GETFD) != -1) open.insert(stream);
  const std::string second = ask("12345");
  for (int stream = 0; stream < 3; ++stream) {
    dup2(saved[static_cast<std::size_t>(stream)], stream);
    close(saved[static_cast<std::size_t>(stream)]);
  }
  EXPECT_EQ(first, "4");
  EXPECT_EQ(second, "5");
  EXPECT_THAT(open, testing::IsEmpty());
}

}  // namespace
}  // namespace swept::detail
