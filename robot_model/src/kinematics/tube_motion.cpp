// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/tube_motion.hpp"

#include "robot/joint_types.hpp"

namespace swept::detail {

void widenRanges(const KinematicModel& model, std::span<const JointTolerance> tube,
                 std::span<JointMotion> motion) {
  for (std::size_t i = 1; i < motion.size(); ++i) {
    const JointTolerance& tolerance = tube[i];
    JointMotion& joint = motion[i];
    joint.largestAngle += tolerance.rotation;
    joint.lowAngle -= tolerance.rotation;
    joint.highAngle += tolerance.rotation;
    if (slidesWithinLimits(model.bodies[i].type)) {
      joint.low -= tolerance.translation;
      joint.high += tolerance.translation;
    } else {
      joint.maxTranslation += tolerance.translation;
    }
  }
}

void boundTubeMotion(const KinematicModel& model, std::span<const JointTolerance> tube, double half,
                     std::span<const JointMotion> motion, std::span<JointMotion> tubeMotion) {
  for (std::size_t i = 1; i < motion.size(); ++i) {
    const JointTolerance& tolerance = tube[i];
    const JointMotion& joint = motion[i];
    JointMotion& own = tubeMotion[i];
    own.speed = half * joint.speed + tolerance.translation;
    own.spinSpeed = half * joint.spinSpeed + tolerance.rotation;
    own.acceleration = half * half * joint.acceleration;
    own.spinAcceleration = half * half * joint.spinAcceleration;
    // The axis of an error of a floating joint's orientation turns with the joint.
    if (model.bodies[i].type == JointType::Floating)
      own.spinAcceleration += half * joint.spinSpeed * tolerance.rotation;
    own.maxTranslation = joint.maxTranslation;
    own.low = joint.low;
    own.high = joint.high;
  }
}

}  // namespace swept::detail
