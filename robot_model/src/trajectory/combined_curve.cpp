// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "rounding/error_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/robot_model/schedule.hpp"
#include "text/numbers.hpp"
#include "trajectory/bernstein.hpp"
#include "trajectory/rate_bounds.hpp"

namespace swept {

namespace {

void requireSchedule(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("combinedCurve: " + message);
}

void requireAllowed(const ScheduledCurve& part, std::size_t i) {
  const std::string of = "curve " + std::to_string(i + 1);
  requireSchedule(std::ssize(part.variables) == part.curve.dimension(),
                  of + " has " + std::to_string(part.curve.dimension()) + " values and " +
                      std::to_string(part.variables.size()) + " names");
  requireSchedule(
      std::isfinite(part.start) && part.start >= 0.0,
      of + " starts at " + detail::formatNumber(part.start) + " s; allowed are 0 and later");
  requireSchedule(std::isfinite(part.slowdown) && part.slowdown > 0.0,
                  of + " has a slowdown of " + detail::formatNumber(part.slowdown) +
                      "; allowed are positive numbers");
  requireSchedule(part.start + part.slowdown * part.curve.begin() >= 0.0,
                  of + " begins before the clock's time 0");
}

/// s, of the clock.
double onClock(const ScheduledCurve& part, double time) {
  return part.start + part.slowdown * time;
}

/// Where the values of a curve are in a configuration of the group. Each is removed from `open`.
std::vector<Eigen::Index> placesOf(const ScheduledCurve& part, const Robot& robot,
                                   const Group& group, std::vector<bool>& open) {
  std::vector<Eigen::Index> places;
  for (const std::string& name : part.variables) {
    const std::optional<int> variable = robot.findVariable(name);
    const auto at =
        variable ? std::ranges::find(group.variables, *variable) : group.variables.end();
    requireSchedule(at != group.variables.end(),
                    "group '" + group.name + "' has no variable '" + name + "'");
    const auto place = at - group.variables.begin();
    requireSchedule(open[static_cast<std::size_t>(place)], "two curves move '" + name + "'");
    open[static_cast<std::size_t>(place)] = false;
    places.push_back(place);
  }
  return places;
}

/// The times at which a piece of any of the curves begins or ends, ascending. Times that rounding
/// alone may tell apart become one.
std::vector<double> knotsOf(std::span<const ScheduledCurve> parts) {
  std::vector<double> times{0.0};
  for (const ScheduledCurve& part : parts)
    for (const double knot : part.curve.knots()) times.push_back(onClock(part, knot));
  std::ranges::sort(times);
  const double same = detail::kSameTime * times.back();
  std::vector<double> knots{0.0};
  for (const double time : times)
    if (time - knots.back() > same) knots.push_back(time);
  return knots;
}

/// Coefficients of a piece over a part of it, [from, to] of its length, at another degree.
Eigen::MatrixXd restricted(const Eigen::MatrixXd& piece, double from, double to, int degree) {
  const auto count = static_cast<std::size_t>(piece.cols());
  Eigen::MatrixXd result(piece.rows(), degree + 1);
  detail::Bernstein whole{};
  detail::Bernstein unused{};
  detail::Bernstein rest{};
  detail::Bernstein part{};
  for (Eigen::Index row = 0; row < piece.rows(); ++row) {
    for (std::size_t k = 0; k < count; ++k) whole[k] = piece(row, static_cast<Eigen::Index>(k));
    const auto first = [count](detail::Bernstein& all) { return std::span(all).first(count); };
    detail::divide(first(whole), from, first(unused), first(rest));
    detail::divide(first(rest), from < 1.0 ? (to - from) / (1.0 - from) : 1.0, first(part),
                   first(unused));
    // Raised by one degree at a time (Farin, section 6.1).
    for (auto d = count; d <= static_cast<std::size_t>(degree); ++d) {
      part[d] = part[d - 1];
      for (std::size_t k = d - 1; k > 0; --k) {
        // What is constant stays so to the last bit.
        part[k] += static_cast<double>(k) / static_cast<double>(d) * (part[k - 1] - part[k]);
      }
    }
    for (Eigen::Index k = 0; k <= degree; ++k) result(row, k) = part[static_cast<std::size_t>(k)];
  }
  return result;
}

/// One curve between two knots of all: a piece of it, or rest.
class PartOnClock {
 public:
  explicit PartOnClock(const ScheduledCurve& part) : part_(part) {}

  int degree(double begin, double end) const {
    return isAtRest(begin, end) ? 1 : part_.curve.degree(pieceOf(begin, end));
  }

  Eigen::MatrixXd piece(double begin, double end, int degree) const {
    const PiecewisePolynomial& curve = part_.curve;
    if (isAtRest(begin, end)) {
      const bool before = middle(begin, end) < onClock(part_, curve.begin());
      const Eigen::MatrixXd& piece = curve.coefficients(before ? 0 : curve.pieces() - 1);
      return piece.col(before ? 0 : piece.cols() - 1).replicate(1, degree + 1);
    }
    const std::size_t index = pieceOf(begin, end);
    const double from = onClock(part_, curve.knots()[index]);
    const double width = onClock(part_, curve.knots()[index + 1]) - from;
    const auto share = [&](double time) { return std::clamp((time - from) / width, 0.0, 1.0); };
    return restricted(curve.coefficients(index), share(begin), share(end), degree);
  }

