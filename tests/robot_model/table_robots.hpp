// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "model_robots.hpp"
#include "simd/tables/pair_separation_table.hpp"
#include "simd_robots.hpp"
#include "swept/robot_model/robot.hpp"
#include "swept/robot_model/world.hpp"

/// Robots for tests of joint tables.
namespace swept::simd_test {

using detail::CheckerModel;
using detail::PairSeparationTable;

inline std::string triple(Random& random, double size) {
  const Eigen::Vector3d v = random.vector(size);
  return std::to_string(v.x()) + " " + std::to_string(v.y()) + " " + std::to_string(v.z());
}

/// A forearm, a wrist of two joints that turn about any axes, and a hand with a finger.
inline std::string randomWrist(Random& random) {
  return R"(<robot name="wrist">
  <link name="fore"><collision><origin xyz="0 0 -0.12"/>
    <geometry><box size="0.08 0.06 0.2"/></geometry></collision></link>
  <link name="bend"><collision><origin xyz="0 0.05 0.03"/>
    <geometry><cylinder radius="0.02" length="0.12"/></geometry></collision></link>
  <link name="hand"><collision><origin xyz="0.07 0 0" rpy="0.1 0.2 0.3"/>
    <geometry><box size="0.14 0.05 0.04"/></geometry></collision>
    <collision><origin xyz="0.16 0.03 0"/><geometry><sphere radius="0.03"/></geometry></collision></link>
  <link name="finger"><collision><origin xyz="0.05 0 0"/>
    <geometry><box size="0.08 0.01 0.01"/></geometry></collision></link>
  <joint name="swing" type="revolute"><parent link="fore"/><child link="bend"/>
    <origin xyz="0 0 0.02" rpy=")" +
         triple(random, 0.5) + R"("/><axis xyz=")" + triple(random, 1.0) + R"("/>
    <limit lower="-2.2" upper="2.6" effort="1" velocity="1"/></joint>
  <joint name="twist" type="continuous"><parent link="bend"/><child link="hand"/>
    <origin xyz=")" +
         triple(random, 0.06) + R"("/><axis xyz=")" + triple(random, 1.0) + R"("/></joint>
  <joint name="pinch" type="revolute"><parent link="hand"/><child link="finger"/>
    <origin xyz="0.12 -0.02 0.01"/><axis xyz=")" +
         triple(random, 1.0) + R"("/>
    <limit lower="-4" upper="6" effort="1" velocity="1"/></joint>
</robot>)";
}

/// Two claws on a trunk that turns, one of which mimics the other; a tail of two joints, and what
/// it hangs on comes after it in the file, so that the deeper body is a pair's first. Long parts.
inline std::string randomCrab(Random& random) {
  const auto joint = [&](const char* name, const char* parent, const char* child,
                         const char* origin, const std::string& rest) {
    return std::string("<joint name='") + name + "' type='revolute'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='" + origin + "' rpy='" +
           triple(random, 0.4) + "'/><axis xyz='" + triple(random, 1.0) + "'/>" + rest +
           "</joint>\n";
  };
  const auto limits = [](const char* lower, const char* upper) {
    return std::string("<limit lower='") + lower + "' upper='" + upper +
           "' effort='1' velocity='1'/>";
  };
  return R"(<robot name="crab">
  <link name="floor"/>
  <link name="sting"><collision><origin xyz="0.1 0 0"/>
    <geometry><box size="0.5 0.03 0.03"/></geometry></collision></link>
  <link name="tail"/>
  <link name="left"><collision><origin xyz="0.6 0 0"/>
    <geometry><box size="1.2 0.04 0.1"/></geometry></collision></link>
  <link name="right"><collision><origin xyz="0.5 0 0"/>
    <geometry><cylinder radius="0.03" length="1.1"/></geometry></collision></link>
  <link name="trunk"><collision>
    <geometry><box size="0.3 0.2 0.1"/></geometry></collision></link>
  <link name="horn"><collision>
    <geometry><box size="0.1 0.02 0.3"/></geometry></collision></link>
  <link name="fin"><collision><origin xyz="0 0 0.1"/>
    <geometry><box size="0.02 0.1 0.1"/></geometry></collision></link>
)" + joint("turn", "floor", "trunk", "0 0 0.5", limits("-2", "2")) +
         joint("open", "trunk", "left", "0.4 0.35 0.1", limits("-1.4", "1.8")) +
         joint("close", "trunk", "right", "0.4 -0.35 0",
               limits("-1.5", "1.5") + "<mimic joint='open' multiplier='-0.7' offset='0.1'/>") +
         joint("bend", "trunk", "tail", "-0.4 0 0", limits("-2", "2")) +
         joint("strike", "tail", "sting", "-0.1 0 0.1", limits("-7", "6.5")) +
         joint("steer", "tail", "fin", "-0.05 0 0.1", limits("-1", "1")) +
         R"(<joint name="grown" type="fixed"><parent link="trunk"/><child link="horn"/>
           <origin xyz="0.1 0 0.2"/></joint></robot>)";
}

