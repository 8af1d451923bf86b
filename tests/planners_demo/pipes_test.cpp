// SPDX-License-Identifier: BSD-3-Clause
// What came out of a pipe was `not a regular file`, and a file of /proc, whose size is 0, was
// empty.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "gantry.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;

/// Shell commands in the folder of the gantry's files.
class Pipes : public testing::Test {
 protected:
  Outcome shell(const std::string& commands) const {
    return runCommands(commands, gantry_.folder().path());
  }
  void expectSame(const std::string& piped, const std::string& direct) const {
    const Outcome expected = shell(direct), run = shell(piped);
    ASSERT_EQ(expected.err, "");
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(run.exitCode, expected.exitCode);
    EXPECT_EQ(run.out, expected.out);
  }
  Gantry gantry_;
};

TEST_F(Pipes, ARobotIsRead) {
  expectSame("cat gantry.urdf | swept check /dev/stdin 0,0 1,0.1 --scene post.yaml",
             "cp gantry.urdf g.urdf; swept check g.urdf 0,0 1,0.1 --scene post.yaml");
}

/// Their format is told from the ending of their name.
TEST_F(Pipes, ScenesAndCloudsOfNamedPipesAreRead) {
  gantry_.folder().write("c.xyz", "1 0 0\n");
  const std::string cloud = "swept check gantry.urdf left --group both --point-radius 0.1 --cloud ";
  expectSame("mkdir p; mkfifo p/c.xyz; cat c.xyz > p/c.xyz & " + cloud + "p/c.xyz",
             cloud + "c.xyz");
  const std::string scene = "swept check gantry.urdf left --group both --scene ";
  expectSame("mkfifo p.yaml; cat post.yaml > p.yaml & " + scene + "p.yaml", scene + "post.yaml");
}

TEST_F(Pipes, ProblemsAndPathsAreRead) {
  const std::string plan = "swept plan gantry.urdf --group both --set over --index 1 --json -q ";
  EXPECT_EQ(shell("cat problems.json | " + plan + "--problems /dev/stdin").exitCode, 0);
  ASSERT_EQ(gantry_.run("plan", {"left", "right", "--embed", "-o", gantry_.folder().path("p.json")})
                .exitCode,
            0);
  expectSame("cat p.json | swept verify /dev/stdin", "swept verify p.json");
}

/// Much of it, and nothing.
TEST_F(Pipes, PointsAreReadToTheirEnd) {
  const std::string info =
      "ln -sf /dev/stdin s.xyz; swept info gantry.urdf --point-radius 0.001 "
      "--cloud s.xyz --group both";
  EXPECT_THAT(shell("seq 1 40000 | sed 's/$/ 0 5/' | (" + info + ")").out,
              HasSubstr("40000 points"));
  EXPECT_EQ(shell("(" + info + ") < /dev/null").err, "s.xyz: error: the file is empty\n");
}

TEST_F(Pipes, WhatIsReadTwiceIsRefused) {
  const std::string reason =
      ": error: this subcommand reads it twice, which a pipe does not allow\n";
  const std::string bench = "swept bench planners gantry.urdf --group both --set over --problems ";
  EXPECT_EQ(shell("cat problems.json | " + bench + "/dev/stdin").err, "/dev/stdin" + reason);
  EXPECT_EQ(shell("cat gantry.srdf | swept acm gantry.urdf --srdf /dev/stdin").err,
            "/dev/stdin" + reason);
  std::filesystem::remove(gantry_.srdf);
  EXPECT_EQ(shell("cat gantry.urdf | swept acm /dev/stdin -q").exitCode, 0);
}

}  // namespace
}  // namespace swept::test
