// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/time_parameterization.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/limits.hpp"
#include "text/numbers.hpp"
#include "trajectory/blend_search.hpp"
#include "trajectory/corner_speeds.hpp"
#include "trajectory/rate_check.hpp"
#include "trajectory/timed_path.hpp"
#include "trajectory/way_point_path.hpp"

namespace swept {

namespace {

void requireTiming(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("timeParameterize: " + message);
}

void requireShare(double value, const char* name) {
  requireTiming(value > 0.0 && value <= 1.0, std::string(name) + " is " +
                                                 detail::formatNumber(value) +
                                                 ", allowed is above 0 and at most 1");
}

void requireOptions(const TimingOptions& options) {
  requireTiming(options.blendDeviation >= 0.0 && std::isfinite(options.blendDeviation),
                "blendDeviation is " + detail::formatNumber(options.blendDeviation) +
                    ", allowed is 0 or more");
  requireShare(options.velocityScale, "velocityScale");
  requireShare(options.accelerationScale, "accelerationScale");
}

/// What a group's variables are called, and how they move.
struct GroupVariables {
  std::vector<std::string> names;
  std::vector<char> cyclic;
  std::vector<char> orientation;
};

GroupVariables variablesOf(const Robot& robot, const Group& group) {
  GroupVariables result;
  for (const int index : group.variables) {
    const Variable& variable = robot.variables()[index];
    result.names.push_back(variable.name);
    result.cyclic.push_back(variable.cyclic);
    result.orientation.push_back(isOrientation(robot, variable));
  }
  return result;
}

/// The limits of one rate, each times a factor.
Eigen::VectorXd scaledLimits(const std::vector<double>& limits, double factor, const char* rate,
                             const GroupVariables& variables) {
  requireTiming(limits.size() == variables.names.size(),
                "there are " + std::to_string(limits.size()) + " limits of " + rate +
                    ", expected " + std::to_string(variables.names.size()));
  Eigen::VectorXd scaled(static_cast<Eigen::Index>(limits.size()));
  for (std::size_t i = 0; i < limits.size(); ++i) {
    requireTiming(limits[i] > 0.0, std::string("the limit of ") + rate + " of " +
                                       variables.names[i] + " is " +
                                       detail::formatNumber(limits[i]) + ", allowed is above 0");
    scaled[static_cast<Eigen::Index>(i)] = factor * limits[i];
  }
  return scaled;
}

detail::VariableLimits limitsOf(const RateLimits& limits, const TimingOptions& options,
                                const GroupVariables& variables) {
  detail::VariableLimits result;
  result.speed = scaledLimits(limits.velocity, options.velocityScale, "velocity", variables);
  result.acceleration =
      scaledLimits(limits.acceleration, options.accelerationScale, "acceleration", variables);
  result.jerk = scaledLimits(limits.jerk, 1.0, "jerk", variables);
  result.ramps = options.jerkLimited;
  result.slack = options.jerkLimited ? detail::kRampSlack : detail::kSlack;
  if (!result.ramps) result.jerk.setConstant(std::numeric_limits<double>::infinity());
  return result;
}

void requireWayPoints(const ConfigurationList& wayPoints, const GroupVariables& variables) {
  const std::size_t size = variables.names.size();
  requireTiming(!wayPoints.empty(), "there is no way point");
  for (std::size_t i = 0; i < wayPoints.size(); ++i) {
    const std::string name = "way point " + std::to_string(i);
    requireTiming(wayPoints[i].size() == size, name + " has " +
                                                   std::to_string(wayPoints[i].size()) +
                                                   " values, expected " + std::to_string(size));
    for (std::size_t j = 0; j < size; ++j) {
      requireTiming(std::isfinite(wayPoints[i][j]),
                    variables.names[j] + " of " + name + " is not finite");
      requireTiming(!variables.orientation[j] || wayPoints[i][j] == wayPoints[0][j],
                    variables.names[j] + " changes to " + name +
                        ": an orientation turns by a slerp, which no trajectory of polynomials "
                        "follows");
    }
  }
}

/// Whether the robot must stop at each way point.
std::vector<char> stopsOf(const TimingOptions& options, std::size_t wayPoints) {
  std::vector<char> result(wayPoints, 0);
  for (const std::size_t stop : options.stops) {
    requireTiming(stop < wayPoints, "stop " + std::to_string(stop) +
                                        " is no way point, there are " + std::to_string(wayPoints));
    result[stop] = 1;
  }
  return result;
}

/// The trajectory that stays.
std::vector<TrajectoryPoint> stayingPoints(ConfigurationView q, bool ramps) {
  constexpr double kStay = 1e-3;  // s
  std::vector<TrajectoryPoint> points(2);
  for (TrajectoryPoint& point : points) {
    point.positions.assign(q.begin(), q.end());
    point.velocities.assign(q.size(), 0.0);
    if (ramps) point.accelerations.assign(q.size(), 0.0);
  }
  points[1].time = kStay;
  return points;
}

/// s, of a path that stops at each corner.
double longestDuration(const detail::WayPointPath& path) {
  double sum = 0.0;
  for (std::size_t i = 0; i < path.parts(); ++i)
    sum += detail::fastestProfile(0.0, 0.0, path.lengths[i], path.straight[i]).duration();
  return sum;
}

/// Of a path that moves.
TimedPath timedMotion(const detail::WayPointPath& path, const std::vector<std::string>& names,
                      const detail::VariableLimits& limits, const BlendProver& proves,
                      double deviation) {
  constexpr double kNanosecond = 1e-9;
  const double leastStep = std::max(kNanosecond, detail::leastStepFor(path, longestDuration(path)));
  detail::CornerSpeeds speeds(path, leastStep);
  detail::chooseBlends(path, deviation, speeds);
  if (proves) detail::proveBlends(proves, path.indices, speeds);
  return detail::timedPath(path, speeds, names, limits, leastStep);
}

}  // namespace

TimedPath timeParameterize(const Robot& robot, const Group& group,
                           const ConfigurationList& wayPoints, const RateLimits& limits,
                           const BlendProver& proves, const TimingOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return timeParameterize(robot, group, wayPoints, limits, proves, options); });
  }
  requireOptions(options);
  const GroupVariables variables = variablesOf(robot, group);
  const detail::VariableLimits whole = limitsOf(limits, options, variables);
  requireWayPoints(wayPoints, variables);
  const detail::WayPointPath path = detail::straightParts(
      detail::continuousPoints(wayPoints, variables.cyclic), stopsOf(options, wayPoints.size()),
      detail::withSlack(whole), variables.names);
  if (path.parts() > 0)
    return timedMotion(path, variables.names, whole, proves, options.blendDeviation);
  JointTrajectory trajectory{variables.names, stayingPoints(wayPoints[0], whole.ramps)};
  PiecewisePolynomial curve = controllerCurve(trajectory);
  return {std::move(trajectory), std::move(curve), {}};
}

}  // namespace swept
