// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/wide_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bv/extents.hpp"
#include "bvh/box_fit.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Node = TreeTopology::Node;

/// A run of primitives.
struct Run {
  int first;
  int count;
};

Aabb boundsOf(const PrimitivePoints& primitives, const Run& run) {
  const std::size_t per = primitives.perPrimitive;
  const auto first = static_cast<std::size_t>(run.first);
  const auto count = static_cast<std::size_t>(run.count);
  Aabb box{primitives.points[first * per], primitives.points[first * per]};
  for (const Vector3d& p : primitives.points.subspan(first * per, count * per)) {
    box.lower = box.lower.cwiseMin(p);
    box.upper = box.upper.cwiseMax(p);
  }
  if (primitives.radii.empty()) return box;
  const auto radii = primitives.radii.subspan(first, count);
  return withBalls(box, *std::max_element(radii.begin(), radii.end()));
}

/// Bounds of every node of a tree.
std::vector<Aabb> boundsOf(const TreeTopology& tree, const PrimitivePoints& primitives) {
  std::vector<Aabb> bounds(tree.nodes.size());
  for (std::size_t i = bounds.size(); i-- > 0;) {  // children follow their parents
    const Node& node = tree.nodes[i];
    if (node.rightChild < 0) {
      bounds[i] = boundsOf(primitives, {node.first, node.count});
      continue;
    }
    const Aabb& left = bounds[i + 1];
    const Aabb& right = bounds[static_cast<std::size_t>(node.rightChild)];
    bounds[i] = {left.lower.cwiseMin(right.lower), left.upper.cwiseMax(right.upper)};
  }
  return bounds;
}

/// Fits boxes to runs of primitives.
class BoxFitter {
 public:
  BoxFitter(const PrimitivePoints& primitives, const Vector3d& middle)
      : primitives_(primitives), middle_(middle) {}

  Moments moments(int primitive) const {
    Moments moments;
    for (const Vector3d& p : pointsOf({primitive, 1})) {
      const Vector3d d = p - middle_;
      moments.count += 1.0;
      moments.sum += d;
      moments.outer += d * d.transpose();
    }
    return moments;
  }

  /// Bounds of one primitive.
  OrientedBox fit(int primitive, const Vector3d& origin) const {
    const Run run{primitive, 1};
    return fit(run, boundsOf(primitives_, run), moments(primitive), origin);
  }

  OrientedBox fit(const Run& run, const Aabb& bounds, const Moments& moments,
                  const Vector3d& origin) const {
    double radius = 0.0;
    if (!primitives_.radii.empty()) {
      for (int i = run.first; i < run.first + run.count; ++i)
        radius = std::max(radius, primitives_.radii[static_cast<std::size_t>(i)]);
    }
    return fitOrientedBox({pointsOf(run), radius, bounds}, moments.scatter(), origin);
  }

 private:
  std::span<const Vector3d> pointsOf(const Run& run) const {
    const std::size_t per = primitives_.perPrimitive;
    return primitives_.points.subspan(static_cast<std::size_t>(run.first) * per,
                                      static_cast<std::size_t>(run.count) * per);
  }

  const PrimitivePoints& primitives_;
  const Vector3d middle_;
};

class Collapse {
 public:
  Collapse(const TreeTopology& binary, const PrimitivePoints& primitives)
      : binary_(binary.nodes),
        bounds_(boundsOf(binary, primitives)),
        fitter_(primitives, bounds_.front().center()) {
    nodes_.reserve(binary.order.size() / 4 + 1);
    const Moments moments = addNode(0);
    const Node& root = binary_.front();
    rootBox_ = fitter_.fit({root.first, root.count}, bounds(), moments, bounds().center());
  }

  std::vector<WideNode> takeNodes() { return std::move(nodes_); }
  const Aabb& bounds() const { return bounds_.front(); }
  const OrientedBox& rootBox() const { return rootBox_; }

