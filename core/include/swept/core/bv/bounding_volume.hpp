// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <concepts>
#include <span>

#include "swept/core/eigen_layout.hpp"

namespace swept {

/// What a hierarchy asks of a bounding volume (Pan, Chitta, Manocha 2012, section III): any type
/// with these members works with `BvTree`, `BvhModel` and the traversals. Lengths in metres.
///
/// * `fit(points)`: a volume that contains the convex hull of the points, rounding included. Of no
///   points, or of any that is not finite: a volume that contains everything.
/// * `merge(a, b)`: contains both. `inflated(by)`: contains all points within `by` (>= 0) of it.
/// * `overlaps(other)`, both in one frame, and `overlaps(other, a_from_b)`, `other` in a frame of
///   its own: false only if the two are proven to share no point. Volumes that contain everything
///   and poses that are not finite overlap.
/// * `distanceBound(other, a_from_b)`: proven lower bound on the distance of what the two
///   contain; 0 for what is not finite; never NaN or infinity.
/// * `contains(p)`: true for every point that was given to `fit`.
/// * `center()`; `size()`: what a traversal compares to choose the side to descend, such as the
///   squared diagonal (m^2).
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

/// Volumes whose merge is as tight as a fit to all points say so with a static member
/// `kMergeIsTight`; a hierarchy of them is fitted in linear time.
template <typename BV>
constexpr bool mergeIsTight() {
  if constexpr (requires { BV::kMergeIsTight; }) {
    return BV::kMergeIsTight;
  } else {
    return false;
  }
}

}  // namespace swept
