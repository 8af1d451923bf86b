// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/link_motion.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include "kinematics/full_state.hpp"
#include "kinematics/joint_path.hpp"
#include "kinematics/lever_arms.hpp"
#include "kinematics/motion_model.hpp"
#include "rounding/error_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

namespace detail {

/// The moving joints between the model frame and a link. Joints that stand still are part of the
/// frames between them.
struct LinkPath {
  std::vector<MovingBody> bodies;  ///< from the model frame to the link
  std::vector<JointMotion> joints;
  Eigen::Isometry3d body_from_link = Eigen::Isometry3d::Identity();  ///< of the last body
  double transforms = 0.0;  ///< number of joints, including those that stand still
  MotionRates rates;
  double span = 0.0;        ///< m, of the link's origin: see LeverArms::spanAtRest, and the slides
  double perUnit = 0.0;     ///< 1 + the sum of the joints' spins, rad per unit of t
  double speeds = 0.0;      ///< m per unit of t, sum of the joints'
  CarriedRounding carried;  ///< of the link

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

[[noreturn]] void refuseMotion(const std::string& what) {
  throw std::invalid_argument("LinkMotion: " + what);
}

void requireValues(std::size_t size, std::size_t expected, const std::string& what) {
  if (size == expected) return;
  refuseMotion(what + " has " + std::to_string(size) + " values instead of " +
               std::to_string(expected));
}

// Lemma: the angular velocity is the sum of the joints' spins. Each of them changes by its own
// acceleration and turns with the joints before it, at most as fast as these turn together.
MotionRates ratesOf(const KinematicModel& kinematics, const detail::LeverArms& levers,
                    const Vector3d& center, const std::vector<JointMotion>& motion) {
  std::vector<double> arms = levers.arms;
  if (levers.vary) detail::motionArms(kinematics, levers.path.back(), center, 0.0, motion, arms);
  const detail::PointMotionBound travel =
      detail::pointMotionBound(kinematics, levers.path, arms, 0, motion);
  MotionRates rates;
  rates.speed = travel.speed;
  rates.acceleration = travel.acceleration;
  for (const int body : levers.path) {
    const JointMotion& joint = motion[static_cast<std::size_t>(body)];
    rates.angularAcceleration += rates.angularSpeed * joint.spinSpeed + joint.spinAcceleration;
    rates.angularSpeed += joint.spinSpeed;
  }
  rates.angularSpeed *= detail::kArithmeticOutward;
  rates.angularAcceleration *= detail::kArithmeticOutward;
  return rates;
}

}  // namespace

LinkMotion::LinkMotion(const Robot& robot, std::string_view group, std::string_view link,
                       ConfigurationView from, ConfigurationView to,
                       const std::optional<Eigen::VectorXd>& reference)
    : Motion(Vector3d::Zero()) {
  if (detail::inForeignEnvironment()) {
    *this =
        inDefaultEnvironment([&] { return LinkMotion(robot, group, link, from, to, reference); });
    return;
  }
  const Group* const moved = robot.findGroup(group);
  if (moved == nullptr) {
    refuseMotion("robot '" + robot.name() + "' has no group '" + std::string(group) + "'");
  }
  const std::optional<int> index = robot.findLink(link);
  if (!index) refuseMotion("robot '" + robot.name() + "' has no link '" + std::string(link) + "'");
  requireValues(from.size(), moved->variables.size(), "the first configuration");
  requireValues(to.size(), moved->variables.size(), "the last configuration");
  const Eigen::VectorXd held = reference.value_or(robot.defaultState());
  detail::requireFullState(robot, held, "LinkMotion", "the reference");

  const KinematicModel kinematics = detail::compileKinematics(robot, *moved, held);
  std::vector<JointMotion> motion(kinematics.bodies.size());
  if (!detail::StraightPath(kinematics, from, to).linearize(0.5, 0.5, motion)) {
    refuseMotion(
        "a value is not finite, a quaternion has no direction, or a prismatic value is outside its "
        "limits");
  }
  auto path = std::make_shared<LinkPath>();
  const auto linkIndex = static_cast<std::size_t>(*index);
  path->body_from_link = kinematics.body_from_link[linkIndex];
  const detail::LeverArms levers = detail::leverArms(kinematics, kinematics.bodyOfLink[linkIndex],
                                                     path->body_from_link.translation(), 0.0);
  const detail::FixedJointChain& fixedChain = kinematics.fixedChainOfLink[linkIndex];
  path->span = levers.spanAtRest + fixedChain.detour(path->body_from_link);
  path->perUnit = 1.0;
  path->transforms = levers.transforms + fixedChain.transforms;
  detail::BodyState still;  // since the last moving joint
  for (const int member : levers.path) {
    MovingBody body = kinematics.bodies[static_cast<std::size_t>(member)];
    const JointMotion& joint = motion[static_cast<std::size_t>(member)];
    path->carried = detail::carriedRounding(path->carried, joint);
    if (joint.speed == 0.0 && joint.spinSpeed == 0.0) {
      still = detail::bodyAt(body, joint, 0.0, still);
      continue;
    }
    body.parent_from_joint = still.world_from_body * body.parent_from_joint;
    still = {};
    path->bodies.push_back(body);
    path->joints.push_back(joint);
    path->perUnit += joint.spinSpeed;
    path->speeds += joint.speed;
  }
  path->span += path->carried.slid;
  const Vector3d origin = path->body_from_link.translation();
  path->body_from_link = still.world_from_body * path->body_from_link;
  path->rates = ratesOf(kinematics, levers, origin, motion);
  path_ = std::move(path);
}

Isometry3d LinkMotion::at(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return LinkMotion::at(t); });
  }
  return state(t).pose;
}

Twist LinkMotion::velocity(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return LinkMotion::velocity(t); });
  }
  return state(t).twist;
}

MotionState LinkMotion::state(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return LinkMotion::state(t); });
  }
  const detail::BodyState body = path_->at(t);
  const Isometry3d pose = body.world_from_body * path_->body_from_link;
  return {pose, {body.linear + body.angular.cross(pose.translation()), body.angular}};
}

MotionRates LinkMotion::rates(double from, double to) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to] { return LinkMotion::rates(from, to); });
  }
  return path_->rates;
}

double LinkMotion::rounding(double reach) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, reach] { return LinkMotion::rounding(reach); });
  }
  // Bound for positions and velocities: turning joints carry the span along, sliding joints add
  // their speeds.
  const double relative = tolerance::kRoundingPerJoint * (path_->transforms + 2.0);
  const double span = path_->span + reach;
  const double turned = relative + path_->carried.angleError;
  return path_->perUnit * (turned * span + path_->carried.slideError) + turned * path_->speeds;
}

Isometry3d linkPose(const Robot& robot, std::string_view group, std::string_view link,
                    ConfigurationView q, const std::optional<Eigen::VectorXd>& reference) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, group, link, q] { return linkPose(robot, group, link, q, reference); });
  }
  return LinkMotion(robot, group, link, q, q, reference).at(0.0);
}

}  // namespace swept
