// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "kinematics/motion_model.hpp"
#include "line/line_deviation.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"

namespace swept::detail {

/// What a ToolLinePlanner knows of its tool.
struct LineModel {
  std::shared_ptr<const Checker> checker;
  KinematicModel kinematics;
  CarriedTool tool;
  InverseKinematics solver;
};

/// A straight motion of a tool, by its share in [0, 1]: see ToolLineOptions.
struct StraightMotion {
  Eigen::Vector3d begin = Eigen::Vector3d::Zero(), way = Eigen::Vector3d::Zero();  ///< m
  Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity();                       ///< at 0
  Eigen::Vector3d turn = Eigen::Vector3d::Zero();  ///< rad, the shorter way to that at 1

  StraightMotion(const Eigen::Isometry3d& from, const Eigen::Isometry3d& to);
  LinePiece piece(double begin, double end) const;
  Eigen::Isometry3d at(double share) const;
};

}  // namespace swept::detail
