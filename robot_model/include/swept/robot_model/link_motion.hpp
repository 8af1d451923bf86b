// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string_view>

#include "swept/core/continuous/motion.hpp"
#include "swept/robot_model/configuration.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

namespace detail {
struct LinkPath;
}

/// The motion of one link while its robot moves from one configuration of a group to another, as
/// Checker defines it: cyclic variables take the shorter way, floating orientations slerp, and
/// mimicking joints follow. The world frame is the robot's model frame. The body frame is the
/// link's, and its origin the reference point. For `continuousCollide` of a single link.
class LinkMotion : public Motion {
 public:
  /// `reference` has a value for each variable of the robot; those outside the group keep it.
  /// Default: Robot::defaultState(). Throws std::invalid_argument for an unknown group or link, a
  /// span or reference of the wrong size, a non-finite value, a zero quaternion, and a prismatic
  /// value outside its limits by more than tolerance::kLimit.
  LinkMotion(const Robot& robot, std::string_view group, std::string_view link,
             ConfigurationView from, ConfigurationView to,
             const std::optional<Eigen::VectorXd>& reference = {});

  Eigen::Isometry3d at(double t) const override;
  Twist velocity(double t) const override;
  MotionState state(double t) const override;
  /// Bounds that hold for any part of the motion.
  MotionRates rates(double from, double to) const override;
  double rounding(double reach) const override;

 private:
  std::shared_ptr<const detail::LinkPath> path_;
};

/// Pose of a link at one configuration of a group: model_from_link. `reference` and exceptions are
/// those of LinkMotion, which is faster for many configurations along one motion.
Eigen::Isometry3d linkPose(const Robot& robot, std::string_view group, std::string_view link,
                           ConfigurationView q,
                           const std::optional<Eigen::VectorXd>& reference = {});

}  // namespace swept
