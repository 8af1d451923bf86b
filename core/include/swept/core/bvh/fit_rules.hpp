// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "swept/core/bv/bounding_volume.hpp"

namespace swept {

/// What a fit rule may use to bound a node.
template <BoundingVolume BV>
struct FitInput {
  std::span<const Eigen::Vector3d> points;  ///< m, of all primitives below the node
  double radius = 0.0;                      ///< m, the largest of the points' radii
  const BV* left = nullptr;                 ///< volumes of the children; null at a leaf
  const BV* right = nullptr;                ///< likewise
};

/// Any callable that bounds a node: the result contains the hull of the points grown by the radius,
/// and may contain more.
template <BoundingVolume BV>
using FitFunction = std::function<BV(const FitInput<BV>&)>;

/// Around all points below: tightest, n log n.
struct FitToPoints {
  /// The volume of a node.
  template <BoundingVolume BV>
  BV operator()(const FitInput<BV>& node) const {
    const BV volume = BV::fit(node.points);
    return node.radius > 0.0 ? volume.inflated(node.radius) : volume;
  }
};

/// Around the children's volumes: linear; oriented volumes come out looser.
struct FitToChildren {
  /// The volume of a node.
  template <BoundingVolume BV>
  BV operator()(const FitInput<BV>& node) const {
    if (node.left == nullptr) return FitToPoints{}(node);
    return BV::merge(*node.left, *node.right);
  }
};

/// To children where that is as tight, else to points.
template <BoundingVolume BV>
FitFunction<BV> defaultFit() {
  if constexpr (mergeIsTight<BV>()) {
    return FitToChildren{};
  } else {
    return FitToPoints{};
  }
}

/// At refits: one of the two above makes way for the linear one; a rule of one's own may bound more
/// than the points, and stays.
template <BoundingVolume BV>
FitFunction<BV> refitOf(const FitFunction<BV>& fit) {
  if (fit.template target<FitToPoints>() == nullptr) return fit;
  return FitToChildren{};
}

}  // namespace swept
