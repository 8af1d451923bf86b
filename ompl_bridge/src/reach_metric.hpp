// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/SpaceInformation.h>
#include <ompl/base/StateSpace.h>

#include <vector>

namespace swept::detail {

/// How far apart two states are for a planner that looks for motions without contact. It is the
/// metric of the space, but each joint counts by how far it moves the robot (jointReach): the
/// nearest state by this is the one from which the least space is swept. The mean square of the
/// factors is 1, so distances are about as large as the space's own.
class ReachMetric {
 public:
  /// Without a checker in the validators, or for a space that is not makeStateSpace's of its group,
  /// the metric is the space's own.
  explicit ReachMetric(const ompl::base::SpaceInformation& si);

  double distance(const ompl::base::State* a, const ompl::base::State* b) const;
  /// Of the joints, if the space is one real vector; else none.
  std::vector<double> jointFactors() const;

 private:
  /// The space, or a component of it. Its metric has either one factor, or one for each joint.
  struct Part {
    const ompl::base::StateSpace* space = nullptr;
    double weight = 1.0;          ///< in the metric of the space
    std::vector<double> factors;  ///< of the joints of a JointSpace, else one
    bool ofJoints = false;
  };

  bool addParts(const ompl::base::SpaceInformation& si);
  void normalize();

  const ompl::base::StateSpace* space_;
  std::vector<Part> parts_;  ///< none: the metric is the space's own
  bool isCompound_ = false;
};

}  // namespace swept::detail
