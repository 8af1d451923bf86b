// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "bvh/wide_bvh.hpp"

namespace swept::detail {

class Crew;

inline std::array<Eigen::Vector3d, 8> cornersOf(const Aabb& box) {
  std::array<Eigen::Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i) {
    for (int k = 0; k < 3; ++k) corners[i][k] = (i >> k & 1) != 0 ? box.upper[k] : box.lower[k];
  }
  return corners;
}

/// The hierarchy over points in an order in which runs are compact: eight points per bucket, eight
/// buckets per node, eight nodes per node above. It consists of arrays only, so it is built level
/// by level.
///
/// The threads of the crew share the work; the hierarchy does not depend on them.
class CloudTree {
 public:
  /// Refers to the points and radii, and to the crew.
  CloudTree(const PointBuckets& buckets, Crew& crew);

  WideBvh bvh() const;

  /// m, of the points without their balls.
  const Aabb& bounds() const { return levels_.back().front(); }
  /// Largest d . p of all points.
  double support(const Eigen::Vector3d& d) const;
  /// Index of a point that attains it.
  std::size_t farthest(const Eigen::Vector3d& d) const;

 private:
  struct Found {
    double value;
    std::size_t point;
  };
  void search(const Eigen::Vector3d& d, std::size_t level, std::size_t index, Found& best) const;
  double radiusOf(std::size_t level, std::size_t index) const;
  std::span<const Eigen::Vector3d> pointsOf(std::size_t level, std::size_t index) const;
  OrientedBox boxFor(std::size_t level, std::size_t index, const Eigen::Vector3d& origin) const;
  OrientedBox rootBox(const Aabb& grown) const;
  std::size_t childrenOf(std::size_t level, std::size_t index) const;

  void findBuckets(std::vector<Aabb>& boxes);
  WideNode nodeOf(std::size_t level, std::size_t index,
                  const std::vector<std::size_t>& start) const;

  PointBuckets buckets_;
  Crew& crew_;
  /// m; boxes of the points: of buckets, of eight buckets, and so on. The last level has one box.
  std::vector<std::vector<Aabb>> levels_;
  std::vector<Eigen::Matrix3d> patches_;  ///< principal axes of runs of eight buckets
  std::vector<double> radii_;  ///< m, the largest of each bucket; empty: all have one radius
};

}  // namespace swept::detail
