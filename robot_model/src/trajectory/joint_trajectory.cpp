// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/joint_trajectory.hpp"

#include <stdexcept>
#include <string>
#include <utility>

#include "swept/core/floating_point_environment.hpp"
#include "trajectory/valid_trajectory.hpp"

namespace swept {

namespace {

void requirePoints(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("controllerCurve: " + message);
}

Eigen::Map<const Eigen::VectorXd> vectorOf(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size())};
}

/// The piece between two points, over `time` seconds.
Eigen::MatrixXd pieceBetween(const TrajectoryPoint& from, const TrajectoryPoint& to, double time) {
  const auto p0 = vectorOf(from.positions);
  const auto p1 = vectorOf(to.positions);
  const bool cubic = !from.velocities.empty() && !to.velocities.empty();
  const bool quintic = cubic && !from.accelerations.empty() && !to.accelerations.empty();
  Eigen::MatrixXd piece(p0.size(), quintic ? 6 : cubic ? 4 : 2);
  piece.col(0) = p0;
  piece.col(piece.cols() - 1) = p1;
  if (!cubic) return piece;
  // The first coefficients have the derivatives at the begin, and the last those at the end.
  const double degree = quintic ? 5.0 : 3.0;
  const double step = time / degree;
  const Eigen::Index last = piece.cols() - 1;
  piece.col(1) = p0 + step * vectorOf(from.velocities);
  piece.col(last - 1) = p1 - step * vectorOf(to.velocities);
  if (!quintic) return piece;
  const double square = time * time / (degree * (degree - 1.0));
  piece.col(2) =
      p0 + 2.0 * step * vectorOf(from.velocities) + square * vectorOf(from.accelerations);
  piece.col(last - 2) =
      p1 - 2.0 * step * vectorOf(to.velocities) + square * vectorOf(to.accelerations);
  return piece;
}

/// The robot at rest, with whatever the point it goes to has.
TrajectoryPoint restAt(ConfigurationView start, const TrajectoryPoint& next) {
  TrajectoryPoint rest;
  rest.positions.assign(start.begin(), start.end());
  rest.velocities.assign(next.velocities.size(), 0.0);
  rest.accelerations.assign(next.accelerations.size(), 0.0);
  return rest;
}

}  // namespace

PiecewisePolynomial controllerCurve(const JointTrajectory& trajectory, ConfigurationView start) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, start] { return controllerCurve(trajectory, start); });
  }
  const std::vector<TrajectoryPoint>& points = trajectory.points;
  const std::size_t size = trajectory.variables.size();
  detail::requireValid(trajectory, "controllerCurve");
  requirePoints(start.empty() || start.size() == size,
                "the start has " + std::to_string(start.size()) + " values, expected " +
                    std::to_string(size));
  std::vector<double> knots;
  std::vector<Eigen::MatrixXd> pieces;
  const auto add = [&](const TrajectoryPoint& from, const TrajectoryPoint& to) {
    if (knots.empty()) knots.push_back(from.time);
    knots.push_back(to.time);
    pieces.push_back(pieceBetween(from, to, to.time - from.time));
  };
  if (!start.empty() && points.front().time > 0.0) add(restAt(start, points.front()), points[0]);
  for (std::size_t i = 1; i < points.size(); ++i) add(points[i - 1], points[i]);
  requirePoints(!pieces.empty(),
                "the trajectory has one point, at which the robot stays: give the state "
                "that it starts from");
  return {std::move(knots), std::move(pieces)};
}

}  // namespace swept
