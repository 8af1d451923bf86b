// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/sphere_cover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "cover_samples.hpp"
#include "message_of.hpp"
#include "swept/core/height_field.hpp"

namespace swept {
namespace {

using Eigen::Vector3d;
using test::Soup;

TriangleMesh meshOf(const Soup& soup, MeshInterior interior = MeshInterior::Solid) {
  return TriangleMesh::build(soup.vertices, soup.triangles, interior);
}

Soup openBox() {
  Soup box = test::boxSoup({-0.2, -0.1, -0.15}, {0.2, 0.1, 0.15});
  box.triangles.pop_back();
  return box;
}

/// A box with a narrow slit: two triangles of the top stop short of each other.
Soup slitBox() {
  Soup box = test::boxSoup({-0.2, -0.1, -0.15}, {0.2, 0.1, 0.15});
  box.vertices.push_back(box.vertices[7] - Vector3d(0.002, 0.0, 0.0));
  box.triangles.back() = {3, 8, 5};
  return box;
}

struct NamedShape {
  std::string name;
  Shape shape;
};

std::vector<NamedShape> shapes() {
  std::mt19937 random(5);
  std::vector<NamedShape> all{
      {"sphere", Sphere{0.1}},
      {"box", Box{{0.2, 0.1, 0.05}}},
      {"plate", Box{{0.2, 0.15, 0.003}}},
      {"cylinder", Cylinder{0.06, 0.1}},
      {"disc", Cylinder{0.1, 0.002}},
      {"capsule", Capsule{0.05, 0.15}},
      {"cone", Cone{0.1, 0.12}},
      {"ellipsoid", Ellipsoid{{0.1, 0.2, 0.05}}},
      {"triangle", Triangle{{Vector3d(0, 0, 0), Vector3d(0.3, 0, 0.1), Vector3d(0, 0.2, 0)}}},
      {"torus", meshOf(test::torusSoup(24, 12, 0.2, 0.06))},
      {"inverted box", meshOf(test::boxSoup({0, 0, 0}, {0.1, 0.2, 0.3}).inverted())},
      {"surface box", meshOf(test::boxSoup({0, 0, 0}, {0.1, 0.2, 0.3}), MeshInterior::Surface)},
      {"open box", meshOf(openBox())},
      {"slit box", meshOf(slitBox())},
  };
  all.push_back(
      {"blob", meshOf(test::blobSoup(random, 7, 9).moved(test::randomPose(random, 0.5)))});
  Soup cross = test::boxSoup({-0.3, -0.05, -0.05}, {0.3, 0.05, 0.05});
  cross.append(test::boxSoup({-0.05, -0.3, -0.04}, {0.05, 0.3, 0.04}));
  all.push_back({"two boxes", meshOf(cross)});
  std::vector<Vector3d> points;
  for (int i = 0; i < 60; ++i) points.push_back(test::uniformPoint(random, 0.3));
  all.push_back({"hull", ConvexHull::of(points)});
  all.push_back({"cloud", PointCloud::build(points, 0.02)});
  std::vector<double> radii;
  for (std::size_t i = 0; i < points.size(); ++i) radii.push_back(test::uniform(random, 0.0, 0.05));
  all.push_back({"cloud of all sizes", PointCloud::build(points, radii)});
  for (Vector3d& point : points) point = {point.x(), point.y(), 0.3 * point.x() + 0.1};
  all.push_back({"flat hull", ConvexHull::of(points)});
  Eigen::MatrixXd heights(9, 12);
  for (int i = 0; i < heights.size(); ++i) heights(i) = test::uniform(random, 0.1, 0.3);
  all.push_back({"terrain", heightField(1.0, 0.8, heights, 0.0)});
  return all;
}

std::vector<Vector3d> sample(const Shape& shape, std::mt19937& random, int count) {
  return std::visit(test::SampleOf(random, count), shape);
}

double distanceFrom(const Shape& shape, const Vector3d& p) {
  return std::visit(test::DistanceOf{p}, shape);
}

/// m. Rounding of the samples themselves.
double slackOf(const Shape& shape) {
  const BoundingSphere ball = boundingSphere(shape);
  return 1e-14 * (ball.center.norm() + ball.radius);
}

void expectCovered(const Shape& shape, const SphereCover& cover, int count) {
  std::mt19937 random(17);
  const double slack = slackOf(shape);
  int missedByShrunk = 0;
  for (const Vector3d& p : sample(shape, random, count)) {
    ASSERT_TRUE(test::covers(cover, p, slack)) << "point " << p.transpose();
    missedByShrunk += test::covers(cover, p, slack, 0.99) ? 0 : 1;
  }
  EXPECT_GT(missedByShrunk, 0) << "balls one percent smaller pass as well: the check is blunt";
}

TEST(SphereCover, EveryCutContainsThePointsOfEveryShape) {
  for (const NamedShape& entry : shapes()) {
    SCOPED_TRACE(entry.name);
    expectCovered(entry.shape, sphereCover(entry.shape), 3000);
  }
}

TEST(SphereCover, NoPointOfABallIsFartherThanItsOverhang) {
  std::mt19937 random(3);
  for (const NamedShape& entry : shapes()) {
    SCOPED_TRACE(entry.name);
    const SphereCover cover = sphereCover(entry.shape, {.mostBalls = 400});
    double tightest = 0.0;
    for (const SphereCover::Node& node : cover.nodes) {
      for (int i = 0; i < 12; ++i) {
        const Vector3d p =
            node.ball.center.cast<double>() + double{node.ball.radius} * test::unitVector(random);
        const double found = distanceFrom(entry.shape, p);
        ASSERT_LE(found, node.overhang + slackOf(entry.shape));
        tightest = std::max(tightest, found / node.overhang);
      }
    }
    if (entry.name == "sphere") continue;  // its overhang is rounding
    EXPECT_GT(tightest, 0.6) << "the bound says little";
  }
}

TEST(SphereCover, LevelsReachTheOverhangTheyAimAt) {
  for (const NamedShape& entry : shapes()) {
    if (entry.name == "cloud of all sizes") continue;  // as far as its radii differ, and no closer
    SCOPED_TRACE(entry.name);
    const SphereCover cover =
        sphereCover(entry.shape, {.finestRelative = 0.05, .mostBalls = 20000});
    const double radius = cover.nodes.front().ball.radius;
    EXPECT_LE(cover.levels.back().aimed, 0.05 * radius * (1.0 + 1e-6));
    for (std::size_t level = 0; level < cover.levels.size(); ++level) {
      double largest = 0.0;
      const std::vector<int> cut = cover.cut(static_cast<int>(level));
      EXPECT_EQ(cover.levels[level].ballCount, static_cast<int>(cut.size()));
      for (const int index : cut) {
        EXPECT_LE(cover.nodes[index].beyond, cover.levels[level].aimed + 1e-6 * radius);
        largest = std::max(largest, double{cover.nodes[index].overhang});
      }
      EXPECT_EQ(cover.levels[level].largestOverhang, largest);
    }
  }
}

TEST(SphereCover, FineLevelsOfThickSolidsFillTheInsideWithFewBalls) {
  // Balls of a fine level touch the surface and are no deeper than needed there: the deep inside,
  // halved down to the size of the level, was too much work and ended in balls that were too large.
  const SphereCover cover =
      sphereCover(Cylinder{1.0, 1.0}, {.finestRelative = 0.01, .mostBalls = 20000});
  EXPECT_LE(cover.levels.back().largestOverhang, cover.levels.back().aimed * (1.0 + 1e-6));
  EXPECT_LE(cover.levels.back().ballCount, 9000);
}

TEST(SphereCover, InnerBallsAreInside) {
  std::mt19937 random(23);
  int shapesWithInside = 0;
  for (const NamedShape& entry : shapes()) {
    SCOPED_TRACE(entry.name);
    const SphereCover cover = sphereCover(entry.shape);
    EXPECT_LE(cover.inner.size(), 16u);
    shapesWithInside += cover.inner.empty() ? 0 : 1;
    for (const CoverBall& ball : cover.inner) {
      EXPECT_GT(ball.radius, 0.0F);
      for (int i = 0; i < 60; ++i) {
        const Vector3d p = ball.center.cast<double>() + double{ball.radius} *
                                                            test::uniform(random, 0.3, 1.0) *
                                                            test::unitVector(random);
        ASSERT_LE(distanceFrom(entry.shape, p), slackOf(entry.shape));
      }
    }
  }
  EXPECT_EQ(shapesWithInside, 16);  // all but two surfaces, two open boxes and a flat hull
}

TEST(SphereCover, InnerBallsAreTheDeepestThereAre) {
  const double slack = 1e-3;
  EXPECT_GE(sphereCover(Sphere{0.1}).inner.front().radius, 0.1 * (1.0 - 1e-6));
  EXPECT_GE(sphereCover(Box{{0.3, 0.2, 0.1}}).inner.front().radius, 0.1 * (1.0 - 0.03));
  EXPECT_GE(sphereCover(Capsule{0.05, 0.2}).inner.front().radius, 0.05 * (1.0 - 0.03));
  const auto torus = meshOf(test::torusSoup(48, 24, 0.2, 0.05));
  EXPECT_GE(sphereCover(torus).inner.front().radius, 0.05 * 0.95 - slack);
}

TEST(SphereCover, NodesTellTheBallsInsideAroundTheirCentres) {
  std::mt19937 random(29);
  int shapesWithInside = 0;
  int insides = 0;
  int leave = 0;
  for (const NamedShape& entry : shapes()) {
    SCOPED_TRACE(entry.name);
    const SphereCover cover = sphereCover(entry.shape, {.finestRelative = 0.06});
    int found = 0;
    for (const SphereCover::Node& node : cover.nodes) {
      if (!(node.inside > 0.0F)) continue;
      ++found;
      const auto probe = [&](double reach) {
        const Vector3d p =
            node.ball.center.cast<double>() + reach * node.inside * test::unitVector(random);
        return distanceFrom(entry.shape, p) <= slackOf(entry.shape);
      };
      for (int i = 0; i < 10; ++i) ASSERT_TRUE(probe(i < 5 ? 1.0 : test::uniform(random, 0, 1)));
      bool stays = true;
      for (int i = 0; i < 60; ++i) stays = stays && probe(1.3);
      leave += stays ? 0 : 1;
    }
    shapesWithInside += found > 0 ? 1 : 0;
    insides += found;
  }
  // The same shapes as have inner balls.
  EXPECT_EQ(shapesWithInside, 16);
  EXPECT_GT(insides, 1000);
  EXPECT_GT(leave, 0.6 * insides) << "balls a third larger are inside as well: the check is blunt";
}

TEST(SphereCover, TheBallsInsideAreTheLargestThereAre) {
  // A box tells the depth of a point in closed form.
  const Vector3d half(0.2, 0.15, 0.1);
  const SphereCover box = sphereCover(Box{half});
  const SphereCover mesh = sphereCover(meshOf(test::boxSoup(-half, half)));
  for (const SphereCover* cover : {&box, &mesh}) {
    int deep = 0;
    for (const SphereCover::Node& node : cover->nodes) {
      const double depth = (half - node.ball.center.cast<double>().cwiseAbs()).minCoeff();
      deep += depth > 0.01 ? 1 : 0;
      EXPECT_GE(node.inside, 0.97 * depth - 1e-4);
      EXPECT_GE(node.inside, node.childCount > 0 ? depth - 1e-5 : -1.0);
      EXPECT_EQ(node.inside > 0.0F, depth > 0.0);
    }
    EXPECT_GT(deep, 0.5 * static_cast<double>(cover->nodes.size()));
    EXPECT_NEAR(cover->nodes.front().inside, half.z(), 1e-5);
  }
  EXPECT_NEAR(sphereCover(Sphere{0.25}).nodes.front().inside, 0.25, 1e-6);
}

TEST(SphereCover, OneOfSeveralComponentsIsEnoughForABallInside) {
  // The middle part has its surface inside the long bar, which the ball at the middle passes.
  Soup cross = test::boxSoup({-0.3, -0.05, -0.05}, {0.3, 0.05, 0.05});
  cross.append(test::boxSoup({-0.03, -0.03, -0.03}, {0.03, 0.03, 0.03}));
  EXPECT_NEAR(sphereCover(meshOf(cross)).nodes.front().inside, 0.05, 1e-3);
  // A shell with a slit is none, but a closed part beside it is.
  Soup mixed = slitBox();
  mixed.append(test::boxSoup({0.3, -0.1, -0.1}, {0.5, 0.1, 0.1}));
  const SphereCover cover = sphereCover(meshOf(mixed));
  int inPart = 0;
  int inShell = 0;
  for (const SphereCover::Node& node : cover.nodes) {
    if (!(node.inside > 0.0F)) continue;
    (node.ball.center.x() > 0.3F ? inPart : inShell) += 1;
  }
  EXPECT_GT(inPart, 10);
  EXPECT_EQ(inShell, 0);
}

TEST(SphereCover, ASphereIsOneExactBall) {
  const SphereCover cover = sphereCover(Sphere{0.25});
  ASSERT_EQ(cover.nodes.size(), 1u);
  EXPECT_EQ(cover.nodes[0].ball.center, Eigen::Vector3f::Zero());
  EXPECT_FLOAT_EQ(cover.nodes[0].ball.radius, 0.25F);
  EXPECT_LT(cover.nodes[0].overhang, 1e-7F);
}

TEST(SphereCover, FewBallsDo) {
  const auto count = [](const Shape& shape, double overhang) {
    SphereCoverOptions options;
    options.finestOverhang = overhang;
    options.finestRelative = 0.0;
    return sphereCover(shape, options).levels.back().ballCount;
  };
  EXPECT_LE(count(Cylinder{0.06, 0.1}, 0.03), 6);
  EXPECT_LE(count(Cylinder{0.06, 0.1}, 0.015), 45);
  EXPECT_LE(count(Capsule{0.05, 0.15}, 0.025), 8);
  EXPECT_LE(count(Capsule{0.05, 0.15}, 0.013), 16);
  EXPECT_LE(count(Box{{0.05, 0.05, 0.05}}, 0.023), 16);
  EXPECT_LE(count(meshOf(test::torusSoup(32, 16, 0.2, 0.05)), 0.032), 32);
}

TEST(SphereCover, APocketCostsNoMoreThanASolid) {
  SphereCoverOptions options;
  options.finestRelative = 0.1;
  const auto solid = meshOf(test::boxSoup({-0.2, -0.1, -0.15}, {0.2, 0.1, 0.15}));
  const SphereCover closed = sphereCover(solid, options);
  const SphereCover slit = sphereCover(meshOf(slitBox()), options);
  const SphereCover open = sphereCover(meshOf(openBox()), options);
  EXPECT_LE(slit.levels.back().ballCount, 1.2 * closed.levels.back().ballCount);
  EXPECT_GT(open.levels.back().ballCount, 2 * closed.levels.back().ballCount);
  EXPECT_TRUE(slit.inner.empty());
  // What is inside is far from the surface, and the overhang says so.
  EXPECT_GT(slit.levels.back().largestOverhang, 0.05);
  EXPECT_LE(slit.nodes.front().overhang, 0.35);
}

TEST(SphereCover, IsTheSameEveryTime) {
  for (const NamedShape& entry : shapes()) {
    SCOPED_TRACE(entry.name);
    const SphereCover first = sphereCover(entry.shape, {.finestRelative = 0.06});
    const SphereCover second = sphereCover(entry.shape, {.finestRelative = 0.06});
    ASSERT_EQ(first.nodes.size(), second.nodes.size());
    for (std::size_t i = 0; i < first.nodes.size(); ++i) {
      EXPECT_EQ(first.nodes[i].ball.center, second.nodes[i].ball.center);
      EXPECT_EQ(first.nodes[i].ball.radius, second.nodes[i].ball.radius);
      EXPECT_EQ(first.nodes[i].firstChild, second.nodes[i].firstChild);
    }
  }
}

TEST(SphereCover, IsATree) {
  for (const NamedShape& entry : shapes()) {
    SCOPED_TRACE(entry.name);
    const SphereCover cover = sphereCover(entry.shape, {.finestRelative = 0.06});
    std::vector<int> parents(cover.nodes.size(), 0);
    for (std::size_t i = 0; i < cover.nodes.size(); ++i) {
      const SphereCover::Node& node = cover.nodes[i];
      for (int k = 0; k < node.childCount; ++k) {
        ASSERT_GT(node.firstChild, static_cast<int>(i));
        ASSERT_LT(node.firstChild + k, static_cast<int>(cover.nodes.size()));
        ++parents[node.firstChild + k];
        EXPECT_GT(cover.nodes[node.firstChild + k].level, node.level);
      }
    }
    EXPECT_EQ(std::count(parents.begin() + 1, parents.end(), 1),
              static_cast<std::ptrdiff_t>(parents.size()) - 1);
  }
}

TEST(SphereCover, StaysWithinTheBallsAllowed) {
  for (const int most : {1, 10, 100}) {
    const SphereCover cover = sphereCover(Cone{0.1, 0.12}, {.mostBalls = most});
    EXPECT_LE(cover.nodes.size(), static_cast<std::size_t>(most));
    expectCovered(Cone{0.1, 0.12}, cover, 2000);
  }
}

TEST(SphereCover, DegenerateShapes) {
  const std::vector<NamedShape> flat{
      {"rectangle", Box{{0.1, 0.2, 0.0}}},
      {"segment", Box{{0.0, 0.2, 0.0}}},
      {"line capsule", Capsule{0.0, 0.1}},
      {"ball capsule", Capsule{0.1, 0.0}},
      {"circle", Cylinder{0.1, 0.0}},
      {"needle", Cylinder{0.0, 0.1}},
      {"flat cone", Cone{0.1, 0.0}},
      {"line cone", Cone{0.0, 0.1}},
      {"flat ellipsoid", Ellipsoid{{0.1, 0.0, 0.2}}},
      {"collinear", Triangle{{Vector3d(0, 0, 0), Vector3d(1, 1, 1), Vector3d(2, 2, 2)}}},
      {"two corners", Triangle{{Vector3d(0, 0, 0), Vector3d(1, 0, 1), Vector3d(1, 0, 1)}}},
      {"wire", Box{{1.0, 1e-7, 1e-7}}},
      {"foil", Box{{1.0, 1.0, 1e-8}}},
      {"hardly flat hull",
       ConvexHull::of(std::vector<Vector3d>{
           {0, 0, 0}, {1, 0, 1e-15}, {0, 1, 0}, {1, 1, -1e-15}, {0.5, 0.5, 1e-14}})},
      {"sliver", meshOf({{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-13, 0}, {0.5, 0, 1e-9}},
                         {{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {0, 2, 3}}})}};
  for (const NamedShape& entry : flat) {
    SCOPED_TRACE(entry.name);
    const SphereCover cover = sphereCover(entry.shape, {.mostBalls = 20000});
    EXPECT_GT(cover.nodes.front().ball.radius, 0.0F);
    EXPECT_LT(cover.levels.back().largestOverhang, 0.04 * cover.nodes.front().ball.radius);
    std::mt19937 random(2);
    for (const Vector3d& p : sample(entry.shape, random, 1000)) {
      ASSERT_TRUE(test::covers(cover, p, slackOf(entry.shape)));
    }
  }
  for (const Shape& point :
       std::vector<Shape>{Sphere{0.0}, Box{{0, 0, 0}}, Ellipsoid{{0, 0, 0}},
                          Triangle{{Vector3d(1, 2, 3), Vector3d(1, 2, 3), Vector3d(1, 2, 3)}}}) {
    const SphereCover cover = sphereCover(point);
    ASSERT_EQ(cover.nodes.size(), 1u);
    EXPECT_LT(cover.nodes.front().ball.radius, 1e-6F);
    EXPECT_TRUE(cover.inner.empty());
  }
}

TEST(SphereCover, MinuteShapes) {
  for (const double size : {1e-14, 1e-16, 1e-80, 1e-310}) {
    for (const Shape& shape :
         std::vector<Shape>{Box{{size, size, size}}, Cylinder{size, size},
                            Ellipsoid{{size, size, size}}, Sphere{size}, Box{{size, size, 0.0}}}) {
      const SphereCover cover = sphereCover(shape);
      std::mt19937 random(2);
      for (const Vector3d& p : sample(shape, random, 100)) {
        ASSERT_TRUE(test::covers(cover, p, 0.0));
      }
      EXPECT_LE(cover.nodes.front().ball.radius, 2.0 * size + 1e-44);
    }
  }
}

TEST(SphereCover, HugeAndTinyAndFarShapes) {
  for (const double size : {1e12, 1e6, 1e-6, 1e-12}) {
    SCOPED_TRACE(size);
    const Vector3d one = Vector3d::Constant(size);
    Soup soup = test::torusSoup(16, 8, size, 0.3 * size);
    for (const Shape& shape : std::vector<Shape>{Cylinder{size, size}, Box{one}, meshOf(soup)}) {
      const SphereCover cover = sphereCover(shape);
      expectCovered(shape, cover, 1000);
      EXPECT_LT(cover.levels.back().largestOverhang, 0.05 * cover.nodes.front().ball.radius);
    }
  }
  const Shape far = meshOf(test::boxSoup({1e4, 1e4, 1e4}, {1e4 + 1, 1e4 + 1, 1e4 + 1}));
  const SphereCover cover = sphereCover(far);
  std::mt19937 random(9);
  for (const Vector3d& p : sample(far, random, 2000)) {
    ASSERT_TRUE(test::covers(cover, p, slackOf(far)));
  }
  const SphereCover beyond = sphereCover(Box{{1e300, 1.0, 1.0}});
  ASSERT_EQ(beyond.nodes.size(), 1u);
  EXPECT_TRUE(std::isinf(beyond.nodes.front().ball.radius));
  expectCovered(Cylinder{1e20, 1e20}, sphereCover(Cylinder{1e20, 1e20}), 500);
}

std::string refusal(const Shape& shape, const SphereCoverOptions& options = {}) {
  return test::messageOf([&] { sphereCover(shape, options); });
}

TEST(SphereCover, RefusesUnboundedShapes) {
  EXPECT_NE(refusal(Plane{Vector3d::UnitZ(), 0.0}).find("plane"), std::string::npos);
  EXPECT_NE(refusal(HalfSpace{Vector3d::UnitZ(), 0.0}).find("half-space"), std::string::npos);
  EXPECT_EQ(refusal(Sphere{1.0}), "");
}

TEST(SphereCover, RefusesOptionsThatMeanNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](const SphereCoverOptions& options) {
    return refusal(Sphere{1.0}, options);
  };
  EXPECT_EQ(message({.finestOverhang = -0.5}),
            "sphere cover option finestOverhang is -0.5; allowed: at least 0");
  EXPECT_NE(message({.finestOverhang = nan}), "");
  EXPECT_NE(message({.finestRelative = nan}), "");
  EXPECT_EQ(message({.mostBalls = 0}), "sphere cover option mostBalls is 0; allowed: at least 1");
  EXPECT_NE(message({.mostInnerBalls = -1}), "");
  EXPECT_EQ(sphereCover(Box{{1, 1, 1}}, {.mostInnerBalls = 0}).inner.size(), 0u);
}

}  // namespace
}  // namespace swept
