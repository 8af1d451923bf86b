// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "exact_motion.hpp"
#include "kinematics/motion_model.hpp"
#include "swept/robot_model/piecewise_polynomial.hpp"

/// Curves in 50 digits, and joints that follow them.
namespace swept::exact_test {

using detail::KinematicModel;
using detail::MovingBody;

/// Joints side by side: one that turns, one that follows it, one that slides, a planar one, a
/// floating one.
inline KinematicModel jointsSideBySide() {
  KinematicModel model;
  model.bodies.emplace_back();
  const auto add = [&model](JointType type, int values, bool cyclic) -> MovingBody& {
    MovingBody body;
    body.parent = 0;
    body.type = type;
    body.variable = model.dimension;
    body.lower = -1e9;
    body.upper = 1e9;
    model.dimension += values;
    for (int i = 0; i < values; ++i) model.cyclic.push_back(cyclic ? 1 : 0);
    return model.bodies.emplace_back(body);
  };
  add(JointType::Continuous, 1, true);
  MovingBody& follower = add(JointType::Revolute, 0, false);
  follower.variable = 0;
  follower.multiplier = -1.75;
  follower.offset = 12.5;
  add(JointType::Prismatic, 1, false);
  add(JointType::Planar, 3, false);
  add(JointType::Floating, 7, false);
  model.fullDimension = model.dimension;
  return model;
}

/// A value of a piece or its derivative by time, at a time, in 50 digits.
inline Digits valueOf(const PiecewisePolynomial& curve, std::size_t piece, Eigen::Index variable,
                      const Digits& time, int order) {
  const Eigen::MatrixXd& own = curve.coefficients(piece);
  const Digits begin(curve.knots()[piece]);
  const Digits length = Digits(curve.knots()[piece + 1]) - begin;
  const Digits u = (time - begin) / length;
  std::vector<Digits> b;
  for (Eigen::Index k = 0; k < own.cols(); ++k) b.emplace_back(own(variable, k));
  for (int o = 0; o < order; ++o) {
    const auto degree = b.size() - 1;
    for (std::size_t k = 0; k < degree; ++k) b[k] = Digits(degree) * (b[k + 1] - b[k]) / length;
    b.pop_back();
  }
  for (std::size_t left = b.size() - 1; left > 0; --left)
    for (std::size_t k = 0; k < left; ++k) b[k] += u * (b[k + 1] - b[k]);
  return b[0];
}

}  // namespace swept::exact_test
