// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

/// Configuring where a library is missing leaves out what needs it, with one line.
namespace swept::test {
namespace {

TEST(Configure, WithoutZlibThereIsNoProgram) {
  const TemporaryFolder folder;
  const Outcome run = runShell("cmake -G Ninja -S . -B '" + folder.path("build") +
                               "' -D CMAKE_DISABLE_FIND_PACKAGE_ZLIB=ON -D SWEPT_BUILD_TESTS=OFF");
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, testing::HasSubstr("-- swept: planners_demo left out (needs ompl_bridge, "
                                          "proofs, CLI11 and zlib)\n"));
}

}  // namespace
}  // namespace swept::test
