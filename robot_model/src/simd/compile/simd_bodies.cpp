// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/simd_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/pair_model.hpp"
#include "robot/joint_types.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/cover_compile.hpp"
#include "simd/compile/single.hpp"
#include "swept/core/axis_frame.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

SimdJointKind kindOf(JointType type) {
  switch (type) {
    case JointType::Prismatic:
      return SimdJointKind::Slide;
    case JointType::Planar:
      return SimdJointKind::Planar;
    case JointType::Floating:
      return SimdJointKind::Floating;
    case JointType::Fixed:
    case JointType::Revolute:
    case JointType::Continuous:
      break;
  }
  return SimdJointKind::Turn;
}

/// rad. An angle from which an offset cancels most rounds in double as the whole angle does. Up to
/// this offset, that is less than its rounding in single precision, which is counted. Sliding
/// joints give their own error.
constexpr double kLargestOffset = 1e6;

bool roundsInSingle(const MovingBody& body) {
  return !turns(body.type) || std::abs(body.offset) <= kLargestOffset;
}

/// The lever arms do not count the slides of planar and floating joints farther out. In front of
/// all other joints, as the base of a mobile robot, such joints are harmless.
bool boundsHold(const KinematicModel& kinematics) {
  return std::ranges::all_of(kinematics.bodies, [](const MovingBody& body) {
    const bool slidesFarOut = slidesFreely(body.type) && body.parent > 0;
    return !slidesFarOut && roundsInSingle(body);
  });
}

/// Frames are rotated so that the joint's axis is z.
Matrix3d bodyFromLane(const MovingBody& body) {
  switch (body.type) {
    case JointType::Revolute:
    case JointType::Continuous:
      return axisFrame(body.axis);
    case JointType::Planar:
      return body.planarBasis;
    case JointType::Fixed:
    case JointType::Prismatic:
    case JointType::Floating:
      break;
  }
  return Matrix3d::Identity();
}

/// Cosine of the angle between the axes of a joint and its parent's, as SimdBody stores it.
float cosineBetween(const MovingBody& body, const MovingBody& parent) {
  if (!turns(body.type) || !turns(parent.type)) return -1.0F;
  const Vector3d inParent = body.parent_from_joint.linear() * body.axis;
  return static_cast<float>(std::min(1.0, std::abs(inParent.dot(parent.axis)) + kCosineError));
}

SimdBody laneBody(const MovingBody& body, const MovingBody& parent,
                  const Matrix3d& lane_from_parent, const Matrix3d& body_from_lane) {
  SimdBody lane;
  lane.parent = body.parent;
  lane.kind = kindOf(body.type);
  lane.cosine = cosineBetween(body, parent);
  const Matrix3d rotation = lane_from_parent * body.parent_from_joint.linear() * body_from_lane;
  assign(lane_from_parent * body.parent_from_joint.translation(), lane.translation);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) lane.rotation[3 * r + c] = static_cast<float>(rotation(r, c));
  return lane;
}

void addBodies(const std::vector<MovingBody>& moving, SimdModel& simd) {
  std::vector<SimdBody> bodies(moving.size());
  std::vector<Matrix3d> fromLane(moving.size(), Matrix3d::Identity());
  std::vector<Matrix3d> laneFromParent(moving.size(), Matrix3d::Identity());
  std::vector<std::vector<int>> ancestors(moving.size());
  std::vector<int> all;
  for (std::size_t i = 1; i < moving.size(); ++i) {
    const int parent = moving[i].parent;
    all.push_back(static_cast<int>(i));
    ancestors[i] = ancestors[parent];
    ancestors[i].push_back(static_cast<int>(i));
    fromLane[i] = bodyFromLane(moving[i]);
    laneFromParent[i] = fromLane[parent].transpose();
    bodies[i] = laneBody(moving[i], moving[parent], laneFromParent[i], fromLane[i]);
    simd.floats = simd.floats || floats(bodies[i].kind);
    simd.slides = simd.slides || slides(bodies[i].kind);
  }
  std::size_t deepest = 0;
  for (const auto& path : ancestors) deepest = std::max(deepest, path.size());
  simd.rounding = static_cast<float>(frameRounding(deepest));
  simd.bodies = SharedArray(std::move(bodies));
  simd.bodyFromLane = SharedArray(std::move(fromLane));
  simd.parentLaneFromParent = SharedArray(std::move(laneFromParent));
  simd.ancestors = SharedArray(std::move(ancestors));
  simd.allBodies = SharedArray(std::move(all));
}

}  // namespace

bool compileSimdBodies(const PairModel& model, SimdModel& simd) {
  if (!boundsHold(model.kinematics)) return false;
  addBodies(model.kinematics.bodies, simd);
  compileCovers(model, simd);
  return true;
}

void shareSimdBodies(const SimdModel& like, SimdModel& simd) {
  simd.bodies = like.bodies;
  simd.parentLaneFromParent = like.parentLaneFromParent;
  simd.bodyFromLane = like.bodyFromLane;
  simd.nodes = like.nodes;
  simd.children = like.children;
  simd.rootOfBody = like.rootOfBody;
  simd.rootOfGeometry = like.rootOfGeometry;
  simd.innerBalls = like.innerBalls;
  simd.probes = like.probes;
  simd.probesOf = like.probesOf;
  simd.meetingRows = like.meetingRows;
  simd.meetingRowsOf = like.meetingRowsOf;
  simd.hulls = like.hulls;
  simd.geometryBody = like.geometryBody;
  simd.allBodies = like.allBodies;
  simd.ancestors = like.ancestors;
  simd.slides = like.slides;
  simd.floats = like.floats;
  simd.rounding = like.rounding;
  simd.reach = like.reach;
  simd.farther = like.farther;
}

}  // namespace swept::detail
