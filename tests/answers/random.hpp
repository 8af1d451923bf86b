// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <string_view>

#include "answer.hpp"

namespace swept::answers {

/// Numbers that follow from the seed alone: no distribution of a standard library, and nothing of
/// the library that is asked.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  /// Of its own for each list of names and number.
  static Random of(std::uint64_t seed, std::initializer_list<std::string_view> names,
                   std::uint64_t index = 0) {
    Digest digest;
    digest.add(seed);
    for (const std::string_view name : names) digest.add(name);
    digest.add(index);
    return Random(digest.value());
  }
  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15;
    return mixed(state_);
  }
  /// From 0 to `count` - 1.
  std::size_t below(std::size_t count) { return (bits() >> 11) % count; }
  bool oneIn(std::size_t count) { return below(count) == 0; }
  double uniform(double lower, double upper) {
    return lower + (upper - lower) * static_cast<double>(bits() >> 11) * 0x1p-53;
  }
  Eigen::Vector3d inBox(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
    const double x = uniform(lower.x(), upper.x());
    const double y = uniform(lower.y(), upper.y());
    const double z = uniform(lower.z(), upper.z());
    return {x, y, z};
  }
  Eigen::Vector3d direction() {
    for (;;) {
      const Eigen::Vector3d v = inBox({-1, -1, -1}, {1, 1, 1});
      const double length = v.norm();
      if (length > 0.1 && length < 1) return v / length;
    }
  }
  Eigen::Matrix3d rotation() {
    const Eigen::Vector3d axis = direction();
    return Eigen::AngleAxisd(uniform(0, 3.1), axis).toRotationMatrix();
  }

 private:
  std::uint64_t state_;
};

}  // namespace swept::answers
