// SPDX-License-Identifier: BSD-3-Clause
// First contacts that are known in closed form, and what the results promise at their edges.
#include "swept/core/continuous/continuous_collide.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mesh_samples.hpp"
#include "swept/core/continuous/motions.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
const UniformMotion kStill = UniformMotion::still(Isometry3d::Identity());

Isometry3d at(double x, double y, double z) {
  return Isometry3d(Translation3d(x, y, z));
}

UniformMotion flight(const Vector3d& from, const Vector3d& to) {
  return UniformMotion::translation(Isometry3d(Translation3d(from)), to - from);
}

Shape boxMesh(const Vector3d& full) {
  const test::Soup soup = test::boxSoup(-0.5 * full, 0.5 * full);
  return TriangleMesh::build(soup.vertices, soup.triangles);
}

void expectFirstContact(const ContinuousResult& result, double t, double within) {
  EXPECT_EQ(result.verdict, Verdict::Collision);
  EXPECT_LE(result.freeUntil, t + 1e-12);
  EXPECT_GE(result.contactBy, t - 1e-12);
  EXPECT_NEAR(result.freeUntil, t, within);
  EXPECT_NEAR(result.contactBy, t, within);
}

ContinuousOptions to(double tolerance) {
  ContinuousOptions options;
  options.tolerance = tolerance;
  return options;
}

/// A 0.1 m ball crosses a plate of 20 mm in a thousandth of its flight.
TEST(ContinuousCollide, NothingTunnels) {
  const Shape ball = makeSphere(0.1);
  const UniformMotion motion = flight({-20, 0.1, 0.2}, {60, 0.1, 0.2});
  const double t = (20.0 - 0.01 - 0.1) / 80.0;
  for (const Shape& plate : {Shape(makeBox({0.02, 2, 2})), boxMesh({0.02, 2, 2})}) {
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
      const ContinuousResult result = continuousCollide(plate, kStill, ball, motion, to(tolerance));
      expectFirstContact(result, t, tolerance / 80.0);
      EXPECT_NEAR(result.pointA.x(), -0.01, 2 * tolerance);
      EXPECT_LT((result.pointA - result.pointB).norm(), 1e-9);
    }
  }
}

/// A plate of no thickness at all.
TEST(ContinuousCollide, SheetsAreNotMissed) {
  const Shape sheet = makeTriangle({0, -1, -1}, {0, 3, -1}, {0, -1, 3});
  const Shape dart = makeTriangle({0, 0, 0}, {-0.1, 0.05, 0}, {-0.1, -0.05, 0});
  expectFirstContact(
      continuousCollide(sheet, kStill, dart, flight({-3, 0, 0}, {5, 0, 0}), to(1e-7)), 3.0 / 8.0,
      1e-7);
  const Shape sensed = PointCloud::build(std::vector<Vector3d>{{0, 0, 0}}, 1e-4);
  expectFirstContact(
      continuousCollide(sheet, kStill, sensed, flight({-3, 0, 0}, {5, 0, 0}), to(1e-7)),
      (3.0 - 1e-4) / 8.0, 1e-7);
}

/// Collision of two bodies on a common clock: their ways cross, but at different times.
TEST(ContinuousCollide, WaysMayCross) {
  const Shape ball = makeSphere(0.5);
  const UniformMotion first = flight({-4, 0, 0}, {4, 0, 0});
  const ContinuousResult apart =
      continuousCollide(ball, first, ball, flight({0, -8, 0}, {0, 0, 0}), to(1e-6));
  EXPECT_EQ(apart.verdict, Verdict::Free);
  EXPECT_EQ(apart.freeUntil, 1.0);
  EXPECT_EQ(apart.contactBy, 1.0);
  // The distance of the centres is 4 sqrt(2) |2 t - 1| when both pass the origin at once.
  const double t = 0.5 * (1.0 - 1.0 / (4.0 * std::numbers::sqrt2));
  expectFirstContact(continuousCollide(ball, first, ball, flight({0, -4, 0}, {0, 4, 0}), to(1e-7)),
                     t, 1e-7);
}

