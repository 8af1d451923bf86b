// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "bvh/box_frames.hpp"
#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// Lower bounds on the distance between each of the node's boxes (in the first frame) and `other`
/// (in the second). Each is the largest from the fifteen axes of the separating axis test
/// (Gottschalk, Lin, Manocha 1996), with the three face axes of a box combined. It is not positive
/// if no axis separates, and less the deeper the boxes overlap. The search may stop early with
/// smaller bounds that are larger than `enough`. Unused lanes are undefined.
void boxLowerBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& other,
                    float enough, std::array<float, WideNode::kLanes>& lower);

/// Directions of the positive bounds, per lane: of any length and either sign, in the first frame.
/// They are in single precision and only proposals; boxGap() proves them.
struct alignas(32) BoxDirections {
  std::array<WideNode::Row, 3> component;

  Eigen::Vector3d of(int lane) const {
    return {component[0][lane], component[1][lane], component[2][lane]};
  }
};
/// The same, with directions.
void boxLowerBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& other,
                    float enough, std::array<float, WideNode::kLanes>& lower,
                    BoxDirections& directions);

/// Bit i: the ray may hit box i of the node; clear only when it certainly misses. A NaN hits.
/// `origin`: m, in the frame of the boxes; `direction`: a unit vector.
std::uint32_t boxesHit(const WideNode& node, const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction);

}  // namespace swept::detail
