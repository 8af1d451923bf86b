// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept::detail {

/// The variables of a trajectory that are in `joint_trajectory` of a message.
struct JointColumns {
  std::vector<std::size_t> places;  ///< in JointTrajectory::variables

  /// Those of all variables; none of none.
  template <typename Value>
  std::vector<Value> of(const std::vector<Value>& all) const {
    std::vector<Value> some;
    if (all.empty()) return some;
    for (const std::size_t place : places) some.push_back(all[place]);
    return some;
  }
};

/// A planar or floating joint, which is in `multi_dof_joint_trajectory`.
struct BaseColumns {
  const Joint* joint = nullptr;
  std::size_t first = 0;  ///< place of its first variable; the others follow it

  /// Position x, y, z (m) and quaternion x, y, z, w of the child in the parent.
  std::array<double, 7> pose(const std::vector<double>& positions) const;
  /// Linear and angular x, y, z of a planar joint: the rates of its values.
  std::array<double, 6> twist(const std::vector<double>& rates) const;
};

/// The variables of a trajectory by the part of a message that they are in.
struct MessageColumns {
  JointColumns joints;
  std::vector<BaseColumns> bases;
};

/// As if all variables were of joints with one value.
JointColumns allJoints(std::size_t variables);
/// Throws std::invalid_argument for a variable that the robot does not have, and for one that does
/// not come with the others of its joint, in their order.
MessageColumns messageColumns(const JointTrajectory& trajectory, const Robot& robot);
/// Throws UsageError for rates of floating joints, and planar joints whose axis is not z.
void requireMessageHolds(const JointTrajectory& trajectory, const MessageColumns& columns,
                         const std::string& where);
/// The joints' names.
std::vector<std::string> namesOf(const std::vector<BaseColumns>& bases);

}  // namespace swept::detail
