// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/triangle_bvh.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace swept::detail {
namespace {

struct Bounds {
  Eigen::Vector3d lower = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d upper = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void include(const Bounds& other) {
    lower = lower.cwiseMin(other.lower);
    upper = upper.cwiseMax(other.upper);
  }
  void include(const Eigen::Vector3d& point) {
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  double halfArea() const {
    const Eigen::Vector3d size = upper - lower;
    return size.x() * size.y() + size.y() * size.z() + size.z() * size.x();
  }
};

/// A triangle while the tree is built.
struct Item {
  Bounds box;
  int triangle;
  Eigen::Vector3d center() const { return 0.5 * box.lower + 0.5 * box.upper; }
};

constexpr int kBins = 16;

/// Where to cut, by the surface area heuristic over equal bins.
struct Cut {
  int axis = 0;
  double lower = 0.0;      ///< of the first bin
  double perLength = 0.0;  ///< bins per metre
  int firstRightBin = 0;   ///< 0: no cut separates anything

  int bin(const Item& item) const {
    const double position = (item.center()[axis] - lower) * perLength;
    return std::clamp(static_cast<int>(position), 0, kBins - 1);
  }
};

Cut chooseCut(std::span<const Item> items) {
  Bounds centers;
  for (const Item& item : items) centers.include(item.center());
  Cut cut;
  const double length = (centers.upper - centers.lower).maxCoeff(&cut.axis);
  cut.lower = centers.lower[cut.axis];
  cut.perLength = kBins / length;
  // Equal centres, and extents so small or large that the scale is not a number.
  if (!(length > 0.0) || !(cut.perLength < std::numeric_limits<double>::infinity()) ||
      !(cut.perLength > 0.0)) {
    return cut;
  }

  std::array<Bounds, kBins> boxes;
  std::array<int, kBins> counts{};
  for (const Item& item : items) {
    const int bin = cut.bin(item);
    boxes[bin].include(item.box);
    ++counts[bin];
  }
  std::array<double, kBins> rightCosts{};
  Bounds right;
  for (int i = kBins - 1, count = 0; i > 0; --i) {
    right.include(boxes[i]);
    count += counts[i];
    rightCosts[i] = count == 0 ? 0.0 : count * right.halfArea();
  }
  double best = std::numeric_limits<double>::infinity();
  Bounds left;
  for (int i = 1, count = 0; i < kBins; ++i) {
    left.include(boxes[i - 1]);
    count += counts[i - 1];
    if (count == 0 || count == static_cast<int>(items.size())) continue;
    const double cost = count * left.halfArea() + rightCosts[i];
    if (cost < best) {
      best = cost;
      cut.firstRightBin = i;
    }
  }
  return cut;
}

/// Splits `items` in two non-empty parts and returns the size of the first. Area-guided cuts may be
/// lopsided at every level; below this depth halving bounds the depth by kMaxDepth for 2^30 items.
std::size_t partition(std::span<Item> items, int depth) {
  constexpr int kDepthOfHalving = 32;
  if (depth < kDepthOfHalving) {
    const Cut cut = chooseCut(items);
    if (cut.firstRightBin > 0) {
      const auto middle = std::partition(items.begin(), items.end(), [&](const Item& item) {
        return cut.bin(item) < cut.firstRightBin;
      });
      return static_cast<std::size_t>(middle - items.begin());
    }
  }
  Bounds centers;
  for (const Item& item : items) centers.include(item.center());
  int axis = 0;
  (centers.upper - centers.lower).maxCoeff(&axis);
  const std::size_t half = items.size() / 2;
  std::nth_element(
      items.begin(), items.begin() + static_cast<std::ptrdiff_t>(half), items.end(),
      [axis](const Item& a, const Item& b) { return a.center()[axis] < b.center()[axis]; });
  return half;
}

TriangleBvh::Node nodeOver(std::span<const Item> items, int first) {
  Bounds box;
  for (const Item& item : items) box.include(item.box);
  const Eigen::Vector3d center = 0.5 * box.lower + 0.5 * box.upper;
  // The subtraction rounds once, by half an epsilon of its result.
  const Eigen::Vector3d half = (box.upper - center).cwiseMax(center - box.lower);
  const Eigen::Vector3d rounded =
      (half * (1.0 + 2.0 * std::numeric_limits<double>::epsilon())).array() +
      std::numeric_limits<double>::min();
  return {center, rounded, -1, first, static_cast<int>(items.size())};
}

class Builder {
 public:
  explicit Builder(std::vector<Item>& items) : items_(items) {
    nodes_.reserve(items.size() * 2);
    build(0, items.size(), 1);
  }

  std::vector<TriangleBvh::Node> takeNodes() { return std::move(nodes_); }
  int depth() const { return depth_; }

 private:
  void build(std::size_t first, std::size_t count, int depth) {
    depth_ = std::max(depth_, depth);
    const std::span<Item> items = std::span(items_).subspan(first, count);
    const std::size_t self = nodes_.size();
    nodes_.push_back(nodeOver(items, static_cast<int>(first)));
    if (count <= TriangleBvh::kMaxLeafTriangles) return;
    const std::size_t left = partition(items, depth);
    build(first, left, depth + 1);
    nodes_[self].rightChild = static_cast<int>(nodes_.size());
    build(first + left, count - left, depth + 1);
  }

  std::vector<Item>& items_;
  std::vector<TriangleBvh::Node> nodes_;
  int depth_ = 0;
};

}  // namespace

TriangleBvh TriangleBvh::build(std::span<const Eigen::Vector3d> vertices,
                               std::vector<Eigen::Vector3i>& triangles,
                               std::vector<int>& componentOf) {
  std::vector<Item> items(triangles.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    items[i].triangle = static_cast<int>(i);
    for (int corner : triangles[i]) items[i].box.include(vertices[corner]);
  }
  Builder builder(items);
  std::vector<Eigen::Vector3i> orderedTriangles(triangles.size());
  std::vector<int> orderedComponents(triangles.size());
  for (std::size_t i = 0; i < items.size(); ++i) {
    orderedTriangles[i] = triangles[items[i].triangle];
    orderedComponents[i] = componentOf[items[i].triangle];
  }
  triangles = std::move(orderedTriangles);
  componentOf = std::move(orderedComponents);
  TriangleBvh bvh;
  bvh.nodes_ = builder.takeNodes();
  bvh.depth_ = builder.depth();
  return bvh;
}

}  // namespace swept::detail
