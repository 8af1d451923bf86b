// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "gantry.hpp"
#include "urdf_text.hpp"

namespace swept::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;

/// Takes its whole second: there is no path.
std::vector<std::string> longWork(const Gantry& gantry) {
  return gantry.arguments(
      "plan", {"--problems", gantry.problems, "--set", "blocked", "--index", "7", "--time", "1"});
}

TEST(Terminal, LongWorkShowsProgressAndWipesIt) {
  const Gantry gantry;
  const Outcome run = runSwept(longWork(gantry), Stderr::Terminal);
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.err, HasSubstr("planning with CertifiedConnect, at most 1 s ("));
  EXPECT_THAT(run.err, EndsWith("\r\033[K"));
  EXPECT_THAT(run.out, HasSubstr("\nnot solved: "));
}

/// So many pairs that no computer looks at them in a blink.
constexpr int kManyLinks = 1500;

std::string longChain() {
  std::string urdf = "<robot name='chain'><link name='l0'/>";
  for (int i = 1; i <= kManyLinks; ++i) {
    const std::string name = std::to_string(i);
    urdf += "<link name='l" + name +
            "'><collision><geometry><sphere radius='0.02'/></geometry></collision></link>" +
            joint("j" + name, "revolute", "l" + std::to_string(i - 1), "l" + name,
                  "<origin xyz='0 0 0.1'/>" + limited("1 0 0", -3.0, 3.0));
  }
  return urdf + "</robot>";
}

/// Straight, or folded twice, into itself.
std::string stateOfChain(bool folded) {
  std::string state;
  for (int i = 1; i <= kManyLinks; ++i)
    state += std::string(i > 1 ? "," : "") + (folded && (i == 2 || i == 5) ? "3" : "0");
  return state;
}

TEST(Terminal, BuildingACheckerOfManyLinksShows) {
  const TemporaryFolder folder;
  folder.write("chain.urdf", longChain());
  const Outcome run =
      runSwept({"check", folder.path("chain.urdf"), stateOfChain(false)}, Stderr::Terminal);
  EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
  EXPECT_THAT(run.err, HasSubstr("building the checker of 1501 links ("));
  EXPECT_THAT(run.err, EndsWith("\r\033[K"));
}

/// A wavy ball of as many triangles as take a while.
std::string largeMesh(double phase) {
  constexpr int kRings = 200;
  std::string text;
  for (int i = 0; i <= kRings; ++i)
    for (int j = 0; j < kRings; ++j) {
      const double a = std::numbers::pi * i / kRings, b = 2.0 * std::numbers::pi * j / kRings;
      const double r = 0.3 + 0.02 * std::sin(7.0 * a + phase) * std::cos(5.0 * b);
      text += "v " + std::to_string(r * std::sin(a) * std::cos(b)) + " " +
              std::to_string(r * std::sin(a) * std::sin(b)) + " " +
              std::to_string(r * std::cos(a)) + "\n";
    }
  for (int i = 0; i < kRings; ++i)
    for (int j = 0; j < kRings; ++j) {
      const auto at = [&](int ring, int sector) {
        return " " + std::to_string(ring * kRings + sector % kRings + 1);
      };
      text += "f" + at(i, j) + at(i + 1, j) + at(i + 1, j + 1) + "\n";
      text += "f" + at(i, j) + at(i + 1, j + 1) + at(i, j + 1) + "\n";
    }
  return text;
}

TEST(Terminal, LoadingLargeMeshesShows) {
  const TemporaryFolder folder;
  std::string urdf = "<robot name='large'><link name='a'>";
  for (const std::string name : {"a.obj", "b.obj", "c.obj", "d.obj"}) {
    folder.write(name, largeMesh(name[0]));
    urdf += "<collision><geometry><mesh filename='" + name + "'/></geometry></collision>";
  }
  folder.write("r.urdf", urdf + "<collision><geometry><sphere radius='0'/></geometry></collision>" +
                             "</link></robot>");
  const Outcome run = runSwept({"info", folder.path("r.urdf")}, Stderr::Terminal);
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("loading the robot: "));
  EXPECT_THAT(run.err, HasSubstr(" of 4 meshes ("));
  // Remarks wait for the line to be gone.
  const std::size_t wiped = run.err.rfind("\r\033[K");
  EXPECT_GT(run.err.find("warning: link 'a'"), wiped);
  EXPECT_THAT(runSwept({"info", folder.path("r.urdf"), "-q"}, Stderr::Terminal).err,
              Not(HasSubstr("loading")));
}

/// The line is that of the cases, and of none when there is to be silence.
TEST(Terminal, BuildingACheckerOfACaseDoesNotShow) {
  const TemporaryFolder folder;
  folder.write("chain.urdf", longChain());
  const Outcome dumped = runSwept({"check", folder.path("chain.urdf"), stateOfChain(true), "-q",
                                   "--dump", folder.path("dumps")});
  ASSERT_EQ(dumped.exitCode, 1) << dumped.out << dumped.err;
  const std::string file =
      std::filesystem::directory_iterator(folder.path("dumps"))->path().string();
  const Outcome quiet = runSwept({"replay", file, "-q"}, Stderr::Terminal);
  EXPECT_EQ(quiet.exitCode, 0) << quiet.out;
  EXPECT_EQ(quiet.err, "");
  EXPECT_THAT(runSwept({"replay", file}, Stderr::Terminal).err, Not(HasSubstr("building")));
}

TEST(Terminal, PipedThereIsNothingButResults) {
  const Gantry gantry;
  const Outcome run = runSwept(longWork(gantry));
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(run.out.find('\r'), std::string::npos);
  EXPECT_EQ(run.out.find('\033'), std::string::npos);
}

TEST(Terminal, QuietIsQuietOnATerminalToo) {
  const Gantry gantry;
  std::vector<std::string> arguments = longWork(gantry);
  arguments.push_back("--quiet");
  EXPECT_EQ(runSwept(arguments, Stderr::Terminal).err, "");
}

TEST(Terminal, ShortWorkDoesNotFlicker) {
  const Gantry gantry;
  const Outcome run = runSwept(gantry.arguments("check", {"left"}), Stderr::Terminal);
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
}

TEST(Terminal, EachCommandPrintsOneJsonObject) {
  const Gantry gantry;
  for (const std::string command : {"info", "check", "motion", "plan"}) {
    const std::vector<std::string> states =
        command == "info" ? std::vector<std::string>{} : std::vector<std::string>{"left", "0,1"};
    std::vector<std::string> more = states;
    more.push_back("--json");
    const Outcome run = gantry.run(command, more);
    EXPECT_EQ(run.exitCode, 0) << command;
    EXPECT_EQ(run.err, "") << command;
    EXPECT_EQ(jsonOf(run)["robot"], "gantry") << command;
  }
}

}  // namespace
}  // namespace swept::test
