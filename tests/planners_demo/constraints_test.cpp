// SPDX-License-Identifier: BSD-3-Clause
// Constraints on the command line, in files with proofs, and what `swept verify` says of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "gantry.hpp"
#include "models_dir.hpp"
#include "page_data.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"
#include "verify/check.hpp"

namespace swept::test {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kOver = "slide,lift\n0,0\n0,0.5\n2,0.5\n2,0\n";

/// The gantry's cube goes over the post at a height of 0.5 m.
class Constraints : public testing::Test {
 protected:
  Outcome certify(const std::vector<std::string>& more) const {
    std::vector<std::string> all{gantry_.folder().write("over.csv", kOver)};
    all.insert(all.end(), more.begin(), more.end());
    return gantry_.run("certify", all);
  }
  /// Of a path whose cube stays below 0.55 m.
  Json proven() const {
    const std::string file = gantry_.folder().path("path.json");
    const Outcome run = certify({"--stay-in", "cube:box:5,1,1.1", "-o", file});
    EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
    return Json::parse(gantry_.folder().read("path.json"));
  }
  /// What verify says of the file after a change of its only constraint; `sign`: with digests that
  /// fit.
  Outcome verified(const std::function<void(Json&)>& change, bool sign) const {
    Json path = proven();
    change(path["constraints"]);
    if (sign) path["proof"]["digests"]["claims"] = verify::claimDigests(path);
    return runSwept({"verify", gantry_.folder().write("changed.json", path.dump())});
  }
  void expectRefused(const std::string& refusal, const std::function<void(Json&)>& change,
                     bool sign = true) const {
    const Outcome run = verified(change, sign);
    EXPECT_EQ(run.exitCode, 1);
    EXPECT_EQ(run.out, "refused: " + refusal + "\n");
  }

  Gantry gantry_;
};

TEST_F(Constraints, OfAFileAreShownAgain) {
  const Json path = proven();
  EXPECT_EQ(path["warnings"], Json::array());
  const std::string file = gantry_.folder().path("path.json");
  const Outcome run = runSwept({"verify", file});
  EXPECT_EQ(run.exitCode, 0) << run.out;
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("\nat every instant: point (0, 0, 0) of cube in a box of 5 x 1 x "
                                 "1.1 m at (0, 0, 0)\n"));
  EXPECT_EQ(jsonOf(runSwept({"verify", file, "--json"}))["constraints"],
            Json::array({"point (0, 0, 0) of cube in a box of 5 x 1 x 1.1 m at (0, 0, 0)"}));
}

TEST_F(Constraints, ThatWereChangedAreNamed) {
  const auto narrower = [](Json& list) { list[0]["regions"][0]["size"][2] = 1.2; };
  expectRefused("path file, constraints: is not as it was when the path was certified", narrower,
                false);
  Json path = proven();
  path.erase("constraints");
  const Outcome run = runSwept({"verify", gantry_.folder().write("changed.json", path.dump())});
  EXPECT_EQ(run.out,
            "refused: path file, constraints: is not there, and was when the path was certified\n");
}

/// Digests keep nobody from writing others. The cube's origin is 0.5 m high, and the path is 2 m
/// long.
TEST_F(Constraints, ThatDoNotHoldAreRefusedWhateverTheDigestsSay) {
  const auto height = [](double size) {
    return [size](Json& list) { list[0]["regions"][0]["size"][2] = size; };
  };
  EXPECT_EQ(verified(height(1.0 + 1e-6), true).exitCode, 0);
  EXPECT_EQ(verified(height(1.0 - 1e-9), true).exitCode, 1);
  expectRefused("segment 1, position of cube: not shown at 0.875 of the segment", height(0.8));
  expectRefused("segment 2, position of cube: not shown at 0.75 of the segment",
                [](Json& list) { list[0]["regions"][0]["size"][0] = 2.8; });
  const auto joint = [](double above) {
    return [above](Json& list) {
      list = {{{"kind", "joint"},
               {"joint", "lift"},
               {"value", 0u},
               {"cyclic", false},
               {"position", 0.2},
               {"above", above},
               {"below", 0.2}}};
    };
  };
  EXPECT_THAT(verified(joint(0.3), true).out,
              HasSubstr("at every instant: joint lift from 0 to 0.5"));
  expectRefused("segment 1, joint lift: not shown at 0.5 of the segment", joint(0.0));
}

