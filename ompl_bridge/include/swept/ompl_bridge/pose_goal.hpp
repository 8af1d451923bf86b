// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/util/RandomNumbers.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/constraint_projection.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"

namespace swept {

namespace detail {
/// Bounds of a state space, in the order of its group's configuration.
struct SpaceBounds {
  std::vector<double> lower, upper;  ///< rad or m
  std::vector<int> quaternions;      ///< index of the first variable of each quaternion
};
}  // namespace detail

/// The tolerances, and how long to search for goal states.
struct PoseGoalOptions {
  double positionTolerance = 1e-3;     ///< m; infinite: any position
  double orientationTolerance = 1e-2;  ///< rad; infinite: any orientation
  std::uint32_t seed = 1;              ///< of the configurations that the searches start from
  int maxSeeds = 1000;                 ///< number of searches, then sampling ends
  int maxSamples = 32;                 ///< number of goal states, then sampling ends
  Eigen::Isometry3d link_from_tool = Eigen::Isometry3d::Identity();  ///< pose of the tool
};

/// Goal region of an OMPL problem: the states in which a tool, a frame fixed in a link, has a given
/// pose. A thread of OMPL samples it while the planner runs, by inverse kinematics from random
/// seeds within the bounds of the space. The thread starts when the space information is set up,
/// and ends by itself. Every sample is valid (proven free, with this bridge's checker), within the
/// tolerances, and at least `kSampleDistance` from those before it in the metric of the space
/// (setMinNewSampleDistance changes that). A pose that cannot be reached, or only in collision,
/// gives no sample. Planners that plan from the goal then return as soon as sampling has ended.
///
/// Where the checker has constraints, a solution that does not keep them is moved to where they and
/// the pose hold together (ConstraintProjection).
///
/// The same seed gives the same samples in the same order. How many samples a planner sees at a
/// time depends on the threads, and so may its path. It does not if the planner starts after
/// isSampling() has become false.
///
/// The distance has no unit, and is no lower bound of a path's length, but OMPL's default heuristic
/// assumes that it is. With a path length objective, set your own heuristic
/// (`setCostToGoHeuristic`).
class PoseGoal final : public ompl::base::GoalLazySamples {
 public:
  static constexpr double kSampleDistance = 0.05;  ///< rad and m, as the space adds them up

  /// `model_from_tool` is the goal pose, in the robot's model frame. Reads the bounds of the space.
  /// Throws std::invalid_argument as ValidityChecker and InverseKinematics do, and for a target
  /// that is not a rigid transform, a tolerance that is not positive, a negative number, and a
  /// checker with more than 62 constraints.
  PoseGoal(const ompl::base::SpaceInformationPtr& si, const std::shared_ptr<const Checker>& checker,
           std::string_view link, const Eigen::Isometry3d& model_from_tool,
           const PoseGoalOptions& options = {});
  /// Waits for the sampling thread to end.
  ~PoseGoal() override;

  /// No unit. For the pose of a state, the larger of position error / tolerance and angle /
  /// tolerance. Less than 1, the threshold, satisfies the goal. Infinite for a state without a
  /// pose: not finite, or beyond the limits of a prismatic joint. Any number of threads may call
  /// it.
  double distanceGoal(const ompl::base::State* state) const override;

  /// The goal pose model_from_tool, as given.
  const Eigen::Isometry3d& target() const { return model_from_tool_; }

 private:
  bool sample(ompl::base::State* state);
  void drawSeed();
  bool findState();
  void requireTarget();
  InverseKinematicsOptions search() const;

  detail::SpaceBounds bounds_;
  InverseKinematics kinematics_;
  StateConversion conversion_;
  Eigen::Isometry3d model_from_tool_;
  PoseGoalOptions options_;
  std::optional<ConstraintProjection>
      together_;  ///< of constraints and the pose; none: no constraints
  // Used only by the sampling thread.
  InverseKinematics::Workspace workspace_;
  std::optional<ConstraintProjection::Workspace> projecting_;
  ompl::RNG random_;
  std::vector<double> q_;
  int seeds_ = 0;  ///< drawn so far
};

}  // namespace swept
