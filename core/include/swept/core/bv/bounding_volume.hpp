// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <concepts>
#include <span>

#include "swept/core/eigen_layout.hpp"

namespace swept {

/// What a hierarchy needs from a bounding volume (Pan, Chitta, Manocha 2012, section III). Any type
/// with these members works with `BvTree`, `BvhModel` and the traversals. Lengths are in metres.
///
/// * `fit(points)`: a volume that contains the convex hull of the points, rounding included. With
/// no points, or any non-finite one: a volume that contains everything.
/// * `merge(a, b)`: contains both. `inflated(by)`: contains all points within `by` (>= 0) of it.
/// * `overlaps(other)`, both in one frame, and `overlaps(other, a_from_b)`, `other` in its own
/// frame: false only if the two are proven to share no point. Volumes that contain everything
/// overlap, and so do volumes under a non-finite pose.
/// * `distanceBound(other, a_from_b)`: proven lower bound on the distance between the contents of
/// the two; 0 for non-finite input; never NaN or infinity.
/// * `contains(p)`: true for every point that was given to `fit`.
/// * `center()`; `size()`: a traversal descends the side of the larger size, for example the
/// squared diagonal (m^2).
///
/// The proofs allow poses whose rotation is orthonormal up to 1e-14 in each entry.
template <typename BV>
concept BoundingVolume = std::copyable<BV> &&
    requires(const BV& volume, std::span<const Eigen::Vector3d> points,
             const Eigen::Isometry3d& a_from_b, const Eigen::Vector3d& p) {
  { BV::fit(points) } -> std::same_as<BV>;
  { BV::merge(volume, volume) } -> std::same_as<BV>;
  { volume.inflated(1.0) } -> std::same_as<BV>;
  { volume.overlaps(volume) } -> std::same_as<bool>;
  { volume.overlaps(volume, a_from_b) } -> std::same_as<bool>;
  { volume.distanceBound(volume, a_from_b) } -> std::same_as<double>;
  { volume.contains(p) } -> std::same_as<bool>;
  { volume.center() } -> std::convertible_to<Eigen::Vector3d>;
  { volume.size() } -> std::convertible_to<double>;
};

/// True for volumes with a static member `kMergeIsTight`: their merge is as tight as a fit to all
/// points. A hierarchy of them is fitted in linear time.
template <typename BV>
constexpr bool mergeIsTight() {
  if constexpr (requires { BV::kMergeIsTight; }) {
    return BV::kMergeIsTight;
  } else {
    return false;
  }
}

}  // namespace swept