/// Each joint may be 0.01 m off, so that the cube is up to 0.51 m high.
TEST_F(Constraints, HoldInTheTubeOfATrajectory) {
  const std::string csv =
      gantry_.folder().write("timed.csv", "time,slide,lift\n0,0,0\n1,0,0.5\n4,2,0.5\n5,2,0\n");
  const std::string file = gantry_.folder().path("timed.json");
  const Outcome run = gantry_.run("trajectory", {csv, "--group", "both", "--tracking", "0.01",
                                                 "--stay-in", "cube:box:5,1,1.1", "-o", file});
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  Json path = Json::parse(gantry_.folder().read("timed.json"));
  const auto exitCode = [&](double size) {
    path["constraints"][0]["regions"][0]["size"][2] = size;
    path["proof"]["digests"]["claims"] = verify::claimDigests(path);
    return runSwept({"verify", gantry_.folder().write("changed.json", path.dump())}).exitCode;
  };
  EXPECT_EQ(exitCode(1.02 + 1e-6), 0);
  EXPECT_EQ(exitCode(1.02 - 1e-9), 1);
}

TEST_F(Constraints, OfAFileThatAreNoneAreRefused) {
  const auto in = [](const char* key, Json value) {
    return [key, value](Json& list) { list[0][key] = value; };
  };
  const auto inRegion = [](const char* key, Json value) {
    return [key, value](Json& list) { list[0]["regions"][0][key] = value; };
  };
  const Json frame = {{"link", "cube"}, {"pose", {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}}};
  const auto instead = [&](Json constraint) {
    return [constraint, frame](Json& list) {
      list[0] = constraint;
      if (constraint["kind"] == "joint") return;
      list[0]["frame"] = list[0]["reference"] = frame;
    };
  };
  const Json joint = {{"kind", "joint"}, {"joint", "lift"}, {"value", 0u}, {"cyclic", false},
                      {"position", 0},   {"above", 1},      {"below", 1}};
  const auto inJoint = [&](const char* key, Json value) {
    Json changed = joint;
    changed[key] = value;
    return instead(changed);
  };
  const auto turned = [&](Json orientation, Json tolerance, Json parameterization) {
    return instead({{"kind", "orientation"},
                    {"orientation", orientation},
                    {"tolerance", tolerance},
                    {"parameterization", parameterization}});
  };
  const auto tilted = [&](Json axis, Json angle) {
    return instead({{"kind", "axis"}, {"axis", axis}, {"direction", {0, 0, 1}}, {"angle", angle}});
  };
  expectRefused("constraints: not a list", [](Json& list) { list = 1; });
  expectRefused("constraint 1: there is no kind", [](Json& list) { list[0].erase("kind"); });
  expectRefused("constraint 1: no kind 'visibility'", in("kind", "visibility"));
  expectRefused("constraint 1: it has no weight", in("weight", 1));
  expectRefused("constraint 1, frame: no link \"lid\"",
                [](Json& list) { list[0]["frame"]["link"] = "lid"; });
  expectRefused("constraint 1, frame, pose: not a rotation",
                [](Json& list) { list[0]["frame"]["pose"][0] = 1.001; });
  expectRefused("constraint 1: there is no region", in("regions", Json::array()));
  expectRefused("constraint 1, regions: no type of region 'cone'", inRegion("type", "cone"));
  expectRefused("constraint 1, regions: not 1 sizes", inRegion("type", "sphere"));
  expectRefused("constraint 1, regions, size: negative", inRegion("size", {1, 1, -1}));
  expectRefused("constraint 1: no joint swing", inJoint("joint", "swing"));
  expectRefused("constraint 1: joint lift has no value 1", inJoint("value", 1u));
  expectRefused("constraint 1: cyclic is neither false nor, of an angle, true",
                inJoint("cyclic", true));
  expectRefused("constraint 1, below: not a number: \"0\"", inJoint("below", "0"));
  expectRefused("constraint 1: orientation has not length 1",
                turned({0, 0, 0, 2}, {1, 1, 1}, "euler_angles"));
  expectRefused("constraint 1: tolerance is not three numbers",
                turned({0, 0, 0, 1}, {1, 1}, "euler_angles"));
  expectRefused("constraint 1: no parameterization 'quaternion'",
                turned({0, 0, 0, 1}, {1, 1, 1}, "quaternion"));
  expectRefused("constraint 1: axis has not length 1", tilted({0, 0, 2}, 1));
  expectRefused("constraint 1, angle: negative", tilted({0, 0, 1}, -1));
}

