// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/motion_input.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

using Eigen::Isometry3d;

namespace {

/// m, of the body, in the frame.
Eigen::Vector3d referenceIn(const Motion& body, const Isometry3d& body_from_frame) {
  return detail::checkedPose(body_from_frame, "body_from_frame").inverse() * body.reference();
}

}  // namespace

AttachedFrame::AttachedFrame(const Motion& body, const Isometry3d& body_from_frame)
    : Motion(inDefaultEnvironment([&] { return referenceIn(body, body_from_frame); })),
      body_(body),
      body_from_frame_(inDefaultEnvironment(
          [&] { return detail::checkedPose(body_from_frame, "body_from_frame"); })) {}

Isometry3d AttachedFrame::at(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return AttachedFrame::at(t); });
  }
  return body_.at(t) * body_from_frame_;
}

Twist AttachedFrame::velocity(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return AttachedFrame::velocity(t); });
  }
  return body_.velocity(t);
}

MotionState AttachedFrame::state(double t) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, t] { return AttachedFrame::state(t); });
  }
  const MotionState body = body_.state(t);
  return {body.pose * body_from_frame_, body.twist};
}

MotionRates AttachedFrame::rates(double from, double to) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, from, to] { return AttachedFrame::rates(from, to); });
  }
  return body_.rates(from, to);
}

double AttachedFrame::rounding(double reach) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, reach] { return AttachedFrame::rounding(reach); });
  }
  const double far = reach + body_from_frame_.translation().norm();
  return body_.rounding(far) + tolerance::kRoundingPerJoint * (far + body_.reference().norm());
}

}  // namespace swept
