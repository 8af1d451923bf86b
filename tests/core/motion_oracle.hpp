// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <vector>

#include "swept/core/continuous/motions.hpp"

/// Where rigid bodies are, in extended precision and by formulas of another kind than the
/// library's: quaternions, powers of a displacement, Bernstein polynomials, divided differences.
namespace motion_oracle {

using Real = long double;
using Vector = Eigen::Matrix<Real, 3, 1>;
using Rotation = Eigen::Matrix<Real, 3, 3>;
using Quaternion = Eigen::Quaternion<Real>;

struct Placement {
  Rotation rotation;
  Vector position;  ///< m, of the body's origin
};
using Curve = std::function<Placement(Real t)>;

/// Of a rotation but for rounding.
inline Quaternion quaternion(const Eigen::Matrix3d& rotation) {
  return Quaternion(Rotation(rotation.cast<Real>())).normalized();
}

inline Quaternion power(const Vector& turn) {
  const Real angle = turn.norm();
  if (!(angle > 0)) return Quaternion::Identity();
  const Vector v = std::sin(angle / 2) / angle * turn;
  return Quaternion(std::cos(angle / 2), v.x(), v.y(), v.z());
}

inline Placement about(const Quaternion& q, const Vector& point, const Vector& reference) {
  const Rotation r = q.toRotationMatrix();
  return {r, point - r * reference};
}

inline Curve turning(const Eigen::Isometry3d& start, const Eigen::Vector3d& turn,
                     const Eigen::Vector3d& move, const Eigen::Vector3d& reference) {
  const Quaternion q = quaternion(start.linear());
  const Vector local = reference.cast<Real>();
  const Vector point = q.toRotationMatrix() * local + start.translation().cast<Real>();
  return [=, w = Vector(turn.cast<Real>()), v = Vector(move.cast<Real>())](Real t) {
    return about(power(t * w) * q, point + t * v, local);
  };
}

/// Shoemake 1985.
inline Curve slerp(const Eigen::Isometry3d& start, const Eigen::Isometry3d& end,
                   const Eigen::Vector3d& reference) {
  const Quaternion from = quaternion(start.linear());
  Quaternion to = quaternion(end.linear());
  if (from.dot(to) < 0) to.coeffs() *= -1;
  const Real angle = 2 * std::asin(std::min<Real>(1, (from.coeffs() - to.coeffs()).norm() / 2));
  const Vector local = reference.cast<Real>();
  const Vector first = from.toRotationMatrix() * local + start.translation().cast<Real>();
  const Vector last = to.toRotationMatrix() * local + end.translation().cast<Real>();
  return [=](Real t) {
    Quaternion q = from;
    if (angle > 1e-9L) {
      q.coeffs() = (std::sin((1 - t) * angle) * from.coeffs() + std::sin(t * angle) * to.coeffs()) /
                   std::sin(angle);
    }
    q.normalize();
    return about(q, (1 - t) * first + t * last, local);
  };
}

/// The displacement to the power t, of rotations that are neither none nor a half turn: the point
/// of the axis next to the origin solves (1 - R) c = d across the axis.
inline Curve screw(const Eigen::Isometry3d& start, const Eigen::Isometry3d& end) {
  const Quaternion from = quaternion(start.linear());
  Quaternion by = quaternion(end.linear()) * from.conjugate();
  if (by.w() < 0) by.coeffs() *= -1;
  const Vector axis = by.vec().normalized();
  const Real angle = 2 * std::atan2(by.vec().norm(), by.w());
  const Vector p = start.translation().cast<Real>();
  const Vector d = end.translation().cast<Real>() - by.toRotationMatrix() * p;
  const Real slide = axis.dot(d);
  const Vector across = d - slide * axis;
  const Vector center = (across + axis.cross(across) / std::tan(angle / 2)) / 2;
  return [=](Real t) {
    const Quaternion q = power(t * angle * axis);
    const Vector moved = q.toRotationMatrix() * (p - center) + center + t * slide * axis;
    return Placement{(q * from).toRotationMatrix(), moved};
  };
}

struct Blend {
  Vector position = Vector::Zero();
  Vector rotation = Vector::Zero();
  void add(Real weight, const swept::ControlPose& pose) {
    position += weight * pose.position.cast<Real>();
    rotation += weight * pose.rotation.cast<Real>();
  }
  Placement placed(const Quaternion& orientation) const {
    return {(power(rotation) * orientation).toRotationMatrix(), position};
  }
};

inline Curve bezier(const Eigen::Matrix3d& orientation, std::vector<swept::ControlPose> control) {
  return [q = quaternion(orientation), control = std::move(control)](Real t) {
    const int degree = static_cast<int>(control.size()) - 1;
    Blend blend;
    Real choose = 1;
    for (int i = 0; i <= degree; ++i) {
      blend.add(choose * std::pow(t, Real(i)) * std::pow(1 - t, Real(degree - i)), control[i]);
      choose = choose * (degree - i) / (i + 1);
    }
    return blend.placed(q);
  };
}

/// The cubic B-spline of knots 0, 1, 2, 3, 4 as a divided difference of truncated powers (Curry and
/// Schoenberg 1966).
inline Real basis(Real x) {
  const Real signs[] = {1, -4, 6, -4, 1};
  Real sum = 0;
  for (int k = 0; k < 5; ++k) {
    const Real rest = std::max<Real>(0, x - k);
    sum += signs[k] * rest * rest * rest / 6;
  }
  return sum;
}

inline Curve uniformCubic(const Eigen::Matrix3d& orientation,
                          std::vector<swept::ControlPose> control) {
  return [q = quaternion(orientation), control = std::move(control)](Real t) {
    const Real x = 3 + t * static_cast<Real>(control.size() - 3);
    Blend blend;
    for (std::size_t i = 0; i < control.size(); ++i) {
      blend.add(basis(x - static_cast<Real>(i)), control[i]);
    }
    return blend.placed(q);
  };
}

struct Derivative {
  Vector velocity, acceleration;  ///< m, of a point
  Vector spin, spinChange;        ///< rad
};

/// Central differences of fourth order of a body's point and orientation. The spin's change is that
/// of spins half a step to either side.
inline Vector spinBy(const Curve& curve, Real t, Real h) {
  const auto half = [&](Real step) {
    const Quaternion q =
        Quaternion(curve(t + step).rotation) * Quaternion(curve(t - step).rotation).conjugate();
    const Vector v = q.w() < 0 ? Vector(-q.vec()) : Vector(q.vec());
    const Real sine = v.norm();
    const Real scale = sine > 0 ? 2 * std::asin(std::min<Real>(1, sine)) / sine : 2;
    return Vector(scale * v / (2 * step));
  };
  return (4 * half(h) - half(2 * h)) / 3;
}

inline Derivative differences(const Curve& curve, Real t, Real h, const Vector& local) {
  const auto point = [&](Real s) {
    const Placement placed = curve(s);
    return Vector(placed.rotation * local + placed.position);
  };
  const Vector before = point(t - h), after = point(t + h), middle = point(t);
  const Vector earlier = point(t - 2 * h), later = point(t + 2 * h);
  Derivative d;
  d.velocity = (8 * (after - before) - (later - earlier)) / (12 * h);
  d.acceleration = (16 * (after + before) - (later + earlier) - 30 * middle) / (12 * h * h);
  d.spin = spinBy(curve, t, h);
  d.spinChange = (spinBy(curve, t + h, h) - spinBy(curve, t - h, h)) / (2 * h);
  return d;
}

}  // namespace motion_oracle
