// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/wide_bvh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh_samples.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

/// Checks that every box contains the primitives below it; returns the number of nodes on the
/// longest path.
class Check {
 public:
  Check(const WideBvh& bvh, const std::vector<Vector3d>& corners, const std::vector<int>& order)
      : bvh_(bvh), corners_(corners), order_(order), seen_(order.size(), 0) {}

  int run() {
    std::vector<int> below;
    const int depth = visit(0, below);
    EXPECT_TRUE(std::all_of(seen_.begin(), seen_.end(), [](int n) { return n == 1; }));
    expectInside(bvh_.rootBox(), below);
    return depth;
  }

 private:
  int visit(int index, std::vector<int>& below) {
    const WideNode& node = bvh_.nodes()[index];
    EXPECT_GE(node.count, 1);
    EXPECT_LE(node.count, WideNode::kLanes);
    int depth = 0;
    for (int lane = 0; lane < node.count; ++lane) {
      std::vector<int> inside;
      if (node.child[lane] < 0) {
        inside.push_back(~node.child[lane]);
        ++seen_[inside.front()];
      } else {
        depth = std::max(depth, visit(node.child[lane], inside));
      }
      expectInside(node.box(lane), inside);
      below.insert(below.end(), inside.begin(), inside.end());
    }
    return depth + 1;
  }

  void expectInside(const BoxF& box, const std::vector<int>& primitives) {
    for (const int primitive : primitives) {
      for (int k = 0; k < 3; ++k) {
        const Vector3d p = corners_[3 * order_[primitive] + k];
        double one = 0.0;
        for (int i = 0; i < 3; ++i) {
          const double away = std::abs((p[i] - bvh_.origin()[i]) - double{box.center[i]});
          EXPECT_LE(away, double{box.half[i]});
          one += std::abs(p[i] - bvh_.origin()[i]);
        }
        EXPECT_LE(one, bvh_.reach() * (1.0 + 1e-6));
      }
    }
  }

  const WideBvh& bvh_;
  const std::vector<Vector3d>& corners_;
  const std::vector<int>& order_;
  std::vector<int> seen_;
};

int checkedDepth(const std::vector<Vector3d>& corners) {
  const auto tree = BvTree<Aabb>::build({corners, 3}, SurfaceAreaSplit{});
  const WideBvh bvh(tree);
  const int depth = Check(bvh, corners, tree.order()).run();
  EXPECT_LE(depth, WideBvh::kMaxDepth);
  EXPECT_GE(bvh.bytes(), bvh.nodes().size() * sizeof(WideNode));
  return depth;
}

std::vector<Vector3d> cornersOf(const test::Soup& soup) {
  std::vector<Vector3d> corners;
  for (const Eigen::Vector3i& t : soup.triangles) {
    for (const int corner : t) corners.push_back(soup.vertices[corner]);
  }
  return corners;
}

TEST(WideBvh, BoxesContainWhatIsBelowThem) {
  std::mt19937 random(1);
  EXPECT_LE(checkedDepth(cornersOf(test::blobSoup(random, 40, 60))), 8);
  EXPECT_EQ(checkedDepth({Vector3d(1, 2, 3), Vector3d(2, 2, 3), Vector3d(1, 4, 5)}), 1);
}

TEST(WideBvh, HoldsAtEveryScaleAndFarFromTheOrigin) {
  std::mt19937 random(2);
  for (const double scale : {1e-300, 1e-9, 1e-6, 1e6, 1e9, 1e29, 1e100, 1e300}) {
    std::vector<Vector3d> corners = cornersOf(test::blobSoup(random, 8, 8));
    for (Vector3d& p : corners) p *= scale;
    checkedDepth(corners);
  }
  for (const double far : {1e3, 1e7, 1e12}) {
    std::vector<Vector3d> corners = cornersOf(test::blobSoup(random, 8, 8));
    for (Vector3d& p : corners) p.x() += far;
    checkedDepth(corners);
  }
}

TEST(WideBvh, IsShallowForManyEqualTriangles) {
  std::vector<Vector3d> corners;
  for (int i = 0; i < 3 * 4096; ++i) corners.push_back(Vector3d::Unit(i % 3));
  EXPECT_LE(checkedDepth(corners), 12);
}

TEST(WideBvh, BoundsItsDepthForLopsidedInput) {
  // Sizes that double put all but one triangle in one bin at each level.
  std::vector<Vector3d> corners;
  double size = 1e-150;
  for (int i = 0; i < 900; ++i, size *= 2.0) {
    for (int k = 0; k < 3; ++k) corners.push_back(size * (Vector3d::Ones() + Vector3d::Unit(k)));
  }
  checkedDepth(corners);
}

}  // namespace
}  // namespace swept::detail
