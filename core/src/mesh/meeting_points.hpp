// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace swept::detail {

/// Selects a few points such that all others are near to one of them. The selected ones are more
/// than `width` (m) apart along an axis, and each other point is within `width` of one of them
/// along each axis.
///
/// Per point of `among` (indices into `points`): the nearest point selected before it, or itself if
/// it is selected. Linear time if few points are within a few widths of each other.
std::vector<int> meetingPoints(std::span<const Eigen::Vector3d> points, std::span<const int> among,
                               double width);

/// Points in nested boxes, to find those near a line segment.
class PointTree {
 public:
  /// `points` (m) must outlive the tree.
  PointTree(std::span<const Eigen::Vector3d> points, std::vector<int> among);

  /// Indices into `points` of a superset of the points within `reach` (m) of the segment from `a`
  /// to `b`.
  void near(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double reach,
            std::vector<int>& found) const;

 private:
  static constexpr int kLeaf = 8;
  struct Node {
    Eigen::Vector3d lower;
    Eigen::Vector3d upper;
    int first;  ///< of its points in among_
    int count;
    int right;  ///< of its second half; the first half comes next; -1: a leaf
  };
  int build(int first, int last);

  std::span<const Eigen::Vector3d> points_;
  std::vector<int> among_;
  std::vector<Node> nodes_;
};

}  // namespace swept::detail