/// As UR5s are built: an upper arm beside a base, a wrist that folds beside the forearm, both
/// within millimetres in most of their range; joints of two turns.
inline std::string universalArm() {
  const auto link = [](const char* name, const char* origin, const char* shape) {
    return std::string("<link name='") + name + "'><collision><origin " + origin + "/><geometry>" +
           shape + "</geometry></collision></link>\n";
  };
  const auto joint = [](const char* name, const char* parent, const char* child, const char* origin,
                        const char* axis) {
    return std::string("<joint name='") + name + "' type='revolute'><parent link='" + parent +
           "'/><child link='" + child + "'/><origin xyz='" + origin + "'/><axis xyz='" + axis +
           "'/><limit lower='-6.2832' upper='6.2832' effort='1' velocity='1'/></joint>\n";
  };
  return "<robot name='universal'>\n" +
         link("base", "xyz='0 0 0.045'", "<cylinder radius='0.075' length='0.09'/>") +
         link("shoulder", "xyz='0 0.02 0'", "<cylinder radius='0.058' length='0.12'/>") +
         link("upper", "xyz='0 0 0.2'", "<box size='0.11 0.11 0.52'/>") +
         link("fore", "xyz='0 0 0.19'", "<box size='0.08 0.08 0.46'/>") +
         link("wrist1", "xyz='0 0.045 0'", "<box size='0.07 0.12 0.07'/>") +
         link("wrist2", "xyz='0 0 0.045'", "<box size='0.07 0.07 0.12'/>") +
         link("tool", "xyz='0 0.08 0'", "<sphere radius='0.035'/>") +
         joint("pan", "base", "shoulder", "0 0 0.152", "0 0 1") +
         joint("lift", "shoulder", "upper", "0 0.136 0", "0 1 0") +
         joint("elbow", "upper", "fore", "0 -0.12 0.425", "0 1 0") +
         joint("one", "fore", "wrist1", "0 0 0.392", "0 1 0") +
         joint("two", "wrist1", "wrist2", "0 0.093 0", "0 0 1") +
         joint("three", "wrist2", "tool", "0 0 0.095", "0 1 0") + "</robot>";
}

struct Named {
  std::string name;
  std::shared_ptr<const CheckerModel> model;
};

inline std::vector<Named> buildRobotsWithTables() {
  const auto compile = [](const std::shared_ptr<const Robot>& robot, const char* group) {
    const Group& known = *robot->findGroup(group);
    const auto model = detail::compileChecker(robot, known, std::make_shared<World>(), {});
    // Tables of bodies that never meet, too.
    const auto all = std::make_shared<CheckerModel>(*model);
    for (detail::BodyPair& pair : all->bodyPairs) pair.never = false;
    all->simd = simdModelOf(*all);
    return std::shared_ptr<const CheckerModel>(all);
  };
  Random random(40);
  const auto wrist = [&] {
    return compile(Robot::parse(randomWrist(random), "wrist.urdf"), "all");
  };
  const auto crab = [&] { return compile(Robot::parse(randomCrab(random), "crab.urdf"), "all"); };
  return {{"wrist", wrist()},
          {"second_wrist", wrist()},
          {"third_wrist", wrist()},
          {"crab", crab()},
          {"second_crab", crab()},
          {"universal", compile(Robot::parse(universalArm(), "universal.urdf"), "all")},
          {"rook6", compile(test::modelRobot("rook6"), "arm_with_tool")},
          {"rook7", compile(test::modelRobot("rook7"), "arm_with_gripper")},
          {"rook6_cart", compile(test::modelRobot("rook6_cart"), "whole_body")}};
}

/// Built once.
inline const std::vector<Named>& robotsWithTables() {
  static const std::vector<Named> robots = buildRobotsWithTables();
  return robots;
}

/// Poses of both bodies at these values of the table's joints, all others at rest.
class Poses {
 public:
  using Axes = std::array<PairSeparationTable::Axis, PairSeparationTable::kMostJoints>;
  Poses(const CheckerModel& model, const Axes& axes, int joints)
      : model_(model), axes_(axes), joints_(joints) {}

  Eigen::Isometry3d between(int bodyA, int bodyB, const std::array<double, 2>& values) const {
    const Pose pose = world(bodyA, values).inverse() * world(bodyB, values);
    Eigen::Isometry3d result(pose.matrix().cast<double>());
    return result;
  }

 private:
  Pose world(int body, const std::array<double, 2>& values) const {
    Pose pose = Pose::Identity();
    for (int b = body; b > 0; b = model_.kinematics.bodies[b].parent) {
      const detail::MovingBody& moving = model_.kinematics.bodies[b];
      Pose joint(moving.parent_from_joint.cast<Real>());
      for (int k = 0; k < joints_; ++k)
        if (axes_[k].body == b)
          joint.rotate(Eigen::AngleAxis<Real>(values[k], moving.axis.cast<Real>()));
      pose = joint * pose;
    }
    return pose;
  }

  const CheckerModel& model_;
  const Axes& axes_;
  const int joints_;
};

}  // namespace swept::simd_test
