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
  Check(const WideBvh& bvh, const std::vector<Vector3d>& corners)
      : bvh_(bvh), corners_(corners), seen_(corners.size() / 3, 0) {}

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
      expectWithinReach(node, lane);
      below.insert(below.end(), inside.begin(), inside.end());
    }
    return depth + 1;
  }

  void expectInside(const OrientedBox& box, const std::vector<int>& primitives) {
    for (const int primitive : primitives) {
      for (int k = 0; k < 3; ++k) {
        const Vector3d& p = corners_[3 * primitive + k];
        for (int j = 0; j < 3; ++j) {
          const Vector3d axis(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
          EXPECT_LE(std::abs(axis.dot(p - box.center)), double{box.half[j]});
        }
        EXPECT_TRUE((p.array() >= bvh_.bounds().lower.array()).all());
        EXPECT_TRUE((p.array() <= bvh_.bounds().upper.array()).all());
        EXPECT_LE(p.cwiseAbs().sum(), bvh_.reach() * (1.0 + 1e-15));
      }
    }
  }

  void expectWithinReach(const WideNode& node, int lane) {
    const OrientedBox box = node.box(lane);
    double size = 0.0;
    for (int i = 0; i < 3; ++i) {
      size += std::abs(double{node.center[i][lane]}) + double{box.half[i]};
      for (int j = 0; j < 3; ++j) {
        double product = 0.0;
        for (int k = 0; k < 3; ++k) product += double{box.axes[i][k]} * double{box.axes[j][k]};
        EXPECT_NEAR(product, i == j ? 1.0 : 0.0, 3.0 * 0x1p-24);
      }
    }
    EXPECT_LE(size, double{node.reach});
  }

  const WideBvh& bvh_;
  const std::vector<Vector3d>& corners_;
  std::vector<int> seen_;
};

/// Of triangles, three corners each, which are put in the order of the leaves.
WideBvh built(std::vector<Vector3d>& corners) {
  const auto tree = TreeTopology::build({corners, 3}, SurfaceAreaSplit{}, WideNode::kLanes);
  std::vector<Vector3d> ordered;
  for (const int from : tree.order) {
    const auto first = corners.begin() + std::ptrdiff_t{3} * from;
    ordered.insert(ordered.end(), first, first + 3);
  }
  corners = std::move(ordered);
  return WideBvh(tree, {corners, 3});
}

int checkedDepth(std::vector<Vector3d> corners) {
  const WideBvh bvh = built(corners);
  const int depth = Check(bvh, corners).run();
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

/// What the search between smooth surfaces lives on: boxes tilt with the surface, and their
/// thickness falls with the square of their length.
TEST(WideBvh, BoxesOfASmoothSurfaceAreThin) {
  constexpr int kCells = 96;
  const auto point = [](int i, int j) {
    const double u = i * (1.0 / kCells), v = j * (1.0 / kCells);
    return Vector3d(u, v + 0.4 * u, u + 0.1 * std::sin(3.0 * u) * std::cos(2.0 * v));
  };
  std::vector<Vector3d> corners;
  for (int i = 0; i < kCells; ++i) {
    for (int j = 0; j < kCells; ++j) {
      for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}}) {
        corners.push_back(point(i + di, j + dj));
      }
    }
  }
  const WideBvh bvh = built(corners);
  int thick = 0, total = 0;
  for (const WideNode& node : bvh.nodes()) {
    for (int lane = 0; lane < node.count; ++lane) {
      const OrientedBox box = node.box(lane);
      const auto [least, most] = std::minmax({box.half[0], box.half[1], box.half[2]});
      // The surface's curvature is below 1 / m: a chord of half length l is at most l^2 / 2 off it.
      thick += double{least} > double{most} * double{most} ? 1 : 0;
      ++total;
    }
  }
  // A few of two or three triangles have less surface along the frame's axes.
  EXPECT_LT(thick, total / 50);
  // Nodes that are half empty would cost memory and time.
  EXPECT_LT(bvh.nodes().size(), corners.size() / 3 / 4);
}

}  // namespace
}  // namespace swept::detail