/// The corner of a turning bar, and a cylinder that the same bar misses by a hair.
TEST(ContinuousCollide, TurningBodies) {
  const Shape bar = makeBox({2, 0.2, 0.2});
  const UniformMotion turning =
      UniformMotion::turning(at(0, 0, 0), Vector3d(0, 0, std::numbers::pi / 2), Vector3d::Zero());
  // The corner (1, 0.1) reaches y = 0.8 first.
  const double radius = std::hypot(1.0, 0.1);
  const double angle = std::asin(0.8 / radius) - std::atan2(0.1, 1.0);
  expectFirstContact(
      continuousCollide(makeHalfSpace({0, -1, 0}, -0.8), kStill, bar, turning, to(1e-7)),
      angle / (std::numbers::pi / 2), 1e-6);
  // Twenty turns beside it.
  const UniformMotion often =
      UniformMotion::turning(at(0, 0, 0), Vector3d(0, 0, 40 * std::numbers::pi), Vector3d::Zero());
  const Shape post = makeCylinder(0.1, 1.0);
  const auto postAt = [&](double x) { return UniformMotion::still(at(x, 0, 0)); };
  EXPECT_EQ(continuousCollide(post, postAt(radius + 0.1 + 2e-4), bar, often, to(1e-4)).verdict,
            Verdict::Free);
  EXPECT_EQ(continuousCollide(post, postAt(radius + 0.1 - 1e-4), bar, often, to(1e-5)).verdict,
            Verdict::Collision);
}

/// A screw on its way into a nut's hole, and turned about an axis beside it.
TEST(ContinuousCollide, Screws) {
  const Shape pin = makeCylinder(0.1, 1.0);
  const Isometry3d end = at(0, 0, 2) * Eigen::AngleAxisd(3.0, Vector3d::UnitZ());
  const UniformMotion driven = UniformMotion::screw(at(0, 0, 0), end);
  expectFirstContact(
      continuousCollide(makePlane(Vector3d::UnitZ(), 1.5), kStill, pin, driven, to(1e-7)), 0.5,
      1e-7);
  const auto wall = [&](double x) {
    return continuousCollide(makeBox({0.2, 4, 8}), UniformMotion::still(at(x + 0.1, 0, 0)), pin,
                             driven, to(1e-4))
        .verdict;
  };
  EXPECT_EQ(wall(0.1002), Verdict::Free);
  EXPECT_EQ(wall(0.0999), Verdict::Collision);
}

/// What one body carries about, or what turns with it, never comes closer.
TEST(ContinuousCollide, BodiesThatMoveTogether) {
  const UniformMotion first =
      UniformMotion::turning(at(0, 0, 0), Vector3d(0, 0, 30), Vector3d(5, 1, 2));
  const AttachedFrame second(first, at(1.0, 0, 0));
  ContinuousResult result =
      continuousCollide(makeBox({1, 1, 1}), first, makeBox({0.98, 1, 1}), second, to(1e-4));
  EXPECT_EQ(result.verdict, Verdict::Free);
  result = continuousCollide(makeBox({1, 1, 1}), first, makeBox({1.0, 1, 1}),
                             AttachedFrame(first, at(0.9, 0, 0)), to(1e-4));
  EXPECT_EQ(result.verdict, Verdict::Collision);
  EXPECT_EQ(result.contactBy, 0.0);
}

