// SPDX-License-Identifier: BSD-3-Clause
// What is executed of a path, against the formulas of circles and splines.
#include "report/executed_curves.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "message_of.hpp"
#include "robot_model/sliding_cube.hpp"
#include "urdf_text.hpp"

namespace swept {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::messageOf;

/// A walk of steps between 0.05 and 2 in so many dimensions.
MatrixXd randomPath(std::mt19937& random, int dimension, int count) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> exponent(std::log(0.05), std::log(2.0));
  MatrixXd points = MatrixXd::Zero(dimension, count);
  for (int i = 1; i < count; ++i) {
    VectorXd step(dimension);
    for (double& value : step) value = normal(random);
    points.col(i) = points.col(i - 1) + std::exp(exponent(random)) * step.normalized();
  }
  return points;
}

/// The arc of a corner by the formulas of Kunz and Stilman, with the angle from its cosine.
struct Arc {
  Arc(const MatrixXd& points, Eigen::Index corner, double deviation)
      : point(points.col(corner)),
        before((points.col(corner) - points.col(corner - 1)).normalized()),
        after((points.col(corner + 1) - points.col(corner)).normalized()),
        angle(std::acos(before.dot(after))) {
    const double half = 0.5 * std::min((points.col(corner) - points.col(corner - 1)).norm(),
                                       (points.col(corner + 1) - points.col(corner)).norm());
    const double whole = deviation * std::sin(0.5 * angle) / (1.0 - std::cos(0.5 * angle));
    limitedByMotions = half < whole;
    length = std::min(half, whole);
    radius = length / std::tan(0.5 * angle);
    center = point + (after - before) / (after - before).norm() * radius / std::cos(0.5 * angle);
  }
  VectorXd point, before, after, center;
  double angle, length = 0.0, radius = 0.0;  ///< length: from the arc's begin to the way point
  bool limitedByMotions = false;
};

double distanceFromPolyline(const MatrixXd& points, const VectorXd& q) {
  double least = INFINITY;
  for (Eigen::Index i = 0; i + 1 < points.cols(); ++i) {
    const VectorXd line = points.col(i + 1) - points.col(i);
    const double share = std::clamp((q - points.col(i)).dot(line) / line.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (points.col(i) + share * line - q).norm());
  }
  return least;
}

/// Of a random path; counts what its arcs are limited by.
void expectArcs(const MatrixXd& points, double deviation, int& byMotions, int& byDeviation) {
  const PiecewisePolynomial curve = circularBlends(points, deviation);
  EXPECT_EQ(curve.position(0.0), points.col(0));
  EXPECT_LT((curve.position(curve.end()) - points.col(points.cols() - 1)).norm(), 1e-9);
  double begin = 0.0;  // of the straight part before a corner
  double straightFrom = 0.0;
  for (Eigen::Index i = 1; i + 1 < points.cols(); ++i) {
    const Arc arc(points, i, deviation);
    ++(arc.limitedByMotions ? byMotions : byDeviation);
    begin += (arc.point - points.col(i - 1)).norm() - straightFrom - arc.length;
    const double end = begin + arc.radius * arc.angle;
    EXPECT_LT((curve.position(begin) - (arc.point - arc.length * arc.before)).norm(), 3e-9);
    EXPECT_LT((curve.position(end) - (arc.point + arc.length * arc.after)).norm(), 3e-9);
    // Tangent to both straight motions.
    EXPECT_LT((curve.velocity(begin + 1e-12).normalized() - arc.before).norm(), 1e-6);
    EXPECT_LT((curve.velocity(end - 1e-12).normalized() - arc.after).norm(), 1e-6);
    double nearest = INFINITY;
    for (int k = 0; k <= 200; ++k) {
      const VectorXd q = curve.position(begin + (end - begin) * k / 200.0);
      EXPECT_NEAR((q - arc.center).norm(), arc.radius, 3e-9);
      EXPECT_LE(distanceFromPolyline(points, q), deviation + 3e-9);
      nearest = std::min(nearest, (q - arc.point).norm());
    }
    const double expected = arc.radius / std::cos(0.5 * arc.angle) - arc.radius;
    EXPECT_NEAR(nearest, expected, 1e-3 * expected + 1e-9);
    EXPECT_LE(expected, deviation * (1.0 + 1e-9));
    if (!arc.limitedByMotions) {
      EXPECT_NEAR(expected, deviation, 1e-6 * deviation);
    }
    begin = end;
    straightFrom = arc.length;
  }
  for (std::size_t piece = 1; piece < curve.pieces(); ++piece) {
    const MatrixXd& left = curve.coefficients(piece - 1);
    const MatrixXd& right = curve.coefficients(piece);
    const VectorXd leaving = left.col(left.cols() - 1) - left.col(left.cols() - 2);
    const VectorXd arriving = right.col(1) - right.col(0);
    EXPECT_LT((leaving.normalized() - arriving.normalized()).norm(), 1e-6);
  }
}

