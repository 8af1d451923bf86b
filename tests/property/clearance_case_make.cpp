// SPDX-License-Identifier: BSD-3-Clause
// What is around the robot of a ClearanceCase, and its Checker.
#include <algorithm>

#include "clearance_case.hpp"

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using swept::CollisionRules;

constexpr const char* kTool = "tool";
constexpr const char* kMover = "mover";

}  // namespace

ClearanceCase::ClearanceCase(std::uint64_t seed, const std::filesystem::path& folder)
    : random_(seed), pieces_(random_, folder) {
  makeRobot(folder);
  for (int i = 0; i < 6; ++i) seeds_.push_back(randomState());
  if (random_.chance(0.6)) makeAttached();
  makeWorld();
  makeRules();
  makeChecker();
  findListed();
  scaleParts();
}

ClearanceCase::Part ClearanceCase::partOf(const RandomPiece& piece) {
  const swept::BoundingSphere ball = swept::boundingSphere(piece.shape);
  return {.shape = piece.shape,
          .body_from_shape = piece.body_from_shape,
          .radius = ball.radius,
          .center = piece.body_from_shape * ball.center};
}

/// Where a ball of this radius is just beyond a piece of the robot, as seen from the first joint
/// that moves the piece.
Vector3d ClearanceCase::besideARobotPiece(const std::vector<double>& q, double radius,
                                          Vector3d& direction) {
  std::vector<Isometry3d> links;
  arm_->poses(q, links);
  const Body& body = robot_[static_cast<std::size_t>(random_.below(robot_.size()))];
  const Part& part = body.parts[static_cast<std::size_t>(random_.below(body.parts.size()))];
  const Vector3d center = links[static_cast<std::size_t>(arm_->link(body.link))] * part.center;
  Vector3d origin = Vector3d::Zero();
  for (int link = arm_->link(body.link); link >= 0;) {
    const auto joint = std::ranges::find(arm_->joints(), link, &oracle::ArmJoint::child);
    if (joint == arm_->joints().end()) break;
    link = joint->parent;
    if (joint->type != "fixed")
      origin = links[static_cast<std::size_t>(link)] * joint->parent_from_joint.translation();
  }
  direction = center - origin;
  direction = direction.norm() > 1e-6 ? direction.normalized() : random_.direction();
  return center + (part.radius + radius + random_.decades(-4.0, -1.0)) * direction;
}

void ClearanceCase::makeWorld() {
  const int bodies = 2 + random_.below(5);
  for (int i = 0; i < bodies; ++i) {
    Body body{.name = "w" + std::to_string(i), .link = {}, .parts = {}};
    const int parts = 1 + random_.below(4);
    for (int k = 0; k < parts; ++k) {
      RandomPiece piece = pieces_.ofWorld();
      Vector3d direction = random_.direction();
      Vector3d place = random_.uniform(0.3, 2.5) * direction;
      if (random_.chance(0.7)) {
        const auto& q = seeds_[static_cast<std::size_t>(random_.below(seeds_.size()))];
        place = besideARobotPiece(q, swept::boundingSphere(piece.shape).radius, direction);
      }
      piece.body_from_shape = pieces_.turned(place);
      // With a side of its box towards the robot it is as far from it as it seems.
      if (random_.chance(0.5))
        piece.body_from_shape.linear() =
            Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), direction).toRotationMatrix();
      body.parts.push_back(partOf(piece));
    }
    world_.push_back(std::move(body));
  }
  // So many that their boxes are sorted.
  for (int i = 0; i > 0 ? i < 40 : random_.chance(0.5); ++i) {
    RandomPiece piece = pieces_.ofWorld();
    piece.body_from_shape = pieces_.turned(pieces_.away(1.0, 2.5));
    world_.push_back({.name = "small" + std::to_string(i), .link = {}, .parts = {partOf(piece)}});
  }
  for (const Body& body : world_) {
    swept::WorldBody built{.name = body.name, .parts = {}};
    for (const Part& part : body.parts) built.parts.push_back({part.shape, part.body_from_shape});
    built_.add(std::move(built));
  }
  if (!random_.chance(0.3)) return;
  swept::MovingObstacle mover{.name = kMover, .parts = {}, .waypoints = {}};
  Body body{.name = kMover, .link = {}, .parts = {}};
  for (int k = 0; k < 2; ++k) {
    RandomPiece piece = pieces_.bounded();
    piece.body_from_shape = pieces_.turned(0.3 * random_.inCube());
    mover.parts.push_back({piece.shape, piece.body_from_shape});
    body.parts.push_back(partOf(piece));
  }
  for (const double time : {0.0, 1.0, 3.0})
    mover.waypoints.push_back({time, pieces_.turned(pieces_.away(0.8, 1.6))});
  ways_[kMover] = mover.waypoints;
  world_.push_back(std::move(body));
  built_.add(std::move(mover));
}

