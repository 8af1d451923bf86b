// SPDX-License-Identifier: BSD-3-Clause
// How far apart are two shapes, or how deep in each other? Exits 0 if the answers agree with a
// calculation by hand.
#include <cmath>
#include <iostream>

#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"

using Eigen::Vector3d;

bool holds(double lower, double upper, double truth) {
  std::cout << "  proven to be in [" << lower << ", " << upper << "] m, by hand " << truth
            << " m\n";
  const double rounding = 1e-12;  // m, of `truth`
  return lower <= truth + rounding && truth <= upper + rounding && upper - lower < 1e-6;
}

int main() {
  const swept::Shape box = swept::makeBox({2.0, 1.0, 1.0});  // full lengths, m
  const swept::Shape ball = swept::makeSphere(0.5);
  // The pose of the second shape in the frame of the first; answers are in the first's frame.
  Eigen::Isometry3d box_from_ball = Eigen::Isometry3d::Identity();
  bool right = true;

  // Beyond the corner (1, 0.5, 0.5) by 1 m, 1 m and 0.5 m: 1.5 m from it, minus the radius.
  box_from_ball.translation() = Vector3d(2.0, 1.5, 1.0);
  const swept::DistanceResult apart = swept::distance(box, ball, box_from_ball);
  std::cout << "distance, from the corner " << apart.pointA.transpose() << '\n';
  right &= holds(apart.lower, apart.upper, 1.0);
  right &= (apart.pointA - Vector3d(1.0, 0.5, 0.5)).norm() < 1e-6;

  // Is it more than 0.9 m away? This query ends as soon as it knows.
  const auto kept = swept::distance(box, ball, box_from_ball, {.enough = 0.9});
  std::cout << "more than 0.9 m: " << (kept.lower > 0.9 ? "proven" : "no") << '\n';
  right &= kept.lower > 0.9;

  // The middle is 0.1 m inside the face x = 1: the shortest way out is that plus the radius.
  box_from_ball.translation() = Vector3d(0.9, 0.0, 0.0);
  const swept::SignedDistanceResult deep = swept::signedDistance(box, ball, box_from_ball);
  std::cout << "depth, and the way out is along " << deep.normal.transpose() << '\n';
  right &= holds(deep.lower, deep.upper, -0.6);

  // After a translation along the normal by the depth, the two are apart, or just touching.
  box_from_ball.translation() += (1e-6 - deep.lower) * deep.normal;
  right &= swept::collide(box, ball, box_from_ball) == swept::Contact::Separate;
  return right ? 0 : 1;
}