TEST(ExecutedCurves, BlendsAreTangentArcsWithinTheDeviation) {
  std::mt19937 random(41);
  int byMotions = 0, byDeviation = 0;
  for (int i = 0; i < 150; ++i) {
    const MatrixXd points = randomPath(random, 2 + i % 6, 3 + i % 7);
    for (const double deviation : {0.1, 0.05, 0.01})
      expectArcs(points, deviation, byMotions, byDeviation);
  }
  EXPECT_GT(byMotions, 200);
  EXPECT_GT(byDeviation, 500);
}

TEST(ExecutedCurves, ARightAngleHasAQuarterOfACircle) {
  MatrixXd points(2, 3);
  points << 0, 1, 1, 0, 0, 1;
  const double deviation = 0.1;
  const double radius = deviation / (std::numbers::sqrt2 - 1.0);
  const PiecewisePolynomial curve = circularBlends(points, deviation);
  EXPECT_NEAR(curve.duration(), 2.0 - 2.0 * radius + 0.5 * std::numbers::pi * radius, 1e-12);
  const VectorXd middle = curve.position(0.5 * curve.duration());
  EXPECT_NEAR(middle[0], 1.0 - radius * (1.0 - std::numbers::sqrt2 / 2.0), 1e-9);
  EXPECT_NEAR(middle[1], radius * (1.0 - std::numbers::sqrt2 / 2.0), 1e-9);
}

/// MoveIt leaves such corners as they are.
TEST(ExecutedCurves, StraightAndTurningBackStay) {
  MatrixXd points(2, 4);
  points << 0, 1, 2, 1, 0, 0, 1e-4, 0;
  const PiecewisePolynomial curve = circularBlends(points, 0.1);
  ASSERT_EQ(curve.pieces(), 3u);
  for (std::size_t piece = 0; piece < 3; ++piece) {
    EXPECT_EQ(curve.degree(piece), 1);
    EXPECT_EQ(curve.coefficients(piece).col(1), points.col(static_cast<int>(piece) + 1));
  }
}

