// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "batch.hpp"
#include "gantry.hpp"

/// Programs that are started without stdin, stdout or stderr. The next file, pipe or socket gets
/// the number of a stream that is closed, and then what is meant for the stream.
namespace swept::test {
namespace {

const std::string kCheck = "swept check models/robots/rook7/rook7.urdf home --group arm ";
constexpr const char* kNoOutput = "swept: error: cannot write to standard output\n";

TEST(ClosedStreams, MeshesAreReadWithAnyTwoOrAllThreeClosed) {
  Outcome run = runShell(kCheck + "<&- >&-");
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.err, kNoOutput);
  run = runShell(kCheck + "<&- 2>&-");
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.out, runShell(kCheck).out);
  EXPECT_EQ(runShell(kCheck + ">&- 2>&-").exitCode, 3);
  EXPECT_EQ(runShell(kCheck + "<&- >&- 2>&-").exitCode, 3);
}

/// A batch that goes on wrote its warnings into the file too.
TEST(ClosedStreams, AResultsFileHasResultsOnly) {
  const Gantry gantry;
  // The box on the rail is in contact with what stands there, which is worth a warning.
  const std::string batch = "swept bench planners '" + gantry.urdf + "' --group both --problems '" +
                            gantry.problems +
                            "' --set over --no-times --attach box:0.1,0.1,0.1@rail:1,0,0 -o ";
  const TemporaryFolder folder;
  const Outcome open = runShell(batch + folder.path("whole"));
  ASSERT_EQ(open.exitCode, 0);
  ASSERT_THAT(open.err, testing::HasSubstr("warning: "));
  const std::string whole = folder.read("whole");
  const std::string part = whole.substr(0, whole.rfind('\n', whole.size() - 2) + 1);
  for (const std::string closed :
       {"2>&-", "<&- 2>&-", ">&-", "<&- >&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
    folder.write("part", part);
    const Outcome run = runShell(batch + folder.path("part") + " --jobs 2 " + closed);
    const bool hasOutput = closed.find(" >") == std::string::npos && closed[0] != '>';
    EXPECT_EQ(run.exitCode, hasOutput ? 0 : 3) << closed;
    EXPECT_EQ(folder.read("part"), whole) << closed;
  }
}

TEST(ClosedStreams, APathFileIsWritten) {
  const Gantry gantry;
  const std::string file = gantry.folder().path("path.csv");
  EXPECT_EQ(runShell("swept plan '" + gantry.urdf + "' left right --group both -o '" + file +
                     "' <&- >&- 2>&-")
                .exitCode,
            3);
  EXPECT_THAT(gantry.folder().read("path.csv"), testing::StartsWith("slide,lift\n0,0\n"));
}

}  // namespace
}  // namespace swept::test
