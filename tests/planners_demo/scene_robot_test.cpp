// SPDX-License-Identifier: BSD-3-Clause
// What a scene says of its robot counts in every subcommand, and in proofs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "program.hpp"

namespace swept::test {
namespace {

using ::testing::HasSubstr;

/// Two balls of radius 0.1 m, at x = -1 + jl and x = 1 + jr, on a base that moves in the plane. The
/// SRDF disables their pair unless `srdf` is another.
class Arms {
 public:
  Arms() {
    const std::string ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
    const auto slide = [](const std::string& name, const std::string& child, const std::string& x) {
      return "<joint name='" + name + "' type='prismatic'><parent link='base'/><child link='" +
             child + "'/><origin xyz='" + x +
             " 0 0'/><axis xyz='1 0 0'/><limit lower='-3' upper='3' effort='1' velocity='1'/>"
             "</joint>";
    };
    urdf_ =
        folder_.write("two.urdf", "<robot name='two'><link name='base'/><link name='l'>" + ball +
                                      "</link><link name='r'>" + ball + "</link>" +
                                      slide("jl", "l", "-1") + slide("jr", "r", "1") + "</robot>");
    folder_.write("two.srdf",
                  "<robot name='two'><virtual_joint name='vj' type='planar' parent_frame='odom' "
                  "child_link='base'/><disable_collisions link1='l' link2='r' reason='Never'/>"
                  "<group name='left'><joint name='jl'/></group></robot>");
  }

