// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace sweeps {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// The same numbers on every platform, if no expression draws two (SplitMix64; Steele, Lea, Flood
/// 2014). Each sweep has its own, so that any one can be made alone.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t index) : state_(seed * 0x2545f4914f6cdd1du) {
    state_ = next() ^ (index * 0x9e3779b97f4a7c15u);
    next();
  }

  double uniform(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(next() >> 11), -53);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  int below(int n) { return static_cast<int>(next() % static_cast<std::uint64_t>(n)); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// 10 to a uniform power.
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }

  Vector3d inCube() {
    Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = uniform(-1.0, 1.0);
    return v;
  }
  Vector3d direction() {
    Vector3d v = inCube();
    while (v.squaredNorm() > 1.0 || v.squaredNorm() < 1e-4) v = inCube();
    return v.normalized();
  }
  Vector3d across(const Vector3d& axis) {
    const Vector3d u = axis.unitOrthogonal();
    const double angle = uniform(0.0, 2.0 * std::numbers::pi);
    return (std::cos(angle) * u + std::sin(angle) * axis.cross(u)).normalized();
  }
  /// One in four turns axes onto axes.
  Matrix3d rotation() {
    const Vector3d axis = direction();
    const double angle = uniform(0.0, 2.0 * std::numbers::pi);
    if (!chance(0.25)) return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
    Matrix3d r = Matrix3d::Zero();
    const int first = below(3), step = below(2) + 1;
    for (int i = 0; i < 3; ++i) r((first + step * i) % 3, i) = sign();
    if (r.determinant() < 0.0) r.col(below(3)) *= -1.0;
    return r;
  }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace sweeps
