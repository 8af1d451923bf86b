// SPDX-License-Identifier: BSD-3-Clause
// Queries that end early, because two points within `contact` are known or a distance beyond
// `enough` is proven: what they say is true nevertheless.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Triangles here and there, so that the nearest two are seldom the first that are met.
TriangleMesh scattered(std::mt19937& random) {
  constexpr int kTriangles = 60;
  std::vector<Vector3d> vertices;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < kTriangles; ++i) {
    const Vector3d middle = test::uniformPoint(random, 1.0);
    for (int k = 0; k < 3; ++k) vertices.push_back(middle + 0.1 * test::uniformPoint(random, 1.0));
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return TriangleMesh::build(vertices, triangles);
}

Shape scatteredShape(std::mt19937& random, int kind) {
  if (kind == 0) return scattered(random);
  if (kind == 1) {
    std::vector<Vector3d> points;
    for (int i = 0; i < 60; ++i) points.push_back(test::uniformPoint(random, 1.0));
    return PointCloud::build(points, 0.02);
  }
  if (kind == 2) return makeBox({0.3, 0.8, 0.2});
  return makeSphere(0.4);
}

TEST(ContactDistance, LowerIsALowerBoundWhicheverCriterionEndsTheQuery) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  int inContact = 0, beyond = 0, both = 0;
  for (int i = 0; i < 2000; ++i) {
    const Shape a = scatteredShape(random, i % 2);
    const Shape b = scatteredShape(random, i / 2 % 4);
    Isometry3d a_from_b = Isometry3d::Identity();
    a_from_b.translation() = 2.5 * test::uniformPoint(random, 1.0);
    const DistanceResult exact = distance(a, b, a_from_b);
    DistanceOptions options;
    options.contact = 0.4 * uniform(random);
    if (i % 3 == 0) options.enough = options.contact + 0.4 * uniform(random);
    const DistanceResult found = distance(a, b, a_from_b, options);
    ASSERT_LE(found.lower, exact.upper) << i << ", contact " << options.contact;
    ASSERT_GE(found.upper, exact.lower) << i << ", contact " << options.contact;
    const bool early = found.upper <= options.contact;
    inContact += early && exact.upper > 0.0 ? 1 : 0;
    beyond += !early && found.lower > options.enough ? 1 : 0;
    both += early && found.upper > 1.01 * exact.upper ? 1 : 0;
  }
  EXPECT_GT(inContact, 300);
  EXPECT_GT(beyond, 100);
  EXPECT_GT(both, 50) << "queries that end before the nearest is found";
}

/// Two points are known before anybody has asked whether one surface is inside the other.
TEST(ContactDistance, OfWhatIsEnclosedIsZero) {
  const auto cube = [](double half) {
    const test::Soup soup = test::boxSoup(Vector3d::Constant(-half), Vector3d::Constant(half));
    return TriangleMesh::build(soup.vertices, soup.triangles);
  };
  const TriangleMesh room = cube(1.0), thing = cube(0.1);
  Isometry3d a_from_b = Isometry3d::Identity();
  a_from_b.translation().x() = 0.8;
  DistanceOptions options;
  options.contact = 0.3;
  EXPECT_EQ(distance(room, thing, a_from_b, options).lower, 0.0);
}

}  // namespace
}  // namespace swept
