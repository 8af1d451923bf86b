// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <utility>
#include <vector>

#include "point_cloud/gaussian.hpp"
#include "point_cloud/noisy_cloud_data.hpp"
#include "point_cloud/probability_goal.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

/// The pairs of points of two noisy clouds that may meet.
class NearPairs {
 public:
  NearPairs(const NoisyCloudData& a, const NoisyCloudData& b, const Eigen::Isometry3d& a_from_b)
      : a_(a), b_(b), a_from_b_(a_from_b) {
    const double pairs =
        static_cast<double>(a.points.size()) * static_cast<double>(b.points.size());
    while (tailBeyond(enough_) > kFarTail / pairs) enough_ += 0.125;
  }

  /// Calls onPair(point of a, point of b) for each pair, until that returns false. Returns whether
  /// all pairs were visited.
  template <typename OnPair>
  bool visit(const OnPair& onPair) {
    std::vector<std::pair<int, int>> waiting{{0, 0}};
    while (!waiting.empty()) {
      const auto [i, j] = waiting.back();
      waiting.pop_back();
      ++boxPairs_;
      if (areBoxesFar(i, j)) continue;
      const auto& nodeA = a_.tree.node(i);
      const auto& nodeB = b_.tree.node(j);
      if (nodeA.isLeaf() && nodeB.isLeaf()) {
        if (!visitLeaves(nodeA, nodeB, onPair)) return false;
      } else if (nodeB.isLeaf() ||
                 (!nodeA.isLeaf() && nodeA.volume.size() >= nodeB.volume.size())) {
        waiting.emplace_back(nodeA.rightChild, j);
        waiting.emplace_back(i + 1, j);
      } else {
        waiting.emplace_back(i, nodeB.rightChild);
        waiting.emplace_back(i, j + 1);
      }
    }
    return true;
  }

  double far() const { return far_; }  ///< upper bound on the probability that any other pair meets
  int boxPairs() const { return boxPairs_; }

 private:
  using Node = BvTree<Aabb>::Node;

  /// Whether `pairs` pairs that are this far apart (m) may be left out; they count in far().
  bool isFar(double apart, double radius, double spread, double pairs) {
    if (!(apart > radius + enough_ * spread)) return false;
    if (spread > 0.0) far_ += pairs * tailBeyond((apart - radius) / spread);
    return true;
  }

  bool areBoxesFar(int i, int j) {
    const auto m = static_cast<std::size_t>(i);
    const auto n = static_cast<std::size_t>(j);
    const Node& nodeA = a_.tree.node(i);
    const Node& nodeB = b_.tree.node(j);
    return isFar(nodeA.volume.distanceBound(nodeB.volume, a_from_b_),
                 a_.nodeRadius[m] + b_.nodeRadius[n],
                 std::hypot(a_.nodeSpread[m], b_.nodeSpread[n]),
                 static_cast<double>(nodeA.count) * nodeB.count);
  }

  template <typename OnPair>
  bool visitLeaves(const Node& nodeA, const Node& nodeB, const OnPair& onPair) {
    for (int m = nodeA.first; m < nodeA.first + nodeA.count; ++m) {
      const auto i = static_cast<std::size_t>(a_.tree.order()[static_cast<std::size_t>(m)]);
      for (int n = nodeB.first; n < nodeB.first + nodeB.count; ++n) {
        const auto j = static_cast<std::size_t>(b_.tree.order()[static_cast<std::size_t>(n)]);
        const Eigen::Vector3d other = a_from_b_ * b_.points[j];
        const double rounding = 4.0 * tolerance::kSupportRounding *
                                    (a_.points[i].norm() + b_.points[j].norm() + other.norm()) +
                                kPositionUnderflow;
        const double apart = (a_.points[i] - other).norm() - rounding;
        if (isFar(apart, a_.radii[i] + b_.radii[j], std::hypot(a_.spreads[i], b_.spreads[j]), 1.0))
          continue;
        if (!onPair(i, j)) return false;
      }
    }
    return true;
  }

  const NoisyCloudData& a_;
  const NoisyCloudData& b_;
  const Eigen::Isometry3d& a_from_b_;
  double enough_ = 0.0;  ///< standard deviations
  double far_ = 0.0;
  int boxPairs_ = 0;
};

}  // namespace swept::detail
