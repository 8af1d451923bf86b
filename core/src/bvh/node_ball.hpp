// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cmath>

#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// A ball around a box of a node.
struct NodeBall {
  /// Relative: more than the skew of a box's axes and the rounding of its half diagonal.
  static constexpr double kOutward = 1.0 + 32.0 * 0x1p-24;

  NodeBall(const WideNode& node, int lane) {
    const OrientedBox box = node.box(lane);
    center = box.center;
    const double squared = static_cast<double>(box.half[0]) * box.half[0] +
                           static_cast<double>(box.half[1]) * box.half[1] +
                           static_cast<double>(box.half[2]) * box.half[2];
    radius = std::sqrt(squared) * kOutward;
  }

  Eigen::Vector3d center;  ///< m, the frame of the tree
  double radius;           ///< m
};

}  // namespace swept::detail
