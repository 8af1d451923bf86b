// SPDX-License-Identifier: BSD-3-Clause
#include "fixtures.hpp"

#include <ompl/util/RandomNumbers.h>

#include "urdf_text.hpp"

namespace swept::test {
namespace {

// OMPL seeds by the clock unless told before its first random number; tests repeat.
[[maybe_unused]] const bool kSeeded = (ompl::RNG::setSeed(42), true);

std::string ballLink(const std::string& name, double radius) {
  return "<link name='" + name + "'><collision><geometry><sphere radius='" +
         std::to_string(radius) + "'/></geometry></collision></link>\n";
}

}  // namespace

std::shared_ptr<const Robot> gantry() {
  const std::string urdf =
      "<?xml version='1.0'?>\n<robot name='gantry'>\n<link name='frame'/>"
      "<link name='beam'/><link name='trolley'/>\n" +
      ballLink("ball", kBallRadius) +
      joint("x", "prismatic", "frame", "beam", limited("1 0 0", -1, 1)) +
      joint("y", "prismatic", "beam", "trolley", limited("0 1 0", -1, 1)) +
      joint("z", "prismatic", "trolley", "ball", limited("0 0 1", -1, 1)) + "</robot>\n";
  return Robot::parse(urdf, "gantry.urdf");
}

std::shared_ptr<const Robot> everyJoint() {
  const std::string urdf =
      "<?xml version='1.0'?>\n<robot name='every_joint'>\n"
      "<link name='l0'/><link name='l1'/><link name='l2'/><link name='l3'/><link name='l4'/>"
      "<link name='l5'/><link name='side'/>\n" +
      ballLink("l6", 0.05) + joint("slide", "prismatic", "l0", "l1", limited("0 0 1", -0.5, 1.5)) +
      joint("turn", "continuous", "l1", "l2", "<axis xyz='0 1 0'/>") +
      joint("elbow", "revolute", "l2", "l3", "<origin xyz='0.3 0 0'/>" + limited("0 0 1", -2, 2)) +
      joint("wrist", "revolute", "l3", "l4", "<origin xyz='0.2 0 0'/>" + limited("1 0 0", -1, 1)) +
      joint("cart", "planar", "l4", "l5", "<axis xyz='0 0 1'/>") +
      joint("body", "floating", "l5", "l6", "") +
      joint("follower", "revolute", "l2", "side",
            limited("0 1 0", -2, 2) + "<mimic joint='elbow' multiplier='0.5'/>") +
      "</robot>\n";
  const std::string srdf =
      "<?xml version='1.0'?>\n<robot name='every_joint'>\n"
      "<group name='all'><joint name='slide'/><joint name='turn'/><joint name='elbow'/>"
      "<joint name='wrist'/><joint name='cart'/><joint name='body'/></group>\n"
      "<group name='turn_only'><joint name='turn'/></group>\n"
      "<group name='limited'><joint name='slide'/><joint name='elbow'/><joint "
      "name='wrist'/></group>\n"
      "</robot>\n";
  return Robot::parse(urdf, "every_joint.urdf", srdf, "every_joint.srdf");
}

double Obstacle::distance(const Eigen::Vector3d& point) const {
  const Eigen::Array3d outside = (point - centre).array().abs() - 0.5 * size.array();
  return outside.max(0.0).matrix().norm();
}

std::vector<Obstacle> boxes() {
  return {{{0.0, 0.0, 0.0}, {0.3, 0.8, 0.9}},   {{0.7, 0.6, -0.5}, {0.6, 0.7, 0.8}},
          {{-0.6, 0.5, 0.6}, {0.6, 0.7, 0.3}},  {{-0.6, -0.6, -0.3}, {0.6, 0.3, 0.9}},
          {{0.6, -0.5, 0.5}, {0.05, 0.8, 0.9}}, {{0.2, 0.8, 0.7}, {0.02, 0.6, 0.9}}};
}

std::vector<Obstacle> wallWithWindow() {
  const double thick = 0.02, low = 0.3, high = 0.7, end = 1.3;
  const double above = end - high, below = end + low;
  return {{{0.0, high + 0.5 * above, 0.0}, {thick, above, 2.0 * end}},
          {{0.0, low - 0.5 * below, 0.0}, {thick, below, 2.0 * end}},
          {{0.0, 0.5, high + 0.5 * above}, {thick, high - low, above}},
          {{0.0, 0.5, low - 0.5 * below}, {thick, high - low, below}}};
}

std::shared_ptr<const World> worldOf(const std::vector<Obstacle>& obstacles) {
  auto world = std::make_shared<World>();
  for (const Obstacle& obstacle : obstacles) {
    world->add("box" + std::to_string(world->bodies().size()), makeBox(obstacle.size),
               Eigen::Isometry3d(Eigen::Translation3d(obstacle.centre)));
  }
  return world;
}

}  // namespace swept::test
