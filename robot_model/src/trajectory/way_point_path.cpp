// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/way_point_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "robot/cyclic_values.hpp"

namespace swept::detail {

namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// How far a way point that is left out may be from the path, of the larger of 1 and the largest
/// value. Rounding puts points of a line that far off; the path is nearer than 1e-12 then.
constexpr double kOnPath = 0x1p-42;

/// A way point of the path.
struct KeptPoint {
  std::size_t index = 0;  ///< among all
  bool stops = false;
};

/// Chooses the way points to keep, from the first on.
class PointFilter {
 public:
  PointFilter(const Eigen::MatrixXd& points, const std::vector<char>& stops)
      : points_(points),
        stops_(stops),
        tolerance_(kOnPath * std::max(1.0, points.cwiseAbs().maxCoeff())) {}

  std::vector<KeptPoint> kept() {
    const auto count = static_cast<std::size_t>(points_.cols());
    kept_ = {{0, false}};
    for (std::size_t i = 1; i < count; ++i) take(i, i + 1 == count);
    return std::move(kept_);
  }

 private:
  auto point(std::size_t i) const { return points_.col(static_cast<Eigen::Index>(i)); }

  void take(std::size_t i, bool isLast) {
    KeptPoint& last = kept_.back();
    if ((point(i) - point(last.index)).norm() <= tolerance_) {
      last.stops = last.stops || stops_[i] != 0;
      if (!isLast) return;
      // The path ends exactly where it should.
      if (kept_.size() > 1)
        last.index = i;
      else if (point(i) != point(0))
        kept_.push_back({i, false});
      return;
    }
    if (kept_.size() > 1 && !last.stops) {
      const double off = offLine(kept_[kept_.size() - 2].index, last.index, i);
      if (leftOut_ + off <= tolerance_) {
        leftOut_ += off;
        last = {i, stops_[i] != 0};
        return;
      }
    }
    leftOut_ = 0.0;
    kept_.push_back({i, stops_[i] != 0});
  }

  /// The distance of a point from the straight part between two others.
  double offLine(std::size_t from, std::size_t middle, std::size_t to) const {
    const Eigen::VectorXd line = point(to) - point(from);
    const Eigen::VectorXd way = point(middle) - point(from);
    const double share = way.dot(line) / line.squaredNorm();
    if (!(share > 0.0 && share < 1.0)) return kNoLimit;
    return (way - share * line).norm();
  }

  const Eigen::MatrixXd& points_;
  const std::vector<char>& stops_;
  double tolerance_;
  std::vector<KeptPoint> kept_;
  /// Bounds how far the way points left out since the last but one are off: each line is turned
  /// against the one before by no more than the end of that one is off it.
  double leftOut_ = 0.0;
};

void requireLimit(double limit, const std::string& rate, const std::string& name,
                  const WayPointPath& path, std::size_t part) {
  if (std::isfinite(limit)) return;
  throw std::invalid_argument(
      "timeParameterize: " + name + " moves from way point " + std::to_string(path.indices[part]) +
      " to " + std::to_string(path.indices[part + 1]) + " and has no limit of " + rate);
}

}  // namespace

Eigen::MatrixXd continuousPoints(const ConfigurationList& wayPoints,
                                 const std::vector<char>& cyclic) {
  const auto size = static_cast<Eigen::Index>(cyclic.size());
  Eigen::MatrixXd points(size, static_cast<Eigen::Index>(wayPoints.size()));
  std::vector<double> turns(cyclic.size());
  for (std::size_t i = 0; i < wayPoints.size(); ++i) {
    for (std::size_t j = 0; j < cyclic.size(); ++j) {
      const double value = wayPoints[i][j];
      if (i > 0 && cyclic[j]) {
        const double before = wayPoints[i - 1][j];
        turns[j] += std::round((cyclicDifference(before, value) - (value - before)) /
                               (2.0 * std::numbers::pi));
      }
      points(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) =
          value + 2.0 * std::numbers::pi * turns[j];
    }
  }
  return points;
}

VariableLimits withSlack(const VariableLimits& limits) {
  const double factor = 1.0 - 4.0 * limits.slack;
  VariableLimits result = limits;
  result.speed *= factor;
  result.acceleration *= factor;
  result.jerk *= factor;
  return result;
}

WayPointPath straightParts(const Eigen::MatrixXd& points, const std::vector<char>& stops,
                           const VariableLimits& limits, const std::vector<std::string>& names) {
  WayPointPath path;
  path.variables = limits;
  for (const KeptPoint& kept : PointFilter(points, stops).kept()) {
    path.indices.push_back(kept.index);
    path.stops.push_back(kept.stops);
  }
  path.points.resize(points.rows(), static_cast<Eigen::Index>(path.indices.size()));
  for (std::size_t i = 0; i < path.indices.size(); ++i)
    path.points.col(static_cast<Eigen::Index>(i)) =
        points.col(static_cast<Eigen::Index>(path.indices[i]));
  const Eigen::Index parts = path.points.cols() - 1;
  path.directions = path.points.rightCols(parts) - path.points.leftCols(parts);
  for (Eigen::Index i = 0; i < parts; ++i) {
    const double length = path.directions.col(i).stableNorm();
    if (!std::isfinite(length))
      throw std::invalid_argument("timeParameterize: the distance to way point " +
                                  std::to_string(path.indices[static_cast<std::size_t>(i) + 1]) +
                                  " is not finite");
    StraightLimits straight{kNoLimit, kNoLimit, kNoLimit};
    for (Eigen::Index j = 0; j < points.rows(); ++j) {
      const double step = path.directions(j, i);
      if (step == 0.0) continue;
      const auto part = static_cast<std::size_t>(i);
      const std::string& name = names[static_cast<std::size_t>(j)];
      requireLimit(limits.speed[j], "velocity", name, path, part);
      requireLimit(limits.acceleration[j], "acceleration", name, path, part);
      if (limits.ramps) requireLimit(limits.jerk[j], "jerk", name, path, part);
      const double share = std::abs(step) / length;
      straight.speed = std::min(straight.speed, limits.speed[j] / share);
      straight.acceleration = std::min(straight.acceleration, limits.acceleration[j] / share);
      straight.jerk = std::min(straight.jerk, limits.jerk[j] / share);
    }
    path.directions.col(i) /= length;
    path.lengths.push_back(length);
    path.straight.push_back(straight);
  }
  return path;
}

}  // namespace swept::detail
