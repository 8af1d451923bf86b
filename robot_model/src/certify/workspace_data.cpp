// SPDX-License-Identifier: BSD-3-Clause
#include "certify/workspace_data.hpp"

#include <algorithm>

namespace swept::detail {

WorkspaceData::WorkspaceData(const CheckerModel& model)
    : version(model.version),
      motion(model.kinematics.bodies.size()),
      states(model.kinematics.bodies.size()),
      stateStamps(model.kinematics.bodies.size(), -1),
      placed(model.robotGeometry.size()),
      carried(model.kinematics.bodies.size()),
      arms(model.kinematics.bodies.size()),
      hints(model.pairCount(), Eigen::Vector3d::Zero()),
      hintStamps(model.pairCount(), -1),
      simd(model.simd),
      probe(model.kinematics.dimension) {
  // Bounds on travel relative to all ancestors together are a little larger than one by one.
  const bool nested = std::ranges::any_of(model.robotGeometry, [](const RobotGeometry& geometry) {
    return geometry.levers.path.size() > kLongPath;
  });
  if (nested) {
    for (const RobotGeometry& geometry : model.robotGeometry)
      nestedMotionBounds.emplace_back(geometry.levers.path.size() + 1);
  } else {
    motionBounds.resize(model.motionBounds.size());
  }
  motionBoundStamps.resize(nested ? model.robotGeometry.size() : model.motionBounds.size(), -1);
  if (model.world->obstacles().empty()) return;
  from.resize(model.kinematics.fullDimension);
  to.resize(model.kinematics.fullDimension);
}

}  // namespace swept::detail
