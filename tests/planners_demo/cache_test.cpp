// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "program.hpp"

namespace swept::test {
namespace {

/// What SWEPT_CACHE names keeps the covers of a robot's meshes, and answers are those without it.
class Cache : public testing::Test {
 protected:
  Cache() {
    folder_.write("t.obj",
                  "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    folder_.write("r.urdf",
                  "<robot name='r'><link name='base'/><link name='a'><collision><geometry><mesh "
                  "filename='t.obj'/></geometry></collision></link><joint name='j' "
                  "type='revolute'><parent link='base'/><child link='a'/><axis xyz='0 0 1'/><limit "
                  "lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>");
  }
  Outcome check(const std::string& cache) const {
    return runShell("SWEPT_CACHE='" + cache + "' swept check '" + folder_.path("r.urdf") + "' 0.5");
  }
  std::ptrdiff_t files() const {
    return std::distance(std::filesystem::directory_iterator(folder_.path("cache")), {});
  }
  TemporaryFolder folder_;
};

TEST_F(Cache, IsTheFolderThatTheEnvironmentNames) {
  const Outcome without = check("");
  EXPECT_EQ(without.exitCode, 0) << without.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.path("cache")));
  for (int run = 0; run < 2; ++run) {
    const Outcome with = check(folder_.path("cache"));
    EXPECT_EQ(with.out, without.out);
    EXPECT_EQ(with.err, without.err);
    EXPECT_EQ(files(), 1);
  }
}

TEST_F(Cache, ThatCannotBeUsedIsAWarning) {
  const Outcome run = check(folder_.path("t.obj"));
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.out, check("").out);
  EXPECT_EQ(run.err, folder_.path("t.obj") + ": warning: the cache is not used: it is no folder\n" +
                         check("").err);
}

}  // namespace
}  // namespace swept::test
