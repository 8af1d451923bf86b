// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <memory>
#include <ostream>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "swept/robot_model/planning_scene.hpp"

/// All that a file makes of world, robot and rules, as text: two files that mean the same have the
/// same.
namespace swept::test {

inline void addPose(const Eigen::Isometry3d& pose, std::ostream& text) {
  for (const double value : pose.matrix().topRows<3>().reshaped())
    text << ' ' << (std::abs(value) < 1e-12 ? 0.0 : value);
}

inline void addShape(const Shape& shape, const Eigen::Isometry3d& pose, std::ostream& text) {
  text << "  " << shape.index();
  if (const auto* plane = std::get_if<Plane>(&shape)) {
    text << " with " << plane->normal.transpose() << ' ' << plane->offset;
  } else {
    const Aabb box = boundingBox(shape);
    text << " from " << box.lower.transpose() << " to " << box.upper.transpose();
  }
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape))
    text << " mesh of " << mesh->triangles().size();
  text << " at";
  addPose(pose, text);
  text << '\n';
}

inline void addBodies(const World& world, std::ostream& text) {
  for (const WorldBody& body : world.bodies()) {
    text << "body " << body.name << '\n';
    for (const WorldBody::Part& part : body.parts)
      addShape(part.shape, part.world_from_shape, text);
  }
  for (const MovingObstacle& obstacle : world.obstacles()) {
    text << "moving " << obstacle.name << '\n';
    for (const MovingObstacle::Part& part : obstacle.parts)
      addShape(part.shape, part.body_from_shape, text);
    for (const MovingObstacle::Waypoint& waypoint : obstacle.waypoints) {
      text << "  at " << waypoint.time << " s";
      addPose(waypoint.world_from_body, text);
      text << '\n';
    }
  }
}

inline void addAttached(const std::vector<AttachedBody>& attached, std::ostream& text) {
  for (const AttachedBody& body : attached) {
    text << "attached " << body.name << " to " << body.link << ", touches";
    for (const std::string& link : body.touchLinks) text << ' ' << link;
    text << '\n';
    for (const AttachedBody::Part& part : body.parts)
      addShape(part.shape, part.link_from_shape, text);
  }
}

inline void addRules(const CollisionRules& rules, std::ostream& text) {
  for (const CollisionRules::Rule& rule : rules.rules())
    text << "rule " << static_cast<int>(rule.kind) << ' ' << rule.bodyA << ' ' << rule.bodyB << ' '
         << rule.value << '\n';
}

inline std::string summaryOf(const PlanningScene& scene) {
  std::ostringstream text;
  addBodies(scene.world, text);
  if (scene.state) text << "state " << scene.state->transpose() << '\n';
  addAttached(scene.attached, text);
  addRules(scene.rules, text);
  return text.str();
}

/// A base that moves in the plane, and two arms that slide along x on balls of radius 0.1 m, whose
/// pair the SRDF disables. `lid` stands still on `l`, `finger` goes where `l` does, half as far.
inline std::shared_ptr<const Robot> twoArms() {
  const std::string ball = "<collision><geometry><sphere radius='0.1'/></geometry></collision>";
  const auto slide = [](const char* name, const char* child, const char* x, const char* rest) {
    return std::string("<joint name='") + name + "' type='prismatic'><parent link='base'/>" +
           "<child link='" + child + "'/><origin xyz='" + x + " 0 0'/><axis xyz='1 0 0'/>" +
           "<limit lower='-3' upper='3' effort='1' velocity='1'/>" + rest + "</joint>";
  };
  return Robot::parse(
      "<robot name='two'><link name='base'/><link name='l'>" + ball + "</link><link name='r'>" +
          ball + "</link><link name='lid'/><link name='finger'/>" + slide("jl", "l", "-1", "") +
          slide("jr", "r", "1", "") +
          slide("jf", "finger", "0", "<mimic joint='jl' multiplier='0.5'/>") +
          "<joint name='screw' type='fixed'><parent link='l'/><child link='lid'/>"
          "<origin xyz='0 0 0.2'/></joint></robot>",
      "two.urdf",
      "<robot name='two'><virtual_joint name='vj' type='planar' parent_frame='odom' "
      "child_link='base'/><disable_collisions link1='l' link2='r' reason='Never'/>"
      "<group name='left'><joint name='jl'/></group><group name='right'><joint name='jr'/></group>"
      "</robot>",
      "two.srdf");
}

}  // namespace swept::test
