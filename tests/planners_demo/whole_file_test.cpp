// SPDX-License-Identifier: BSD-3-Clause
// A signal that ended the program while it wrote a file left a hidden one beside it. A file that
// was protected against writing was replaced.
#include "output/whole_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <climits>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "batch/interrupt.hpp"
#include "command_line/exit_code.hpp"
#include "nobody.hpp"
#include "program.hpp"

namespace swept::test {
namespace {

constexpr const char* kFile = "file";
constexpr const char* kOld = "old";
constexpr std::size_t kBytes = std::size_t{32} << 20;  // tens of milliseconds to write

/// Bytes in the hidden file beside kFile; 0 without one.
std::uintmax_t unfinishedBytes(const TemporaryFolder& folder) {
  std::error_code gone;  // it was written meanwhile
  for (const std::string& name : folder.names())
    if (name != kFile) {
      const std::uintmax_t size = std::filesystem::file_size(folder.path(name), gone);
      if (!gone) return size;
    }
  return 0;
}

/// Hidden files in the folder.
std::ptrdiff_t unfinishedNames(const TemporaryFolder& folder) {
  return std::ranges::count_if(folder.names(),
                               [](const std::string& name) { return name.starts_with('.'); });
}

/// The child's life: a file is written, and the signal sent as soon as there are bytes in the one
/// beside it.
[[noreturn]] void writeAndBeSignalled(const TemporaryFolder& folder, int signal) {
  const std::thread sender([&] {
    while (unfinishedBytes(folder) == 0) std::this_thread::yield();
    kill(getpid(), signal);
  });
  writeWholeFile(folder.path(kFile), std::string(kBytes, 'x'));
  _exit(0);
}

/// The status of a child that was signalled as it wrote; 0 if it was done before.
int statusOfWriter(const TemporaryFolder& folder, int signal, bool asRequest) {
  const pid_t child = fork();
  if (child == 0) {
    std::optional<Interrupt> interrupt;
    if (asRequest) {
      interrupt.emplace();
      raise(SIGINT);  // the first is a request to stop
    }
    writeAndBeSignalled(folder, signal);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

void expectOldFileAlone(const TemporaryFolder& folder) {
  EXPECT_EQ(folder.read(kFile), kOld);
  EXPECT_THAT(folder.names(), testing::ElementsAre(kFile));
}

/// Calls `judge(status)` for a child that was signalled in time: most are.
template <typename Judge>
void signalWriters(int signal, bool asRequest, const Judge& judge) {
  constexpr int kMet = 5;
  constexpr int kMany = 100;
  int met = 0;
  for (int i = 0; i < kMany && met < kMet; ++i) {
    const TemporaryFolder folder;
    folder.write(kFile, kOld);
    const int status = statusOfWriter(folder, signal, asRequest);
    if (folder.read(kFile) != kOld) continue;  // too late: it was written
    judge(status);
    expectOldFileAlone(folder);
    ++met;
  }
  EXPECT_EQ(met, kMet);
}

TEST(WholeFile, IsLeftAloneByASignalThatEndsTheProgram) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP})
    signalWriters(signal, false, [signal](int status) {
      ASSERT_TRUE(WIFSIGNALED(status));
      EXPECT_EQ(WTERMSIG(status), signal);
    });
}

TEST(WholeFile, IsLeftAloneByTheSecondInterrupt) {
  for (const int signal : {SIGINT, SIGTERM})
    signalWriters(signal, true, [](int status) {
      ASSERT_TRUE(WIFEXITED(status));
      EXPECT_EQ(WEXITSTATUS(status), 130);
    });
}

/// Of two files that threads wrote at the same time, one was cleared away.
TEST(WholeFile, OfSeveralThreadsAreAllLeftAloneByASignal) {
  constexpr int kMany = 100;
  bool met = false;
  for (int i = 0; i < kMany && !met; ++i) {
    const TemporaryFolder folder;
    const pid_t child = fork();
    if (child == 0) {
      const auto write = [&](const char* name) {
        writeWholeFile(folder.path(name), std::string(kBytes, 'x'));
      };
      const std::thread first(write, "a"), second(write, "b");
      while (folder.names().size() < 2) std::this_thread::yield();
      kill(getpid(), SIGTERM);
      for (;;) pause();
    }
    waitpid(child, nullptr, 0);
    EXPECT_EQ(unfinishedNames(folder), 0);
    met = folder.names().empty();
  }
  EXPECT_TRUE(met);
}

/// The name that it was written under had 8 bytes more, and was refused once the work was done.
TEST(WholeFile, MayHaveTheLongestName) {
  const TemporaryFolder folder;
  const std::string name(NAME_MAX, 'n');
  requireWritable(folder.path(name));
  writeWholeFile(folder.path(name), "new");
  EXPECT_EQ(folder.read(name), "new");
  EXPECT_THAT(folder.names(), testing::ElementsAre(name));
}

TEST(WholeFile, IsRefusedBeforeTheWorkWhenItsNameIsTooLong) {
  const TemporaryFolder folder;
  std::string deep = folder.path("d");
  while (deep.size() + 200 < PATH_MAX) deep += "/" + std::string(150, 'd');
  deep += "/" + std::string(PATH_MAX - 20 - deep.size(), 'd');
  std::filesystem::create_directories(deep);
  deep += "/" + std::string(10, 'f');  // which would fit, without letters for the unfinished file
  for (const std::string& file : {folder.path(std::string(NAME_MAX + 1, 'n')), deep}) {
    const std::string refusal = "cannot write '" + file + "': File name too long";
    EXPECT_THAT([&] { requireWritable(file); }, testing::ThrowsMessage<UsageError>(refusal));
  }
}

TEST(WholeFile, IsLeftAloneWhereItMayNotBeWritten) {
  const TemporaryFolder folder;
  folder.write(kFile, kOld);
  const std::string file = folder.path(kFile), link = folder.path("link");
  std::filesystem::create_symlink(file, link);
  std::filesystem::permissions(folder.path("."), std::filesystem::perms::all);
  std::filesystem::permissions(file, std::filesystem::perms::others_read);
  const Nobody nobody;
  for (const std::string& name : {file, link}) {
    const std::string refusal = "cannot write '" + name + "': Permission denied";
    EXPECT_THAT([&] { requireWritable(name); }, testing::ThrowsMessage<UsageError>(refusal));
  }
  requireWritable(folder.path("new"));
}

/// Who ignored a signal before goes on ignoring it, and afterwards nothing is as it was not before.
TEST(WholeFile, LeavesHandlersAsTheyWere) {
  const TemporaryFolder folder;
  const auto before = std::signal(SIGHUP, SIG_IGN);
  writeWholeFile(folder.path(kFile), "new");
  EXPECT_EQ(std::signal(SIGHUP, before), SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction now = {};
    sigaction(signal, nullptr, &now);
    EXPECT_EQ(now.sa_handler, SIG_DFL);
  }
  EXPECT_EQ(folder.read(kFile), "new");
  EXPECT_THAT(folder.names(), testing::ElementsAre(kFile));
}

}  // namespace
}  // namespace swept::test