/// However deep: inside a solid without touching its surface, too.
TEST(ContinuousCollide, OverlapAtTheStartIsAtZero) {
  const std::vector<Shape> around = {makeBox({2, 2, 2}), makeSphere(1.0), boxMesh({2, 2, 2}),
                                     makeHalfSpace(Vector3d::UnitZ(), 50.0)};
  const std::vector<Shape> inside = {makeSphere(1e-3), makeBox({0.1, 0.2, 0.3}),
                                     boxMesh({0.1, 0.1, 0.1}),
                                     makeTriangle({0, 0, 0}, {0.1, 0, 0}, {0, 0.1, 0}),
                                     PointCloud::build(std::vector<Vector3d>{{0, 0, 0}}, 0.01)};
  for (const Shape& outer : around) {
    for (const Shape& inner : inside) {
      for (const bool swapped : {false, true}) {
        const UniformMotion out = flight({0.1, 0, 0}, {9, 0, 0});
        const ContinuousResult result = swapped ? continuousCollide(inner, out, outer, kStill)
                                                : continuousCollide(outer, kStill, inner, out);
        EXPECT_EQ(result.verdict, Verdict::Collision);
        EXPECT_EQ(result.freeUntil, 0.0);
        EXPECT_EQ(result.contactBy, 0.0);
        EXPECT_LT((result.pointA - result.pointB).norm(), 1e-9);
      }
    }
  }
  // Surfaces have nothing inside.
  std::vector<Vector3d> corners = std::get<TriangleMesh>(around[2]).vertices();
  const Shape hollow = TriangleMesh::build(corners, std::get<TriangleMesh>(around[2]).triangles(),
                                           MeshInterior::Surface);
  expectFirstContact(
      continuousCollide(hollow, kStill, makeSphere(0.1), flight({0, 0, 0}, {9, 0, 0}), to(1e-6)),
      0.1, 1e-6);
}

TEST(ContinuousCollide, MarginsAreKept) {
  ContinuousOptions options = to(1e-6);
  options.margin = 0.25;
  const Shape box = makeBox({1, 1, 1});
  const UniformMotion motion = flight({-3, 0, 0}, {5, 0, 0});
  expectFirstContact(continuousCollide(box, kStill, box, motion, options), (3.0 - 1.25) / 8.0,
                     1e-6);
  expectFirstContact(continuousCollide(boxMesh({1, 1, 1}), kStill, box, motion, options),
                     (3.0 - 1.25) / 8.0, 1e-6);
  EXPECT_EQ(
      continuousCollide(box, kStill, box, flight({-3, 1.26, 0}, {5, 1.26, 0}), options).verdict,
      Verdict::Free);
}

TEST(ContinuousCollide, StopsAtTheTimeTolerance) {
  ContinuousOptions options = to(1e-12);
  options.timeTolerance = 1e-3;
  const ContinuousResult coarse = continuousCollide(
      boxMesh({1, 1, 1}), kStill, makeSphere(0.3),
      UniformMotion::turning(at(3, 0, 0), Vector3d(0, 0, 0.7), Vector3d(-6, 0.2, 0)), options);
  EXPECT_EQ(coarse.verdict, Verdict::Collision);
  EXPECT_LE(coarse.contactBy - coarse.freeUntil, 2e-3);
}

/// Sliding along a wall at no distance at all can be neither proven nor refuted.
TEST(ContinuousCollide, GrazingIsUndecided) {
  const Shape box = makeBox({1, 1, 1});
  const ContinuousResult grazing =
      continuousCollide(makeHalfSpace(Vector3d::UnitY(), 0.0), kStill, box,
                        flight({-3, 0.5 + 1e-16, 0}, {5, 0.5 + 1e-16, 0}), to(1e-3));
  EXPECT_NE(grazing.verdict, Verdict::Free);
  const ContinuousResult lifted =
      continuousCollide(makeHalfSpace(Vector3d::UnitY(), 0.0), kStill, box,
                        flight({-3, 0.5 + 1e-9, 0}, {5, 0.5 + 1e-9, 0}), to(1e-3));
  EXPECT_EQ(lifted.verdict, Verdict::Free);
}

TEST(ContinuousCollide, CapsEndTheSearch) {
  ContinuousOptions options = to(1e-6);
  options.maxIntervals = 3;
  const UniformMotion turning =
      UniformMotion::turning(at(0, 0, 0), Vector3d(0, 0, 40), Vector3d::Zero());
  const ContinuousResult result =
      continuousCollide(makeBox({2, 0.2, 0.2}), turning, makeSphere(0.1),
                        UniformMotion::still(at(1.2, 0, 0)), options);
  EXPECT_EQ(result.verdict, Verdict::Undecided);
  EXPECT_LE(result.effort.intervals, 3);
  EXPECT_LT(result.freeUntil, 1.0);
}

