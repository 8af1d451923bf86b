// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// Squared distances (m^2) of a point from the boxes of a node, in single precision: fewer than
/// twelve roundings of coordinates relative to the node's origin. Bit i of the result: box i is in
/// use and its squared distance is not above `most`. Lanes not in use hold anything.
std::uint32_t pointBoxes(const WideNode& node, const Eigen::Vector3d& p, float most,
                         std::array<float, WideNode::kLanes>& squared);

}  // namespace swept::detail
