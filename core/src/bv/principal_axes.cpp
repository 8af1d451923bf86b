// SPDX-License-Identifier: BSD-3-Clause
#include "bv/principal_axes.hpp"

#include <cmath>

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// A vector whose square is a normal number, so that dividing by its length is safe.
bool isUsable(double squared) {
  return squared > 1e-280 && squared < 1e280;
}

Vector3d anyAcross(const Vector3d& unit) {
  Eigen::Index least = 0;
  unit.cwiseAbs().minCoeff(&least);
  return unit.cross(Vector3d::Unit(least)).normalized();
}

}  // namespace

Matrix3d scatterOf(std::span<const Vector3d> points) {
  // Coordinates are relative to a point of the set, so that distant sets keep their digits.
  const Vector3d origin = points.front();
  double x = 0.0, y = 0.0, z = 0.0;
  double xx = 0.0, xy = 0.0, xz = 0.0, yy = 0.0, yz = 0.0, zz = 0.0;
  for (const Vector3d& p : points) {
    const double dx = p[0] - origin[0];
    const double dy = p[1] - origin[1];
    const double dz = p[2] - origin[2];
    x += dx;
    y += dy;
    z += dz;
    xx += dx * dx;
    xy += dx * dy;
    xz += dx * dz;
    yy += dy * dy;
    yz += dy * dz;
    zz += dz * dz;
  }
  const double n = 1.0 / static_cast<double>(points.size());
  Matrix3d scatter;
  scatter << xx - n * x * x, xy - n * x * y, xz - n * x * z,  //
      xy - n * x * y, yy - n * y * y, yz - n * y * z,         //
      xz - n * x * z, yz - n * y * z, zz - n * z * z;
  return scatter;
}

Vector3d principalAxis(const Matrix3d& scatter) {
  // Squaring the matrix doubles the exponent of its eigenvalues' ratios: six times is the power 64.
  constexpr int kSquarings = 6;
  Matrix3d power = scatter;
  for (int i = 0; i < kSquarings; ++i) {
    const double trace = power(0, 0) + power(1, 1) + power(2, 2);
    if (!isUsable(trace * trace)) return Vector3d::UnitX();
    const double scale = 1.0 / trace;
    const double xx = power(0, 0) * scale, xy = power(0, 1) * scale, xz = power(0, 2) * scale;
    const double yy = power(1, 1) * scale, yz = power(1, 2) * scale, zz = power(2, 2) * scale;
    power(0, 0) = xx * xx + xy * xy + xz * xz;
    power(1, 1) = xy * xy + yy * yy + yz * yz;
    power(2, 2) = xz * xz + yz * yz + zz * zz;
    power(0, 1) = power(1, 0) = xx * xy + xy * yy + xz * yz;
    power(0, 2) = power(2, 0) = xx * xz + xy * yz + xz * zz;
    power(1, 2) = power(2, 1) = xy * xz + yy * yz + yz * zz;
  }
  // What is left is the projector on the axis: its largest column.
  Eigen::Index column = 0;
  power.diagonal().maxCoeff(&column);
  const double squared = power.col(column).squaredNorm();
  return isUsable(squared) ? Vector3d(power.col(column) / std::sqrt(squared)) : Vector3d::UnitX();
}

Matrix3d frameAlong(const Vector3d& first, const Vector3d& second) {
  Matrix3d axes;
  const double squaredFirst = first.squaredNorm();
  if (!isUsable(squaredFirst)) return Matrix3d::Identity();
  axes.col(0) = first / std::sqrt(squaredFirst);
  Vector3d across = second - axes.col(0).dot(second) * axes.col(0);
  double squared = across.squaredNorm();
  // The rest of a nearly parallel vector is mostly rounding and not orthogonal.
  if (!isUsable(squared) || !(squared > 1e-12 * second.squaredNorm())) {
    across = anyAcross(axes.col(0));
    squared = across.squaredNorm();
  }
  across /= std::sqrt(squared);
  // Once more: the first difference may have cancelled.
  across -= axes.col(0).dot(across) * axes.col(0);
  axes.col(1) = across.normalized();
  axes.col(2) = axes.col(0).cross(axes.col(1));
  return axes;
}

Matrix3d principalAxes(const Matrix3d& scatter) {
  const Vector3d first = principalAxis(scatter);
  const Vector3d u = anyAcross(first);
  const Vector3d v = first.cross(u);
  // Eigenvector of the 2 x 2 scatter across the first axis, by its half-angle formula.
  const double uu = u.dot(scatter * u);
  const double uv = u.dot(scatter * v);
  const double vv = v.dot(scatter * v);
  const double difference = 0.5 * (uu - vv);
  const double root = std::sqrt(difference * difference + uv * uv);
  const Vector3d second = difference > 0.0 ? Vector3d((root + difference) * u + uv * v)
                                           : Vector3d(uv * u + (root - difference) * v);
  const double squared = second.squaredNorm();
  return frameAlong(first, isUsable(squared) ? second : u);
}

Matrix3d triangleAxes(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const Vector3d ab = b - a, bc = c - b, ca = a - c;
  const double squaredAb = ab.squaredNorm();
  const double squaredBc = bc.squaredNorm();
  const double squaredCa = ca.squaredNorm();
  if (squaredAb >= squaredBc && squaredAb >= squaredCa) return frameAlong(ab, ca);
  if (squaredBc >= squaredCa) return frameAlong(bc, ab);
  return frameAlong(ca, bc);
}

}  // namespace swept::detail
