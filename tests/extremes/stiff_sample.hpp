// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sample.hpp"
#include "swept/robot_model/checker.hpp"

namespace extremes {

/// The same ball without a robot, from angle 0, and the post alone.
struct Spin {
  double lever, ball;  ///< m
  swept::Cylinder post;
  Isometry3d place;                             ///< of the post
  double turn;                                  ///< rad, about z
  double up;                                    ///< m
  double tolerance;                             ///< m
  std::optional<Real> contact;                  ///< the first t; none: free
  Real least;                                   ///< m
  std::function<Real(const Real& t)> distance;  ///< m
};

/// One motion of a robot with one ball, among obstacles, and its truth in 50 digits.
struct StiffSample {
  std::shared_ptr<const swept::Checker> checker;
  std::vector<double> from, to;
  std::function<Real(const Real& t)> distance;  ///< m, signed
  std::optional<Real> contact = {};             ///< the first t; none: free
  Real least = 0;                               ///< m, of all t, signed
  double reach = 1.0;                           ///< m, errors are relative to it
  double path = 0.0;                            ///< m, on the way of the ball
  std::optional<Spin> spin = {};
  double accuracy = 0.0;  ///< m, for motionClearance; 0: 10 tolerances
};

struct StiffCase {
  std::string name, baseline;
  double workLimit;
  std::function<StiffSample(Random& random, int i)> draw;
  bool bothSides = true;
  double clearanceLimit = 0.0;  ///< of motionClearance instead of workLimit; 0: the same
};

/// A joint of a chain, and what is between it and the one before.
struct ChainJoint {
  std::string type;
  Vector3d axis = Vector3d::UnitZ();
  Vector3d origin = Vector3d::Zero();  ///< m
  double limit = 1e6;                  ///< rad, either way; slides have their own
};

/// The last link has a ball at `tip` (m), the others nothing.
std::shared_ptr<const swept::Robot> chainWithBall(const std::vector<ChainJoint>& joints,
                                                  const Vector3d& tip, double radius);

std::shared_ptr<const swept::Checker> checkerOf(std::shared_ptr<const swept::Robot> robot,
                                                swept::World world, double tolerance);

std::vector<StiffCase> turnCases();
std::vector<StiffCase> slideCases();

}  // namespace extremes