/// A crumb that is far away and moves by many times its size within the tolerance.
TEST(ContinuousCollide, SmallAndFastBodies) {
  const Shape crumb = boxMesh({0.01, 0.01, 0.01});
  const UniformMotion motion =
      UniformMotion::turning(at(-200, 0, 0), Vector3d(1, 2, 3), Vector3d(400, 0, 0));
  for (const double tolerance : {1.0, 0.1, 1e-3, 1e-6}) {
    const Shape plate = makeEllipsoid({1e-4, 10, 10});
    const auto beside = UniformMotion::still(at(0, 12.0, 0));
    const ContinuousResult passed = continuousCollide(crumb, motion, plate, beside, to(tolerance));
    EXPECT_EQ(passed.verdict, Verdict::Free) << tolerance;
    EXPECT_LT(passed.effort.intervals, 100);
    const ContinuousResult hit = continuousCollide(crumb, motion, plate, kStill, to(tolerance));
    EXPECT_NE(hit.verdict, Verdict::Free) << tolerance;
    EXPECT_NEAR(hit.freeUntil, 0.5, (0.02 + tolerance) / 400.0);
    EXPECT_LT(hit.effort.intervals, 100);
  }
}

/// Planes and half-spaces that turn have no bounded speed of their own; what passes them has.
TEST(ContinuousCollide, MovingPlanes) {
  const Shape plane = makePlane(Vector3d::UnitZ(), 0.0);
  const UniformMotion tilting =
      UniformMotion::turning(at(0, 0, 0), Vector3d(0, 1.0, 0), Vector3d::Zero());
  const Shape ball = makeSphere(0.25);
  // The plane turns about y: at x = 1 its height is -tan(angle).
  const UniformMotion below = UniformMotion::still(at(1, 0, -0.75));
  const double angle = std::atan2(0.75, 1.0) - std::asin(0.25 / std::hypot(0.75, 1.0));
  expectFirstContact(continuousCollide(plane, tilting, ball, below, to(1e-7)), angle, 1e-6);
  const UniformMotion above = UniformMotion::still(at(1, 0, 0.75));
  EXPECT_EQ(continuousCollide(ball, above, plane, tilting, to(1e-7)).verdict, Verdict::Free);
  // Parallel ones meet, or keep their distance; turned ones meet at once.
  const Shape half = makeHalfSpace(Vector3d::UnitZ(), -1.0);
  expectFirstContact(
      continuousCollide(plane, flight({0, 0, 0}, {0, 0, -4}), half, kStill, to(1e-7)), 0.25, 1e-6);
  EXPECT_EQ(continuousCollide(plane, flight({0, 0, 0}, {0, 0, 4}), half, kStill, to(1e-7)).verdict,
            Verdict::Free);
  const ContinuousResult turned = continuousCollide(plane, tilting, half, kStill, to(1e-7));
  EXPECT_EQ(turned.verdict, Verdict::Collision);
  EXPECT_LT(turned.contactBy, 1e-9);
}

/// Goes nowhere from some t on.
class Lost : public Motion {
 public:
  Lost() : Motion(Vector3d::Zero()) {}
  Isometry3d at(double t) const override {
    Isometry3d pose = Isometry3d::Identity();
    pose.translation().x() = t < 0.4 ? 0.0 : std::numeric_limits<double>::quiet_NaN();
    return pose;
  }
  Twist velocity(double /*t*/) const override { return {}; }
  MotionRates rates(double /*from*/, double /*to*/) const override { return {1.0, 0, 0, 0}; }
  double rounding(double /*reach*/) const override { return 0.0; }
};

