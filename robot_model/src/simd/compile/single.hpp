// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace swept::detail {

/// Single precision, at least `value`. Volatile, as GCC 12 takes a number that is rounded to single
/// precision and back for what it was, where it makes vectors of neighbouring statements.
inline float singleAbove(double value) {
  const volatile float rounded = static_cast<float>(value);
  const float single = rounded;
  if (static_cast<double>(single) >= value) return single;
  return std::nextafter(single, std::numeric_limits<float>::infinity());
}

/// Single precision, at most `value`.
inline float singleBelow(double value) {
  return -singleAbove(-value);
}

inline void assign(const Eigen::Vector3d& from, float (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

/// The axes and the offset of coordinates in a frame: axes[i] . x + offset[i].
template <typename Compiled>
void assignFrame(const Eigen::Isometry3d& frame_from_world, Compiled& to) {
  for (int i = 0; i < 3; ++i) {
    assign(frame_from_world.linear().row(i), to.axes[i]);
    to.offset[i] = static_cast<float>(frame_from_world.translation()[i]);
  }
}

}  // namespace swept::detail
