// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace swept::test {

/// The same numbers on every platform, if no expression draws two (SplitMix64; Steele, Lea, Flood
/// 2014).
class SplitMix {
 public:
  explicit SplitMix(std::uint64_t seed) : state_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(next() >> 11), -53);
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }
  int below(std::size_t n) { return static_cast<int>(next() % n); }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  /// 10 to a uniform power.
  double decades(double low, double high) { return std::pow(10.0, uniform(low, high)); }

  Eigen::Vector3d inCube() {
    Eigen::Vector3d v;
    for (int i = 0; i < 3; ++i) v[i] = uniform(-1.0, 1.0);
    return v;
  }
  Eigen::Vector3d inBall() {
    Eigen::Vector3d v = inCube();
    while (v.squaredNorm() > 1.0 || v.squaredNorm() < 1e-4) v = inCube();
    return v;
  }
  Eigen::Vector3d direction() { return inBall().normalized(); }
  /// Axes onto axes.
  Eigen::Matrix3d permutation() {
    Eigen::Matrix3d r = Eigen::Matrix3d::Zero();
    const int first = below(3);
    const int step = below(2) + 1;
    for (int i = 0; i < 3; ++i) r((first + step * i) % 3, i) = sign();
    if (r.determinant() < 0.0) r.col(below(3)) *= -1.0;
    return r;
  }

 protected:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace swept::test
