// SPDX-License-Identifier: BSD-3-Clause
#include "state_layout.hpp"

#include <stdexcept>

namespace swept::detail {
namespace {

SubspaceKind kindOf(const Robot& robot, const Joint& joint) {
  switch (joint.type) {
    case JointType::Planar:
      return SubspaceKind::SE2;
    case JointType::Floating:
      return SubspaceKind::SE3;
    case JointType::Fixed:
    case JointType::Revolute:
    case JointType::Continuous:
    case JointType::Prismatic:
      break;
  }
  const bool cyclic = robot.variables()[joint.firstVariable].cyclic;
  return cyclic ? SubspaceKind::SO2 : SubspaceKind::RealVector;
}

int variableCount(SubspaceKind kind) {
  switch (kind) {
    case SubspaceKind::SE2:
      return 3;
    case SubspaceKind::SE3:
      return 7;
    case SubspaceKind::RealVector:
    case SubspaceKind::SO2:
      break;
  }
  return 1;
}

}  // namespace

std::vector<JointRun> jointRuns(const Robot& robot, const Group& group) {
  std::vector<JointRun> runs;
  for (const int index : group.joints) {
    const Joint& joint = robot.joints()[index];
    const SubspaceKind kind = kindOf(robot, joint);
    const bool shares =
        kind == SubspaceKind::RealVector && !runs.empty() && runs.back().kind == kind;
    if (!shares) runs.push_back({kind, {}, {}});
    runs.back().joints.push_back(index);
    for (int i = 0; i < variableCount(kind); ++i) {
      runs.back().variables.push_back(joint.firstVariable + i);
    }
  }
  if (runs.empty()) throw std::invalid_argument("group `" + group.name + "` has no variables");
  return runs;
}

bool isSingleRealVector(const std::vector<JointRun>& runs) {
  return runs.size() == 1 && runs.front().kind == SubspaceKind::RealVector;
}

}  // namespace swept::detail
