// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/lane_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "certify/checker_model.hpp"
#include "lanes/cover_compile.hpp"
#include "lanes/single.hpp"
#include "swept/core/axis_frame.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

LaneJointKind kindOf(JointType type) {
  switch (type) {
    case JointType::Prismatic:
      return LaneJointKind::Slide;
    case JointType::Planar:
      return LaneJointKind::Planar;
    case JointType::Floating:
      return LaneJointKind::Floating;
    default:
      return LaneJointKind::Turn;
  }
}

/// rad. What is left of an angle by an offset rounds in double as the angle does: up to this offset
/// by less than it rounds in single precision, which is counted. What so slides says by how much.
constexpr double kLargestOffset = 1e6;

bool roundsInSingle(const MovingBody& body) {
  return !turns(body.type) || std::abs(body.offset) <= kLargestOffset;
}

/// The arms do not count what planar and floating joints farther out let a body slide; in front of
/// all other joints, as the base of a mobile robot, they are harmless.
bool boundsHold(const KinematicModel& kinematics) {
  return std::ranges::all_of(kinematics.bodies, [](const MovingBody& body) {
    const bool slidesFarOut = slidesFreely(body.type) && body.parent > 0;
    return !slidesFarOut && roundsInSingle(body);
  });
}

/// Frames are turned so that the joint's axis is z.
Matrix3d bodyFromLane(const MovingBody& body) {
  if (body.type == JointType::Planar) return body.planarBasis;
  if (!turns(body.type)) return Matrix3d::Identity();
  return axisFrame(body.axis);
}

/// Of the angle between the axes of a joint and its parent's, as LaneBody has it.
float cosineBetween(const MovingBody& body, const MovingBody& parent) {
  if (!turns(body.type) || !turns(parent.type)) return -1.0F;
  const Vector3d inParent = body.parent_from_joint.linear() * body.axis;
  return static_cast<float>(std::min(1.0, std::abs(inParent.dot(parent.axis)) + 1e-6));
}

LaneBody laneBody(const MovingBody& body, const MovingBody& parent,
                  const Matrix3d& lane_from_parent, const Matrix3d& body_from_lane) {
  LaneBody lane;
  lane.parent = body.parent;
  lane.kind = kindOf(body.type);
  lane.cosine = cosineBetween(body, parent);
  const Matrix3d rotation = lane_from_parent * body.parent_from_joint.linear() * body_from_lane;
  assign(lane_from_parent * body.parent_from_joint.translation(), lane.translation);
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) lane.rotation[3 * r + c] = static_cast<float>(rotation(r, c));
  return lane;
}

void addBodies(const std::vector<MovingBody>& moving, LaneModel& lanes) {
  std::vector<LaneBody> bodies(moving.size());
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
    lanes.floats = lanes.floats || bodies[i].kind == LaneJointKind::Floating;
    lanes.slides = lanes.slides || bodies[i].kind != LaneJointKind::Turn;
  }
  std::size_t deepest = 0;
  for (const auto& path : ancestors) deepest = std::max(deepest, path.size());
  lanes.rounding = static_cast<float>(32.0 * kSingle * static_cast<double>(deepest + 4));
  lanes.bodies = SharedArray(std::move(bodies));
  lanes.bodyFromLane = SharedArray(std::move(fromLane));
  lanes.parentLaneFromParent = SharedArray(std::move(laneFromParent));
  lanes.ancestors = SharedArray(std::move(ancestors));
  lanes.allBodies = SharedArray(std::move(all));
}

}  // namespace

bool compileLaneBodies(const CheckerModel& model, LaneModel& lanes) {
  if (!boundsHold(model.kinematics)) return false;
  addBodies(model.kinematics.bodies, lanes);
  compileCovers(model, lanes);
  return true;
}

void shareLaneBodies(const LaneModel& like, LaneModel& lanes) {
  lanes.bodies = like.bodies;
  lanes.parentLaneFromParent = like.parentLaneFromParent;
  lanes.bodyFromLane = like.bodyFromLane;
  lanes.nodes = like.nodes;
  lanes.children = like.children;
  lanes.rootOfBody = like.rootOfBody;
  lanes.rootOfGeometry = like.rootOfGeometry;
  lanes.innerBalls = like.innerBalls;
  lanes.probes = like.probes;
  lanes.probesOf = like.probesOf;
  lanes.meetingRows = like.meetingRows;
  lanes.meetingRowsOf = like.meetingRowsOf;
  lanes.hulls = like.hulls;
  lanes.geometryBody = like.geometryBody;
  lanes.allBodies = like.allBodies;
  lanes.ancestors = like.ancestors;
  lanes.slides = like.slides;
  lanes.floats = like.floats;
  lanes.rounding = like.rounding;
  lanes.reach = like.reach;
  lanes.farther = like.farther;
}

}  // namespace swept::detail
