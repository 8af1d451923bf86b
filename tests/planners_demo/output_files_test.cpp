// SPDX-License-Identifier: BSD-3-Clause
#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <future>

#include "gantry.hpp"

/// Written files stay what they were: links, pipes and devices, and modes.
namespace swept::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::StartsWith;
using Words = std::vector<std::string>;

class OutputFiles : public testing::Test {
 protected:
  OutputFiles() { fs::create_directory(path("out")); }
  std::string path(const std::string& name) const { return gantry_.folder().path(name); }
  Outcome plan(const std::string& file) const {
    return gantry_.run("plan", {"left", "right", "-q", "-o", file});
  }
  void expectRefused(const std::string& file, const std::string& reason) const {
    const Outcome run = plan(file);
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "") << "before planning";
    EXPECT_EQ(run.err, "swept: error: cannot write '" + file + "': " + reason + "\n");
  }
  std::vector<std::string> names(const std::string& folder) const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(path(folder)))
      found.push_back(entry.path().filename().string());
    std::ranges::sort(found);
    return found;
  }

  Gantry gantry_;
};

TEST_F(OutputFiles, ALinkStaysAndItsFileIsWritten) {
  fs::create_directory(path("store"));
  gantry_.folder().write("store/real.csv", "old\n");
  fs::create_symlink("../store/real.csv", path("out/second.csv"));
  fs::create_symlink("out/second.csv", path("first.csv"));
  ASSERT_EQ(plan(path("first.csv")).exitCode, 0);
  EXPECT_TRUE(fs::is_symlink(path("first.csv")));
  EXPECT_TRUE(fs::is_symlink(path("out/second.csv")));
  EXPECT_THAT(gantry_.folder().read("store/real.csv"), StartsWith("slide,lift\n"));
  EXPECT_THAT(names("store"), ElementsAre("real.csv"));
  EXPECT_THAT(names("out"), ElementsAre("second.csv"));
}

TEST_F(OutputFiles, ALinkToNothingMakesItsFile) {
  fs::create_symlink("out/new.csv", path("link.csv"));
  ASSERT_EQ(plan(path("link.csv")).exitCode, 0);
  EXPECT_TRUE(fs::is_symlink(path("link.csv")));
  EXPECT_THAT(gantry_.folder().read("out/new.csv"), StartsWith("slide,lift\n"));
}

TEST_F(OutputFiles, LinksThatLeadNowhereAreRefusedBeforePlanning) {
  fs::create_symlink("none/path.csv", path("out/lost.csv"));
  expectRefused(path("out/lost.csv"), "No such file or directory");
  fs::create_symlink("b.csv", path("out/a.csv"));
  fs::create_symlink("a.csv", path("out/b.csv"));
  expectRefused(path("out/a.csv"), "Too many levels of symbolic links");
  fs::create_symlink(".", path("out/folder.csv"));
  expectRefused(path("out/folder.csv"), "Is a directory");
  EXPECT_THAT(names("out"), ElementsAre("a.csv", "b.csv", "folder.csv", "lost.csv"));
}

TEST_F(OutputFiles, APipeIsWrittenTo) {
  const std::string pipe = path("out/pipe.csv");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  // Open for both, so that neither end waits for the other; what is written fits into the pipe.
  const int end = open(pipe.c_str(), O_RDWR | O_CLOEXEC);
  ASSERT_GE(end, 0);
  const Outcome run = plan(pipe);
  EXPECT_EQ(run.exitCode, 0) << run.err;
  ASSERT_TRUE(fs::is_fifo(pipe));
  char text[11] = {};
  ASSERT_EQ(read(end, text, 10), 10);
  EXPECT_STREQ(text, "slide,lift");
  close(end);
  EXPECT_THAT(names("out"), ElementsAre("pipe.csv"));
}

/// A device, in a folder where a user may not make another one: the name of a link decides about
/// the format.
TEST_F(OutputFiles, ADeviceIsWrittenTo) {
  fs::create_symlink("/dev/null", path("out/null.csv"));
  const Outcome run = plan(path("out/null.csv"));
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_TRUE(fs::is_symlink(path("out/null.csv")));
  ASSERT_TRUE(fs::is_character_file("/dev/null"));
  fs::create_symlink("/dev/full", path("out/full.csv"));
  const Outcome full = plan(path("out/full.csv"));
  EXPECT_EQ(full.exitCode, 3);
  EXPECT_EQ(full.err,
            "swept: error: cannot write '" + path("out/full.csv") + "': No space left on device\n");
  EXPECT_THAT(names("out"), ElementsAre("full.csv", "null.csv"));
}

