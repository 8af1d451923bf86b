// SPDX-License-Identifier: BSD-3-Clause
#include "proof.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rounding.hpp"

namespace swept::verify {
namespace {

using Eigen::Vector3d;

/// Whether a body is a link itself, and not something that the link carries.
bool isLink(const Model& model, int body) {
  const int link = model.linkOf[static_cast<std::size_t>(body)];
  return link >= 0 && model.bodies[static_cast<std::size_t>(body)].name() ==
                          model.links[static_cast<std::size_t>(link)];
}

/// Two links that a joint connects.
bool adjacent(const Model& model, int a, int b) {
  if (!isLink(model, a) || !isLink(model, b)) return false;
  const auto links = std::minmax(model.linkOf[static_cast<std::size_t>(a)],
                                 model.linkOf[static_cast<std::size_t>(b)]);
  return std::ranges::any_of(model.joints, [&](const Joint& joint) {
    return std::pair(joint.parent, joint.child) == std::pair(links.first, links.second);
  });
}

}  // namespace

std::vector<PairToProve> pairsToProve(const Model& model) {
  std::vector<PairToProve> pairs;
  const auto count = static_cast<int>(model.bodies.size());
  for (int a = 0; a < count; ++a) {
    const int linkA = model.linkOf[static_cast<std::size_t>(a)];
    if (linkA < 0) break;
    for (int b = a + 1; b < count; ++b) {
      const int linkB = model.linkOf[static_cast<std::size_t>(b)];
      const int reference = linkB < 0 ? -1 : commonAncestor(model, linkA, linkB);
      const bool moved = isMoved(model, linkA, reference) || isMoved(model, linkB, reference) ||
                         model.obstacles.contains(b);
      const bool empty = model.bodies[static_cast<std::size_t>(a)].nodes().empty() ||
                         (model.bodies[static_cast<std::size_t>(b)].nodes().empty() &&
                          model.bodies[static_cast<std::size_t>(b)].flats().empty());
      const bool connected = adjacent(model, a, b) && !model.asked.contains({a, b});
      if (!moved || empty || connected || model.allowed.contains({a, b})) continue;
      pairs.push_back({a, b});
    }
  }
  return pairs;
}

PairMotion::PairMotion(const Model& model, const Motion& motion, PairToProve pair, double begin,
                       double end)
    : bodyA_(model.bodies[static_cast<std::size_t>(pair.a)]),
      bodyB_(model.bodies[static_cast<std::size_t>(pair.b)]),
      half_(0.5 * (end - begin)) {
  const int linkA = model.linkOf[static_cast<std::size_t>(pair.a)];
  const int linkB = model.linkOf[static_cast<std::size_t>(pair.b)];
  const int reference = linkB < 0 ? -1 : commonAncestor(model, linkA, linkB);
  const double middle = 0.5 * (begin + end);
  a_ = motion.at(linkA, reference, middle, half_);
  const Bounds boundsA = motion.bounds(linkA, reference, bodyA_.reach(), middle, half_);
  Bounds boundsB;
  if (const auto obstacle = model.obstacles.find(pair.b); obstacle != model.obstacles.end()) {
    boundsB = placeObstacle(obstacle->second, motion, middle);
  } else {
    b_ = motion.at(linkB, reference, middle, half_);
    boundsB = motion.bounds(linkB, reference, bodyB_.reach(), middle, half_);
  }
  const double acceleration = boundsA.acceleration + boundsB.acceleration;
  const double size = boundsA.extent + boundsB.extent + bodyA_.size() + bodyB_.size();
  const double turn = 1.0 + boundsA.turn + boundsB.turn;
  // What a direction swings by grows with the interval, and so does what that rounds by.
  const double swing = 1.0 + (boundsA.spin + boundsB.spin);
  slack_ = 0.5 * acceleration +
           kRounding * (boundsA.joints + boundsB.joints + 4) * turn * swing * size + kUnderflow;
  // NaN, too: numbers were too large on the way.
  if (!(turn <= kLargest && size <= kLargest)) slack_ = std::numeric_limits<double>::infinity();
}

Bounds PairMotion::placeObstacle(const Obstacle& obstacle, const Motion& motion, double middle) {
  if (!motion.clock())
    throw Refusal("body " + bodyB_.name() +
                  ": it moves, and a path without times does not say when");
  const Obstacle::Placed placed = obstacle.at(*motion.clock(), middle);
  const Obstacle::Bounds own = obstacle.bounds(*motion.clock(), bodyB_.reach(), middle, half_);
  b_ = {.reference_from_link = placed.world_from_body,
        .linear = placed.linear,
        .angular = placed.angular};
  return {.acceleration = own.deviation,
          .extent = own.extent,
          .turn = own.turn,
          .spin = own.spin,
          .joints = 1};
}

double PairMotion::most(const Body& body, int node, const Placed& placed, double s,
                        const Vector3d& direction) {
  const Vector3d swung = direction + s * direction.cross(placed.angular);
  const auto& pose = placed.reference_from_link;
  return body.support(node, pose.linear().transpose() * swung) + swung.dot(pose.translation()) +
         s * direction.dot(placed.linear);
}

double PairMotion::gap(int nodeA, int nodeB, const Vector3d& direction) const {
  // Squares and lengths of tiny numbers have few digits or none: n would not be of length one.
  const Vector3d n = (direction / direction.cwiseAbs().maxCoeff()).normalized();
  const auto at = [&](double s) {
    return -most(bodyB_, nodeB, b_, s, -n) - most(bodyA_, nodeA, a_, s, n);
  };
  return std::min(at(-half_), at(half_)) - play(nodeA, nodeB, n) - slack_;
}

double PairMotion::play(int nodeA, int nodeB, const Vector3d& n) const {
  return playOf(bodyA_, nodeA, a_, n) + playOf(bodyB_, nodeB, b_, -n);
}

double PairMotion::playOf(const Body& body, int node, const Placed& placed, const Vector3d& n) {
  double sum = 0.0;
  for (const Play& play : placed.plays) {
    const Vector3d way = n.cross(play.turn);
    if (!way.isZero(0.0)) {
      const double origin = way.dot(play.origin);
      sum += std::max(most(body, node, placed, 0.0, way) - origin,
                      most(body, node, placed, 0.0, -way) + origin);
    }
    const double arm =
        (placed.reference_from_link.translation() - play.origin).norm() + body.reach();
    const double along = n.dot(play.axis);
    sum += along * (along > 0.0 ? play.forward : -play.backward) + play.slideAnywhere +
           play.turnAnywhere * arm;
  }
  return sum;
}

double PairMotion::gapToFlat(int nodeA, std::size_t flat, int side) const {
  const Flat& plane = bodyB_.flats()[flat];
  if (plane.solid && side < 0) return -std::numeric_limits<double>::infinity();
  // From a towards the flat, which stands still: bodies with flats are the world's, and none of
  // them moves.
  const Vector3d n = -static_cast<double>(side) * plane.normal;
  const auto at = [&](double s) { return -side * plane.offset - most(bodyA_, nodeA, a_, s, n); };
  return std::min(at(-half_), at(half_)) - playOf(bodyA_, nodeA, a_, n) - slack_;
}

}  // namespace swept::verify