 private:
  static double middle(double begin, double end) { return begin + 0.5 * (end - begin); }
  double ownMiddle(double begin, double end) const {
    return (middle(begin, end) - part_.start) / part_.slowdown;
  }
  bool isAtRest(double begin, double end) const {
    const double own = ownMiddle(begin, end);
    return own < part_.curve.begin() || own > part_.curve.end();
  }
  std::size_t pieceOf(double begin, double end) const {
    return part_.curve.pieceAt(ownMiddle(begin, end));
  }

  const ScheduledCurve& part_;
};

/// Whether two one-sided derivatives are one, but for rounding.
bool areOne(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  constexpr double kPlay = 1e-9;  // of 1 and of the larger one: as PiecewisePolynomial has for ends
  return ((a - b).array().abs() <= kPlay * a.array().abs().max(b.array().abs()).max(1.0)).all();
}

/// A derivative at all knots.
std::optional<std::vector<Eigen::VectorXd>> atKnots(const PiecewisePolynomial& curve, int order) {
  std::vector<Eigen::VectorXd> values;
  for (std::size_t i = 0; i < curve.pieces(); ++i) {
    const double duration = curve.knots()[i + 1] - curve.knots()[i];
    Eigen::MatrixXd piece = curve.coefficients(i);
    for (int k = 0; k < order; ++k) piece = detail::derivative(piece, duration);
    const Eigen::VectorXd begin = piece.leftCols<1>();
    if (values.empty()) values.push_back(begin);
    if (!areOne(values.back(), begin)) return std::nullopt;
    values.push_back(piece.rightCols<1>());
  }
  return values;
}

std::vector<double> list(const Eigen::VectorXd& values) {
  return {values.begin(), values.end()};
}

}  // namespace

CombinedCurve combinedCurve(const Robot& robot, const Group& group,
                            std::span<const ScheduledCurve> curves, ConfigurationView still) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, curves, still] { return combinedCurve(robot, group, curves, still); });
  }
  requireSchedule(!curves.empty(), "there is no curve");
  requireSchedule(still.empty() || still.size() == group.variables.size(),
                  "the configuration has " + std::to_string(still.size()) + " values, expected " +
                      std::to_string(group.variables.size()));
  std::vector<bool> open(group.variables.size(), true);
  std::vector<std::vector<Eigen::Index>> places;
  std::vector<PartOnClock> parts;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    requireAllowed(curves[i], i);
    places.push_back(placesOf(curves[i], robot, group, open));
    parts.emplace_back(curves[i]);
  }
  Eigen::VectorXd rest = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(open.size()));
  for (std::size_t v = 0; v < open.size(); ++v) {
    if (!open[v]) continue;
    requireSchedule(!still.empty(),
                    "no curve moves '" + robot.variables()[group.variables[v]].name + "'");
    requireSchedule(std::isfinite(still[v]), "the configuration has a value that is not finite");
    rest[static_cast<Eigen::Index>(v)] = still[v];
  }

  std::vector<double> knots = knotsOf(curves);
  requireSchedule(knots.size() > 1, "the curves take no time");
  std::vector<Eigen::MatrixXd> pieces;
  for (std::size_t k = 0; k + 1 < knots.size(); ++k) {
    int degree = 1;
    for (const PartOnClock& part : parts)
      degree = std::max(degree, part.degree(knots[k], knots[k + 1]));
    Eigen::MatrixXd piece = rest.replicate(1, degree + 1);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const Eigen::MatrixXd own = parts[i].piece(knots[k], knots[k + 1], degree);
      for (std::size_t v = 0; v < places[i].size(); ++v)
        piece.row(places[i][v]) = own.row(static_cast<Eigen::Index>(v));
    }
    pieces.push_back(std::move(piece));
  }

  std::vector<double> rounding(open.size(), 0.0);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::vector<double> rates = detail::largestRates(curves[i].curve);
    const std::vector<double> values = detail::largestValues(curves[i].curve);
    for (std::size_t v = 0; v < places[i].size(); ++v)
      rounding[static_cast<std::size_t>(places[i][v])] =
          detail::combinedRounding(values[v], rates[v] / curves[i].slowdown, knots.back());
  }
  return {PiecewisePolynomial(std::move(knots), std::move(pieces)), std::move(rounding)};
}

std::optional<JointTrajectory> controllerTrajectory(const PiecewisePolynomial& curve,
                                                    std::vector<std::string> variables) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return controllerTrajectory(curve, std::move(variables)); });
  }
  if (std::ssize(variables) != curve.dimension())
    throw std::invalid_argument("controllerTrajectory: the curve has " +
                                std::to_string(curve.dimension()) + " values and " +
                                std::to_string(variables.size()) + " names");
  int degree = 1;
  for (std::size_t i = 0; i < curve.pieces(); ++i) degree = std::max(degree, curve.degree(i));
  const auto positions = atKnots(curve, 0);
  const auto velocities = degree > 1 ? atKnots(curve, 1) : std::nullopt;
  const auto accelerations = degree > 3 ? atKnots(curve, 2) : std::nullopt;
  if (!positions || degree > 5 || (degree > 1 && !velocities) || (degree > 3 && !accelerations))
    return std::nullopt;
  JointTrajectory trajectory{.variables = std::move(variables), .points = {}};
  for (std::size_t k = 0; k < curve.knots().size(); ++k) {
    TrajectoryPoint point;
    point.time = curve.knots()[k];
    point.positions = list((*positions)[k]);
    if (velocities) point.velocities = list((*velocities)[k]);
    if (accelerations) point.accelerations = list((*accelerations)[k]);
    trajectory.points.push_back(std::move(point));
  }
  return trajectory;
}

}  // namespace swept
