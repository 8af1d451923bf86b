// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/triangle_bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "mesh_samples.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using test::Soup;

/// Checks a subtree from what it covers, and returns its depth and the index after its last node.
struct Checked {
  int depth = 0;
  int end = 0;
};

Checked checkSubtree(const TriangleBvh& bvh, const Soup& soup, int index, int first, int count) {
  const TriangleBvh::Node& node = bvh.nodes()[index];
  EXPECT_EQ(node.firstTriangle, first);
  EXPECT_EQ(node.triangleCount, count);
  for (int i = first; i < first + count; ++i) {
    for (int corner : soup.triangles[i]) {
      const Vector3d& p = soup.vertices[corner];
      EXPECT_TRUE(((p - node.center).cwiseAbs().array() <= node.halfExtents.array()).all());
    }
  }
  if (node.rightChild < 0) {
    EXPECT_GE(count, 1);
    EXPECT_LE(count, TriangleBvh::kMaxLeafTriangles);
    return {1, index + 1};
  }
  const int leftCount = bvh.nodes()[index + 1].triangleCount;
  const Checked left = checkSubtree(bvh, soup, index + 1, first, leftCount);
  EXPECT_EQ(node.rightChild, left.end);
  const Checked right =
      checkSubtree(bvh, soup, node.rightChild, first + leftCount, count - leftCount);
  return {1 + std::max(left.depth, right.depth), right.end};
}

/// Builds the tree over `soup` and checks every promise of the header.
TriangleBvh buildChecked(Soup soup) {
  using Key = std::tuple<int, int, int, int>;
  std::vector<int> labels(soup.triangles.size());
  std::map<Key, int> before;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    labels[i] = static_cast<int>(i);
    const Vector3i& t = soup.triangles[i];
    ++before[{t[0], t[1], t[2], labels[i]}];
  }
  TriangleBvh bvh = TriangleBvh::build(soup.vertices, soup.triangles, labels);
  std::map<Key, int> after;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    const Vector3i& t = soup.triangles[i];
    ++after[{t[0], t[1], t[2], labels[i]}];
  }
  EXPECT_EQ(before, after) << "triangles or their labels were lost or mixed up";

  const int count = static_cast<int>(soup.triangles.size());
  const Checked checked = checkSubtree(bvh, soup, 0, 0, count);
  EXPECT_EQ(checked.end, static_cast<int>(bvh.nodes().size()));
  EXPECT_EQ(checked.depth, bvh.depth());
  EXPECT_LE(bvh.depth(), TriangleBvh::kMaxDepth);
  return bvh;
}

TEST(TriangleBvh, HoldsEveryTriangleOfRandomSoups) {
  std::mt19937 random(21);
  for (int count : {1, 2, 3, 4, 5, 17, 1000}) {
    Soup soup;
    for (int i = 0; i < count; ++i) {
      const Vector3d center = test::uniformPoint(random, 10.0);
      for (int j = 0; j < 3; ++j) soup.vertices.push_back(center + test::uniformPoint(random, 1.0));
      soup.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    buildChecked(soup);
  }
}

TEST(TriangleBvh, IsShallowAndTightOnARegularMesh) {
  const TriangleBvh bvh = buildChecked(test::torusSoup(128, 64, 1.0, 0.3));
  EXPECT_LE(bvh.depth(), 20);  // 16,384 triangles: 13 levels of halving, and some
  // Of the area of all leaves little may be wasted: each is near its triangles' own size.
  double area = 0.0;
  for (const TriangleBvh::Node& node : bvh.nodes()) {
    if (node.rightChild >= 0) continue;
    const Vector3d& h = node.halfExtents;
    area += 8.0 * (h.x() * h.y() + h.y() * h.z() + h.z() * h.x());
  }
  const double torusArea = 4.0 * std::numbers::pi * std::numbers::pi * 0.3;
  EXPECT_LT(area, 8.0 * torusArea);
}

TEST(TriangleBvh, EndsOnEqualCenters) {
  std::mt19937 random(22);
  Soup soup;
  for (int i = 0; i < 3000; ++i) {
    // Right triangles over a diagonal through the origin: all boxes are centred there.
    const Vector3d p = test::uniformPoint(random, 1.0);
    soup.vertices.push_back(p);
    soup.vertices.push_back(-p);
    soup.vertices.emplace_back(p.x(), -p.y(), p.z());
    soup.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  EXPECT_LE(buildChecked(soup).depth(), 13);
}

TEST(TriangleBvh, BoundsTheDepthOfLopsidedInput) {
  // Sizes and distances halve from triangle to triangle, so an area-guided cut takes off few at a
  // time.
  Soup soup;
  for (int i = 0; i < 900; ++i) {
    const double size = std::ldexp(1.0, -i);
    soup.vertices.emplace_back(size, 0.0, 0.0);
    soup.vertices.emplace_back(0.9 * size, 0.1 * size, 0.0);
    soup.vertices.emplace_back(0.9 * size, 0.0, 0.1 * size);
    soup.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  EXPECT_GT(buildChecked(soup).depth(), 20);
}

TEST(TriangleBvh, CopesWithExtremeCoordinates) {
  for (double scale : {1e-308, 1e150, 1e307}) {
    Soup soup = test::torusSoup(16, 8, 1.0, 0.3);
    for (Vector3d& v : soup.vertices) v *= scale;
    buildChecked(soup);
  }
}

}  // namespace
}  // namespace swept::detail
