// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

namespace detail {
struct ToolChain;
}

/// How far a frame is from where it should be.
struct PoseError {
  double position = 0.0;  ///< m, between the origins
  double angle = 0.0;     ///< rad in [0, pi], of the rotation between them
};

/// Of two rigid transforms to the same frame.
PoseError poseError(const Eigen::Isometry3d& actual, const Eigen::Isometry3d& wanted);

/// What InverseKinematics::solve takes for a solution, and when it gives up. With an infinite
/// tolerance the position, or the orientation, may be any.
struct InverseKinematicsOptions {
  double positionTolerance = 1e-6;     ///< m
  double orientationTolerance = 1e-6;  ///< rad
  int maxIterations = 100;             ///< steps that are tried
};

/// Configurations of a group that put a tool, a frame fixed in one of the robot's links, where it
/// is wanted. Numeric, and from one seed: damped least squares (Wampler 1986; Nakamura and Hanafusa
/// 1986) with the damping chosen as Levenberg and Marquardt do, and limits kept by projection
/// (Bertsekas 1982). Collisions play no part.
///
/// All variables of the group that move the link take part: mimicking joints follow theirs, planar
/// and floating joints move too. Those that do not move it keep the values of the seed. Any number
/// of threads may use one object, each with a workspace of its own.
class InverseKinematics {
 public:
  /// Scratch memory for one thread; of the object that it was made for and the copies of that.
  class Workspace {
   public:
    /// Allocates all that solve() needs.
    explicit Workspace(const InverseKinematics& kinematics);

   private:
    friend class InverseKinematics;
    std::vector<double> candidate_;
    std::vector<Eigen::Isometry3d> world_from_joint_, world_from_body_;  ///< along the chain
    Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian_;
    Eigen::VectorXd step_;
  };

  /// `reference` has a value for each variable of the robot; those outside the group keep it.
  /// Default: Robot::defaultState(). Throws std::invalid_argument without a robot, for a group or
  /// link that is not there, a link that the group does not move, a reference of the wrong size,
  /// not finite or with a quaternion without direction, and a tool that is not a rigid transform.
  InverseKinematics(std::shared_ptr<const Robot> robot, std::string_view group,
                    std::string_view link, const std::optional<Eigen::VectorXd>& reference = {},
                    const Eigen::Isometry3d& link_from_tool = Eigen::Isometry3d::Identity());

  /// The same with limits (rad or m, a value for each variable of the group) within the robot's
  /// own, which hold as well: one that is beyond those by at most tolerance::kLimit is taken for
  /// them. Those of cyclic variables and of quaternions are not looked at. Throws
  /// std::invalid_argument for spans of the wrong size, and where no value is left.
  InverseKinematics within(ConfigurationView lower, ConfigurationView upper) const;

  ///@{
  /// As given when it was made.
  const Robot& robot() const;
  const Group& group() const;
  ///@}
  int dimension() const;  ///< of a configuration of the group
  /// Ways to move: one for each variable, except that the four of a quaternion have three.
  int degreesOfFreedom() const;

  /// The tool's frame: model_from_tool. Throws std::invalid_argument for a configuration that has
  /// the wrong size or a value that is not finite, a quaternion without direction, and a prismatic
  /// value outside its limits by more than tolerance::kLimit.
  Eigen::Isometry3d pose(ConfigurationView q) const;
  /// The same, and nothing where `pose` throws for a value. Throws for the wrong size.
  std::optional<Eigen::Isometry3d> findPose(ConfigurationView q) const;

  /// Velocity of the tool's origin (m, rows 0 to 2) and angular velocity (rad, rows 3 to 5), both
  /// in the model frame, per unit (rad or m) of each degree of freedom, in the order of the
  /// variables. The three of a quaternion are turns of the joint's child frame about the axes of
  /// the joint frame. Throws as `pose`.
  Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(ConfigurationView q) const;

  /// True: at `q` the tool is within both tolerances of `model_from_tool`, all variables are within
  /// their limits, cyclic ones that take part in [-pi, pi], quaternions that do of unit length.
  /// False: no solution was found from this seed, which proves nothing; `q` is as good a
  /// configuration as was found, within the same limits. Values of the seed that are outside their
  /// limits are moved onto them first. The same arguments give the same result; nothing is
  /// allocated.
  ///
  /// Throws std::invalid_argument for a target that is not a rigid transform, a seed that has the
  /// wrong size, a value that is not finite or a quaternion without direction, a tolerance that is
  /// not positive, a negative number of iterations and a workspace of another object that
  /// does not fit.
  bool solve(const Eigen::Isometry3d& model_from_tool, ConfigurationSpan q,
             const InverseKinematicsOptions& options, Workspace& workspace) const;

 private:
  class Search;
  explicit InverseKinematics(std::shared_ptr<const detail::ToolChain> chain);
  std::shared_ptr<const detail::ToolChain> chain_;
};

}  // namespace swept
