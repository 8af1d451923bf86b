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
  for (const auto& t : reference::trianglesOf(mesh.vertices(), mesh.triangles()))
    nearest = std::min(nearest, reference::pointTriangle(p, t));
  return nearest;
}

TriangleMesh soup(std::mt19937& random, const Vector3d& offset) {
  const test::Soup soup = test::sliverSoup(random, 200, offset);
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
