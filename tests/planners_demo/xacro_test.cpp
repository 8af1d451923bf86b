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

}  // namespace
}  // namespace swept::test
