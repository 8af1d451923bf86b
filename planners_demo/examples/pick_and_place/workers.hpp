// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "swept/robot_model/named_states.hpp"
#include "swept/robot_model/work_cell.hpp"
#include "workplace.hpp"

/// The work cell of two rooks: the left one works.
inline Worker twoRooks(const std::filesystem::path& models) {
  Worker worker;
  worker.robot = swept::loadWorkCell(swept::WorkCell::read(models / "cells/two_rooks.yaml"));
  worker.hand = {.arm = "left/arm",
                 .gripper = "left/gripper",
                 .palm = "left/hand",
                 .tool = {.body = "left/tool"},
                 .fingers = {"left/finger_left", "left/finger_right"},
                 .open = 0.04,
                 // The inside of a finger is 1.5 mm from its frame.
                 .closedOn = [](double radius) { return radius - 0.0015; }};
  worker.otherArm = "right/arm";
  const auto posture = [&](const char* group, const char* name) {
    return swept::namedConfiguration(*worker.robot, *worker.robot->findGroup(group), name);
  };
  worker.start = posture("left/arm", "home");
  worker.other = posture("right/arm", "tucked");
  worker.otherLater = posture("right/arm", "home");
  worker.model_from_table = Eigen::Translation3d(0.3, 0, 0.1);
  return worker;
}

/// A PR2, from the folder of its URDF: the right arm works.
inline Worker pr2(const std::filesystem::path& folder) {
  swept::LoadOptions options;
  options.packages = {{"moveit_resources_pr2_description/urdf", folder}};
  Worker worker;
  // The SRDF's group of the gripper has a motor besides.
  worker.robot =
      swept::Robot::load(folder / "pr2.urdf", folder / "pr2.srdf", options)
          ->withGroup("right_fingers", std::vector<std::string>{"r_gripper_l_finger_joint"});
  // Its tool frame points along x.
  const Eigen::Isometry3d turned(Eigen::AngleAxisd(M_PI / 2, Eigen::Vector3d::UnitY()));
  const std::string finger = "r_gripper_", link = "_finger_link", tip = "_finger_tip_link";
  worker.hand = {
      .arm = "right_arm",
      .gripper = "right_fingers",
      .palm = "r_gripper_palm_link",
      .tool = {.body = "r_gripper_tool_frame", .body_from_frame = turned},
      .fingers = {finger + "l" + link, finger + "r" + link, finger + "l" + tip, finger + "r" + tip},
      .open = 0.5,
      // Two bars of 91 mm keep the fingertips parallel.
      .closedOn = [](double radius) { return std::asin(std::min(1.0, radius / 0.0914)); }};
  worker.otherArm = "left_arm";
  const swept::Group& other = *worker.robot->findGroup("left_arm");
  worker.start = {-1.2, 0.3, -1.0, -1.6, 0.0, -1.2, 0.0};
  worker.other = swept::namedConfiguration(*worker.robot, other, "tuck_left_arm");
  worker.otherLater = {1.5, 0.3, 1.0, -1.8, 0.0, -0.5, 0.0};
  worker.model_from_table = Eigen::Translation3d(0.4, -0.15, 0.6);
  return worker;
}
