// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "program.hpp"

/// With a program of the tests' own in the place of xacro: it writes what it was called with.
namespace swept::test {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class Xacro : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("arm.urdf", "<robot name='raw'><xacro:include/></robot>");
    install("echo \"<robot name='$1 $2 $3'><link name='l'/></robot>\"");
  }
  void install(const std::string& script) {
    fs::create_directories(folder_.path("bin"));
    folder_.write("bin/xacro", "#!/bin/sh\n" + script + "\n");
    fs::permissions(folder_.path("bin/xacro"), fs::perms::owner_all);
  }
  Outcome run(const std::string& options) const {
    return runCommands("PATH=\"$PWD/bin:$PATH\" swept info arm.urdf " + options, folder_.path());
  }
  TemporaryFolder folder_;
};

TEST_F(Xacro, MakesTheRobotWithItsArguments) {
  const Outcome all = run("--xacro --xacro-arg side:=left --xacro-arg 'text:=a b'");
  EXPECT_EQ(all.exitCode, 0) << all.err;
  EXPECT_THAT(all.out, HasSubstr("robot arm.urdf side:=left text:=a b from arm.urdf\n"));
  EXPECT_EQ(all.err, "");
}

TEST_F(Xacro, IsAskedForWhereItIsMissing) {
  const Outcome without = run("");
  EXPECT_EQ(without.exitCode, 3);
  EXPECT_THAT(without.err, HasSubstr("arm.urdf:1: error: <xacro:include> is not expanded; run "
                                     "xacro on the file first, or let swept do it with --xacro"));
}

TEST_F(Xacro, FailuresAreSaid) {
  install("echo 'no such macro' >&2; exit 2");
  const Outcome failed = run("--xacro");
  EXPECT_EQ(failed.exitCode, 3);
  EXPECT_THAT(failed.err, HasSubstr("no such macro"));
  EXPECT_THAT(failed.err, HasSubstr("--xacro: xacro has made no URDF of 'arm.urdf' (exit code 2)"));
  install("echo '<robot name=\"r\"><link/></robot>'");
  EXPECT_THAT(run("--xacro").err,
              HasSubstr("arm.urdf (expanded):1: error: <link> has no attribute 'name'"));
  fs::remove(folder_.path("bin/xacro"));
  EXPECT_THAT(run("--xacro").err, HasSubstr("the program xacro cannot be run"));
  EXPECT_THAT(run("--xacro-arg a:=b").err, HasSubstr("--xacro"));
  EXPECT_THAT(run("--xacro --xacro-arg b").err, HasSubstr("must be NAME:=VALUE, not b"));
}

/// A robot of one joint, for whatever is called with its name.
constexpr const char* kArm =
    "cat <<'END'\n<robot name='arm'><link name='a'><collision><geometry><sphere radius='0.1'/>"
    "</geometry></collision></link><link name='b'><collision><origin xyz='0.5 0 0'/><geometry>"
    "<sphere radius='0.1'/></geometry></collision></link><joint name='turn' type='revolute'>"
    "<parent link='a'/><child link='b'/><axis xyz='0 0 1'/><limit lower='-1' upper='1' effort='1' "
    "velocity='1'/></joint></robot>\nEND";

TEST_F(Xacro, IsRunWhereverARobotIsNamed) {
  install(kArm);
  folder_.write("s.yaml",
                "world:\n  collision_objects:\n    - id: post\n      primitives: [{type: box, "
                "dimensions: [0.1, 0.1, 0.1]}]\n      primitive_poses: [{position: [0, 2, 0], "
                "orientation: [0, 0, 0, 1]}]\n");
  const auto outcome = [&](const std::string& line) {
    return runCommands("PATH=\"$PWD/bin:$PATH\" swept " + line + " --xacro", folder_.path());
  };
  for (const std::string line : {"info arm.urdf", "check arm.urdf 0.1", "acm arm.urdf --json",
                                 "report arm.urdf --scene s.yaml --motions 10 --passes 1 -q"}) {
    const Outcome run = outcome(line);
    EXPECT_EQ(run.exitCode, 0) << line << run.out << run.err;
    EXPECT_NE(run.out, "") << line;
  }
}

/// What differs once it is expanded, is another robot, whatever the file says.
TEST_F(Xacro, ResultsOfBatchesAreOfWhatItWrote) {
  install(kArm);
  folder_.write("p.json",
                R"({"one": [{"index": 1, "world": {"box": [], "cylinder": [], "sphere": []},
                    "start": [0.0], "goals": [[0.5]], "joint_names": ["turn"]}]})");
  const auto batch = [&](const std::string& more) {
    return runCommands(
        "PATH=\"$PWD/bin:$PATH\" swept bench planners arm.urdf --xacro --problems "
        "p.json -o r.jsonl --no-times -q " +
            more,
        folder_.path());
  };
  const Outcome first = batch("");
  ASSERT_EQ(first.exitCode, 0) << first.err;
  EXPECT_EQ(batch("").exitCode, 0);
  install(std::string("echo '<!-- changed -->'; ") + kArm);
  const Outcome changed = batch("");
  EXPECT_EQ(changed.exitCode, 3);
  EXPECT_THAT(changed.err, HasSubstr("r.jsonl:1: error: urdf is "));
}

}  // namespace
}  // namespace swept::test
