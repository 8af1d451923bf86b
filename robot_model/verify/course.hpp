// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace swept::verify {

/// A value or a place over a segment, t from 0 to 1: a polynomial by its first Bernstein
/// coefficient and the steps from each to the next. (G. Farin, Curves and Surfaces for CAGD,
/// chapter 5.)
template <typename Value>
struct Curve {
  std::size_t degree = 1;  ///< 1, 3 or 5
  Value start;
  std::array<Value, 5> steps;  ///< as many as the degree
};

/// What it does at all times within `half` of one.
template <typename Value>
struct Around {
  Value value, rate;          ///< at the time itself
  double range = 0.0;         ///< how far it gets from `value`
  double speed = 0.0;         ///< bound on its rate
  double acceleration = 0.0;  ///< bound on the rate of its rate
};

inline double sizeOf(double value) {
  return std::abs(value);
}
inline double sizeOf(const Eigen::Vector3d& value) {
  return value.norm();
}

/// The largest of `count` Bernstein coefficients over a part of their interval: none of the values
/// there is larger. Each is a blossom: of so many begins and so many ends.
template <typename Value>
double mostOf(const std::array<Value, 5>& coefficients, std::size_t count, double begin,
              double end) {
  double most = 0.0;
  for (std::size_t ends = 0; ends < count; ++ends) {
    std::array<Value, 5> own = coefficients;
    for (std::size_t step = 1; step < count; ++step)
      for (std::size_t k = 0; k + step < count; ++k)
        own[k] += (step <= ends ? end : begin) * (own[k + 1] - own[k]);
    most = std::max(most, sizeOf(own[0]));
  }
  return most;
}

template <typename Value>
Around<Value> around(const Curve<Value>& curve, double middle, double half) {
  const auto degree = static_cast<double>(curve.degree);
  const double begin = middle - half, end = middle + half;
  std::array<Value, 5> steps = curve.steps;
  Around<Value> result{.value = curve.start, .rate = curve.start};
  for (std::size_t left = curve.degree; left > 0; --left) {
    result.value += middle * steps[0];
    for (std::size_t k = 0; k + 1 < left; ++k) steps[k] += middle * (steps[k + 1] - steps[k]);
  }
  result.rate = degree * steps[0];
  result.speed = degree * mostOf(curve.steps, curve.degree, begin, end);
  steps = curve.steps;
  for (std::size_t k = 0; k + 1 < curve.degree; ++k) steps[k] = steps[k + 1] - steps[k];
  result.acceleration = degree * (degree - 1.0) * mostOf(steps, curve.degree - 1, begin, end);
  result.range = half * result.speed;
  return result;
}

/// A knot of a trajectory. Velocities and accelerations are empty where there are none.
struct Point {
  double time = 0.0;                  ///< s
  std::vector<double> positions;      ///< rad or m, per variable
  std::vector<double> velocities;     ///< rad/s or m/s
  std::vector<double> accelerations;  ///< rad/s^2 or m/s^2
};

/// One value over a segment.
struct Course {
  Curve<double> curve;
  ///@{
  /// rad or m: the sizes of what the value is made of, added up; of a straight course at its begin
  /// and end, of a curve at both ends what holds all over.
  double begin = 0.0, end = 0.0;
  ///@}
};

/// Straight, from one value on by a difference to another.
Course straightCourse(double from, double difference, double to);

/// Whether a trajectory is no straight line between two points: both have velocities.
bool isCurved(const Point& from, const Point& to);
/// The polynomial of a variable between two points, as ros2_control's joint_trajectory_controller
/// has it: linear, cubic or quintic, by what both of them have.
Course courseOf(const Point& from, const Point& to, std::size_t variable);

/// Whether a value is between two limits at all times of its course.
bool staysWithin(const Course& course, double lower, double upper);

}  // namespace swept::verify
