// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "swept/ompl_bridge/state_space.hpp"

namespace swept::detail {

/// Consecutive joints of a group that become one subspace: limited joints share one, others do not.
struct JointRun {
  SubspaceKind kind;
  std::vector<int> joints;
  std::vector<int> variables;
};

/// The one place that decides how a group is laid out. Throws std::invalid_argument for a group
/// without variables.
std::vector<JointRun> jointRuns(const Robot& robot, const Group& group);

/// The space of makeStateSpace(robot, group) but for its projection, which takes far longer to make
/// than all else. It cannot be set up.
ompl::base::StateSpacePtr unprojectedSpace(const Robot& robot, const Group& group);

/// Such a group's space is no compound.
bool isSingleRealVector(const std::vector<JointRun>& runs);

}  // namespace swept::detail
