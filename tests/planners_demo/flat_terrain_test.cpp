// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.hpp"

/// `heights` of a case that are a text: `flat, all H, RxC samples, base B`.
namespace swept::test {
namespace {

using nlohmann::json;
using testing::EndsWith;

constexpr const char* kWanted = "rows of numbers, or 'flat, all H, RxC samples, base B'";

/// A ball of radius 1 whose centre is 5 above the terrain's origin.
Outcome replay(const std::string& heights, double expected) {
  const json here = {{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
  json above = here;
  above[2][3] = 5;
  const json terrain = {{"type", "heightfield"}, {"x_dim", 1}, {"y_dim", 1}, {"heights", heights}};
  const json file = {{"cases",
                      {{{"id", "a"},
                        {"query", "distance"},
                        {"shapes", {{{"type", "sphere"}, {"radius", 1}}, terrain}},
                        {"transforms", {above, here}},
                        {"expected", {{"signed_distance", expected}, {"tolerance", 1e-9}}}}}}};
  const TemporaryFolder folder;
  Outcome run = runSwept({"replay", folder.write("cases.json", file.dump())});
  if (const auto at = run.err.find(folder.path()); at != std::string::npos)
    run.err.replace(at, folder.path("cases.json").size(), "FILE");
  return run;
}

TEST(FlatTerrain, NumbersAsTheyAreUsuallyWritten) {
  for (const auto& [text, distance] : std::vector<std::pair<std::string, double>>{
           {"flat, all 1, 9x5 samples, base -1", 3.0},
           {"flat, all 0.5, 2x2 samples, base 0", 3.5},
           {"flat, all -.5, 2x9999 samples, base -1e0", 4.5},
           {"flat, all +1.25E-1, 0003x03 samples, base -1.", 3.875}}) {
    const Outcome run = replay(text, distance);
    EXPECT_THAT(run.out, EndsWith("1 passed, 0 failed, 0 skipped\n")) << text << run.err;
  }
}

TEST(FlatTerrain, OtherTextsAreRefused) {
  for (const std::string text :
       {"", "flat", "flat, all 1, 9x5 samples, base", "flat, all 1, 9x5 samples, base -1 ",
        "flat, all one, 9x5 samples, base 0", "flat, all 1, 9x samples, base 0",
        "flat, all 1, 9x-5 samples, base 0", "flat, all 1, 9 x 5 samples, base 0",
        "flat, all 1e999, 9x5 samples, base 0", "flat, all nan, 9x5 samples, base 0",
        "flat, all 1, 12345x2 samples, base 0", "flat, all 1--, 2x2 samples, base 0",
        "hilly, all 1, 9x5 samples, base 0", "flat, all  1, 9x5 samples, base 0"}) {
    const Outcome run = replay(text, 0.0);
    EXPECT_EQ(run.exitCode, 3) << text;
    EXPECT_EQ(run.err, "FILE: error: case 'a': shapes[1].heights is " + json(text).dump() +
                           "; it must be " + kWanted + "\n");
  }
  EXPECT_EQ(replay("flat, all 1, 1x2 samples, base 0", 0.0).err,
            "FILE: error: case 'a': shapes[1] is no shape: height field has 1 rows and 2 columns; "
            "allowed: at least 2 of each\n");
}

/// A regular expression went down the stack with each of its characters, to the stack's end.
TEST(FlatTerrain, ALongTextIsRefusedAndNotRepeated) {
  for (const std::string& text :
       {"flat, all " + std::string(300'000, '1') + ", 9x5 samples, base 0",
        std::string(300'000, 'f')}) {
    const Outcome run = replay(text, 0.0);
    EXPECT_EQ(run.signal, 0);
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.err, "FILE: error: case 'a': shapes[1].heights is a text of " +
                           std::to_string(text.size()) + " characters; it must be " + kWanted +
                           "\n");
  }
}

TEST(FlatTerrain, MoreSamplesThanMemoryHasRoomForAreRefused) {
  EXPECT_EQ(replay("flat, all 1, 9999x9999 samples, base 0", 0.0).err,
            "FILE: error: case 'a': shapes[1].heights has 9999x9999 samples; it may have 1000000 "
            "in all\n");
  EXPECT_EQ(replay("flat, all 1, 1001x1000 samples, base 0", 0.0).exitCode, 3);
}

}  // namespace
}  // namespace swept::test
