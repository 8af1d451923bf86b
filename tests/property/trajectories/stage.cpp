// SPDX-License-Identifier: BSD-3-Clause
#include "stage.hpp"

#include <algorithm>
#include <utility>

#include "models_dir.hpp"

namespace trajectories {

namespace {

using swept::JointType;

swept::MovingObstacle passingBox() {
  swept::MovingObstacle box{
      .name = "passing",
      .parts = {{swept::makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}}};
  for (const double time : {0.0, 0.3, 0.7, 2.0, 5.0}) {
    const Eigen::Vector3d place(0.7, 0.6 * (time - 1.5), 0.4 + 0.1 * time);
    Eigen::Isometry3d pose(Eigen::Translation3d{place});
    pose.rotate(Eigen::AngleAxisd(0.4 * time, Eigen::Vector3d(0.6, 0.0, 0.8)));
    box.waypoints.push_back({time, pose});
  }
  return box;
}

std::shared_ptr<const swept::World> worldOf(const std::string& scene, bool passing) {
  auto world = std::make_shared<swept::World>(
      swept::World::load(modelsDir() + "/scenes/" + scene + ".yaml"));
  if (passing) world->add(passingBox());
  return world;
}

Scene sceneOf(const std::string& robot, const std::string& group, const std::string& world,
              bool passing = false) {
  const std::string urdf = modelsDir() + "/robots/" + robot + "/" + robot + ".urdf";
  return {robot + " " + group + " in " + world + (passing ? ", box passing" : ""),
          swept::Robot::load(urdf, swept::Robot::srdfBeside(urdf)), group, worldOf(world, passing)};
}

double tolerance(std::uint64_t tube, Random& random) {
  if (tube == 1) return random.decades(-4.0, -3.0);
  if (tube == 2) return random.decades(-3.0, -2.3);
  return random.decades(-2.3, -1.3);
}

/// For all joints, or for each of its own.
swept::TrackingTolerance trackingOf(const Scene& scene, std::uint64_t tube, Random& random) {
  swept::TrackingTolerance tracking;
  if (tube == 0) return tracking;
  tracking.rotation = tolerance(tube, random);
  tracking.translation = 0.3 * tolerance(tube, random);
  if (random.chance(0.5)) return tracking;
  for (const int joint : scene.robot->findGroup(scene.group)->joints) {
    swept::JointTolerance own;
    if (random.chance(0.8)) own.rotation = tolerance(tube, random);
    if (random.chance(0.8)) own.translation = 0.3 * tolerance(tube, random);
    if (random.chance(0.8))
      tracking.joints[scene.robot->joints()[static_cast<std::size_t>(joint)].name] = own;
  }
  return tracking;
}

void addJoints(const Scene& scene, const swept::TrackingTolerance& tracking, Stage& stage) {
  const swept::Robot& robot = *scene.robot;
  const swept::Group& group = *robot.findGroup(scene.group);
  for (const int index : group.joints) {
    const swept::Joint& joint = robot.joints()[static_cast<std::size_t>(index)];
    StageJoint& own = stage.joints.emplace_back();
    own.type = joint.type;
    const auto at = std::ranges::find(group.variables, joint.firstVariable);
    own.first = static_cast<std::size_t>(at - group.variables.begin());
    const auto named = tracking.joints.find(joint.name);
    if (named == tracking.joints.end())
      own.tolerance = tracking;
    else
      own.tolerance = named->second;
    stage.widest = std::max({stage.widest, own.tolerance.rotation, own.tolerance.translation});
  }
  for (const int index : group.variables) {
    const swept::Variable& variable = robot.variables()[static_cast<std::size_t>(index)];
    const JointType type = robot.joints()[static_cast<std::size_t>(variable.joint)].type;
    const std::size_t at = stage.variables.size();
    const bool orientation = std::ranges::any_of(stage.joints, [at](const StageJoint& own) {
      return own.type == JointType::Floating && at >= own.first + 3 && at < own.first + 7;
    });
    stage.variables.push_back({variable.lower, variable.upper, type == JointType::Prismatic,
                               variable.cyclic, orientation});
  }
}

}  // namespace

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> all{
      sceneOf("rook7", "arm", "shelf"),
      sceneOf("rook7", "arm_with_gripper", "tunnel_trap"),
      sceneOf("rook6", "arm_with_tool", "bin"),
      sceneOf("rook6_cart", "whole_body", "cage"),
      sceneOf("drifter", "body", "table_objects"),
      sceneOf("rook7", "arm", "table_objects", true),
  };
  return all;
}

Stage makeStage(std::uint64_t seed, std::uint64_t index) {
  Random random(seed + 1'000'003, index);
  const Scene& scene = scenes()[index % scenes().size()];
  swept::CheckerOptions options;
  options.margin = random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.02);
  swept::Checker plain(scene.robot, scene.group, scene.world, options);
  options.tracking = trackingOf(scene, index / scenes().size() % kTubes, random);
  swept::Checker checker(scene.robot, scene.group, scene.world, options);
  Stage stage{.scene = scene.name,
              .checker = std::move(checker),
              .plain = std::move(plain),
              .joints = {},
              .variables = {},
              .timed = !scene.world->obstacles().empty()};
  addJoints(scene, options.tracking, stage);
  return stage;
}

}  // namespace trajectories
