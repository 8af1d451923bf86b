// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/motion_input.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

using Eigen::Isometry3d;

AttachedFrame::AttachedFrame(const Motion& body, const Isometry3d& body_from_frame)
    : Motion(detail::checkedPose(body_from_frame, "body_from_frame").inverse() * body.reference()),
      body_(body),
      body_from_frame_(detail::checkedPose(body_from_frame, "body_from_frame")) {}

Isometry3d AttachedFrame::at(double t) const {
  return body_.at(t) * body_from_frame_;
}

Twist AttachedFrame::velocity(double t) const {
  return body_.velocity(t);
}

MotionState AttachedFrame::state(double t) const {
  const MotionState body = body_.state(t);
  return {body.pose * body_from_frame_, body.twist};
}

MotionRates AttachedFrame::rates(double from, double to) const {
  return body_.rates(from, to);
}

double AttachedFrame::rounding(double reach) const {
  const double far = reach + body_from_frame_.translation().norm();
  return body_.rounding(far) + tolerance::kRoundingPerJoint * (far + body_.reference().norm());
}

}  // namespace swept
