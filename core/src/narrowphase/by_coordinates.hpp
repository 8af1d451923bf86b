// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace swept::detail {

/// p + s d, coordinate by coordinate: loads of two coordinates at once would wait for what was just
/// stored one by one.
[[gnu::always_inline]] inline Eigen::Vector3d moved(const Eigen::Vector3d& p, double s,
                                                    const Eigen::Vector3d& d) {
  return {p.x() + s * d.x(), p.y() + s * d.y(), p.z() + s * d.z()};
}

/// r d, for a rotation matrix or a pose's block.
template <typename Rotation>
[[gnu::always_inline]] inline Eigen::Vector3d turned(const Rotation& r, const Eigen::Vector3d& d) {
  return {r(0, 0) * d.x() + r(0, 1) * d.y() + r(0, 2) * d.z(),
          r(1, 0) * d.x() + r(1, 1) * d.y() + r(1, 2) * d.z(),
          r(2, 0) * d.x() + r(2, 1) * d.y() + r(2, 2) * d.z()};
}
/// r^T d.
template <typename Rotation>
[[gnu::always_inline]] inline Eigen::Vector3d turnedBack(const Rotation& r,
                                                         const Eigen::Vector3d& d) {
  return {r(0, 0) * d.x() + r(1, 0) * d.y() + r(2, 0) * d.z(),
          r(0, 1) * d.x() + r(1, 1) * d.y() + r(2, 1) * d.z(),
          r(0, 2) * d.x() + r(1, 2) * d.y() + r(2, 2) * d.z()};
}

}  // namespace swept::detail
