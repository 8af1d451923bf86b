// SPDX-License-Identifier: BSD-3-Clause
#include "kinematics/joint_path.hpp"

#include <algorithm>
#include <cstddef>
#include <stdexcept>

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

/// Of the time, for which the ends of neighbouring intervals may round apart.
constexpr double kPathOutward = 1.0 + 1e-12;
constexpr double kTimeRounding = 0x1p-50;

/// By t' with t = begin + width t'.
void rescale(double begin, double width, JointMotion& joint) {
  joint.anchor = width > 0.0 ? (joint.anchor - begin) / width : 0.0;
  joint.rate *= width;
  joint.spin *= width;
  joint.angleRate *= width;
  joint.speed *= width * kPathOutward;
  joint.spinSpeed *= width * kPathOutward;
  joint.acceleration *= width * width * kPathOutward;
  joint.spinAcceleration *= width * width * kPathOutward;
}

}  // namespace

bool PathSegment::linearize(double t, double half, std::span<JointMotion> joints) const {
  const double width = end_ - begin_;
  const auto robot = std::min(static_cast<std::size_t>(model_->firstObstacle), joints.size());
  if (!path_->linearize(begin_ + t * width, half * width + kTimeRounding, joints.first(robot)))
    return false;
  for (std::size_t i = 1; i < robot; ++i) rescale(begin_, width, joints[i]);
  for (std::size_t i = robot; i < joints.size(); ++i)
    if (!compileJoint(*model_, model_->bodies[i], from_, to_, joints[i])) return false;
  return true;
}

void PathSegment::interpolate(double t, std::span<double> q) const {
  path_->interpolate(begin_ + t * (end_ - begin_), q);
}

}  // namespace swept::detail