void ClearanceCase::makeAttached() {
  const Body& link = robot_[1 + static_cast<std::size_t>(random_.below(robot_.size() - 1))];
  swept::AttachedBody tool{.name = kTool, .link = link.name, .parts = {}, .touchLinks = {}};
  Body body{.name = kTool, .link = link.name, .parts = {}};
  const int parts = 1 + random_.below(3);
  for (int k = 0; k < parts; ++k) {
    RandomPiece piece = pieces_.bounded();
    piece.body_from_shape = pieces_.turned(pieces_.away(0.1, k == 0 ? 1.2 : 0.3));
    tool.parts.push_back({piece.shape, piece.body_from_shape});
    body.parts.push_back(partOf(piece));
  }
  options_.attached.push_back(std::move(tool));
  robot_.push_back(std::move(body));
}

void ClearanceCase::makeRules() {
  CollisionRules& rules = options_.rules;
  if (random_.chance(0.3)) options_.margin = 0.02;
  // Links that are nearer to each other than to the world would be all that is measured.
  if (random_.chance(0.7)) {
    for (const Body& a : robot_)
      for (const Body& b : robot_) rules.allow(a.name, b.name);
  }
  if (random_.chance(0.3)) rules.pad("l1", random_.uniform(0.01, 0.05));
  if (random_.chance(0.3)) rules.margin("l1", "w0", random_.uniform(0.0, 0.1));
  if (random_.chance(0.2)) rules.allow("l1", "w1");
  if (random_.chance(0.2)) rules.scale("l1", random_.uniform(0.7, 1.3));
  if (random_.chance(0.2)) rules.scale("w0", random_.uniform(0.7, 1.3));
}

/// At once, or as versions.
void ClearanceCase::makeChecker() {
  const auto world = std::make_shared<const swept::World>(built_);
  if (random_.chance(0.5)) {
    checker_.emplace(loaded_, "all", world, options_);
    return;
  }
  checker_.emplace(loaded_, "all", std::make_shared<const swept::World>(),
                   swept::CheckerOptions{.margin = options_.margin});
  for (const swept::AttachedBody& body : options_.attached) checker_ = checker_->withAttached(body);
  checker_ = checker_->withWorld(world).withRules(options_.rules);
}

void ClearanceCase::scaleParts() {
  for (std::vector<Body>* bodies : {&robot_, &world_})
    for (Body& body : *bodies) {
      const double scale = options_.rules.scale(body.name);
      for (Part& part : body.parts)
        if (scale != 1.0)
          part = partOf({swept::scaled(part.shape, scale), part.body_from_shape, {}});
    }
}

std::vector<double> ClearanceCase::state() {
  std::vector<double> whole = randomState();
  if (random_.chance(0.7)) {
    whole = seeds_[static_cast<std::size_t>(random_.below(seeds_.size()))];
    if (random_.chance(0.5))
      for (std::size_t i = 0; i < whole.size(); ++i)
        whole[i] = std::clamp(whole[i] + random_.uniform(-0.03, 0.03), arm_->variables()[i].lower,
                              arm_->variables()[i].upper);
  }
  std::vector<double> q;
  for (const int i : place_) q.push_back(whole[static_cast<std::size_t>(i)]);
  if (!ways_.empty()) q.push_back(random_.uniform(-0.5, 3.5));
  return q;
}

std::vector<double> ClearanceCase::stateAfter(const std::vector<double>& q) {
  std::vector<double> next = state();
  if (random_.chance(0.3)) return next;
  const double share = random_.decades(-2.0, -0.3);
  for (std::size_t i = 0; i < q.size(); ++i) next[i] = q[i] + share * (next[i] - q[i]);
  return next;
}
