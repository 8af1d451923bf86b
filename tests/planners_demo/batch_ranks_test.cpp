// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "batch.hpp"

/// A batch shared by the processes of an MPI job.
namespace swept::test {
namespace {

#if defined(SWEPT_MPIEXEC)

/// `ranks` processes; as root and on fewer processors too, which Open MPI refuses unless told so:
/// version 4 by the third name, version 5 by the fourth.
Outcome runRanks(int ranks, const Words& arguments) {
  std::string line =
      "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
      "OMPI_MCA_rmaps_base_oversubscribe=1 PRTE_MCA_rmaps_default_mapping_policy=:oversubscribe; "
      "'" SWEPT_MPIEXEC "' -n " +
      std::to_string(ranks) + " '" SWEPT_MPI_PROGRAM "'";
  for (const std::string& word : arguments) line += " '" + word + "'";
  return runShell(line);
}

Words batch(const Words& more) {
  Words all{"--set", "shelf", "--runs", "8", "--no-times", "--no-clearance", "-q"};
  all.insert(all.end(), more.begin(), more.end());
  return rook7Batch(all);
}

TEST(BatchRanks, ResultsAreThoseOfOneProcess) {
  const TemporaryFolder folder;
  const Outcome one = runSwept(batch({"-o", folder.path("one")}));
  ASSERT_EQ(one.exitCode, 0) << one.err;
  for (const int ranks : {1, 3}) {
    const std::string name = std::to_string(ranks);
    const Outcome run = runRanks(ranks, batch({"-o", folder.path(name)}));
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.out, one.out) << "one table, from rank 0";
    EXPECT_EQ(sortedLines(folder.read(name)), sortedLines(folder.read("one")));
  }
}

TEST(BatchRanks, WhatIsThereIsNotDoneAgain) {
  const TemporaryFolder folder;
  ASSERT_EQ(runSwept(batch({"-o", folder.path("whole")})).exitCode, 0);
  ASSERT_EQ(runSwept(batch({"-o", folder.path("part"), "--limit", "2"})).exitCode, 0);
  const std::string part = folder.read("part");
  EXPECT_EQ(runRanks(2, batch({"-o", folder.path("part")})).exitCode, 0);
  EXPECT_THAT(folder.read("part"), testing::StartsWith(part));
  EXPECT_EQ(sortedLines(folder.read("part")), sortedLines(folder.read("whole")));
}

TEST(BatchRanks, ARankThatCannotGoOnEndsTheJob) {
  const TemporaryFolder folder;
  folder.write("r", "a note\n");
  const Outcome run = runRanks(2, batch({"-o", folder.path("r")}));
  EXPECT_NE(run.exitCode, 0);
  EXPECT_THAT(run.err, testing::HasSubstr("swept: error: rank 0: " + folder.path("r") +
                                          ":1: error: not a results file: "));
  EXPECT_EQ(folder.read("r"), "a note\n");
}

#else

TEST(BatchRanks, ResultsAreThoseOfOneProcess) {
  GTEST_SKIP() << "built without MPI";
}

#endif

}  // namespace
}  // namespace swept::test
