// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/rss.hpp"

namespace swept {

/// An oriented box and a swept rectangle around the same points; a `BoundingVolume`. The box
/// answers overlap, the swept rectangle distance (Pan, Chitta, Manocha 2012, section III-B). Use it
/// for queries of both kinds on one hierarchy.
struct ObbRss {
  Obb obb;  ///< for overlap
  Rss rss;  ///< for distance

  ///@{
  /// See `BoundingVolume`.
  static ObbRss fit(std::span<const Eigen::Vector3d> points);
  static ObbRss merge(const ObbRss& a, const ObbRss& b);
  ///@}
  ObbRss inflated(double by) const { return {obb.inflated(by), rss.inflated(by)}; }  ///< by: m

  ///@{
  /// The box's answer.
  bool overlaps(const ObbRss& other) const { return obb.overlaps(other.obb); }
  bool overlaps(const ObbRss& other, const Eigen::Isometry3d& a_from_b) const {
    return obb.overlaps(other.obb, a_from_b);
  }
  ///@}
  double distanceBound(const ObbRss& other, const Eigen::Isometry3d& a_from_b) const {  ///< m
    return rss.distanceBound(other.rss, a_from_b);
  }
  /// Whether both volumes contain p.
  bool contains(const Eigen::Vector3d& p) const { return obb.contains(p) && rss.contains(p); }
  const Eigen::Vector3d& center() const { return obb.center(); }  ///< m
  double size() const { return obb.size(); }                      ///< m^2
};

}  // namespace swept
