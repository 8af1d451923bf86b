// SPDX-License-Identifier: BSD-3-Clause
// What no answer can be given about is refused by name and value, or answered with the widest
// interval.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/signed_distance.hpp"
#include "swept/robot_model/checker.hpp"

namespace {

using namespace swept;
using Eigen::Isometry3d;
using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kDenormal = 5e-324;

/// The message of the std::invalid_argument that `make` throws.
template <class Make>
std::string refusal(const Make& make) {
  try {
    make();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "nothing was refused";
}

Isometry3d posed(double x) {
  return Isometry3d(Eigen::Translation3d(x, 0.0, 0.0));
}

Isometry3d bent(double by) {
  Isometry3d pose = Isometry3d::Identity();
  pose.linear()(0, 1) += by;
  return pose;
}

TEST(BadInput, SizesAreFiniteAndNotNegative) {
  const std::string allowed = "allowed: finite and not negative";
  for (const double bad : {kNan, kInfinity, -kInfinity, -1.0, -kDenormal}) {
    EXPECT_THAT(refusal([&] { makeSphere(bad); }), HasSubstr(allowed)) << bad;
    EXPECT_THAT(refusal([&] { makeBox({1.0, bad, 1.0}); }), HasSubstr(allowed)) << bad;
    EXPECT_THAT(refusal([&] { makeCylinder(bad, 1.0); }), HasSubstr(allowed)) << bad;
    EXPECT_THAT(refusal([&] { makeCapsule(1.0, bad); }), HasSubstr(allowed)) << bad;
    EXPECT_THAT(refusal([&] { makeCone(bad, 1.0); }), HasSubstr(allowed)) << bad;
    EXPECT_THAT(refusal([&] { makeEllipsoid({1.0, 1.0, bad}); }), HasSubstr(allowed)) << bad;
    const std::vector<Vector3d> point = {Vector3d::Zero()};
    EXPECT_THAT(refusal([&] { PointCloud::build(point, bad); }), HasSubstr(allowed)) << bad;
  }
  EXPECT_EQ(refusal([] { makeSphere(kNan); }), "sphere radius is nan; " + allowed);
  EXPECT_NO_THROW(makeSphere(kDenormal));
  EXPECT_NO_THROW(makeSphere(std::numeric_limits<double>::max()));
}

TEST(BadInput, CoordinatesAreFinite) {
  const std::string allowed = "allowed: finite coordinates";
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    const std::vector<Vector3d> points = {{0, 0, 0}, {1, 0, 0}, {0, bad, 0}};
    const std::vector<Eigen::Vector3i> faces = {{0, 1, 2}};
    EXPECT_THAT(refusal([&] { ConvexHull::of(points); }), HasSubstr("finite")) << bad;
    EXPECT_THAT(refusal([&] { TriangleMesh::build(points, faces); }), HasSubstr("mesh vertex 2"));
    EXPECT_THAT(refusal([&] { TriangleMesh::build(points, faces); }), HasSubstr(allowed));
    EXPECT_THAT(refusal([&] { PointCloud::build(points, 0.1); }), HasSubstr("point 2"));
    EXPECT_THAT(refusal([&] { makeTriangle(points[0], points[1], points[2]); }),
                HasSubstr("triangle corner 2"));
    EXPECT_THAT(refusal([&] { makePlane({0, 0, 1}, bad); }), HasSubstr("plane has normal"));
    EXPECT_THAT(refusal([&] {
                  makeHalfSpace({0, bad, 1}, 0);
                }),
                HasSubstr("half-space has normal"));
  }
  for (const double small : {0.0, kDenormal, 1e-310}) {
    EXPECT_THAT(refusal([&] {
                  makePlane({0, 0, small}, 1.0);
                }),
                HasSubstr("a normal that is not zero"));
  }
}

TEST(BadInput, PosesThatAreNotFiniteGiveTheWidestAnswer) {
  const Shape ball = makeSphere(0.5);
  const Shape box = makeBox({1, 1, 1});
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    const auto apart = distance(ball, box, posed(bad));
    EXPECT_EQ(apart.lower, 0.0);
    EXPECT_EQ(apart.upper, kInfinity);
    const auto both = signedDistance(ball, box, posed(bad));
    EXPECT_EQ(both.lower, -kInfinity);
    EXPECT_EQ(both.upper, kInfinity);
    EXPECT_EQ(collide(ball, box, posed(bad)), Contact::Unknown);
    const auto turned = distance(box, box, bent(bad));
    EXPECT_EQ(turned.lower, 0.0);
    EXPECT_EQ(turned.upper, kInfinity);
  }
}

