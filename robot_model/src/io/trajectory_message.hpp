// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/group_columns.hpp"
#include "io/input_source.hpp"
#include "io/robot_state_yaml.hpp"
#include "io/scene_frames.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// A moveit_msgs/RobotTrajectory, or a trajectory_msgs/JointTrajectory as its only part.
struct MessagePart {
  YamlPlace whole;                ///< what both parts are in
  std::vector<YamlPlace> names;   ///< of joints with one value
  std::vector<YamlPlace> points;  ///< their points
  YamlPlace bases;                ///< `multi_dof_joint_trajectory`
  std::vector<YamlPlace> poses;   ///< its points; none if it names no joint

  /// Both have as many points, unless one has none.
  std::size_t size() const { return points.empty() ? poses.size() : points.size(); }
  /// What messages about a point name.
  const YamlPlace& point(std::size_t i) const { return points.empty() ? poses[i] : points[i]; }
  FailAt failAtPoint(std::size_t i) const;
};

/// A message of one of the types that TrajectoryMessage lists.
struct MessageParts {
  std::vector<MessagePart> parts;           ///< several only of a moveit_msgs/DisplayTrajectory
  std::optional<YamlPlace> start;           ///< its `trajectory_start`
  std::optional<YamlPlace> displayed = {};  ///< its `trajectory`
};

/// Reads messages that ROS prints, and refuses keys that they do not have. The columns of a part
/// are the joints of `names`, then the variables of the bases.
class MessageReader {
 public:
  /// `reader`: the public function that reads, for messages.
  MessageReader(const InputSource& source, const Robot& robot, const char* reader);

  MessageParts message(const YamlPlace& root) const;
  /// The columns' values of a point.
  std::vector<double> positions(const MessagePart& part, std::size_t i) const;
  ///@{
  /// The columns' names, and what fails for one of them.
  std::vector<std::string> columnNames(const MessagePart& part) const;
  static FailAtColumn failAtColumn(const MessagePart& part);
  ///@}

  /// `columns`: for its own use. `first`: the group's values where the message begins.
  void requireStart(const YamlPlace& start, GroupColumns columns,
                    const std::vector<double>& first) const;
  /// No planner has planned the gap between the `end` of one trajectory and the `begin` of the
  /// next, `part`.
  static void requireGoesOn(const MessagePart& part, const GroupColumns& columns,
                            const std::vector<double>& end, const std::vector<double>& begin);

 private:
  /// Values by the names of variables.
  using Values = std::vector<std::pair<std::string, double>>;

  MessageParts displayOf(const YamlPlace& root) const;
  MessagePart robotPart(const YamlPlace& robot) const;
  MessagePart partOf(const YamlPlace& whole, const YamlPlace& joints, const YamlPlace& bases) const;
  Values baseValues(const MessagePart& part, std::size_t i) const;
  Values valuesOf(const YamlPlace& place, const std::vector<BasePose>& poses) const;

  const Robot& robot_;
  SceneFrames frames_;
};

/// Fails for a message, or a part of one, that has none.
[[noreturn]] void failWithoutPoint(const YamlPlace& place);

/// Fails for a place with `count` of `what` unless there are as many as `of`.
void requireAsMany(const YamlPlace& place, std::size_t count, const std::string& what,
                   std::size_t wanted, const std::string& of);

}  // namespace swept::detail
