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

/// The error between two rigid transforms to the same frame.
PoseError poseError(const Eigen::Isometry3d& actual, const Eigen::Isometry3d& wanted);

/// When InverseKinematics::solve accepts a solution, and when it gives up. An infinite tolerance
/// allows any position, or any orientation.
struct InverseKinematicsOptions {
  double positionTolerance = 1e-6;     ///< m
  double orientationTolerance = 1e-6;  ///< rad
  int maxIterations = 100;             ///< steps tried
  /// Of the first step, relative to squared lever arms of about 1; above 0. From a seed that nearly
  /// solves it, such as the way point before, 1e-6 takes fewer steps.
  double firstDamping = 1e-2;
};

/// Finds configurations of a group that bring a tool, a frame fixed in one of the robot's links, to
/// a given pose. It is numeric, from one seed: damped least squares (Wampler 1986; Nakamura and
/// Hanafusa 1986) with the damping of Levenberg and Marquardt, and limits kept by projection
/// (Bertsekas 1982). It ignores collisions.
///
/// All variables of the group that move the link take part: mimicking joints follow theirs, and
/// planar and floating joints move too. Variables that do not move the link keep the values of the
/// seed. Any number of threads may use one object, each with its own workspace.
class InverseKinematics {
 public:
  /// Scratch memory for one thread, for the object that it was made for and its copies.
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
  /// Default: Robot::defaultState(). Throws std::invalid_argument without a robot, for an unknown
  /// group or link, a link that the group does not move, a reference of the wrong size, not finite
  /// or with a zero quaternion, and a tool that is not a rigid transform.
  InverseKinematics(std::shared_ptr<const Robot> robot, std::string_view group,
                    std::string_view link, const std::optional<Eigen::VectorXd>& reference = {},
                    const Eigen::Isometry3d& link_from_tool = Eigen::Isometry3d::Identity());

  /// The same with tighter limits (rad or m, a value for each variable of the group). The robot's
  /// own limits hold as well; a limit that is beyond those by at most tolerance::kLimit becomes
  /// equal to them. Limits of cyclic variables and of quaternions are ignored. Throws
  /// std::invalid_argument for spans of the wrong size, and if no value is left.
  InverseKinematics within(ConfigurationView lower, ConfigurationView upper) const;

  ///@{
  /// As given to the constructor.
  const Robot& robot() const;
  const Group& group() const;
  ///@}
  int dimension() const;  ///< of a configuration of the group
  /// Degrees of freedom: one for each variable, except that the four of a quaternion have three.
  int degreesOfFreedom() const;

  /// Pose of the tool's frame: model_from_tool. Throws std::invalid_argument for a configuration
  /// with the wrong size or a non-finite value, a zero quaternion, and a prismatic value outside
  /// its limits by more than tolerance::kLimit.
  Eigen::Isometry3d pose(ConfigurationView q) const;
  /// The same, but without a value if `pose` throws for a value. Throws for the wrong size.
  std::optional<Eigen::Isometry3d> findPose(ConfigurationView q) const;

  /// Velocity of the tool's origin (m, rows 0 to 2) and angular velocity (rad, rows 3 to 5), both
  /// in the model frame, per unit (rad or m) of each degree of freedom, in the order of the
  /// variables. The three of a quaternion are rotations of the joint's child frame about the axes
  /// of the joint frame. Throws as `pose` does.
  Eigen::Matrix<double, 6, Eigen::Dynamic> jacobian(ConfigurationView q) const;

  /// Returns true if it found a solution: at `q` the tool is within both tolerances of
  /// `model_from_tool`, all variables are within their limits, cyclic variables that take part are
  /// in [-pi, pi], and quaternions that take part have unit length. Returns false if it found none
  /// from this seed, which proves nothing; `q` is then the best configuration found, within the
  /// same limits. `q` is the seed. Seed values outside their limits are moved to them first. The
  /// same arguments give the same result. Allocates nothing.
  ///
  /// Throws std::invalid_argument for a target that is not a rigid transform; a seed with the wrong
  /// size, a non-finite value or a zero quaternion; a tolerance or damping that is not positive; a
  /// negative number of iterations; and a workspace of another object that does not fit.
  bool solve(const Eigen::Isometry3d& model_from_tool, ConfigurationSpan q,
             const InverseKinematicsOptions& options, Workspace& workspace) const;

 private:
  class Search;
  explicit InverseKinematics(std::shared_ptr<const detail::ToolChain> chain);
  std::shared_ptr<const detail::ToolChain> chain_;
};

}  // namespace swept
