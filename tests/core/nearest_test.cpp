// SPDX-License-Identifier: BSD-3-Clause
#include "cover/nearest.hpp"

#include <gtest/gtest.h>

#include "bvh/wide_bvh.hpp"
#include "cover_samples.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

double bruteForce(const TriangleMesh& mesh, const Vector3d& p) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Eigen::Vector3i& t : mesh.triangles()) {
    nearest =
        std::min(nearest, test::distanceToTriangle(p, mesh.vertices()[t[0]], mesh.vertices()[t[1]],
                                                   mesh.vertices()[t[2]]));
  }
  return nearest;
}

/// Random triangles, a part of them slivers of all widths.
TriangleMesh soup(std::mt19937& random, const Vector3d& offset) {
  test::Soup soup;
  for (int i = 0; i < 200; ++i) {
    const Vector3d a = offset + test::uniformPoint(random, 1.0);
    const Vector3d along = test::uniformPoint(random, 0.5);
    const double width = i % 2 == 0 ? 0.5 : std::pow(10.0, -test::uniform(random, 1.0, 16.0));
    const auto first = static_cast<int>(soup.vertices.size());
    soup.vertices.insert(soup.vertices.end(),
                         {a, a + along, a + 0.4 * along + width * test::unitVector(random)});
    soup.triangles.emplace_back(first, first + 1, first + 2);
  }
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

TEST(Nearest, IsWithinItsErrorOfTheTruth) {
  std::mt19937 random(8);
  for (const double far : {0.0, 10.0}) {
    const Vector3d offset = Vector3d::Constant(far);
    const TriangleMesh mesh = soup(random, offset);
    const Nearest nearest(mesh.vertices(), mesh.triangles(), mesh.bvh());
    for (int i = 0; i < 3000; ++i) {
      const Vector3d p = offset + test::uniformPoint(random, 1.5);
      const double truth = bruteForce(mesh, p);
      const Nearest::Found found = nearest.find(p, std::numeric_limits<double>::infinity());
      ASSERT_NEAR(std::sqrt(found.squared), truth, nearest.error(p));
      EXPECT_NEAR((found.point - p).norm(), std::sqrt(found.squared), 1e-14);
      EXPECT_LT(nearest.error(p), 1e-4);
    }
  }
}

TEST(Nearest, LooksOnlyWithinTheBound) {
  std::mt19937 random(9);
  const TriangleMesh mesh = soup(random, Vector3d::Zero());
  const Nearest nearest(mesh.vertices(), mesh.triangles(), mesh.bvh());
  int within = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d p = test::uniformPoint(random, 1.5);
    const double truth = bruteForce(mesh, p);
    const double bound = test::uniform(random, 0.0, 2.0) * truth;
    if (std::abs(bound - truth) < 1e-5) continue;
    const Nearest::Found found = nearest.find(p, bound);
    EXPECT_EQ(found.primitive >= 0, truth < bound);
    within += found.primitive >= 0 ? 1 : 0;
  }
  EXPECT_GT(within, 600);
  EXPECT_LT(within, 1400);
}

TEST(Nearest, FindsPoints) {
  std::mt19937 random(10);
  std::vector<Vector3d> points;
  for (int i = 0; i < 300; ++i) points.push_back(test::uniformPoint(random, 1.0));
  const PointCloud cloud = PointCloud::build(points, 0.1);
  const Nearest nearest(cloud.points(), cloud.bvh());
  for (int i = 0; i < 1000; ++i) {
    const Vector3d p = test::uniformPoint(random, 1.5);
    double truth = std::numeric_limits<double>::infinity();
    for (const Vector3d& point : points) truth = std::min(truth, (p - point).norm());
    const Nearest::Found found = nearest.find(p, std::numeric_limits<double>::infinity());
    ASSERT_NEAR(std::sqrt(found.squared), truth, nearest.error(p));
  }
}

}  // namespace
}  // namespace swept::detail
