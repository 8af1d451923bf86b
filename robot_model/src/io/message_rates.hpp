// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/group_columns.hpp"
#include "io/trajectory_message.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// Velocities and accelerations of a message's points.
///
/// The messages do not say what the twist of a base is about. MoveIt writes the rates of a planar
/// joint's values (RobotTrajectory::getRobotTrajectoryMsg): `linear.x`, `linear.y` and `angular.z`
/// are those of x, y and theta. They are read as that.
class MessageRates {
 public:
  /// `columns`: the part's, so many. All must outlive this.
  MessageRates(const Robot& robot, const MessagePart& part, const GroupColumns& columns,
               std::size_t count);

  /// A value for each column, by the key `velocities` or `accelerations`; empty if the i-th point
  /// has none. Throws InputError for a point with some of them.
  std::vector<double> at(std::size_t i, const std::string& key) const;

 private:
  void addTwist(const YamlPlace& twist, const YamlPlace& name, std::vector<double>& rates) const;

  const Robot& robot_;
  const MessagePart& part_;
  std::size_t joints_, count_;  ///< columns of joints, and all
  ///@{
  /// Whether the group moves some.
  bool movesJoints_, movesBases_;
  ///@}
};

/// s, `time_from_start` of a point: a duration of ROS 2 or ROS 1, or a number. Throws InputError.
double timeFromStart(const YamlPlace& point);

}  // namespace swept::detail
