// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "swept/robot_model/joint_trajectory.hpp"

namespace trajectories {

/// A curve by the published formulas, in extended precision: none of swept's classes computes it.
struct Truth {
  std::vector<double> knots;  ///< s
  /// Values (order 0) or their derivatives by time at a time (s) of a piece.
  std::function<void(std::size_t piece, double t, int order, std::vector<double>& values)> at;

  std::size_t pieces() const { return knots.size() - 1; }
  /// The later piece at a knot, the last one at the end.
  std::size_t pieceAt(double t) const;
};

/// What ros2_control makes of a trajectory, in powers of the time since the first of two points
/// (joint_trajectory_controller, trajectory.cpp). `start`: as for controllerCurve().
Truth truthOf(const swept::JointTrajectory& trajectory, const std::vector<double>& start);

/// Of Bernstein coefficients, by the formula of Bernstein polynomials. `orientations`: indices of
/// the first components of quaternions, which follow slerp where the degree is 1.
Truth truthOf(std::vector<double> knots, std::vector<Eigen::MatrixXd> coefficients,
              std::vector<Eigen::Index> orientations);

/// Of a B-spline, by the recursion of Cox and de Boor.
Truth truthOf(int degree, std::vector<double> knots, Eigen::MatrixXd controlPoints);

}  // namespace trajectories
