// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace swept::detail {

/// Of some points a few that all others are near to. Those few are more than `width` (m) apart
/// along an axis, and each other point is within `width` of one of them along each axis.
///
/// Per point of `among` (indices into `points`): the nearest of them that were chosen before it,
/// itself when it is chosen. Takes linear time where not many points are within a few widths.
std::vector<int> meetingPoints(std::span<const Eigen::Vector3d> points, std::span<const int> among,
                               double width);

/// Points in boxes within boxes, to find those near a line segment.
class PointTree {
 public:
  /// `points` (m) has to outlive the tree.
  PointTree(std::span<const Eigen::Vector3d> points, std::vector<int> among);

  /// A superset of those within `reach` (m) of the segment from `a` to `b`, indices into `points`.
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
