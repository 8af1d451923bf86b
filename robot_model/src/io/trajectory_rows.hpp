// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "io/group_columns.hpp"
#include "io/input_source.hpp"
#include "io/point_remarks.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Reads points of trajectories from tables whose columns have names of joints and variables. Puts
/// each into the order of a group's variables and judges it.
class TrajectoryRows {
 public:
  /// `reference`: a value for each of the robot's variables, for those outside of the group.
  TrajectoryRows(const InputSource& source, const Robot& robot, const Group& group,
                 const Eigen::VectorXd& reference);

  /// Begins a trajectory with these columns of positions, velocities and accelerations. `fail` is
  /// for what is missing.
  void begin(std::span<const std::string> names, const FailAtColumn& failAt, const FailAt& fail);
  ///@{
  /// Other columns of velocities or accelerations.
  void setVelocities(std::span<const std::string> names, const FailAtColumn& failAt,
                     const FailAt& fail);
  void setAccelerations(std::span<const std::string> names, const FailAtColumn& failAt,
                        const FailAt& fail);
  ///@}
  /// The columns of positions.
  const GroupColumns& columns() const { return positions_; }

  /// Adds a point, whose values are those of the columns, each finite. `line`: for warnings.
  void add(const TrajectoryPoint& row, int line, const FailAt& fail);

  /// Warns of values that were moved to limits.
  void tellRemarks() const;
  const std::vector<JointTrajectory>& trajectories() const { return trajectories_; }
  std::vector<JointTrajectory> take() { return std::move(trajectories_); }

 private:
  void requireLater(double time, const FailAt& fail) const;
  std::vector<double> positionsOf(std::span<const double> row, int line, const FailAt& fail);

  const InputSource& source_;
  const Robot& robot_;
  const Group& group_;
  GroupColumns positions_, velocities_, accelerations_;
  std::vector<JointTrajectory> trajectories_;
  PointRemarks taken_;
};

}  // namespace swept::detail
