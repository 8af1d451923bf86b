// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "certify/checker_model.hpp"
#include "lanes/cover_compile.hpp"
#include "lanes/joint_tables.hpp"
#include "lanes/lane_model.hpp"
#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
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

class LaneCompiler {
 public:
  LaneCompiler(const CheckerModel& model, const LaneModel* like) : model_(model), like_(like) {}

  LaneModel compile() {
    lanes_.usable = boundsHold();
    if (!lanes_.usable) return std::move(lanes_);
    lanes_.margin = std::nextafter(static_cast<float>(model_.options.margin), 1e30F);
    addBodies();
    compileCovers(model_, like_, lanes_);
    addReferences();
    addPairs();
    addTables();
    lanes_.obstacles = compileObstacles(model_.worldGeometry, lanes_.reach, reachIsBounded());
    return std::move(lanes_);
  }

 private:
  /// The arms do not count what planar and floating joints farther out let a body slide; in front
  /// of all other joints, as the base of a mobile robot, they are harmless.
  bool boundsHold() const {
    for (const MovingBody& body : model_.kinematics.bodies) {
      const bool slidesFreely = body.type == JointType::Planar || body.type == JointType::Floating;
      if (slidesFreely && body.parent > 0) return false;
    }
    return true;
  }

  bool reachIsBounded() const {
    return std::ranges::none_of(model_.kinematics.bodies, [](const MovingBody& body) {
      return body.type == JointType::Planar || body.type == JointType::Floating;
    });
  }

