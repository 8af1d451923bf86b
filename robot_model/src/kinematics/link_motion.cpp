// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/link_motion.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"
#include "kinematics/whole_state.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

namespace detail {

/// The joints between the model frame and a link that move; those that stand still are part of the
/// frames between them.
struct LinkPath {
  std::vector<MovingBody> bodies;  ///< from the model frame to the link
  std::vector<JointMotion> joints;
  Eigen::Isometry3d body_from_link = Eigen::Isometry3d::Identity();  ///< of the last body
  double transforms = 0.0;  ///< joints, with those that stand still
  MotionRates rates;
  double span = 0.0;        ///< m, see LeverArms::span, of the link's origin
  double perUnit = 0.0;     ///< 1 + the sum of the joints' rates, rad and m per unit of t
  double angleError = 0.0;  ///< rad, see detail::angleError
  double slideError = 0.0;  ///< m, see detail::slideError

  BodyState at(double t) const {
    BodyState state;
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      state = bodyAt(bodies[i], joints[i], t, state);
    }
    return state;
  }
};

}  // namespace detail

namespace {

using detail::JointMotion;
using detail::KinematicModel;
using detail::LinkPath;
using detail::MovingBody;
using Eigen::Isometry3d;
using Eigen::Vector3d;

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("LinkMotion: " + what);
}

void requireSize(std::size_t size, std::size_t expected, const std::string& what) {
  if (size == expected) return;
  refuse(what + " has " + std::to_string(size) + " values instead of " + std::to_string(expected));
}

// Lemma: the angular velocity is the sum of the joints' spins, each of which turns with the joints
// before it, at most as fast as these turn together.
MotionRates ratesOf(const KinematicModel& kinematics, const detail::LeverArms& levers,
                    const std::vector<JointMotion>& motion) {
  const detail::TravelBound travel = detail::travelBound(kinematics, levers, 0, motion);
  MotionRates rates;
  rates.speed = travel.speed;
  rates.acceleration = travel.acceleration;
  for (const int body : levers.path) {
    const double spin = motion[static_cast<std::size_t>(body)].spinSpeed;
    rates.angularAcceleration += rates.angularSpeed * spin;
    rates.angularSpeed += spin;
  }
  constexpr double kOutward = 1.0 + 1e-12;
  rates.angularSpeed *= kOutward;
  rates.angularAcceleration *= kOutward;
  return rates;
}

}  // namespace

LinkMotion::LinkMotion(const Robot& robot, std::string_view group, std::string_view link,
                       std::span<const double> from, std::span<const double> to,
                       const std::optional<Eigen::VectorXd>& reference)
    : Motion(Vector3d::Zero()) {
  const Group* const moved = robot.findGroup(group);
  if (moved == nullptr) {
    refuse("robot '" + robot.name() + "' has no group '" + std::string(group) + "'");
  }
  const std::optional<int> index = robot.findLink(link);
  if (!index) refuse("robot '" + robot.name() + "' has no link '" + std::string(link) + "'");
  requireSize(from.size(), moved->variables.size(), "the first configuration");
  requireSize(to.size(), moved->variables.size(), "the last configuration");
  const Eigen::VectorXd held = reference.value_or(robot.defaultState());
  detail::requireWholeState(robot, held, "LinkMotion", "the reference");

  const KinematicModel kinematics = detail::compileKinematics(robot, *moved, held);
  std::vector<JointMotion> motion(kinematics.bodies.size());
  if (!detail::compileMotion(kinematics, from, to, motion)) {
    refuse(
        "a value is not finite, a quaternion has no direction, or a prismatic value is outside its "
        "limits");
  }
  auto path = std::make_shared<LinkPath>();
  const auto linkIndex = static_cast<std::size_t>(*index);
  path->body_from_link = kinematics.body_from_link[linkIndex];
  const detail::LeverArms levers = detail::leverArms(kinematics, kinematics.bodyOfLink[linkIndex],
                                                     path->body_from_link.translation(), 0.0);
  const detail::Fold& fold = kinematics.foldOfLink[linkIndex];
  path->span = levers.span + fold.detour(path->body_from_link);
  path->perUnit = 1.0;
  path->transforms = levers.transforms + fold.transforms;
  detail::BodyState still;  // since the last joint that moves
  for (const int member : levers.path) {
    MovingBody body = kinematics.bodies[static_cast<std::size_t>(member)];
    const JointMotion& joint = motion[static_cast<std::size_t>(member)];
    path->span += joint.wander;
    if (joint.speed == 0.0 && joint.spinSpeed == 0.0) {
      still = detail::bodyAt(body, joint, 0.0, still);
      continue;
    }
    body.parent_from_joint = still.world_from_body * body.parent_from_joint;
    still = {};
    path->bodies.push_back(body);
    path->joints.push_back(joint);
    path->perUnit += joint.speed + joint.spinSpeed;
  }
  path->body_from_link = still.world_from_body * path->body_from_link;
  path->angleError = detail::angleError(motion);
  path->slideError = detail::slideError(motion);
  path->rates = ratesOf(kinematics, levers, motion);
  path_ = std::move(path);
}

Isometry3d LinkMotion::at(double t) const {
  return state(t).pose;
}

Twist LinkMotion::velocity(double t) const {
  return state(t).twist;
}

MotionState LinkMotion::state(double t) const {
  const detail::BodyState body = path_->at(t);
  const Isometry3d pose = body.world_from_body * path_->body_from_link;
  return {pose, {body.linear + body.angular.cross(pose.translation()), body.angular}};
}

MotionRates LinkMotion::rates(double /*from*/, double /*to*/) const {
  return path_->rates;
}

double LinkMotion::rounding(double reach) const {
  const double joints = path_->transforms + 2.0;
  return (tolerance::kRoundingPerJoint * joints * path_->perUnit + path_->angleError) *
             (path_->span + reach) +
         path_->slideError;
}

Isometry3d linkPose(const Robot& robot, std::string_view group, std::string_view link,
                    std::span<const double> q, const std::optional<Eigen::VectorXd>& reference) {
  return LinkMotion(robot, group, link, q, q, reference).at(0.0);
}

}  // namespace swept
