// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>

#include "swept/core/bv/bounding_volume.hpp"

namespace swept {

/// Input of a fit rule: what it may use to bound a node.
template <BoundingVolume BV>
struct FitInput {
  std::span<const Eigen::Vector3d> points;  ///< m, of all primitives below the node
  double radius = 0.0;                      ///< m, the largest of the points' radii
  const BV* left = nullptr;                 ///< volumes of the children; null at a leaf
  const BV* right = nullptr;                ///< likewise
};

/// Any callable that bounds a node. The result contains the hull of the points grown by the radius,
/// and may contain more.
template <BoundingVolume BV>
using FitFunction = std::function<BV(const FitInput<BV>&)>;

/// Fits the volume to all points below the node: tightest, n log n.
struct FitToPoints {
  /// The volume of a node.
  template <BoundingVolume BV>
  BV operator()(const FitInput<BV>& node) const {
    const BV volume = BV::fit(node.points);
    return node.radius > 0.0 ? volume.inflated(node.radius) : volume;
  }
};

/// Fits the volume to the children's volumes: linear time; oriented volumes are looser.
struct FitToChildren {
  /// The volume of a node.
  template <BoundingVolume BV>
  BV operator()(const FitInput<BV>& node) const {
    if (node.left == nullptr) return FitToPoints{}(node);
    return BV::merge(*node.left, *node.right);
  }
};

/// The default rule: FitToChildren if that is as tight, else FitToPoints.
template <BoundingVolume BV>
FitFunction<BV> defaultFit() {
  if constexpr (mergeIsTight<BV>()) {
    return FitToChildren{};
  } else {
    return FitToPoints{};
  }
}

/// The rule at refits. FitToPoints and FitToChildren both become the linear one. Your own rule
/// stays, since it may bound more than the points.
template <BoundingVolume BV>
FitFunction<BV> refitOf(const FitFunction<BV>& fit) {
  if (fit.template target<FitToPoints>() == nullptr) return fit;
  return FitToChildren{};
}

}  // namespace swept
