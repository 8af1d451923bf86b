// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/joint_path.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

#include "rounding/error_model.hpp"

namespace swept::detail {

void linearizePart(const JointPath& path, double t, double half, std::span<JointMotion> joints) {
  if (!path.linearize(t, half, joints))
    throw std::logic_error("a JointPath that has bounds over a motion has none over a part of it");
}

bool StraightPath::linearize(double /*t*/, double /*half*/, std::span<JointMotion> joints) const {
  return compileMotion(*model_, from_, to_, joints);
}

void StraightPath::interpolate(double t, std::span<double> q) const {
  if (t == 0.0 || t == 1.0) {
    std::ranges::copy((t == 0.0 ? from_ : to_).first(q.size()), q.begin());
  } else {
    interpolateMotion(*model_, from_, to_, t, q);
  }
}

namespace {

/// The derivative by t' with t = begin + width t'. `wider`: how much more of t than of t' the
/// bounds are about.
void rescale(double begin, double width, double wider, JointMotion& joint) {
  joint.anchor = width > 0.0 ? (joint.anchor - begin) / width : 0.0;
  joint.rate *= width;
  joint.spin *= width;
  joint.angleRate *= width;
  joint.speed *= width * kArithmeticOutward;
  joint.spinSpeed *= width * kArithmeticOutward;
  const double stretch = width * wider;
  joint.acceleration *= stretch * stretch * kArithmeticOutward;
  joint.spinAcceleration *= stretch * stretch * kArithmeticOutward;
}

}  // namespace

bool PathSegment::linearize(double t, double half, std::span<JointMotion> joints) const {
  const double width = end_ - begin_;
  const double part = half * width;
  const auto robot = std::min(static_cast<std::size_t>(model_->firstObstacle), joints.size());
  if (!path_->linearize(begin_ + t * width, part + kTimeRounding, joints.first(robot)))
    return false;
  const double wider = part > 0.0 ? (part + kTimeRounding) / part : 1.0;
  for (std::size_t i = 1; i < robot; ++i) rescale(begin_, width, wider, joints[i]);
  for (std::size_t i = robot; i < joints.size(); ++i)
    if (!compileJoint(*model_, model_->bodies[i], from_, to_, joints[i])) return false;
  return true;
}

void PathSegment::interpolate(double t, std::span<double> q) const {
  path_->interpolate(begin_ + t * (end_ - begin_), q);
}

}  // namespace swept::detail
