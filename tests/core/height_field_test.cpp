// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/height_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "mesh_samples.hpp"
#include "swept/core/distance.hpp"

namespace swept::test {
namespace {

Eigen::MatrixXd randomHeights(std::mt19937& random, int rows, int columns) {
  Eigen::MatrixXd heights(rows, columns);
  for (int i = 0; i < heights.size(); ++i) heights(i) = uniform(random, 0.1, 0.6);
  return heights;
}

/// Height of the surface, from the cell's plane; independent of the mesh.
double heightAt(const Eigen::MatrixXd& heights, double xSize, double ySize, double x, double y) {
  const double u = (x / xSize + 0.5) * static_cast<double>(heights.cols() - 1);
  const double v = (y / ySize + 0.5) * static_cast<double>(heights.rows() - 1);
  const int c = std::min(static_cast<int>(u), static_cast<int>(heights.cols()) - 2);
  const int r = std::min(static_cast<int>(v), static_cast<int>(heights.rows()) - 2);
  const double s = u - c, t = v - r;
  const double low = heights(r, c), high = heights(r + 1, c + 1);
  return s >= t ? low + s * (heights(r, c + 1) - low) + t * (high - heights(r, c + 1))
                : low + t * (heights(r + 1, c) - low) + s * (high - heights(r + 1, c));
}

TEST(HeightField, IsClosedAndEnclosesWhatIsUnderTheHeights) {
  std::mt19937 random(7);
  const Eigen::MatrixXd heights = randomHeights(random, 6, 9);
  const TriangleMesh field = heightField(2.0, 1.0, heights, -0.25);
  EXPECT_TRUE(field.isClosed());
  EXPECT_EQ(field.report().closedComponents, 1);
  EXPECT_EQ(field.report().duplicatesDropped, 0);
  EXPECT_EQ(field.report().verticesKept, 6 * 9 + 26 + 1);
  EXPECT_EQ(field.triangles().size(), 2u * 5 * 8 + 3u * 26);
  int inside = 0, outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const double x = uniform(random, -1.1, 1.1), y = uniform(random, -0.55, 0.55);
    const double z = uniform(random, -0.4, 0.7);
    const bool over = std::abs(x) < 1.0 && std::abs(y) < 0.5 && z > -0.25;
    const bool expected = over && z < heightAt(heights, 2.0, 1.0, x, y);
    EXPECT_EQ(field.encloses({x, y, z}), expected) << x << " " << y << " " << z;
    ++(expected ? inside : outside);
  }
  EXPECT_GT(inside, 800);
  EXPECT_GT(outside, 800);
}

TEST(HeightField, TrianglesFaceOutward) {
  std::mt19937 random(8);
  const TriangleMesh field = heightField(2.0, 3.0, randomHeights(random, 4, 3), 0.0);
  double sixVolumes = 0.0;
  for (const TriangleMesh::Triangle& t : field.triangles()) {
    sixVolumes += field.vertices()[t[0]].dot(field.vertices()[t[1]].cross(field.vertices()[t[2]]));
  }
  EXPECT_GT(sixVolumes, 6.0 * 2.0 * 3.0 * 0.1);
}

TEST(HeightField, RowsRunAlongYAndColumnsAlongX) {
  Eigen::MatrixXd heights = Eigen::MatrixXd::Constant(2, 3, 1.0);
  heights(0, 2) = 5.0;
  const TriangleMesh field = heightField(4.0, 10.0, heights, 0.0);
  Eigen::Vector3d highest = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& v : field.vertices())
    if (v.z() > highest.z()) highest = v;
  EXPECT_EQ(highest, Eigen::Vector3d(2.0, -5.0, 5.0));
}

TEST(HeightField, DistanceToASphereAboveAPlateau) {
  const TriangleMesh field = heightField(4.0, 4.0, Eigen::MatrixXd::Zero(9, 9), -1.0);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.09, -0.11, 0.75);
  const DistanceResult above = distance(field, makeSphere(0.5), pose);
  EXPECT_LE(above.lower, 0.25);
  EXPECT_NEAR(above.upper, 0.25, 2e-9);
  EXPECT_NEAR((above.pointA - Eigen::Vector3d(0.09, -0.11, 0.0)).norm(), 0.0, 1e-4);
  pose.translation() = Eigen::Vector3d(0.0, 0.0, -1.75);
  EXPECT_NEAR(distance(field, makeSphere(0.5), pose).upper, 0.25, 2e-9);
  pose.translation() = Eigen::Vector3d(0.3, 0.1, -0.5);
  EXPECT_EQ(collide(field, makeSphere(0.1), pose), Contact::Touching);
}

TEST(HeightField, RefusesWhatIsNoTerrain) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Eigen::MatrixXd flat = Eigen::MatrixXd::Ones(3, 3);
  Eigen::MatrixXd hole = flat;
  hole(1, 2) = nan;
  const std::pair<std::function<void()>, const char*> refused[] = {
      {[&] { heightField(0.0, 1.0, flat, 0.0); }, "height field x size is 0; allowed: "},
      {[&] { heightField(1.0, nan, flat, 0.0); }, "height field y size is nan; allowed: "},
      {[&] { heightField(1.0, 1.0, Eigen::MatrixXd::Ones(1, 3), 0.0); },
       "height field has 1 rows and 3 columns; allowed: at least 2 of each"},
      {[&] { heightField(1.0, 1.0, flat, -std::numeric_limits<double>::infinity()); },
       "height field base is -inf; allowed: finite"},
      {[&] { heightField(1.0, 1.0, hole, 0.0); },
       "height field has height nan in row 1, column 2; allowed: finite and greater than the base"},
      {[&] { heightField(1.0, 1.0, flat, 1.0); },
       "height field has height 1 in row 0, column 0; allowed: finite and greater than the base, "
       "1"},
  };
  for (const auto& [call, text] : refused) {
    try {
      call();
      ADD_FAILURE() << "accepted: " << text;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), testing::StartsWith(text));
    }
  }
}

}  // namespace
}  // namespace swept::test