/// Half-spaces that face each other, parallel and apart at 0, 0.5 and 1, and cross far out between:
/// no bound is known of what turns and has no end.
TEST(ContinuousCollide, EndlessBodiesThatTurnAreNotFree) {
  const Shape below = makeHalfSpace({0, 0, 1}, 0.0), above = makeHalfSpace({0, 0, -1}, -1.0);
  const std::vector<ControlPose> sway{{Vector3d::Zero(), Vector3d::Zero()},
                                      {Vector3d::Zero(), Vector3d(0.3, 0, 0)},
                                      {Vector3d::Zero(), Vector3d(-0.3, 0, 0)},
                                      {Vector3d::Zero(), Vector3d::Zero()}};
  const SplineMotion motion = SplineMotion::bezier(Eigen::Matrix3d::Identity(), sway);
  const SplineMotion nod = SplineMotion::bezier(
      Eigen::Matrix3d::Identity(),
      std::vector<ControlPose>(4, ControlPose{Vector3d::Zero(), Vector3d::Zero()}));
  for (const auto& [a, b] : {std::pair<const Motion*, const Motion*>(&kStill, &motion),
                             std::pair<const Motion*, const Motion*>(&motion, &nod)}) {
    const ContinuousResult result = continuousCollide(below, *a, above, *b);
    EXPECT_NE(result.verdict, Verdict::Free);
    EXPECT_LT(result.freeUntil, 1e-6);
  }
}

/// A plate that lies flat against a face is through it at once, and inside for a while.
TEST(ContinuousCollide, APlateIsInsideAsSoonAsItIsThrough) {
  const test::Soup box = test::boxSoup({-1, -1, -1}, {1, 1, 1});
  const Shape solid = TriangleMesh::build(box.vertices, box.triangles);
  const Shape plate =
      Triangle{{Vector3d(-0.2, -0.1, 0), Vector3d(0.3, -0.1, 0), Vector3d(0, 0.2, 0)}};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> drift(-0.3, 0.3);
  for (int i = 0; i < 200; ++i) {
    const Vector3d from(drift(random), drift(random), 1.4 + drift(random));
    const Vector3d way(drift(random), drift(random), -1.9);
    const double first = (from.z() - 1.0) / 1.9;
    const ContinuousResult found =
        continuousCollide(solid, kStill, plate, flight(from, from + way), to(1e-6));
    ASSERT_EQ(found.verdict, Verdict::Collision) << i;
    EXPECT_LE(found.freeUntil, first + 1e-12) << i;
    EXPECT_GE(found.contactBy, first - 1e-12) << i;
    EXPECT_LE((found.contactBy - found.freeUntil) * way.norm(), 1.000001e-6) << i;
  }
}

/// Dust that is through a sheet in a tenth of the tolerance of time, one mote after the other.
TEST(ContinuousCollide, WhatIsThroughWithinTheTimeToleranceIsFound) {
  const test::Soup box = test::boxSoup({-1, -1, -0.01}, {1, 1, 0.01});
  const Shape sheets = TriangleMesh::build(box.vertices, box.triangles, MeshInterior::Surface);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  constexpr double kRadius = 2e-4, kSpeed = 400.0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Vector3d> motes;
    for (int j = 0; j < 5; ++j) motes.push_back({2e-3 * unit(random), 0.0, 4e-3 * unit(random)});
    double lowest = kInfinity;
    for (const Vector3d& mote : motes) lowest = std::min(lowest, mote.z());
    const Shape dust = PointCloud::build(motes, kRadius);
    const Vector3d from{0.2 * unit(random), 0.2 * unit(random), 200.0 + 100.0 * unit(random)};
    const double first = (from.z() + lowest - kRadius - 0.01) / kSpeed;
    ContinuousOptions options = to(1e-5);
    options.timeTolerance = 2e-5;
    const ContinuousResult found = continuousCollide(
        sheets, kStill, dust, flight(from, from - kSpeed * Vector3d::UnitZ()), options);
    expectFirstContact(found, first, options.timeTolerance);
    EXPECT_LE(found.contactBy - found.freeUntil, options.timeTolerance) << i;
  }
}

