// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "rounding/error_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/schedule.hpp"
#include "text/numbers.hpp"
#include "trajectory/bernstein.hpp"
#include "trajectory/curve_on_clock.hpp"
#include "trajectory/rate_bounds.hpp"

namespace swept {

namespace {

void requireSchedule(bool holds, const std::string &message) {
  if (!holds)
    throw std::invalid_argument("combinedCurve: " + message);
}

void requireAllowed(const ScheduledCurve &part, std::size_t i) {
  const std::string of = "curve " + std::to_string(i + 1);
  requireSchedule(std::ssize(part.variables) == part.curve.dimension(),
                  of + " has " + std::to_string(part.curve.dimension()) +
                      " values and " + std::to_string(part.variables.size()) +
                      " names");
  requireSchedule(std::isfinite(part.start) && part.start >= 0.0,
                  of + " starts at " + detail::formatNumber(part.start) +
                      " s; allowed are 0 and later");
  requireSchedule(std::isfinite(part.slowdown) && part.slowdown > 0.0,
                  of + " has a slowdown of " +
                      detail::formatNumber(part.slowdown) +
                      "; allowed are positive numbers");
  requireSchedule(part.start + part.slowdown * part.curve.begin() >= 0.0,
                  of + " begins before the clock's time 0");
}

/// Where the values of a curve are in a configuration of the group. Each is
/// removed from `open`.
std::vector<Eigen::Index> placesOf(const ScheduledCurve &part,
                                   const Robot &robot, const Group &group,
                                   std::vector<bool> &open) {
  std::vector<Eigen::Index> places;
  for (const std::string &name : part.variables) {
    const std::optional<int> variable = robot.findVariable(name);
    const auto at = variable ? std::ranges::find(group.variables, *variable)
                             : group.variables.end();
    requireSchedule(at != group.variables.end(), "group '" + group.name +
                                                     "' has no variable '" +
                                                     name + "'");
    const auto place = at - group.variables.begin();
    requireSchedule(open[static_cast<std::size_t>(place)],
                    "two curves move '" + name + "'");
    open[static_cast<std::size_t>(place)] = false;
    places.push_back(place);
  }
  return places;
}

/// Whether two one-sided derivatives are one, but for rounding.
bool areOne(const Eigen::VectorXd &a, const Eigen::VectorXd &b) {
  constexpr double kPlay =
      1e-9; // of 1 and of the larger one: as PiecewisePolynomial has for ends
  return ((a - b).array().abs() <=
          kPlay * a.array().abs().max(b.array().abs()).max(1.0))
      .all();
}

/// A derivative at all knots.
std::optional<std::vector<Eigen::VectorXd>>
atKnots(const PiecewisePolynomial &curve, int order) {
  std::vector<Eigen::VectorXd> values;
  for (std::size_t i = 0; i < curve.pieces(); ++i) {
    const double duration = curve.knots()[i + 1] - curve.knots()[i];
    Eigen::MatrixXd piece = curve.coefficients(i);
    for (int k = 0; k < order; ++k)
      piece = detail::derivative(piece, duration);
    const Eigen::VectorXd begin = piece.leftCols<1>();
    if (values.empty())
      values.push_back(begin);
    if (!areOne(values.back(), begin))
      return std::nullopt;
    values.push_back(piece.rightCols<1>());
  }
  return values;
}

std::vector<double> list(const Eigen::VectorXd &values) {
  return {values.begin(), values.end()};
}

} // namespace

CombinedCurve combinedCurve(const Robot &robot, const Group &group,
                            std::span<const ScheduledCurve> curves,
                            ConfigurationView still) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, curves, still] {
      return combinedCurve(robot, group, curves, still);
    });
  }
  requireSchedule(!curves.empty(), "there is no curve");
  requireSchedule(still.empty() || still.size() == group.variables.size(),
                  "the configuration has " + std::to_string(still.size()) +
                      " values, expected " +
                      std::to_string(group.variables.size()));
  std::vector<bool> open(group.variables.size(), true);
  std::vector<std::vector<Eigen::Index>> places;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    requireAllowed(curves[i], i);
    places.push_back(placesOf(curves[i], robot, group, open));
  }
  std::vector<detail::CurveOnClock> parts;
  double end = 0.0;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    parts.emplace_back(curves[i], places[i]);
    end = std::max(end, parts.back().end());
  }
  Eigen::VectorXd rest =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(open.size()));
  for (std::size_t v = 0; v < open.size(); ++v) {
    if (!open[v])
      continue;
    requireSchedule(!still.empty(),
                    "no curve moves '" +
                        robot.variables()[group.variables[v]].name + "'");
    requireSchedule(std::isfinite(still[v]),
                    "the configuration has a value that is not finite");
    rest[static_cast<Eigen::Index>(v)] = still[v];
  }

  requireSchedule(end > 0.0, "the curves take no time");
  std::vector<double> rounding(open.size(), 0.0);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::vector<double> rates = detail::largestRates(curves[i].curve);
    const std::vector<double> values = detail::largestValues(curves[i].curve);
    for (std::size_t v = 0; v < places[i].size(); ++v)
      rounding[static_cast<std::size_t>(places[i][v])] =
          detail::combinedRounding(values[v], rates[v] / curves[i].slowdown,
                                   end);
  }
  return {detail::combined(parts, rest, 0.0, end), std::move(rounding)};
}

std::optional<JointTrajectory>
controllerTrajectory(const PiecewisePolynomial &curve,
                     std::vector<std::string> variables) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return controllerTrajectory(curve, std::move(variables)); });
  }
  if (std::ssize(variables) != curve.dimension())
    throw std::invalid_argument("controllerTrajectory: the curve has " +
                                std::to_string(curve.dimension()) +
                                " values and " +
                                std::to_string(variables.size()) + " names");
  int degree = 1;
  for (std::size_t i = 0; i < curve.pieces(); ++i)
    degree = std::max(degree, curve.degree(i));
  const auto positions = atKnots(curve, 0);
  const auto velocities = degree > 1 ? atKnots(curve, 1) : std::nullopt;
  const auto accelerations = degree > 3 ? atKnots(curve, 2) : std::nullopt;
  if (!positions || degree > 5 || (degree > 1 && !velocities) ||
      (degree > 3 && !accelerations))
    return std::nullopt;
  JointTrajectory trajectory{.variables = std::move(variables), .points = {}};
  for (std::size_t k = 0; k < curve.knots().size(); ++k) {
    TrajectoryPoint point;
    point.time = curve.knots()[k];
    point.positions = list((*positions)[k]);
    if (velocities)
      point.velocities = list((*velocities)[k]);
    if (accelerations)
      point.accelerations = list((*accelerations)[k]);
    trajectory.points.push_back(std::move(point));
  }
  return trajectory;
}

} // namespace swept