 private:
  /// A node of the binary tree, or a single primitive.
  struct Lane {
    std::size_t node;
    int primitive;  ///< -1: it is a node
  };
  struct Lanes {
    std::array<Lane, WideNode::kLanes> of;
    int count = 0;
    void add(std::size_t node, int primitive) { of[count++] = {node, primitive}; }
  };

  Moments addNode(std::size_t root) {
    Lanes lanes;
    lanes.add(root, -1);
    while (lanes.count < WideNode::kLanes && splitLargest(lanes)) {
    }
    while (unfoldSmallest(lanes)) {
    }
    const std::size_t index = nodes_.size();
    nodes_.emplace_back();
    WideNode node{};
    node.count = lanes.count;
    node.origin = bounds_[root].center();
    Moments all;
    for (int i = 0; i < lanes.count; ++i) {
      const auto [from, primitive] = lanes.of[i];
      if (primitive >= 0) {
        node.child[i] = ~primitive;
        node.set(i, fitter_.fit(primitive, node.origin));
        all.add(fitter_.moments(primitive));
        continue;
      }
      node.child[i] = static_cast<int>(nodes_.size());
      const Moments moments = addNode(from);
      const Run run{binary_[from].first, binary_[from].count};
      node.set(i, fitter_.fit(run, bounds_[from], moments, node.origin));
      all.add(moments);
    }
    nodes_[index] = node;
    return all;
  }

  /// Replaces the lane of the largest inner node by its two children.
  bool splitLargest(Lanes& lanes) const {
    const auto area = [&](int lane) {
      const Aabb& box = bounds_[lanes.of[lane].node];
      return halfSurface(box.upper - box.lower);
    };
    int largest = -1;
    for (int i = 0; i < lanes.count; ++i) {
      if (binary_[lanes.of[i].node].rightChild < 0) continue;
      if (largest < 0 || area(i) > area(largest)) largest = i;
    }
    if (largest < 0) return false;
    const std::size_t parent = lanes.of[largest].node;
    lanes.of[largest].node = parent + 1;
    lanes.add(static_cast<std::size_t>(binary_[parent].rightChild), -1);
    return true;
  }

  /// Replaces the leaf with the fewest primitives by these primitives, if there is room. Other
  /// leaves become nodes of their own.
  bool unfoldSmallest(Lanes& lanes) const {
    int smallest = -1;
    for (int i = 0; i < lanes.count; ++i) {
      const Lane& lane = lanes.of[i];
      const Node& node = binary_[lane.node];
      if (lane.primitive >= 0 || node.rightChild >= 0) continue;
      if (node.count + lanes.count - 1 > WideNode::kLanes) continue;
      if (smallest < 0 || node.count < binary_[lanes.of[smallest].node].count) smallest = i;
    }
    if (smallest < 0) return false;
    const std::size_t leaf = lanes.of[smallest].node;
    lanes.of[smallest].primitive = binary_[leaf].first;
    for (int i = 1; i < binary_[leaf].count; ++i) lanes.add(leaf, binary_[leaf].first + i);
    return true;
  }

  const std::vector<Node>& binary_;
  const std::vector<Aabb> bounds_;
  const BoxFitter fitter_;
  std::vector<WideNode> nodes_;
  OrientedBox rootBox_;
};

/// Refits the boxes of a tree, children before their parents.
class Refit {
 public:
  Refit(std::vector<WideNode>& nodes, const PrimitivePoints& primitives, const Vector3d& middle)
      : nodes_(nodes), primitives_(primitives), fitter_(primitives, middle) {}

  /// The range of primitives below a node or a lane.
  struct Below {
    Run run;
    Aabb bounds;
    Moments moments;
  };

  Below refit(std::int32_t index) {
    const int count = nodes_[static_cast<std::size_t>(index)].count;
    std::array<Below, WideNode::kLanes> lanes;
    Below all{};
    for (int i = 0; i < count; ++i) {
      const std::int32_t child = nodes_[static_cast<std::size_t>(index)].child[i];
      lanes[i] = child >= 0 ? refit(child) : single(~child);
      all = i == 0 ? lanes[i] : together(all, lanes[i]);
    }
    WideNode& node = nodes_[static_cast<std::size_t>(index)];
    node.origin = all.bounds.center();
    node.reach = 0.0F;
    for (int i = 0; i < count; ++i) node.set(i, fit(lanes[i], node.origin));
    return all;
  }

