// SPDX-License-Identifier: BSD-3-Clause
#include "point_cloud/cloud_tree.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "bv/principal_axes.hpp"
#include "bvh/box_fit.hpp"
#include "threads/crew.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kLanes = WideNode::kLanes;

/// Levels up to this one have boxes along the surface that their points may lie on, which is nearly
/// flat. Larger patches are curved, and not worth another pass over all points.
constexpr std::size_t kLastOriented = 2;

/// Pieces for one thread at a time: some 50 us of work.
constexpr std::size_t kBucketsAtOnce = 1024, kPatchesAtOnce = 64;

Aabb joined(const Aabb& a, const Aabb& b) {
  return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
}

/// Largest d . p of a box.
double supportOf(const Aabb& box, const Vector3d& d) {
  return d.cwiseProduct(box.lower).cwiseMax(d.cwiseProduct(box.upper)).sum();
}

}  // namespace

/// Of each bucket, the box of its points, and the largest radius if radii differ.
void CloudTree::findBuckets(std::vector<Aabb>& boxes) {
  const std::size_t count = (buckets_.points.size() + kLanes - 1) / kLanes;
  boxes.resize(count);
  if (!buckets_.radii.empty()) radii_.resize(count);
  crew_.forPieces(count, kBucketsAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const std::size_t first = i * kLanes;
      const auto run =
          buckets_.points.subspan(first, std::min(kLanes, buckets_.points.size() - first));
      Aabb box{run.front(), run.front()};
      for (const Vector3d& p : run) box = {box.lower.cwiseMin(p), box.upper.cwiseMax(p)};
      boxes[i] = box;
      if (buckets_.radii.empty()) continue;
      radii_[i] = *std::ranges::max_element(buckets_.radii.subspan(first, run.size()));
    }
  });
}

CloudTree::CloudTree(const PointBuckets& buckets, Crew& crew) : buckets_(buckets), crew_(crew) {
  levels_.emplace_back();
  findBuckets(levels_.back());
  while (levels_.back().size() > 1) {
    const std::vector<Aabb>& below = levels_.back();
    std::vector<Aabb> above;
    above.reserve((below.size() + kLanes - 1) / kLanes);
    for (std::size_t i = 0; i < below.size(); ++i) {
      if (i % kLanes == 0) {
        above.push_back(below[i]);
      } else {
        above.back() = joined(above.back(), below[i]);
      }
    }
    levels_.push_back(std::move(above));
  }
  if (levels_.size() == 1) return;
  patches_.resize(levels_[1].size());
  crew_.forPieces(patches_.size(), kPatchesAtOnce, [this](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      patches_[i] = principalAxes(scatterOf(pointsOf(1, i)));
  });
}

std::size_t CloudTree::childrenOf(std::size_t level, std::size_t index) const {
  return std::min(kLanes, levels_[level - 1].size() - kLanes * index);
}

std::span<const Vector3d> CloudTree::pointsOf(std::size_t level, std::size_t index) const {
  const std::size_t size = std::size_t{1} << (3 * (level + 1));
  const std::size_t first = index * size;
  return buckets_.points.subspan(first, std::min(size, buckets_.points.size() - first));
}

double CloudTree::radiusOf(std::size_t level, std::size_t index) const {
  if (radii_.empty()) return buckets_.radius;
  const std::size_t size = std::size_t{1} << (3 * level);
  const auto all = std::span(radii_).subspan(index * size);
  return *std::ranges::max_element(all.first(std::min(size, all.size())));
}

OrientedBox CloudTree::boxFor(std::size_t level, std::size_t index, const Vector3d& origin) const {
  const double radius = radiusOf(level, index);
  const Aabb grown = withBalls(levels_[level][index], radius);
  if (level > kLastOriented) return alignedBox(grown, origin);
  const std::span<const Vector3d> points = pointsOf(level, index);
  if (level == kLastOriented) {
    return fitBoxAlong({points, radius, grown}, principalAxes(scatterOf(points)), origin);
  }
  // A bucket has too few points to show the orientation of the surface; its node has enough.
  return fitBoxAlong({points, radius, grown}, patches_[level == 0 ? index / kLanes : index],
                     origin);
}

/// Around the boxes of patches instead of points: there are fewer.
OrientedBox CloudTree::rootBox(const Aabb& grown) const {
  const std::size_t top = levels_.size() - 1;
  std::vector<Vector3d> corners;
  for (const Aabb& patch : levels_[std::min<std::size_t>(top, 1)]) {
    for (const Vector3d& corner : cornersOf(patch)) corners.push_back(corner);
  }
  return fitOrientedBox({corners, radiusOf(top, 0), grown}, scatterOf(corners), grown.center());
}

/// `start`: per level, the first of its nodes.
WideNode CloudTree::nodeOf(std::size_t level, std::size_t index,
                           const std::vector<std::size_t>& start) const {
  WideNode node{};
  node.count = static_cast<std::int32_t>(childrenOf(level, index));
  node.origin = levels_[level][index].center();
  for (int lane = 0; lane < node.count; ++lane) {
    const std::size_t child = kLanes * index + static_cast<std::size_t>(lane);
    node.child[lane] = static_cast<std::int32_t>(start[level - 1] + child);
    node.set(lane, boxFor(level - 1, child, node.origin));
  }
  return node;
}

WideBvh CloudTree::bvh() const {
  // Nodes of level k hold boxes of level k - 1. The root is the first; buckets follow the last.
  std::vector<std::size_t> start(levels_.size());
  std::size_t count = 0;
  for (std::size_t level = levels_.size(); level-- > 1;) {
    start[level] = count;
    count += levels_[level].size();
  }
  start[0] = count;
  std::vector<WideNode> nodes(count);
  for (std::size_t level = levels_.size(); level-- > 1;) {
    crew_.forPieces(levels_[level].size(), kPatchesAtOnce,
                    [&](std::size_t first, std::size_t last) {
                      for (std::size_t i = first; i < last; ++i)
                        nodes[start[level] + i] = nodeOf(level, i, start);
                    });
  }
  const std::size_t top = levels_.size() - 1;
  const Aabb grown = withBalls(bounds(), radiusOf(top, 0));
  return {std::move(nodes), buckets_, grown, rootBox(grown)};
}

double CloudTree::support(const Vector3d& d) const {
  return d.dot(buckets_.points[farthest(d)]);
}

std::size_t CloudTree::farthest(const Vector3d& d) const {
  Found best{-std::numeric_limits<double>::infinity(), 0};
  search(d, levels_.size() - 1, 0, best);
  return best.point;
}

/// The most promising box first.
void CloudTree::search(const Vector3d& d, std::size_t level, std::size_t index, Found& best) const {
  if (level == 0) {
    const std::size_t first = index * kLanes;
    for (std::size_t i = first; i < std::min(first + kLanes, buckets_.points.size()); ++i) {
      const double value = d.dot(buckets_.points[i]);
      if (value > best.value) best = {value, i};
    }
    return;
  }
  std::array<std::pair<double, std::size_t>, kLanes> open;
  const std::size_t count = childrenOf(level, index);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t child = kLanes * index + i;
    const std::pair box{supportOf(levels_[level - 1][child], d), child};
    std::size_t place = i;
    for (; place > 0 && open[place - 1] < box; --place) open[place] = open[place - 1];
    open[place] = box;
  }
  for (std::size_t i = 0; i < count && open[i].first > best.value; ++i) {
    search(d, level - 1, open[i].second, best);
  }
}

}  // namespace swept::detail
