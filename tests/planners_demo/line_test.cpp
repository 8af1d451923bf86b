// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "program.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;

class LineProgram : public testing::Test {
 protected:
  /// Two links of 1 m that turn about z; the tip carries a ball. Begins at (1, 1, 0).
  Outcome run(const std::vector<std::string>& options) const {
    std::vector<std::string> all{"line", urdf_, "0,1.5707963267948966", "--link", "tip"};
    all.insert(all.end(), options.begin(), options.end());
    return runSwept(all);
  }

  TemporaryFolder folder_;
  std::string urdf_ = folder_.write("arm.urdf", R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base"/><link name="upper"/><link name="lower"/>
  <link name="tip"><collision><geometry><sphere radius="0.05"/></geometry></collision></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="elbow" type="revolute"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/>
    <axis xyz="0 0 1"/><limit lower="-3" upper="3" effort="1" velocity="1"/></joint>
  <joint name="end" type="fixed"><parent link="lower"/><child link="tip"/><origin xyz="1 0 0"/></joint>
</robot>
)");
  std::string wall_ = folder_.write("wall.yaml", R"(world:
  collision_objects:
    - id: wall
      primitives:
        - {type: box, dimensions: [0.2, 1, 1]}
      primitive_poses:
        - {position: [1.6, 1, 0], orientation: [0, 0, 0, 1]}
)");
};

TEST_F(LineProgram, GoesThereAndBack) {
  const std::string out = folder_.path("line.json");
  const Outcome there = run({"--by", "0.3,0,0", "--by", "-0.3,0,0", "--deviation", "1,180",
                             "--scene", wall_, "--json", "-o", out});
  ASSERT_EQ(there.exitCode, 0) << there.err << there.out;
  const nlohmann::json found = jsonOf(there);
  EXPECT_EQ(found["complete"], true);
  ASSERT_EQ(found["lines"].size(), 2U);
  for (const nlohmann::json& line : found["lines"]) {
    EXPECT_NEAR(line["length"], 0.3, 1e-9);
    EXPECT_EQ(line["proven_share"], 1.0);
    EXPECT_LE(line["deviation"], 1e-3);
    EXPECT_TRUE(line["stop"].is_null());
  }
  EXPECT_NEAR(found["states"].back()[0], 0.0, 1e-5);
  EXPECT_EQ(found["path_file"], out);
  // The path is one for the other subcommands.
  EXPECT_EQ(runSwept({"certify", urdf_, out, "--scene", wall_}).exitCode, 0);
  const Outcome verified = runSwept({"verify", out});
  EXPECT_EQ(verified.exitCode, 0) << verified.out;
  EXPECT_THAT(verified.out, HasSubstr("at every instant: in segments 1 to "));
  EXPECT_THAT(verified.out, HasSubstr(" point (0, 0, 0) of tip within 0.001 m of the line from (1, "
                                      "1, 0) to (1.3, 1, 0)\n"));
  EXPECT_THAT(verified.out, HasSubstr("of the line from (1.3, 1, 0) to (1, 1, 0)\n"));
}

/// Who says that the tool keeps to another line is not believed.
TEST_F(LineProgram, ItsProofIsOfTheLine) {
  const std::string out = folder_.path("line.json");
  ASSERT_EQ(run({"--by", "0.3,0,0", "--deviation", "1,180", "--embed", "-o", out}).exitCode, 0);
  EXPECT_EQ(runSwept({"verify", out}).exitCode, 0);
  auto path = nlohmann::ordered_json::parse(folder_.read("line.json"));
  path["lines"][0]["position"] = 1e-6;
  folder_.write("line.json", path.dump());
  const Outcome changed = runSwept({"verify", out});
  EXPECT_EQ(changed.exitCode, 1);
  EXPECT_EQ(changed.out,
            "refused: path file, lines: is not as it was when the path was certified\n");
}

TEST_F(LineProgram, SaysWhereALineEnds) {
  const std::string out = folder_.path("line.json");
  const Outcome blocked =
      run({"--to", "1.7,1,0", "--deviation", "1,180", "--scene", wall_, "-o", out});
  EXPECT_EQ(blocked.exitCode, 1);
  EXPECT_THAT(blocked.out, HasSubstr("line 1: ends early"));
  EXPECT_THAT(blocked.out, HasSubstr("contact at 0.64"));  // 0.45 m of 0.7 m
  EXPECT_THAT(blocked.out, HasSubstr("tip - wall"));
  EXPECT_THAT(blocked.out, HasSubstr("no path written: a line ends early"));
  const Outcome far = run({"--by", "1,0,0", "--deviation", "1,180", "--json"});
  EXPECT_EQ(far.exitCode, 1);
  const nlohmann::json line = jsonOf(far)["lines"][0];
  EXPECT_EQ(line["stop"]["reason"], "singularity");
  EXPECT_NEAR(line["proven_share"], std::sqrt(3.0) - 1.0, 1e-3);
  // Along the lower link, which points along y.
  const Outcome tool =
      run({"--by", "0.1,0,0", "--frame", "tool", "--deviation", "1,180", "--json"});
  const nlohmann::json q = jsonOf(tool)["states"].back();
  EXPECT_NEAR(std::sin(q[0].get<double>()) + std::sin(q[0].get<double>() + q[1].get<double>()), 1.1,
              1e-5);
}

TEST_F(LineProgram, SaysWhatIsWrongWithItsInput) {
  const auto error = [&](const std::vector<std::string>& options) {
    const Outcome outcome = run(options);
    EXPECT_EQ(outcome.exitCode, 3) << outcome.out;
    return outcome.err;
  };
  EXPECT_THAT(error({}), HasSubstr("line: --to or --by is needed"));
  EXPECT_THAT(error({"--by", "1,2"}), HasSubstr("--by: 2 values, expected 3: x,y,z"));
  EXPECT_THAT(error({"--by", "0,0,0", "--frame", "base"}),
              HasSubstr("--frame is 'base', allowed are world and tool"));
  EXPECT_THAT(error({"--to", "1,1,0,0,0,0,2"}),
              HasSubstr("--to: the quaternion has norm 2, allowed is 1"));
  EXPECT_THAT(error({"--by", "0,0,0", "--deviation", "-1"}),
              HasSubstr("--deviation: mm is -1, which must be above 0"));
  EXPECT_THAT(error({"--by", "0,0,0", "--deviation", "1,0"}),
              HasSubstr("--deviation: degrees is 0, which must be above 0"));
  EXPECT_THAT(error({"--by", "0,0,0", "--embed"}), HasSubstr("--embed needs -o FILE.json"));
  EXPECT_THAT(runSwept({"line", urdf_, "0,1", "--link", "tap", "--by", "0,0,0"}).err,
              HasSubstr("'tap' is no link and no attached body; did you mean 'tip'?"));
  EXPECT_THAT(runSwept({"line", urdf_, "0,1", "0,1", "--by", "0,0,0"}).err,
              HasSubstr("line: one state is needed, where it starts"));
}

}  // namespace
}  // namespace swept::test
