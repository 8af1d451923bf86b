// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "bvh/box_frames.hpp"
#include "bvh/wide_bvh.hpp"

namespace swept::detail {

/// Lower bounds on the distance between each of the node's boxes (in the first frame) and `other`
/// (in the second): the largest that the fifteen axes of the separating axis test give (Gottschalk,
/// Lin, Manocha 1996), the three face axes of a box taken together. Not positive where no axis
/// separates: the less, the deeper the boxes overlap. May stop early, with smaller bounds that are
/// larger than `enough`. Lanes not in use hold anything.
void boxLowerBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& other,
                    float enough, std::array<float, WideNode::kLanes>& lower);

/// Along which a positive bound of each lane was found: of any length and either sense, in the
/// first frame. In single precision: a proposal, which boxGap() makes a proof of.
struct alignas(32) BoxDirections {
  std::array<WideNode::Row, 3> component;

  Eigen::Vector3d of(int lane) const {
    return {component[0][lane], component[1][lane], component[2][lane]};
  }
};
/// The same, and where.
void boxLowerBounds(const WideNode& node, const BoxFrames& frames, const OrientedBox& other,
                    float enough, std::array<float, WideNode::kLanes>& lower,
                    BoxDirections& directions);

/// Bit i: the ray may hit box i of the node; clear only when it certainly misses. A NaN hits.
/// `origin`: m, in the frame of the boxes; `direction`: a unit vector.
std::uint32_t boxesHit(const WideNode& node, const Eigen::Vector3d& origin,
                       const Eigen::Vector3d& direction);

}  // namespace swept::detail
