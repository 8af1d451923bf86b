// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <string>

namespace swept {

/// How far one joint may be from where it should be. A joint that turns has a rotation, one that
/// slides a translation; a planar or floating joint has both.
struct JointTolerance {
  double rotation = 0.0;     ///< rad; of a floating joint: the angle between both orientations
  double translation = 0.0;  ///< m; of a planar or floating joint: the distance of both places
};

/// How far the robot may be, at every instant, from the configuration that a query is about: what a
/// controller tolerates (`constraints.JOINT.trajectory` of ros2_control), what encoders are off,
/// what an approximation deviates. Each joint of the group is off by what it likes within its
/// tolerance, at every instant anew; mimicking joints follow their masters. Joints outside of the
/// group, and moving obstacles, are where they should be. No sliding joint is beyond its limits.
///
/// Free then means that no configuration within the tolerances is in contact: the robot touches
/// nothing unless its controller has stopped it.
struct TrackingTolerance : JointTolerance {
  /// By joint name, in place of `rotation` and `translation`.
  std::map<std::string, JointTolerance, std::less<>> joints = {};
};

}  // namespace swept