  OrientedBox fit(const Below& below, const Vector3d& origin) const {
    return fitter_.fit(below.run, below.bounds, below.moments, origin);
  }

 private:
  Below single(int primitive) const {
    const Run run{primitive, 1};
    return {run, boundsOf(primitives_, run), fitter_.moments(primitive)};
  }

  /// Primitives below a node are contiguous.
  static Below together(const Below& a, const Below& b) {
    Below both{{std::min(a.run.first, b.run.first), a.run.count + b.run.count},
               {a.bounds.lower.cwiseMin(b.bounds.lower), a.bounds.upper.cwiseMax(b.bounds.upper)},
               a.moments};
    both.moments.add(b.moments);
    return both;
  }

  std::vector<WideNode>& nodes_;
  const PrimitivePoints& primitives_;
  const BoxFitter fitter_;
};

}  // namespace

OrientedBox WideNode::box(int lane) const {
  OrientedBox box;
  for (int i = 0; i < 3; ++i) {
    box.center[i] = origin[i] + static_cast<double>(center[i][lane]);
    box.half[i] = half[i][lane];
    for (int j = 0; j < 3; ++j) box.axes[j][i] = axes[j][i][lane];
  }
  return box;
}

void WideNode::set(int lane, const OrientedBox& box) {
  double size = 0.0;
  for (int i = 0; i < 3; ++i) {
    center[i][lane] = static_cast<float>(box.center[i] - origin[i]);
    half[i][lane] = box.half[i];
    for (int j = 0; j < 3; ++j) axes[j][i][lane] = box.axes[j][i];
    size += std::abs(box.center[i] - origin[i]) + box.half[i];
  }
  reach = std::max(reach, aboveInSingle(size));
}

const WideNode& WideBvh::node(std::int32_t index, WideNode& room) const {
  if (!isBucket(index)) return nodes_[static_cast<std::size_t>(index)];
  makeNode(buckets_, index - static_cast<std::int32_t>(nodes_.size()), room);
  return room;
}

WideBvh::WideBvh(std::vector<WideNode> nodes, const PointBuckets& buckets, const Aabb& bounds,
                 const OrientedBox& rootBox)
    : nodes_(std::move(nodes)), buckets_(buckets), bounds_(bounds), rootBox_(rootBox) {
  findReach();
}

WideBvh::WideBvh(const TreeTopology& binary, const PrimitivePoints& primitives) {
  Collapse collapse(binary, primitives);
  nodes_ = collapse.takeNodes();
  bounds_ = collapse.bounds();
  rootBox_ = collapse.rootBox();
  findReach();
}

WideBvh WideBvh::refitted(const PrimitivePoints& primitives) const {
  WideBvh tree;
  tree.nodes_ = nodes_;
  tree.bounds_ = boundsOf(primitives, {0, static_cast<int>(primitives.count())});
  Refit refit(tree.nodes_, primitives, tree.bounds_.center());
  const Refit::Below root = refit.refit(0);
  tree.rootBox_ = refit.fit(root, tree.bounds_.center());
  tree.findReach();
  return tree;
}

double WideBvh::spread() const {
  double inner = 0.0, leaves = 0.0;
  for (const WideNode& node : nodes_) {
    for (int i = 0; i < node.count; ++i) {
      const Vector3d half(node.half[0][i], node.half[1][i], node.half[2][i]);
      (node.child[i] >= 0 ? inner : leaves) += halfSurface(half);
    }
  }
  const double ratio = inner / leaves;
  return std::isfinite(ratio) ? ratio : 0.0;
}

void WideBvh::findReach() {
  for (int i = 0; i < 3; ++i) {
    reach_ += std::max(std::abs(bounds_.lower[i]), std::abs(bounds_.upper[i]));
  }
}

}  // namespace swept::detail
