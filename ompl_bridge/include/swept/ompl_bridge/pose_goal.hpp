// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/goals/GoalLazySamples.h>
#include <ompl/util/RandomNumbers.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"

namespace swept {

namespace detail {
/// Of a state space, in the order of its group's configuration.
struct SpaceBounds {
  std::vector<double> lower, upper;  ///< rad or m
  std::vector<int> quaternions;      ///< the first variable of each
};
}  // namespace detail

/// How near is enough, and how long to look for states.
struct PoseGoalOptions {
  double positionTolerance = 1e-3;     ///< m; infinite: any position
  double orientationTolerance = 1e-2;  ///< rad; infinite: any orientation
  std::uint32_t seed = 1;              ///< of the configurations that the searches start from
  int maxSeeds = 1000;                 ///< searches after which no more samples are looked for
  int maxSamples = 32;                 ///< goal states after which no more are looked for
  Eigen::Isometry3d link_from_tool = Eigen::Isometry3d::Identity();  ///< what is to be placed
};

/// Goal region of an OMPL problem: the states in which a tool, a frame fixed in a link, is where it
/// is wanted. A thread of OMPL's samples it while the planner runs, by inverse kinematics from
/// random seeds within the bounds of the space; it starts once the space information is set up and
/// ends by itself. Every sample is valid (proven free, with this bridge's checker) and within the
/// tolerances, and at least `kSampleDistance` from those before it in the metric of the space
/// (setMinNewSampleDistance changes that). A pose that cannot be reached, or only in collision,
/// gives no sample, and planners that plan from the goal return as soon as sampling has ended.
///
/// The same seed gives the same samples in the same order. How many of them a planner sees by when
/// depends on the threads, and so may its path; not if it starts when isSampling() has become
/// false.
///
/// The distance has no unit, and is no lower bound of a path's length: with a path length objective
/// give that a heuristic of your own (`setCostToGoHeuristic`), since OMPL's takes it for one.
class PoseGoal final : public ompl::base::GoalLazySamples {
 public:
  static constexpr double kSampleDistance = 0.05;  ///< rad and m, as the space adds them up

  /// `model_from_tool` is wanted, in the scene's frame. The bounds of the space are read here.
  /// Throws std::invalid_argument as ValidityChecker and InverseKinematics do, and for a target
  /// that is not a rigid transform, a tolerance that is not positive, and a negative number.
  PoseGoal(const ompl::base::SpaceInformationPtr& si, const std::shared_ptr<const Checker>& checker,
           std::string_view link, const Eigen::Isometry3d& model_from_tool,
           const PoseGoalOptions& options = {});
  /// Waits for the sampling thread to end.
  ~PoseGoal() override;

  /// Of the pose that a state gives: the larger of position error / tolerance and angle /
  /// tolerance. Less than 1, the threshold, is satisfied. Infinite for a state without a pose: not
  /// finite, or beyond the limits of a prismatic joint. Any number of threads may call it.
  double distanceGoal(const ompl::base::State* state) const override;

  /// model_from_tool, as given.
  const Eigen::Isometry3d& target() const { return model_from_tool_; }

 private:
  bool sample(ompl::base::State* state);
  void drawSeed();
  void requireTarget();
  InverseKinematicsOptions search() const;

  detail::SpaceBounds bounds_;
  InverseKinematics kinematics_;
  StateConversion conversion_;
  Eigen::Isometry3d model_from_tool_;
  PoseGoalOptions options_;
  // Used by the sampling thread alone.
  InverseKinematics::Workspace workspace_;
  ompl::RNG random_;
  std::vector<double> q_;
  int seeds_ = 0;  ///< drawn so far
};

}  // namespace swept