TEST(ContinuousCollide, WhatIsNotFiniteIsUndecided) {
  const Shape ball = makeSphere(0.1);
  const ContinuousResult lost =
      continuousCollide(ball, Lost(), ball, UniformMotion::still(at(1, 0, 0)));
  EXPECT_EQ(lost.verdict, Verdict::Undecided);
  EXPECT_LT(lost.freeUntil, 0.4);
  const UniformMotion motion = flight({-3, 0, 0}, {5, 0, 0});
  for (const double bad : {-1.0, kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    ContinuousOptions options;
    options.margin = bad;
    EXPECT_EQ(continuousCollide(ball, kStill, ball, motion, options).verdict, Verdict::Undecided);
  }
  for (const double bad : {kInfinity, -kInfinity, std::numeric_limits<double>::quiet_NaN()}) {
    ContinuousOptions length, time;
    length.tolerance = time.timeTolerance = bad;
    for (const ContinuousOptions& options : {length, time}) {
      const ContinuousResult result = continuousCollide(ball, kStill, ball, motion, options);
      EXPECT_EQ(result.verdict, Verdict::Undecided) << bad;
      EXPECT_EQ(result.freeUntil, 0.0) << bad;
    }
  }
  for (const double bad : {-1.0, 0.0}) {
    ContinuousOptions options;
    options.tolerance = bad;
    const ContinuousResult result = continuousCollide(ball, kStill, ball, motion, options);
    EXPECT_LE(result.freeUntil, 2.8 / 8.0 + 1e-12);
    EXPECT_LT(result.effort.intervals, 1000);
  }
}

/// Lengths whose squares underflow: a ball that goes through a plane at t = 0.8.
TEST(ContinuousCollide, NothingIsProvenOfWhatIsTooSmallToMeasure) {
  int decided = 0;
  for (int power = -300; power <= 0; power += 5) {
    const double s = std::pow(10.0, power);
    const UniformMotion motion = flight({0, 3.0 * s, 0}, {0, 0.5 * s, 0});
    const ContinuousResult found = continuousCollide(makeHalfSpace(Vector3d::UnitY(), 0.0), kStill,
                                                     makeSphere(s), motion, to(1e-6 * s));
    EXPECT_NE(found.verdict, Verdict::Free) << power;
    EXPECT_LE(found.freeUntil, 0.8) << power;
    decided += found.verdict == Verdict::Collision ? 1 : 0;
  }
  EXPECT_GT(decided, 20) << "most are large enough";
}

/// Workspaces hold memory, no answers.
TEST(ContinuousCollide, WorkspacesDoNotMatter) {
  std::mt19937 random(4);
  const test::Soup blob = test::blobSoup(random, 12, 16);
  const Shape mesh = TriangleMesh::build(blob.vertices, blob.triangles);
  ContinuousWorkspace workspace;
  int hits = 0;
  for (int i = 0; i < 40; ++i) {
    const Vector3d from = 4.0 * test::unitVector(random), goal = 3.0 * test::unitVector(random);
    const UniformMotion motion = UniformMotion::turning(
        Isometry3d(Translation3d(from)), 2.0 * test::unitVector(random), goal - from);
    const ContinuousResult used =
        continuousCollide(mesh, kStill, mesh, motion, to(1e-5), workspace);
    const ContinuousResult fresh = continuousCollide(mesh, kStill, mesh, motion, to(1e-5));
    EXPECT_EQ(used.verdict, fresh.verdict);
    EXPECT_EQ(used.freeUntil, fresh.freeUntil);
    EXPECT_EQ(used.contactBy, fresh.contactBy);
    EXPECT_EQ(used.pointA, fresh.pointA);
    EXPECT_EQ(used.effort.leafTests, fresh.effort.leafTests);
    hits += used.verdict == Verdict::Collision;
  }
  EXPECT_GT(hits, 5);
  EXPECT_LT(hits, 40);
}

}  // namespace
}  // namespace swept
