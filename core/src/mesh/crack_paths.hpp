// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "mesh/meeting_points.hpp"
#include "mesh/open_patches.hpp"

namespace swept::detail {

inline double distanceToSegment(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                                const Eigen::Vector3d& b) {
  const Eigen::Vector3d along = b - a;
  const double at = std::clamp((point - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
  // NaN if the square of the length underflows.
  if (!(at >= 0.0)) return (point - a).norm();
  return (point - a - at * along).norm();
}

/// Open edges over the points where their corners meet. Each edge is replaced by a path through all
/// such points near it, so that edges along each other become equal paths, however they are
/// divided.
class CrackPaths {
 public:
  CrackPaths(std::span<const Eigen::Vector3d> vertices, std::span<const OpenEdge> open,
             double width)
      : vertices_(vertices), reach_(kReach * width), tree_(vertices, {}) {
    std::vector<int> chosen = cornersOf(open);
    const std::vector<int> met = width > 0.0 ? meetingPoints(vertices, chosen, width) : chosen;
    meets_.resize(vertices.size());
    for (std::size_t i = 0; i < chosen.size(); ++i) meets_[chosen[i]] = met[i];
    if (!(width > 0.0)) return;
    std::erase_if(chosen, [&](int corner) { return meets_[corner] != corner; });
    tree_ = PointTree(vertices, std::move(chosen));
  }

  /// Path from the meeting point of `edge.from` to that of `edge.to`; one point if they are the
  /// same. No vertex comes twice. Valid up to the next call.
  const std::vector<int>& between(const OpenEdge& edge) {
    path_.clear();
    addBetween(edge);
    return path_;
  }
  /// The same with the edge's own ends at its ends. No vertex comes twice.
  const std::vector<int>& of(const OpenEdge& edge) {
    path_.assign(1, edge.from);
    addBetween(edge);
    add(edge.to);
    return path_;
  }

 private:
  /// In widths. Corners of a path may be one width from the original corners along each axis, and
  /// points near the edge one more.
  static constexpr double kReach = 3.0;

  static std::vector<int> cornersOf(std::span<const OpenEdge> edges) {
    std::vector<int> corners;
    for (const OpenEdge& edge : edges) corners.insert(corners.end(), {edge.from, edge.to});
    std::ranges::sort(corners);
    corners.erase(std::ranges::unique(corners).begin(), corners.end());
    return corners;
  }

  void add(int vertex) {
    if (path_.empty() || path_.back() != vertex) path_.push_back(vertex);
  }
  void addBetween(const OpenEdge& edge) {
    const int first = meets_[edge.from];
    const int last = meets_[edge.to];
    add(first);
    divide(first, last);
    add(last);
  }

  /// Adds the points between two meeting points. Depends only on these, up to its direction.
  void divide(int first, int last) {
    if (first == last) return;
    const Eigen::Vector3d& a = vertices_[std::min(first, last)];
    const Eigen::Vector3d& b = vertices_[std::max(first, last)];
    const Eigen::Vector3d along = b - a;
    found_.clear();
    tree_.near(a, b, reach_, found_);
    between_.clear();
    for (const int point : found_) {
      const double at = (vertices_[point] - a).dot(along) / along.squaredNorm();
      if (point == first || point == last || !(at > 0.0 && at < 1.0)) continue;
      if (distanceToSegment(vertices_[point], a, b) <= reach_) between_.emplace_back(at, point);
    }
    std::ranges::sort(between_);
    if (first > last) std::ranges::reverse(between_);
    for (const auto& [at, point] : between_) add(point);
  }

  std::span<const Eigen::Vector3d> vertices_;
  double reach_;
  std::vector<int> meets_;  ///< per corner of an open edge
  PointTree tree_;
  std::vector<int> path_;
  std::vector<int> found_;
  std::vector<std::pair<double, int>> between_;
};

}  // namespace swept::detail
