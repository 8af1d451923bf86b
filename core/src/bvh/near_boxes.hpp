// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// A segment in single precision, relative to a node's origin.
struct NearSegment {
  std::array<float, 3> center;  ///< m
  std::array<float, 3> half;    ///< m
};

/// m^2, the least normal number of single precision. If squares underflow, the sums below are off
/// by less than this.
inline constexpr double kNormalSquare = 0x1p-126;

// In each function, bit i of the result says that box i is in use and that its square is at most
// `most` (m^2), or NaN. Unused lanes are undefined.

/// Squared distances (m^2) of a point from the boxes of a node, in single precision: fewer than
/// twelve roundings of coordinates relative to the node's origin.
std::uint32_t pointBoxes(const WideNode& node, const Eigen::Vector3d& p, float most,
                         std::array<float, WideNode::kLanes>& squared);

/// Squares (m^2) of lower bounds on the distances of a segment from the boxes of a node.
///
/// Lemma (rounding): let u = 2^-24 and m = |center|_1 + |half|_1 + the node's reach. Along an axis
/// of a box, off by 3 u of a unit vector, the difference of centres is off by 8 u m (one rounding
/// of either, three in the sum of products), the half by 7 u m, and the gap by 17 u m with its own.
/// The norm of three gaps is off by 29 u m, by 2 u m for the squares, and by 3 u m for axes that
/// are not quite perpendicular. 48 u m covers it.
std::uint32_t segmentBoxes(const WideNode& node, const NearSegment& segment, float most,
                           std::array<float, WideNode::kLanes>& squared);

}  // namespace swept::detail