TEST_F(Constraints, ThatAreLeftAreNamed) {
  const Outcome run = certify({"--stay-in", "cube:box:5,1,0.8"});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, HasSubstr("position of 'cube' is "));
  EXPECT_THAT(run.out, HasSubstr(" m outside its region"));
}

/// The tool is turned by 0.8 rad about the vertical, at the end and on the way.
TEST(ConstrainedPlan, OfAGoalPoseIsProvenAndShownAgain) {
  const std::string rook = modelsDir() + "/robots/rook7/rook7";
  const auto robot = Robot::load(rook + ".urdf", rook + ".srdf");
  const Group& arm = *std::ranges::find(robot->groups(), "arm", &Group::name);
  std::vector<double> q = namedConfiguration(*robot, arm, "ready");
  q[0] += 0.8;
  const Eigen::Isometry3d pose = linkPose(*robot, "arm", "link7", q);
  const Eigen::Quaterniond turn(pose.linear());
  std::string goal;
  for (const double number : {pose.translation().x(), pose.translation().y(),
                              pose.translation().z(), turn.x(), turn.y(), turn.z(), turn.w()})
    goal += (goal.empty() ? "" : ",") + std::to_string(number);
  TemporaryFolder folder;
  const std::string file = folder.path("path.json");
  const Outcome run = runSwept({"plan", rook + ".urdf", "ready", "--goal-pose=" + goal, "--group",
                                "arm", "--keep-level", "link7:10", "--seed", "1", "-o", file});
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  EXPECT_THAT(run.out, HasSubstr("proven free"));
  const Outcome check = runSwept({"verify", file});
  EXPECT_EQ(check.exitCode, 0) << check.out;
  EXPECT_THAT(check.out, HasSubstr("of link7 within 0.175 rad of (0, 0, 1)"));
  // An own reading: the axis that is up at the start stays within 10 degrees of it.
  const Json path = Json::parse(folder.read("path.json"));
  const Eigen::Vector3d up =
      linkPose(*robot, "arm", "link7", namedConfiguration(*robot, arm, "ready")).linear().row(2);
  const auto states = path["states"].get<std::vector<std::vector<double>>>();
  for (std::size_t i = 1; i < states.size(); ++i)
    for (int k = 0; k <= 1000; ++k) {
      for (std::size_t j = 0; j < q.size(); ++j)
        q[j] = states[i - 1][j] + k / 1000.0 * (states[i][j] - states[i - 1][j]);
      const double cosine = (linkPose(*robot, "arm", "link7", q).linear() * up).z();
      ASSERT_GE(cosine, std::cos(10.0 * M_PI / 180.0) - 1e-12) << i << ' ' << k;
    }
}

/// The curve of a trajectory, in a tube.
TEST(ConstrainedPlan, OfATrajectoryIsShownAgain) {
  const std::string rook = modelsDir() + "/robots/rook7/rook7.urdf";
  TemporaryFolder folder;
  const std::string file = folder.path("trajectory.json");
  const Outcome run = runSwept({"plan", rook, "ready", "1.5,-0.3,0,1.9,0,1.54,0", "--group", "arm",
                                "--keep-level", "link7:10", "--timed", "--tracking", "0.005",
                                "--max-acceleration", "5", "--seed", "1", "-o", file});
  ASSERT_EQ(run.exitCode, 0) << run.out << run.err;
  const Outcome check = runSwept({"verify", file});
  EXPECT_EQ(check.exitCode, 0) << check.out;
  EXPECT_THAT(check.out, StartsWith("verified: trajectory of "));
  EXPECT_THAT(check.out, HasSubstr("tube 0.005 rad"));
  EXPECT_THAT(check.out, HasSubstr("of link7 within 0.175 rad of (0, 0, 1)"));
}

}  // namespace
}  // namespace swept::test
