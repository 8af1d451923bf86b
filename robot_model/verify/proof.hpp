// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <string>
#include <utility>
#include <vector>

#include "model.hpp"
#include "motion.hpp"

namespace swept::verify {

/// Two bodies that have to keep apart; the first is the robot's.
struct PairToProve {
  int a, b;  ///< into Model::bodies
};
/// All pairs that the group moves relative to each other, but for those that are allowed to touch
/// and links that a joint connects.
std::vector<PairToProve> pairsToProve(const Model& model);

/// Two bodies on a part of a motion, with all that the joints' tolerances allow beside it, seen
/// from the link that carries both (or the model frame).
class PairMotion {
 public:
  PairMotion(const Model& model, const Motion& motion, PairToProve pair, double begin, double end);

  /// m. A lower bound of the distance between what two nodes hold, at every time of the part and
  /// wherever the tolerances let them be: that along `direction` (any length but zero, in the
  /// reference frame). At time m + s, m being the middle and |s| <= h, the point p is within half
  /// of Bounds::acceleration of p(m) + s v(p(m)) and what play() bounds, and along n the former is
  /// (n + s n x w) . p + s n . v0. For given s, the least over b less the greatest over a are two
  /// supports; as a function of s the former is concave and the latter convex, so that the least of
  /// their difference is at s = -h or h. Rounding is taken off.
  double gap(int nodeA, int nodeB, const Eigen::Vector3d& direction) const;
  /// m. The same to a plane or half-space of b, on the side that its normal points to (1) or the
  /// other one (-1).
  double gapToFlat(int nodeA, std::size_t flat, int side) const;
  /// m. How much of a distance along n, a unit vector, the tolerances take at most, to first order:
  /// a joint that turns by e about a moves p by e a x (p - o), and along n by e (p - o) . (n x a).
  double play(int nodeA, int nodeB, const Eigen::Vector3d& n) const;

  const Placed& placedA() const { return a_; }  ///< in the middle
  const Placed& placedB() const { return b_; }

 private:
  /// The largest direction . x over a node, at time m + s, but for acceleration.
  static double most(const Body& body, int node, const Placed& placed, double s,
                     const Eigen::Vector3d& direction);
  /// How far the tolerances take what a node holds along n.
  static double playOf(const Body& body, int node, const Placed& placed, const Eigen::Vector3d& n);

  /// Pose and bounds of b, a body of the world that moves.
  Bounds placeObstacle(const Obstacle& obstacle, const Motion& motion, double middle);

  const Body& bodyA_;
  const Body& bodyB_;
  Placed a_, b_;
  double half_ = 0.0;
  double slack_ = 0.0;  ///< m: acceleration and rounding
};

}  // namespace swept::verify
