// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "swept/robot_model/input.hpp"
#include "swept/robot_model/joint_trajectory.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Reads timed trajectories from any planner. The file's extension gives the format:
///
/// * `.csv`: a line with `time` and the names of the joints, `JOINT_velocity` and
///   `JOINT_acceleration`, in any order, then a line for each point;
/// * `.yaml`, `.yml`: trajectory_msgs/JointTrajectory, moveit_msgs/RobotTrajectory or
///   moveit_msgs/DisplayTrajectory as ROS prints them, one or several with `---` between;
/// * `.json`: an object `trajectory`, as writeTrajectory() writes it, also in a file with a proof.
///
/// robot_model/FORMATS.md says how each key is treated. There is a trajectory for each message, and
/// for each trajectory of a DisplayTrajectory, each of which begins where the one before it ends.
/// JointTrajectory::variables are the group's, in its order, whatever the file's order is.
///
/// Every point has a time, which is 0 or more and increases, and positions: a controller would
/// integrate velocities only where it is told to. Velocities and accelerations may be missing at
/// any point. Values are those of the file: angles are not wrapped, and values beyond limits are
/// kept, except that positions up to tolerance::kLimit beyond are moved to the limit, with one
/// remark for each variable, and that quaternions are normalized. Transforms of a planar joint give
/// an angle within half a turn of the one before, and those of a floating joint the quaternion
/// nearer to the one before.
///
/// Where all joints of the group are of one robot of a WorkCell, the file may name them without it,
/// as files of that robot alone do.
///
/// The file may name joints outside the group. Their positions must equal those in `reference` (a
/// value for each of the robot's variables; default Robot::defaultState()), to within
/// tolerance::kLimit, their velocities and accelerations must be 0, and mimicking joints must
/// follow their masters: a proof is about no other motion.
///
/// There is at least one trajectory, and each has at least one point. Throws InputError, with file,
/// line, the value and what is allowed, also for values that are not finite, and for joints of the
/// group that the file lacks. Throws std::invalid_argument for a reference of another size.
std::vector<JointTrajectory> readTrajectories(const std::filesystem::path& file, const Robot& robot,
                                              const Group& group,
                                              const std::optional<Eigen::VectorXd>& reference = {},
                                              const LoadOptions& options = {});

/// The messages of ROS that hold a trajectory.
enum class TrajectoryMessage : std::uint8_t {
  Joint,   ///< trajectory_msgs/JointTrajectory
  Robot,   ///< moveit_msgs/RobotTrajectory
  Display  ///< moveit_msgs/DisplayTrajectory, which begins at the first point
};

/// Writes a trajectory. What readTrajectories() returned is read back bit for bit. The file's
/// extension gives the format:
///
/// * `.csv`: `time`, positions, velocities and accelerations. Columns of a kind that no point has
///   are left out, and cells of a point without them are empty;
/// * `.yaml`, `.yml`: trajectory_msgs/JointTrajectory as `ros2 topic echo` prints it. Variables of
///   planar and floating joints are names like others (`base/x`), which swept reads and no
///   controller knows. Times are rounded to whole nanoseconds, which the message has;
/// * `.json`: an object `trajectory` with `variables` and `points`.
///
/// Whoever reads the file meanwhile sees the old file or the whole new one. Throws
/// std::invalid_argument as controllerCurve() does for a trajectory, and for one with a name twice
/// or without any. Throws UsageError for another extension, a file that cannot be written or would
/// be too large to be read again, a name that the format cannot hold, a time of 2^31 - 1 s or more
/// in YAML, and two times that are the same in whole nanoseconds there (.json and .csv keep them).
void writeTrajectory(const std::filesystem::path& file, const JointTrajectory& trajectory);

/// The same for a robot with the variables. `message` is what a YAML file has; other formats have
/// one form. In RobotTrajectory and DisplayTrajectory, planar and floating joints are in
/// `multi_dof_joint_trajectory`: readTrajectories() finds their poses to within rounding, and
/// angles that may differ by whole turns. Throws std::invalid_argument for a variable that the
/// robot does not have, or that comes without the others of its joint, and UsageError, too, for
/// velocities and accelerations of a floating joint, which these messages cannot hold, and for a
/// planar joint whose axis is not z.
void writeTrajectory(const std::filesystem::path& file, const JointTrajectory& trajectory,
                     const Robot& robot, TrajectoryMessage message);

}  // namespace swept
