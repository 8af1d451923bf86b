// SPDX-License-Identifier: BSD-3-Clause
// The classes behind the cases of cases.txt, with sizes, turns and gaps of their own and answers
// from a formula.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "shape_pair_case.hpp"

namespace swept::test {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

class ShapePairClass : public testing::Test {
 protected:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  /// Of any order of magnitude between the two.
  double size(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int pick(int count) { return std::uniform_int_distribution<int>(0, count - 1)(random_); }
  double sign() { return pick(2) == 0 ? -1.0 : 1.0; }

  Isometry3d anyMotion(double reach) {
    std::normal_distribution<double> normal;
    const double w = normal(random_), x = normal(random_), y = normal(random_);
    Isometry3d motion = Isometry3d::Identity();
    motion.linear() = Eigen::Quaterniond(w, x, y, normal(random_)).normalized().toRotationMatrix();
    motion.translation() = reach * Vector3d{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
    return motion;
  }

  /// A box, or the hull of its corners: the same set by another route.
  ShapeText block(const Vector3d& full) {
    if (pick(2) == 0) return {"box", {full.x(), full.y(), full.z()}};
    ShapeText text{"convex", {}};
    for (int corner = 0; corner < 8; ++corner)
      for (int axis = 0; axis < 3; ++axis)
        text.numbers.push_back((corner >> axis & 1 ? 0.5 : -0.5) * full[axis]);
    return text;
  }

  Vector3d anyFull() { return {size(0.01, 10.0), size(0.01, 10.0), size(0.01, 10.0)}; }

  /// Checks it as it stands and under a common motion.
  void expectEverywhere(const ShapeText& a, const ShapeText& b, const Isometry3d& a_from_b,
                        double signedDistance, double tolerance) {
    ShapePairCase item{::testing::UnitTest::GetInstance()->current_test_info()->name(),
                       "a formula",
                       a,
                       b,
                       {},
                       {},
                       signedDistance,
                       tolerance,
                       1.0};
    item.world_from_a = Eigen::Affine3d::Identity();
    item.world_from_b = a_from_b;
    expectRight(item);
    expectRight(item.moved(anyMotion(5.0)));
  }

  static Isometry3d shift(const Vector3d& by) {
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = by;
    return pose;
  }

 private:
  std::mt19937_64 random_{7};
};

constexpr int kEach = 60;

/// fcl#493, #495, #398: parallel faces at, just above and just below touching.
TEST_F(ShapePairClass, BlocksWhoseFacesKiss) {
  int asked = 0;
  for (int i = 0; i < kEach; ++i) {
    const Vector3d a = anyFull(), b = anyFull();
    const int axis = pick(3);
    const double scale = std::max(a.maxCoeff(), b.maxCoeff());
    const double gap = pick(3) == 0 ? 0.0 : sign() * scale * size(1e-16, 1e-4);
    // A shallow gap is the depth only if no other way out is shorter.
    if (-gap > 0.2 * std::min(a.minCoeff(), b.minCoeff())) continue;
    Vector3d offset;
    for (int k = 0; k < 3; ++k) offset[k] = uniform(-0.1, 0.1) * std::min(a[k], b[k]);
    offset[axis] = sign() * (0.5 * a[axis] + 0.5 * b[axis] + gap);
    expectEverywhere(block(a), block(b), shift(offset), gap, 1e-9 * scale);
    ++asked;
  }
  EXPECT_GT(asked, kEach / 2);
}

/// fcl#508: apart along one axis, right beyond x only.
TEST_F(ShapePairClass, BlocksFarApartAlongAnyAxis) {
  for (int i = 0; i < kEach; ++i) {
    const Vector3d a = anyFull(), b = anyFull();
    const int axis = i % 3;
    const double gap = size(0.1, 100.0);
    Vector3d offset;
    for (int k = 0; k < 3; ++k) offset[k] = uniform(-0.5, 0.5) * (a[k] + b[k]);
    offset[axis] = sign() * (0.5 * a[axis] + 0.5 * b[axis] + gap);
    expectEverywhere(block(a), block(b), shift(offset), gap, 1e-9 * (1.0 + gap));
  }
}

/// fcl#346, #415: the same centre, or the same centre but for one axis.
TEST_F(ShapePairClass, BodiesWithTheSameCentre) {
  for (int i = 0; i < kEach; ++i) {
    const Vector3d a = anyFull(), b = anyFull();
    const double r = size(0.01, 10.0), s = size(0.01, 10.0);
    const double scale = std::max({a.maxCoeff(), b.maxCoeff(), r, s});
    expectEverywhere({"sphere", {r}}, {"sphere", {s}}, shift(Vector3d::Zero()), -(r + s),
                     1e-9 * scale);
    expectEverywhere(block(a), block(b), shift(Vector3d::Zero()), -0.5 * (a + b).minCoeff(),
                     1e-9 * scale);
    expectEverywhere(block(a), {"sphere", {r}}, shift(Vector3d::Zero()), -(0.5 * a.minCoeff() + r),
                     1e-9 * scale);
    expectEverywhere({"capsule", {r, s}}, {"sphere", {r}}, shift(Vector3d::Zero()), -2.0 * r,
                     1e-9 * scale);
  }
}

/// drake#8049: turned upside down, its depth in the ground is another one.
TEST_F(ShapePairClass, CylindersTurnedInTheGround) {
  const ShapeText ground{"halfspace", {0.0, 0.0, 1.0, 0.0}};
  for (int i = 0; i < kEach; ++i) {
    const double radius = size(0.01, 1.0), length = size(0.01, 1.0);
    Isometry3d pose = Isometry3d::Identity();
    const double angle = i % 2 == 0 ? 0.5 * std::numbers::pi * (i / 2 % 4) : uniform(-4.0, 4.0);
    pose.linear() = Eigen::AngleAxisd(angle, i % 3 == 0 ? Vector3d::UnitX() : Vector3d::UnitY())
                        .toRotationMatrix();
    pose.translation().z() = uniform(-1.0, 1.0) * (radius + length);
    const double reach =
        0.5 * length * std::abs(std::cos(angle)) + radius * std::abs(std::sin(angle));
    expectEverywhere(ground, {"cylinder", {radius, length}}, pose, pose.translation().z() - reach,
                     1e-12);
  }
}

/// fcl#316, #321: spheres that only just enter a face, a side or an end.
TEST_F(ShapePairClass, SpheresJustInsideAFace) {
  for (int i = 0; i < kEach; ++i) {
    const double radius = size(0.01, 1.0), depth = sign() * radius * size(1e-9, 0.05);
    const double half = size(0.5, 5.0), side = half * uniform(-0.8, 0.8);
    const double tolerance = 1e-12 * half;
    const double height = half + radius - depth;
    expectEverywhere({"box", {10.0, 10.0, 2.0 * half}}, {"sphere", {radius}},
                     shift({side, -side, sign() * height}), -depth, tolerance);
    expectEverywhere({"cylinder", {10.0, 2.0 * half}}, {"sphere", {radius}},
                     shift({side, side, sign() * height}), -depth, tolerance);
    expectEverywhere({"cylinder", {half, 100.0}}, {"sphere", {radius}},
                     shift({0.0, sign() * height, side}), -depth, 10.0 * tolerance);
  }
}

/// fcl#568, #31: a capsule with one end at a box's face.
TEST_F(ShapePairClass, CapsulesEndingAtAFace) {
  for (int i = 0; i < kEach; ++i) {
    const double radius = size(0.1, 5.0), length = size(0.5, 50.0);
    const double half = 10.0 * radius;
    const double gap = uniform(-0.9, 2.0) * radius;
    // The axis rises from its lower end, which is nearest the face.
    const Vector3d axis =
        Vector3d{uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(0.2, 1.0)}.normalized();
    const Vector3d end{uniform(-0.5, 0.5) * half, uniform(-0.5, 0.5) * half, half + radius + gap};
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() =
        Eigen::Quaterniond::FromTwoVectors(sign() * Vector3d::UnitZ(), axis).toRotationMatrix();
    pose.translation() = end + 0.5 * length * axis;
    expectEverywhere({"box", {2.0 * half, 2.0 * half, 2.0 * half}}, {"capsule", {radius, length}},
                     pose, gap, 1e-9 * half);
  }
}

/// coal:test/gjk.cpp triangle_capsule, JoltPhysics#1008: a flat triangle, edge first.
TEST_F(ShapePairClass, TrianglesEdgeFirstIntoRoundSides) {
  for (int i = 0; i < kEach; ++i) {
    const double radius = size(0.1, 2.0), length = size(1.0, 4.0);
    const double gap = uniform(-1.0, 1.0) * std::min(radius, 0.4 * length);
    const double edge = radius + gap, far = 20.0;
    const ShapeText triangle{"triangle", {edge, -far, 0.0, edge, far, 0.0, edge + far, 0.0, 0.0}};
    const double height = uniform(-0.05, 0.05) * length;
    const double turn = uniform(-3.0, 3.0);
    Isometry3d pose = shift({0.0, 0.0, height});
    pose = Eigen::AngleAxisd(turn, Vector3d::UnitZ()) * pose;
    expectEverywhere({"capsule", {radius, length}}, triangle, pose, gap, 1e-9 * far);
    expectEverywhere({"cylinder", {radius, length}}, triangle, pose, gap, 1e-9 * far);
  }
}

/// fcl:test/test_fcl_box_box.cpp, coal:test/box_box_distance.cpp: an edge on a face.
TEST_F(ShapePairClass, BlocksTurnedOntoAnEdge) {
  for (int i = 0; i < kEach; ++i) {
    const double half = size(0.1, 5.0), other = half * uniform(0.2, 1.0);
    const double gap = (pick(2) == 0 ? -0.2 : 2.0) * other * uniform(0.0, 1.0);
    Isometry3d pose = Isometry3d::Identity();
    pose.linear() =
        Eigen::AngleAxisd(0.25 * std::numbers::pi, Vector3d::UnitZ()).toRotationMatrix();
    pose.translation() = Vector3d{half + std::numbers::sqrt2 * other + gap,
                                  uniform(-0.3, 0.3) * half, uniform(-0.3, 0.3) * half};
    expectEverywhere(block(Vector3d::Constant(2.0 * half)), block(Vector3d::Constant(2.0 * other)),
                     pose, gap, 1e-9 * half);
  }
}

/// fcl#640, coal#879: what is made of meshes answers in the right frame.
TEST_F(ShapePairClass, SpheresAtTerrainAndVoxels) {
  for (int i = 0; i < kEach; ++i) {
    const double radius = size(0.05, 0.5), depth = uniform(-1.0, 0.9) * radius;
    const Vector3d over{uniform(-1.0, 1.0), uniform(-1.0, 1.0), 0.5 + radius - depth};
    expectEverywhere({"flat_terrain", {4.0, 4.0, 5.0, 7.0, 0.5, -3.0}}, {"sphere", {radius}},
                     shift(over), -depth, 1e-9);
    const double gap = size(0.01, 10.0);
    expectEverywhere({"voxels", {0.25, 8.0, 0.0, 0.0, 8.0, 2.0, 0.0, 11.0, 0.0, 4.0}},
                     {"sphere", {radius}}, shift({2.0 - radius - gap, 0.1, 0.1}), gap, 1e-9);
  }
}

}  // namespace
}  // namespace swept::test
