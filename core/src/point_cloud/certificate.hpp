// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>

namespace swept::detail {

/// An interval of a line, in parameters along it; empty if from > to.
struct Interval {
  double from = std::numeric_limits<double>::infinity();
  double to = -std::numeric_limits<double>::infinity();

  bool isEmpty() const { return !(from <= to); }
};

/// A convex set of positions for which an event is proven to occur, or proven not to.
struct Certificate {
  enum class Form : std::uint8_t {
    Ball,       ///< |p - vector| <= number
    HalfSpace,  ///< vector . p >= number
  };
  Form form = Form::Ball;
  bool occurs = false;
  Eigen::Vector3d vector = Eigen::Vector3d::Zero();  ///< m, center; or unit normal
  double number = 0.0;                               ///< m, radius; or offset

  /// The set shrunk all around by `by` (m), the rounding of positions.
  Certificate shrunk(double by) const {
    Certificate smaller = *this;
    smaller.number += form == Form::Ball ? -by : by;
    return smaller;
  }

  /// The interval of the line of points origin + w * way that is in the set.
  Interval along(const Eigen::Vector3d& origin, const Eigen::Vector3d& way) const {
    return form == Form::Ball ? alongBall(origin, way) : alongHalfSpace(origin, way);
  }

 private:
  // Uses the line's nearest point to the center: its rounding is that of positions, and no
  // difference of squares cancels.
  Interval alongBall(const Eigen::Vector3d& origin, const Eigen::Vector3d& way) const {
    const double length = way.norm();
    if (!(length > 0.0)) return {};
    const Eigen::Vector3d fromCenter = origin - vector;
    const double middle = -(way / length).dot(fromCenter) / length;
    const double apart = (fromCenter + middle * way).norm();
    if (!(apart <= number)) return {};
    const double half = std::sqrt((number - apart) * (number + apart)) / length;
    return {middle - half, middle + half};
  }

  Interval alongHalfSpace(const Eigen::Vector3d& origin, const Eigen::Vector3d& way) const {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const double beyond = vector.dot(origin) - number;
    const double slope = vector.dot(way);
    if (slope > 0.0) return {-beyond / slope, kInfinity};
    if (slope < 0.0) return {-kInfinity, -beyond / slope};
    if (beyond >= 0.0) return {-kInfinity, kInfinity};
    return {};
  }
};

/// What a query at one position proves about an event.
struct Finding {
  std::optional<Certificate> proof;  ///< a set around the position
  double clearance = 0.0;  ///< m, estimate: distance to where the event occurs, or minus that to
                           ///< where it does not
  Eigen::Vector3d outward = Eigen::Vector3d::Zero();  ///< unit, where it grows; zero if unknown
};

/// Queries a position (m).
using LookAt = std::function<Finding(const Eigen::Vector3d&)>;

}  // namespace swept::detail
