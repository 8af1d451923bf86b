// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/obstacle_tree.hpp"

#include <algorithm>
#include <limits>
#include <span>

#include "model/pair_model.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/single.hpp"
#include "threads/for_each_index.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Enough to be worth several threads.
constexpr std::size_t kManyEntries = 8192;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Eight-wide tree of boxes along the model frame's axes.
class BoxTree {
 public:
  BoxTree() = default;
  BoxTree(const std::vector<WorldGeometry>& world, double reach, std::span<const float> extras) {
    std::vector<Entry> bounded;
    std::vector<Entry> unbounded;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const double extra = extras.empty() ? 0.0 : static_cast<double>(extras[i]);
      const Entry entry = entryOf(world[i], reach, extra, ~static_cast<std::int32_t>(i));
      (entry.half.allFinite() ? bounded : unbounded).push_back(entry);
    }
    if (world.empty()) return;
    nodes_.emplace_back();
    // Unbounded boxes would spoil the boxes around them.
    std::vector<Entry> root;
    while (unbounded.size() >= kLanes) {
      const Entry packed = pack(std::span(unbounded).last(kLanes - 1));
      unbounded.resize(unbounded.size() - (kLanes - 1));
      unbounded.push_back(packed);
    }
    root = unbounded;
    if (bounded.size() + root.size() <= kLanes) {
      root.insert(root.end(), bounded.begin(), bounded.end());
    } else {
      root.push_back(pack(bounded));
    }
    fill(0, root);
  }

  std::vector<SimdWorldNode> take() { return std::move(nodes_); }

 private:
  struct Entry {
    Vector3d center;  ///< m
    Vector3d half;    ///< m
    std::int32_t child;
  };

  static Entry entryOf(const WorldGeometry& geometry, double reach, double extra,
                       std::int32_t child) {
    const Eigen::Isometry3d world_from_box = geometry.box_from_world.inverse();
    const double slack = obstacleRounding(reach + geometry.magnitude, extra) + extra;
    Entry entry;
    entry.child = child;
    entry.center = world_from_box.translation();
    entry.half = Vector3d::Constant(std::numeric_limits<double>::infinity());
    if (geometry.halfExtents.allFinite())
      entry.half = (world_from_box.linear().cwiseAbs() * geometry.halfExtents).array() + slack;
    return entry;
  }

  static Entry bound(std::span<const Entry> entries) {
    Vector3d lower = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d upper = -lower;
    for (const Entry& entry : entries) {
      lower = lower.cwiseMin(entry.center - entry.half);
      upper = upper.cwiseMax(entry.center + entry.half);
    }
    return {0.5 * (lower + upper), 0.5 * (upper - lower), 0};
  }

  void fill(std::size_t node, std::span<const Entry> entries) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const bool used = lane < static_cast<int>(entries.size());
      for (int i = 0; i < 3; ++i) {
        // Nothing but an infinite box overlaps an empty one; the walk skips its child.
        nodes_[node].lower[i].lane[lane] =
            used ? singleBelow(entries[lane].center[i] - entries[lane].half[i]) : kInfinity;
        nodes_[node].upper[i].lane[lane] =
            used ? singleAbove(entries[lane].center[i] + entries[lane].half[i]) : -kInfinity;
      }
      nodes_[node].child[lane] = used ? entries[lane].child : 0;
    }
  }

  /// Halves along the longest side until there are eight groups.
  static void split(std::span<Entry> entries, int halvings, std::vector<std::span<Entry>>& groups) {
    if (halvings == 0 || entries.size() <= 1) {
      if (!entries.empty()) groups.push_back(entries);
      return;
    }
    Eigen::Index axis = 0;
    bound(entries).half.maxCoeff(&axis);
    const auto middle = entries.begin() + static_cast<std::ptrdiff_t>(entries.size() / 2);
    std::nth_element(entries.begin(), middle, entries.end(), [&](const Entry& a, const Entry& b) {
      return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis] : a.child < b.child;
    });
    split({entries.begin(), middle}, halvings - 1, groups);
    split({middle, entries.end()}, halvings - 1, groups);
  }

  Entry pack(std::span<Entry> entries) {
    Entry result = bound(entries);
    const std::size_t node = nodes_.size();
    result.child = static_cast<std::int32_t>(node);
    nodes_.emplace_back();
    if (entries.size() <= kLanes) {
      fill(node, entries);
      return result;
    }
    std::vector<std::span<Entry>> groups;
    split(entries, 3, groups);
    fill(node, isPart_ || entries.size() < kManyEntries ? packed(groups) : packedAtOnce(groups));
    return result;
  }

  std::vector<Entry> packed(const std::vector<std::span<Entry>>& groups) {
    std::vector<Entry> children;
    for (const std::span<Entry> group : groups)
      children.push_back(group.size() == 1 ? group.front() : pack(group));
    return children;
  }

  /// The same, on several threads, with the nodes in the same order.
  std::vector<Entry> packedAtOnce(const std::vector<std::span<Entry>>& groups) {
    std::vector<BoxTree> trees(groups.size());
    std::vector<Entry> children(groups.size());
    forEachIndex(groups.size(), 0, [&](std::size_t i) {
      trees[i].isPart_ = true;
      children[i] = trees[i].pack(groups[i]);
    });
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const auto first = static_cast<std::int32_t>(nodes_.size());
      children[i].child += first;
      for (SimdWorldNode& node : trees[i].nodes_) {
        for (std::int32_t& child : node.child)
          if (child > 0) child += first;  // 0: the lane is empty
        nodes_.push_back(node);
      }
    }
    return children;
  }

  std::vector<SimdWorldNode> nodes_;
  bool isPart_ = false;  ///< of a tree that several threads build
};

}  // namespace

std::vector<SimdWorldNode> buildObstacleTree(const std::vector<WorldGeometry>& world, double reach,
                                             std::span<const float> extras) {
  return BoxTree(world, reach, extras).take();
}

}  // namespace swept::detail