TEST(ExecutedCurves, TheSplineIsSmoothAndAtRestAtItsEnds) {
  std::mt19937 random(42);
  for (int i = 0; i < 100; ++i) {
    const MatrixXd points = randomPath(random, 1 + i % 7, 2 + i % 9);
    const PiecewisePolynomial curve = cubicSpline(points);
    ASSERT_EQ(static_cast<Eigen::Index>(curve.pieces()), points.cols() - 1);
    EXPECT_LT(curve.velocity(0.0).norm(), 1e-12);
    EXPECT_LT(curve.velocity(curve.end()).norm(), 1e-12);
    for (std::size_t k = 0; k < curve.pieces(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const MatrixXd& piece = curve.coefficients(k);
      const double time = curve.knots()[k + 1] - curve.knots()[k];
      EXPECT_EQ(piece.col(0), points.col(column));
      EXPECT_EQ(piece.col(3), points.col(column + 1));
      EXPECT_NEAR(time, (points.col(column + 1) - points.col(column)).norm(), 1e-12);
      if (k == 0) continue;
      const MatrixXd& last = curve.coefficients(k - 1);
      const double lastTime = curve.knots()[k] - curve.knots()[k - 1];
      const VectorXd speedBefore = 3.0 / lastTime * (last.col(3) - last.col(2));
      const VectorXd speedAfter = 3.0 / time * (piece.col(1) - piece.col(0));
      EXPECT_LT((speedBefore - speedAfter).norm(), 1e-11);
      const VectorXd bendBefore =
          6.0 / (lastTime * lastTime) * (last.col(3) - 2.0 * last.col(2) + last.col(1));
      const VectorXd bendAfter =
          6.0 / (time * time) * (piece.col(2) - 2.0 * piece.col(1) + piece.col(0));
      EXPECT_LT((bendBefore - bendAfter).norm(), 1e-9 * (1.0 + bendBefore.norm()));
    }
  }
}

/// Three way points on a line, a second apart: the velocity in the middle is 3/4 of 2 m in 1 s.
TEST(ExecutedCurves, ASplineByHand) {
  MatrixXd points(1, 3);
  points << 0, 1, 2;
  const PiecewisePolynomial curve = cubicSpline(points);
  EXPECT_NEAR(curve.velocity(1.0)[0], 1.5, 1e-14);
  EXPECT_NEAR(curve.position(0.5)[0], 0.5 - 1.5 / 8.0, 1e-14);
}

TEST(ExecutedCurves, WayPointsThatRepeatAreLeftOut) {
  MatrixXd points(1, 5);
  points << 0, 0, 1, 1 + 1e-10, 3;
  EXPECT_EQ(polyline(points).knots(), (std::vector<double>{0, 1, 3}));
  EXPECT_EQ(cubicSpline(points).pieces(), 2u);
  EXPECT_EQ(circularBlends(points, 0.1).pieces(), 2u);
}

TEST(ExecutedCurves, RefuseWhatIsNoPath) {
  EXPECT_EQ(messageOf([] { polyline(MatrixXd::Ones(2, 3)); }),
            "a curve needs two way points that differ, but the path has 3 and 1 of them differ");
  EXPECT_EQ(messageOf([] { circularBlends(MatrixXd::Identity(2, 2), 0.0); }),
            "the deviation of blends is 0, allowed is above 0");
}

/// Six values from 3 rad on, in steps of 1 rad that go on beyond half a turn.
TEST(ExecutedCurves, CyclicValuesGoOn) {
  const auto robot = Robot::parse(
      "<robot name='wheel'><link name='base'/><link name='rim'/>" +
          test::joint("spin", "continuous", "base", "rim", "<axis xyz='0 0 1'/>") + "</robot>",
      "wheel.urdf");
  std::vector<std::vector<double>> path;
  for (int i = 0; i < 6; ++i) path.push_back({std::remainder(3.0 + i, 2.0 * std::numbers::pi)});
  const MatrixXd points = continuousWayPoints(*robot, robot->groups()[0], path);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(points(0, i), 3.0 + i, 1e-12);
}

TEST(ExecutedCurves, OrientationsMayNotChange) {
  const auto robot =
      Robot::parse("<robot name='box'><link name='base'/><link name='body'/>" +
                       test::joint("free", "floating", "base", "body", "") + "</robot>",
                   "box.urdf");
  std::vector<std::vector<double>> path{{0, 0, 0, 0, 0, 0, 1}, {1, 0, 0, 0, 0, 0, 1}};
  EXPECT_EQ(continuousWayPoints(*robot, robot->groups()[0], path).col(1)[0], 1.0);
  path.push_back({1, 0, 0, 0, 0, 1, 0});
  EXPECT_EQ(messageOf([&] { continuousWayPoints(*robot, robot->groups()[0], path); }),
            "free/rot_z changes to way point 2: an orientation turns by a slerp, which no "
            "polynomial follows");
}

/// A cube of 0.2 m that slides around a corner at (1, 1), and a block of 0.2 m at (x, z).
class CubeAtACorner {
 public:
  CubeAtACorner(double x, double z)
      : checker_(
            test::slidingCube(), "all",
            [&] {
              auto world = std::make_shared<World>();
              Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
              pose.translation() = Eigen::Vector3d(x, 0.0, z);
              world->add(WorldBody{.name = "block", .parts = {{makeBox({0.2, 0.2, 0.2}), pose}}});
              return world;
            }()),
        workspace_(checker_) {
    points_.resize(2, 3);
    points_ << -1, 1, 1, 1, 1, -1;
  }

  Verdict straight() { return verdict(polyline(points_)); }
  Verdict blended(double deviation) { return verdict(circularBlends(points_, deviation)); }
  Verdict splined() { return verdict(cubicSpline(points_)); }

 private:
  Verdict verdict(const PiecewisePolynomial& curve) {
    return checker_.certifyTrajectory(curve, workspace_).verdict;
  }

  Checker checker_;
  Workspace workspace_;
  MatrixXd points_;
};

/// The corner of the block is 0.01 m from that of the cube in both directions: from the way point,
/// a blend of deviation d goes inwards by d / sqrt(2) in both.
TEST(ExecutedCurves, ABlendCutsIntoWhatThePathGoesAround) {
  CubeAtACorner inside(0.79, 0.79);
  EXPECT_EQ(inside.straight(), Verdict::Free);
  EXPECT_EQ(inside.blended(0.1), Verdict::Collision);
  EXPECT_EQ(inside.blended(0.015), Verdict::Collision);
  EXPECT_EQ(inside.blended(0.013), Verdict::Free);
  EXPECT_EQ(inside.splined(), Verdict::Free);
}

/// The spline swings beyond the corner, the blend stays inside of it.
TEST(ExecutedCurves, ABlendMissesWhatACornerTouches) {
  CubeAtACorner outside(1.19, 1.19);
  EXPECT_EQ(outside.straight(), Verdict::Collision);
  EXPECT_EQ(outside.blended(0.1), Verdict::Free);
  EXPECT_EQ(outside.splined(), Verdict::Collision);
  CubeAtACorner beyond(1.21, 0.7);
  EXPECT_EQ(beyond.straight(), Verdict::Free);
  EXPECT_EQ(beyond.splined(), Verdict::Collision);
}

}  // namespace
}  // namespace swept