  Outcome run(const std::string& command, const std::string& scene,
              const std::vector<std::string>& more) const {
    std::vector<std::string> words{
        command, urdf_, "--group", "left", "-q", "--scene", folder_.write("s.yaml", scene)};
    words.insert(words.end(), more.begin(), more.end());
    return runSwept(words);
  }
  int check(const std::string& scene, const std::string& state) const {
    return run("check", scene, {"--", state}).exitCode;
  }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
  std::string urdf_;
};

constexpr int kFree = 0, kCollision = 1, kBadInput = 3;

const std::string kBall =
    "collision_objects: [{id: a, primitives: [{type: sphere, dimensions: [0.1]}], "
    "primitive_poses: [{position: [-1, 0, 1.5]}]}]\n";
const std::string kRod =
    "robot_state: {attached_collision_objects: [{link_name: l, object: {id: rod, header: "
    "{frame_id: l}, primitives: [{type: box, dimensions: [0.1, 0.1, 4]}]}}]}\n";
const std::string kOther = "robot_state: {joint_state: {name: [jr], position: [-1.5]}}\n";
const std::string kMatrix =
    "allowed_collision_matrix: {entry_names: [l, r], entry_values: [[1, 0], [0, 1]]}\n";
const std::string kEmpty = "world: {collision_objects: []}\n";

TEST(SceneRobot, CheckAnswersForTheSceneOfTheFile) {
  const Arms arms;
  EXPECT_EQ(arms.check(kBall, "0"), kFree);
  EXPECT_EQ(arms.check(kRod + kBall, "0"), kCollision) << "an attached object";
  EXPECT_EQ(arms.check(kMatrix + kEmpty, "0.45"), kFree);
  EXPECT_EQ(arms.check(kMatrix + kOther + kEmpty, "0.45"), kCollision) << "the other arm";
  EXPECT_EQ(arms.check(kOther + kEmpty, "0.45"), kFree) << "the SRDF's pair";
  const std::string base =
      "robot_state: {multi_dof_joint_state: {joint_names: [vj], transforms: [{translation: [0, 3, "
      "0]}]}}\ncollision_objects: [{id: a, primitives: [{type: sphere, dimensions: [0.1]}], "
      "primitive_poses: [{position: [-1, 3, 0]}]}]\n";
  EXPECT_EQ(arms.check(base, "0"), kCollision) << "a moved base";
  const std::string frame =
      "collision_objects: [{id: a, header: {frame_id: l}, primitives: [{type: sphere, dimensions: "
      "[0.1]}]}]\n";
  EXPECT_EQ(arms.check(frame, "0"), kCollision) << "an object at a link";
  EXPECT_EQ(arms.check(frame, "0.5"), kFree);
}

TEST(SceneRobot, AFrameThatNobodyKnowsIsNoFrameOfTheRobot) {
  const Outcome run = Arms().run(
      "check",
      "collision_objects: [{id: a, header: {frame_id: camera}, primitives: [{type: sphere, "
      "dimensions: [0.1]}]}]\n",
      {"--", "0"});
  EXPECT_EQ(run.exitCode, kBadInput);
  EXPECT_THAT(run.err, HasSubstr("header.frame_id is 'camera', which is no frame of the robot"));
}

TEST(SceneRobot, RulesOfTheCommandLineCountBeforeTheScenes) {
  const Arms arms;
  EXPECT_EQ(arms.run("check", kMatrix + kOther + kEmpty, {"--allow", "l,r", "--", "0.45"}).exitCode,
            kFree);
}

TEST(SceneRobot, MotionsPlansAndProofsAreForTheSceneOfTheFile) {
  const Arms arms;
  EXPECT_EQ(arms.run("motion", kMatrix + kOther + kEmpty, {"--", "0", "1.5"}).exitCode, kCollision);
  EXPECT_NE(arms.run("plan", kRod + kBall, {"--time", "0.2", "--", "0", "0.2"}).exitCode, kFree);
  const std::string path = arms.folder().path("path.json");
  const std::string scene = kMatrix + kOther + kBall;
  ASSERT_EQ(arms.run("plan", scene, {"-o", path, "--", "0", "0.25"}).exitCode, kFree);
  EXPECT_EQ(runSwept({"verify", path}).exitCode, 0);
  // In the same file the other arm stands in the way by now.
  arms.folder().write(
      "s.yaml", kMatrix + "robot_state: {joint_state: {name: [jr], position: [-1.8]}}\n" + kBall);
  EXPECT_EQ(runSwept({"verify", path}).exitCode, kCollision);
}

TEST(SceneRobot, InfoShowsWhatLinksCarry) {
  const Outcome run = Arms().run("info", kRod + kBall, {"--explain", "rod,a"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("rod - a: checked"));
}

TEST(SceneRobot, ARequestCarriesWhatItsStartSays) {
  const Arms arms;
  const auto request = [&](const std::string& attached, const std::string& goal) {
    return arms.folder().write(
        "r.yaml", "group_name: left\nstart_state: {joint_state: {name: [jl], position: [0]}" +
                      attached + "}\ngoal_constraints: [{joint_constraints: [" + goal + "]}]\n");
  };
  const std::string goal = "{joint_name: jl, position: 0.2}";
  const auto plan = [&](const std::string& scene, const std::string& file) {
    return arms.run("plan", scene, {"--time", "0.2", "--request", file});
  };
  EXPECT_EQ(plan(kBall, request("", goal)).exitCode, kFree);
  EXPECT_NE(plan(kRod + kBall, request("", goal)).exitCode, kFree) << "of the scene";
  const std::string rod =
      ", attached_collision_objects: [{link_name: l, object: {id: rod, header: {frame_id: l}, "
      "primitives: [{type: box, dimensions: [0.1, 0.1, 4]}]}}]";
  EXPECT_NE(plan(kBall, request(rod, goal)).exitCode, kFree) << "of the request";
  const Outcome other = plan(kBall, request("", goal + ", {joint_name: jr, position: 1}"));
  EXPECT_EQ(other.exitCode, kBadInput);
  EXPECT_THAT(other.err, HasSubstr("goal: joint 'jr' is at 0, where group 'left' has it, and not "
                                   "at 1"));
}

}  // namespace
}  // namespace swept::test