TEST_F(OutputFiles, ASocketIsRefusedBeforePlanning) {
  const int end = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string file = path("out/s.csv");
  ASSERT_LT(file.size(), sizeof address.sun_path);
  std::ranges::copy(file, address.sun_path);
  ASSERT_EQ(bind(end, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  expectRefused(file, "No such device or address");
  EXPECT_TRUE(fs::is_socket(file));
  close(end);
}

TEST_F(OutputFiles, AnOldFileKeepsItsMode) {
  const std::string file = gantry_.folder().write("path.csv", "old\n");
  for (const mode_t mode : {0600u, 0640u, 0666u}) {
    ASSERT_EQ(chmod(file.c_str(), mode), 0);
    ASSERT_EQ(plan(file).exitCode, 0);
    struct stat status {};
    ASSERT_EQ(stat(file.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777u, mode);
  }
  EXPECT_THAT(gantry_.folder().read("path.csv"), StartsWith("slide,lift\n"));
}

/// The results of a batch were replaced by their table, and a robot by its SRDF.
TEST_F(OutputFiles, WhatIsReadOrWrittenOtherwiseIsNotReplaced) {
  const std::string urdf = gantry_.urdf, results = path("out/r"), again = path("out/../out/r");
  const Words bench{"bench",      "planners",       urdf,    "--group", "both", "-q",
                    "--problems", gantry_.problems, "--set", "over"};
  const auto expectKept = [&](Words words, const Words& more, const std::string& message) {
    words.insert(words.end(), more.begin(), more.end());
    const Outcome run = runSwept(words);
    EXPECT_EQ(run.exitCode, 3) << message;
    EXPECT_EQ(run.out, "") << message;
    EXPECT_EQ(run.err, "swept: error: " + message + "\n");
  };
  expectKept(bench, {"-o", results, "--csv", again},
             "--csv '" + again + "' would replace the file of -o '" + results + "'");
  EXPECT_THAT(names("out"), testing::IsEmpty());
  fs::create_symlink(urdf, path("out/link"));
  expectKept({"acm", urdf}, {"-o", path("out/link")},
             "-o '" + path("out/link") + "' would replace the file of robot '" + urdf + "'");
  EXPECT_THAT(gantry_.folder().read("gantry.urdf"), testing::HasSubstr("</robot>"));
  const Words plan{"plan", urdf, "left", "right", "--group", "both"};
  expectKept(
      plan, {"--scene", gantry_.scene, "-o", gantry_.scene},
      "-o '" + gantry_.scene + "' would replace the file of --scene '" + gantry_.scene + "'");
  expectKept({"report", urdf, "--group", "both"}, {"-o", path("m.csv"), "--csv", path("m.csv")},
             "--csv '" + path("m.csv") + "' would replace the file of -o '" + path("m.csv") + "'");

  Words whole = bench;
  whole.insert(whole.end(), {"-o", results, "--csv", "/dev/null"});
  ASSERT_EQ(runSwept(whole).exitCode, 0);
  const std::string lines = gantry_.folder().read("out/r");
  expectKept({"bench", "summary", results}, {"--csv", again},
             "--csv '" + again + "' would replace the file of results '" + results + "'");
  EXPECT_EQ(gantry_.folder().read("out/r"), lines);
}

/// What was printed was lost, or took the place of the first results.
TEST_F(OutputFiles, WhatIsPrintedIsNotReplaced) {
  const std::string file = path("out/printed.csv"), urdf = "'" + gantry_.urdf + "'";
  const auto expectKept = [&](const std::string& command, const std::string& message) {
    EXPECT_EQ(runShell("swept " + command).exitCode, 3) << command;
    EXPECT_EQ(gantry_.folder().read("out/printed.csv"), message) << command;
  };
  const std::string batch = "bench planners " + urdf + " --group both --problems '" +
                            gantry_.problems + "' --set over -o ";
  const std::string output = " >'" + file + "'", both = output + " 2>&1";
  for (const std::string& command :
       {"plan " + urdf + " left right --group both -o ", "acm " + urdf + " -o ", batch})
    expectKept(command + "'" + file + "'" + both,
               "swept: error: -o '" + file + "' is the file that standard output goes to\n");
  expectKept(batch + "/dev/stdout" + output, "");
  expectKept(batch + "/dev/stderr 2>'" + file + "'",
             "swept: error: -o '/dev/stderr' is the file that standard error goes to\n");
}

}  // namespace
}  // namespace swept::test