  /// Frames are turned so that the joint's axis is z.
  void addBodies() {
    const auto& bodies = model_.kinematics.bodies;
    lanes_.bodyFromLane.assign(bodies.size(), Matrix3d::Identity());
    lanes_.bodies.resize(bodies.size());
    lanes_.parentLaneFromParent.assign(bodies.size(), Matrix3d::Identity());
    lanes_.ancestors.resize(bodies.size());
    for (std::size_t i = 1; i < bodies.size(); ++i) {
      const MovingBody& body = bodies[i];
      lanes_.allBodies.push_back(static_cast<int>(i));
      lanes_.ancestors[i] = lanes_.ancestors[body.parent];
      lanes_.ancestors[i].push_back(static_cast<int>(i));
      if (body.type == JointType::Planar) lanes_.bodyFromLane[i] = body.planarBasis;
      if (turns(body.type))
        lanes_.bodyFromLane[i] =
            Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), body.axis).toRotationMatrix();
      LaneBody& lane = lanes_.bodies[i];
      lane.parent = body.parent;
      const MovingBody& parent = bodies[body.parent];
      if (turns(body.type) && turns(parent.type)) {
        const Vector3d inParent = body.parent_from_joint.linear() * body.axis;
        lane.cosine = static_cast<float>(std::min(1.0, std::abs(inParent.dot(parent.axis)) + 1e-6));
      }
      lane.kind = kindOf(body.type);
      lanes_.floats = lanes_.floats || lane.kind == LaneJointKind::Floating;
      lanes_.slides = lanes_.slides || lane.kind != LaneJointKind::Turn;
      const Matrix3d lane_from_parent = lanes_.bodyFromLane[body.parent].transpose();
      lanes_.parentLaneFromParent[i] = lane_from_parent;
      const Matrix3d rotation =
          lane_from_parent * body.parent_from_joint.linear() * lanes_.bodyFromLane[i];
      const Vector3d translation = lane_from_parent * body.parent_from_joint.translation();
      for (int r = 0; r < 3; ++r) {
        lane.translation[r] = static_cast<float>(translation[r]);
        for (int c = 0; c < 3; ++c) lane.rotation[3 * r + c] = static_cast<float>(rotation(r, c));
      }
    }
  }

  /// All ball centres of a body as one ball, in the body's frame.
  void centersOf(int body, Vector3d& middle, double& radius) const {
    Eigen::AlignedBox3d box;
    std::vector<Vector3d> centers;
    for (std::size_t i = 0; i < lanes_.nodes.size(); ++i) {
      if (nodeBody_[i] != body) continue;
      const float(&c)[3] = lanes_.nodes[i].center;
      centers.push_back(lanes_.bodyFromLane[body] * Vector3d(c[0], c[1], c[2]));
      box.extend(centers.back());
    }
    middle = box.isEmpty() ? Vector3d(Vector3d::Zero()) : box.center();
    radius = 0.0;
    for (const Vector3d& center : centers) radius = std::max(radius, (center - middle).norm());
  }

  void addReferences() {
    findNodeBodies();
    levers_.resize(lanes_.bodies.size());
    for (std::size_t body = 1; body < lanes_.bodies.size(); ++body) {
      Vector3d middle;
      double radius = 0.0;
      centersOf(static_cast<int>(body), middle, radius);
      levers_[body] = leverArms(model_.kinematics, static_cast<int>(body), middle, radius);
    }
    addReference(0);
    std::size_t deepest = 0;
    for (const auto& ancestors : lanes_.ancestors) deepest = std::max(deepest, ancestors.size());
    lanes_.rounding = static_cast<float>(32.0 * kSingle * static_cast<double>(deepest + 4));
  }

  void findNodeBodies() {
    nodeBody_.assign(lanes_.nodes.size(), -1);
    for (std::size_t body = 0; body < lanes_.bodies.size(); ++body) {
      if (lanes_.rootOfBody[body] < 0) continue;
      std::vector<std::int32_t> stack{lanes_.rootOfBody[body]};
      while (!stack.empty()) {
        const std::int32_t node = stack.back();
        stack.pop_back();
        nodeBody_[node] = static_cast<int>(body);
        for (int i = 0; i < lanes_.nodes[node].childCount; ++i)
          stack.push_back(lanes_.nodes[node].firstChild + i);
      }
    }
  }

  int addReference(int body) {
    for (std::size_t i = 0; i < lanes_.references.size(); ++i)
      if (lanes_.references[i].body == body) return static_cast<int>(i);
    LaneReference reference;
    reference.body = body;
    reference.slot.assign(lanes_.bodies.size(), -1);
    std::vector<int> moved;
    for (std::size_t i = 1; i < lanes_.bodies.size(); ++i) {
      const auto& ancestors = lanes_.ancestors[i];
      const bool below = body == 0 || std::ranges::find(ancestors, body) != ancestors.end();
      if (!below || static_cast<int>(i) == body) continue;
      reference.slot[i] = static_cast<int>(moved.size());
      moved.push_back(static_cast<int>(i));
    }
    reference.rows = (static_cast<int>(moved.size()) + kLanes - 1) / kLanes;
    reference.arms.resize(moved.size() * reference.rows, Row{});
    reference.carried.resize(moved.size() * reference.rows, Row{});
    for (const int step : moved) reference.steps.push_back(stepOf(step, reference));
    for (const int carried : moved) fillArms(carried, reference);
    lanes_.references.push_back(std::move(reference));
    return static_cast<int>(lanes_.references.size()) - 1;
  }

  LaneReference::Step stepOf(int body, const LaneReference& reference) const {
    const MovingBody& moving = model_.kinematics.bodies[body];
    LaneReference::Step step;
    step.body = body;
    step.parent = reference.slot[moving.parent];
    if (step.parent < 0) return step;
    step.turnsAfter = lanes_.bodies[body].cosine >= 0.0F;
    step.grandparent = reference.slot[model_.kinematics.bodies[moving.parent].parent];
    return step;
  }

  void fillArms(int body, LaneReference& reference) const {
    const LeverArms& levers = levers_[body];
    const int slot = reference.slot[body];
    for (std::size_t i = 0; i < levers.path.size(); ++i) {
      const int step = reference.slot[levers.path[i]];
      if (step < 0) continue;
      const int at = step * reference.rows + slot / kLanes;
      reference.arms[at].lane[slot % kLanes] = static_cast<float>(levers.arms[i] * (1.0 + 1e-6));
      reference.carried[at].lane[slot % kLanes] = 1.0F;
    }
  }

  void addPairs() {
    const std::size_t obstacles = model_.worldGeometry.size();
    lanes_.pairOf.assign(model_.robotGeometry.size() * obstacles, -1);
    const std::size_t geometries = model_.robotGeometry.size();
    lanes_.pairOfGeometries.assign(geometries * geometries, -1);
    lanes_.sources.resize(model_.pairs.size());
    std::vector<char> meetsWorld(lanes_.bodies.size(), 0);
    std::map<std::pair<int, int>, std::size_t> known;
    for (std::size_t i = 0; i < model_.pairs.size(); ++i) {
      const GeometryPair& pair = model_.pairs[i];
      const int bodyA = model_.robotGeometry[pair.a].body;
      if (!pair.self) {
        lanes_.pairOf[pair.a * obstacles + pair.b] = static_cast<std::int32_t>(i);
        lanes_.sources[i] = {pair.a, pair.b, 0, 0};
        meetsWorld[bodyA] = 1;
        continue;
      }
      lanes_.pairOfGeometries[pair.a * model_.robotGeometry.size() + pair.b] =
          static_cast<std::int32_t>(i);
      const int bodyB = model_.robotGeometry[pair.b].body;
      const auto [at, isNew] = known.try_emplace({bodyA, bodyB}, lanes_.bodyPairs.size());
      if (isNew) lanes_.bodyPairs.push_back({bodyA, bodyB, addReference(pair.reference), {}});
      lanes_.sources[i] = {pair.a, -1, pair.b, static_cast<int>(at->second)};
    }
    for (std::size_t body = lanes_.bodies.size(); body-- > 1;)
      if (meetsWorld[body]) lanes_.worldBodies.push_back(static_cast<int>(body));
  }

  void addTables() {
    if (like_ == nullptr) {
      const auto tables = buildJointTables(model_, lanes_);
      for (std::size_t i = 0; i < tables.size(); ++i) lanes_.bodyPairs[i].table = tables[i];
      return;
    }
    for (LaneBodyPair& bodies : lanes_.bodyPairs) {
      const auto same = [&](const LaneBodyPair& other) {
        return other.bodyA == bodies.bodyA && other.bodyB == bodies.bodyB;
      };
      bodies.table = std::ranges::find_if(like_->bodyPairs, same)->table;
    }
  }

  const CheckerModel& model_;
  const LaneModel* like_;
  LaneModel lanes_;
  std::vector<int> nodeBody_;
  std::vector<LeverArms> levers_;
};

}  // namespace

LaneModel compileLanes(const CheckerModel& model, const LaneModel* like) {
  return LaneCompiler(model, like).compile();
}

}  // namespace swept::detail