TEST(BadInput, MotionsAreOfRotations) {
  EXPECT_THAT(refusal([] { UniformMotion::still(bent(1e-5)); }),
              HasSubstr("a linear part that is no rotation"));
  EXPECT_NO_THROW(UniformMotion::still(bent(1e-7)));
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    EXPECT_THAT(refusal([&] { UniformMotion::still(posed(bad)); }), HasSubstr("is not finite"));
    EXPECT_THAT(refusal([&] {
                  UniformMotion::translation(posed(0), {0, bad, 0});
                }),
                HasSubstr("is not finite"));
    EXPECT_THAT(refusal([&] {
                  UniformMotion::turning(posed(0), {0, bad, 0}, Vector3d::Zero());
                }),
                HasSubstr("is not finite"));
  }
  ContinuousOptions options;
  const auto still = UniformMotion::still(posed(0));
  const auto away = UniformMotion::still(posed(3));
  for (const double bad : {kNan, kInfinity, -1.0}) {
    options.margin = bad;
    const auto found = continuousCollide(makeSphere(1), still, makeSphere(1), away, options);
    EXPECT_EQ(found.verdict, Verdict::Undecided);
    EXPECT_EQ(found.freeUntil, 0.0);
  }
}

/// A ball on a slide before a wall.
std::shared_ptr<const Robot> slide() {
  return Robot::parse(
      "<robot name='slide'><link name='base'/><link name='tip'><collision><geometry>"
      "<sphere radius='0.1'/></geometry></collision></link><joint name='x' type='prismatic'>"
      "<parent link='base'/><child link='tip'/><axis xyz='1 0 0'/>"
      "<limit lower='-2' upper='2' effort='1' velocity='1'/></joint></robot>",
      "slide.urdf");
}

TEST(BadInput, ConfigurationsThatAreNotFiniteAreUndecided) {
  World world;
  world.add("wall", makeBox({0.1, 2, 2}), posed(1.0));
  const Checker checker(slide(), "all", std::make_shared<const World>(world));
  Workspace workspace(checker);
  const std::vector<double> good = {0.0};
  for (const double bad : {kNan, kInfinity, -kInfinity}) {
    const std::vector<double> q = {bad};
    EXPECT_EQ(checker.checkState(q, workspace), Verdict::Undecided);
    EXPECT_FALSE(checker.reportState(q, workspace).finite);
    EXPECT_EQ(checker.clearance(q, workspace), 0.0);
    for (const auto& [from, to] : {std::pair(good, q), std::pair(q, good), std::pair(q, q)}) {
      EXPECT_EQ(checker.certifyMotion(from, to, workspace).verdict, Verdict::Undecided);
      EXPECT_EQ(checker.motionClearance(from, to, 1e-3, workspace).lower, 0.0);
    }
  }
  for (const double bad : {kNan, -kInfinity, 0.0}) {
    EXPECT_THAT(refusal([&] { checker.motionClearance(good, good, bad, workspace); }),
                HasSubstr("must be greater than zero"));
  }
  // However rough, a bound is one: the ball is 0.85 m from the wall.
  const auto rough = checker.motionClearance(good, good, kInfinity, workspace);
  EXPECT_LE(rough.lower, 0.85 + 1e-12);
  EXPECT_GE(rough.upper, 0.85 - 1e-12);
  EXPECT_THAT(refusal([&] {
                checker.checkState(std::vector<double>{0, 0}, workspace);
              }),
              HasSubstr("has 1 values, not 2"));
}

TEST(BadInput, CheckersHaveFiniteMargins) {
  const auto world = std::make_shared<const World>();
  const auto refused = [&](const CheckerOptions& options) {
    return refusal([&] { Checker(slide(), "all", world, options); });
  };
  for (const double bad : {kNan, kInfinity, -1.0}) {
    CheckerOptions options;
    options.margin = bad;
    EXPECT_THAT(refused(options), HasSubstr("must be a finite number that is not negative"));
    options = {};
    options.tolerance = bad;
    EXPECT_THAT(refused(options), HasSubstr("must be a finite number greater than zero"));
  }
}

TEST(BadInput, WorldsHaveRigidPoses) {
  World world;
  for (const Isometry3d& pose : {posed(kNan), posed(kInfinity), bent(1e-8), bent(kNan)}) {
    EXPECT_THAT(refusal([&] { world.add("body", makeSphere(1), pose); }),
                HasSubstr("'body' is no finite rigid transform"));
  }
  EXPECT_NO_THROW(world.add("body", makeSphere(1), bent(1e-10)));
}

TEST(BadInput, UrdfNumbersAreFinite) {
  for (const char* radius : {"nan", "inf", "-1", "1e999"}) {
    const std::string text =
        std::string("<robot name='r'><link name='base'><collision><geometry>") +
        "<sphere radius='" + radius + "'/></geometry></collision></link></robot>";
    try {
      Robot::parse(text, "r.urdf");
      ADD_FAILURE() << "nothing was refused: " << radius;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("r.urdf:1: error: ")) << radius;
    }
  }
}

}  // namespace
