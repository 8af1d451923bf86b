// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/collision_probability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "mesh_samples.hpp"
#include "message_of.hpp"
#include "swept/core/distance.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using test::uniform;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

NoisyPointCloud onePoint(const Vector3d& point, double radius, const Matrix3d& covariance) {
  return NoisyPointCloud::build({{point}}, {{radius}}, {{covariance}});
}

Matrix3d randomFactor(std::mt19937& random, double s) {
  const Vector3d sizes{s, uniform(random, 0.2, 1.0) * s, uniform(random, 0.05, 1.0) * s};
  return test::randomPose(random, 0.0).linear() * sizes.asDiagonal();
}

CollisionProbabilityOptions accurateTo(double accuracy) {
  CollisionProbabilityOptions options;
  options.accuracy = accuracy;
  return options;
}

void expectHolds(const CollisionProbability& found, double truth, double accuracy) {
  EXPECT_LE(found.lower, truth + 1e-11);
  EXPECT_GE(found.upper, truth - 1e-11);
  EXPECT_LE(found.upper - found.lower, accuracy);
  EXPECT_NEAR(found.probability, truth, accuracy);
  EXPECT_EQ(found.standardError, 0.0);
}

/// P(|x| <= radius), x Gaussian about (distance, 0, 0) with deviation s: the density of |x|
/// (noncentral chi, three degrees of freedom) by Simpson's rule.
double noncentralChi(double distance, double radius, double s) {
  const auto density = [&](double r) {
    const double below = (r - distance) / s;
    const double above = (r + distance) / s;
    const double scale = r / (distance * s * std::sqrt(2.0 * std::numbers::pi));
    return scale * (std::exp(-0.5 * below * below) - std::exp(-0.5 * above * above));
  };
  constexpr int kSteps = 4000;
  const double step = radius / kSteps;
  double sum = density(0.0) + density(radius);
  for (int i = 1; i < kSteps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * density(i * step);
  return sum * step / 3.0;
}

double cdf(double x) {
  return 0.5 * (1.0 + std::erf(x / std::sqrt(2.0)));
}

/// P(|mean + factor z| <= radius): lines along the last coordinate of z meet the ball in intervals;
/// the midpoint rule over the others.
double ballByLines(const Vector3d& mean, const Matrix3d& factor, double radius) {
  constexpr int kSteps = 400;
  constexpr double kReach = 6.5;
  const double step = 2.0 * kReach / kSteps;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double u = -kReach + (i + 0.5) * step;
      const double v = -kReach + (j + 0.5) * step;
      const Vector3d origin = mean + factor.col(0) * u + factor.col(1) * v;
      const double a = factor.col(2).squaredNorm();
      const double b = factor.col(2).dot(origin);
      const double root = b * b - a * (origin.squaredNorm() - radius * radius);
      if (root <= 0.0) continue;
      const double inside = cdf((-b + std::sqrt(root)) / a) - cdf((-b - std::sqrt(root)) / a);
      sum += inside * std::exp(-0.5 * (u * u + v * v));
    }
  }
  return sum * step * step / (2.0 * std::numbers::pi);
}

TEST(CollisionProbability, OfAHalfSpaceIsANormalDistribution) {
  std::mt19937 random(1);
  int open = 0;
  for (int i = 0; i < 60; ++i) {
    const Vector3d normal = test::unitVector(random);
    const Isometry3d pose = test::randomPose(random, 1.0);
    const Matrix3d factor = randomFactor(random, 0.1);
    const double radius = i % 2 == 0 ? 0.0 : 0.05;
    const double deviation = (factor.transpose() * (pose.linear() * normal)).norm();
    const double apart = uniform(random, -2.5, 2.5) * deviation;
    const Vector3d along = normal.unitOrthogonal() * uniform(random, 0.0, 2.0);
    const Vector3d point = pose * Vector3d((0.3 + apart + radius) * normal + along);
    const NoisyPointCloud cloud = onePoint(point, radius, factor * factor.transpose());
    const double accuracy = i % 3 == 0 ? 0.001 : 0.02;
    const double truth = cdf(-apart / deviation);
    expectHolds(collisionProbability(cloud, makeHalfSpace(normal, 0.3), pose, accurateTo(accuracy)),
                truth, accuracy);
    open += truth > 0.05 && truth < 0.95 ? 1 : 0;
  }
  EXPECT_GT(open, 30);
}

/// As two clouds and as a cloud and a shape.
TEST(CollisionProbability, OfTwoBallsIsANoncentralChiDistribution) {
  std::mt19937 random(2);
  int open = 0;
  for (int i = 0; i < 40; ++i) {
    const Vector3d point = test::uniformPoint(random, 1.0);
    const double s = uniform(random, 0.02, 0.2);
    const double t = i % 2 == 0 ? 0.0 : 0.1;
    const double both = std::hypot(s, t);
    const double radius = uniform(random, 0.05, 0.4);
    const double apart = i % 8 == 0 ? 1e-3 : uniform(random, 0.3, 1.0) * (radius + both);
    const Isometry3d pose = test::randomPose(random, 1.0);
    const Vector3d other = pose.inverse() * Vector3d(point + apart * test::unitVector(random));
    const auto a = NoisyPointCloud::build({{point}}, 0.3 * radius, s);
    const auto b = NoisyPointCloud::build({{other}}, 0.7 * radius, t);
    const double truth = noncentralChi(apart, radius, both);
    expectHolds(collisionProbability(a, b, pose, accurateTo(1e-7)), truth, 1e-7);
    open += truth > 0.05 && truth < 0.95 ? 1 : 0;
    if (t > 0.0) continue;
    Isometry3d ball = Isometry3d::Identity();
    ball.translation() = pose * other;
    expectHolds(collisionProbability(a, makeSphere(0.7 * radius), ball, accurateTo(0.03)), truth,
                0.03);
  }
  EXPECT_GT(open, 20);
}

/// Below 1e-150 m squares of distances underflow: balls apart were taken for one in the other.
TEST(CollisionProbability, HoldsForNoiseOfAnySize) {
  std::mt19937 random(12);
  for (const double exponent : {-310.0, -300.0, -170.0, -162.0, -161.0, -160.0, -150.0, -100.0,
                                -12.0, 6.0, 100.0, 150.0, 155.0, 200.0, 300.0}) {
    const double s = std::pow(10.0, exponent);
    for (int i = 0; i < 12; ++i) {
      const double radius = uniform(random, 0.2, 2.0);
      const double apart = uniform(random, 0.1, 2.0) * radius;
      const double truth = noncentralChi(apart, radius, 1.0);
      const Vector3d away = apart * s * test::unitVector(random);
      const auto a = NoisyPointCloud::build({{Vector3d::Zero()}}, 0.3 * radius * s, 0.6 * s);
      const auto b = NoisyPointCloud::build({{away}}, 0.7 * radius * s, 0.8 * s);
      const auto pair = collisionProbability(a, b, Isometry3d::Identity(), accurateTo(1e-9));
      EXPECT_LE(pair.lower, truth + 1e-11) << exponent;
      EXPECT_GE(pair.upper, truth - 1e-11) << exponent;
      if (std::abs(exponent) <= 100.0) {
        EXPECT_LE(pair.upper - pair.lower, 1e-9);
      }
      const auto alone = NoisyPointCloud::build({{Vector3d::Zero()}}, 0.3 * radius * s, s);
      Isometry3d pose = Isometry3d::Identity();
      pose.translation() = away;
      const auto ball =
          collisionProbability(alone, makeSphere(0.7 * radius * s), pose, accurateTo(0.03));
      EXPECT_LE(ball.lower, truth + 1e-11) << exponent;
      EXPECT_GE(ball.upper, truth - 1e-11) << exponent;
    }
  }
}

/// With noise that is not the same in all directions, by a series; singular, by an integral.
TEST(CollisionProbability, OfTwoBallsWithUnevenNoise) {
  std::mt19937 random(3);
  int open = 0;
  for (int i = 0; i < 24; ++i) {
    Matrix3d factor = randomFactor(random, 0.2);
    const bool singular = i % 4 == 0;
    if (singular) factor.col(0) *= 0.0;
    const Vector3d mean = test::uniformPoint(random, 0.25);
    const double radius = uniform(random, 0.1, 0.3);
    const Isometry3d pose = test::randomPose(random, 1.0);
    const Matrix3d turned = pose.linear().transpose() * factor;
    const auto a = onePoint(Vector3d::Zero(), 0.5 * radius, Matrix3d::Zero());
    const auto b = onePoint(pose.inverse() * mean, 0.5 * radius, turned * turned.transpose());
    const double truth = ballByLines(mean, factor, radius);
    const double accuracy = singular ? 0.02 : 1e-4;  // the truth is known to some 1e-5
    const auto found = collisionProbability(a, b, pose, accurateTo(accuracy));
    EXPECT_NEAR(found.probability, truth, accuracy) << i;
    EXPECT_LE(found.lower, truth + 1e-4) << i;
    EXPECT_GE(found.upper, truth - 1e-4) << i;
    open += truth > 0.05 && truth < 0.95 ? 1 : 0;
  }
  EXPECT_GT(open, 12);
}

/// Balls that a point may meet in turn, but never at once, or only together.
TEST(CollisionProbability, OfPairsWithACommonPoint) {
  const std::vector<Vector3d> center{Vector3d::Zero()};
  const auto noisy = NoisyPointCloud::build(center, 0.0, 0.1);
  const double once = noncentralChi(0.15, 0.1, 0.1);
  const std::vector<Vector3d> apart{{0.15, 0.0, 0.0}, {-0.15, 0.0, 0.0}};
  const std::vector<Vector3d> together{{0.15, 0.0, 0.0}, {0.15, 0.0, 0.0}};
  for (const bool exclusive : {true, false}) {
    const auto known = NoisyPointCloud::build(exclusive ? apart : together, 0.1, 0.0);
    const double truth = exclusive ? 2.0 * once : once;
    const auto found = collisionProbability(noisy, known, Isometry3d::Identity(), accurateTo(0.01));
    EXPECT_NEAR(found.lower, once, 1e-6);
    EXPECT_NEAR(found.upper, 2.0 * once, 1e-6);
    EXPECT_GT(found.standardError, 0.0);
    EXPECT_LE(3.0 * found.standardError, 0.01);
    EXPECT_NEAR(found.probability, truth, 4.0 * found.standardError + 1e-6);
    // The seed counts, but not for what is proven.
    CollisionProbabilityOptions other = accurateTo(0.01);
    other.seed = 7;
    const auto again = collisionProbability(noisy, known, Isometry3d::Identity(), other);
    EXPECT_EQ(again.lower, found.lower);
    EXPECT_EQ(again.upper, found.upper);
  }
}

std::vector<Shape> bodies() {
  const test::Soup soup = test::boxSoup({-0.5, -0.3, -0.2}, {0.5, 0.3, 0.2});
  return {TriangleMesh::build(soup.vertices, soup.triangles),
          TriangleMesh::build(soup.vertices, soup.triangles, MeshInterior::Surface),
          makeBox({0.6, 0.4, 0.5}),
          makeTriangle({-0.4, 0, 0}, {0.4, 0, 0}, {0, 0.5, 0}),
          makePlane({0, 0, 1}, 0.1),
          makeCone(0.3, 0.5)};
}

/// Known points collide as collide() says.
TEST(CollisionProbability, WithoutNoiseIsCollide) {
  std::mt19937 random(4);
  int touching = 0;
  int total = 0;
  for (const Shape& body : bodies()) {
    for (int i = 0; i < 60; ++i) {
      std::vector<Vector3d> points;
      for (int k = 0; k < 6; ++k) points.push_back(test::uniformPoint(random, 1.0));
      const Isometry3d pose = test::randomPose(random, 0.5);
      const Contact contact = collide(PointCloud::build(points, 0.03), body, pose);
      ASSERT_NE(contact, Contact::Unknown);
      const auto found =
          collisionProbability(NoisyPointCloud::build(points, 0.03, 0.0), body, pose);
      const double truth = contact == Contact::Touching ? 1.0 : 0.0;
      EXPECT_EQ(found.probability, truth);
      EXPECT_EQ(found.lower, truth);
      EXPECT_EQ(found.upper, truth);
      std::vector<Vector3d> others;
      for (int k = 0; k < 40; ++k) others.push_back(test::uniformPoint(random, 1.0));
      const Contact clouds =
          collide(PointCloud::build(points, 0.1), PointCloud::build(others, 0.1), pose);
      const auto pairs = collisionProbability(NoisyPointCloud::build(points, 0.1, 0.0),
                                              NoisyPointCloud::build(others, 0.1, 0.0), pose);
      EXPECT_EQ(pairs.lower, clouds == Contact::Touching ? 1.0 : 0.0);
      EXPECT_EQ(pairs.upper, pairs.lower);
      touching += (contact == Contact::Touching ? 1 : 0) + (pairs.lower > 0.0 ? 1 : 0);
      total += 2;
    }
  }
  EXPECT_GT(touching, total / 5);
  EXPECT_LT(touching, total * 7 / 10);
}

TEST(CollisionProbability, FarAndDeepPointsAreAllButCertain) {
  const Shape mesh = bodies().front();
  const auto far = NoisyPointCloud::build({{Vector3d(0.0, 0.0, 1.0)}}, 0.01, 0.05);
  EXPECT_LE(collisionProbability(far, mesh, Isometry3d::Identity()).upper, 1e-9);
  const auto deep = NoisyPointCloud::build({{Vector3d::Zero()}}, 0.01, 0.02);
  EXPECT_GE(collisionProbability(deep, mesh, Isometry3d::Identity()).lower, 1.0 - 1e-9);
}

/// Noise along a wall does not lead into it.
TEST(CollisionProbability, NoiseOfLowerRankStaysInItsDirections) {
  const Shape wall = makeHalfSpace({0, 0, 1}, 0.0);
  const Matrix3d along = Vector3d(1.0, 0.5, 0.0).asDiagonal();
  for (const double height : {0.1, -0.1}) {
    const auto found = collisionProbability(onePoint({0, 0, height}, 0.05, along), wall,
                                            Isometry3d::Identity(), accurateTo(1e-6));
    expectHolds(found, height > 0.0 ? 0.0 : 1.0, 1e-6);
  }
}

TEST(CollisionProbability, GrowsWithTheRadius) {
  const Shape mesh = bodies().front();
  const std::vector<Vector3d> points{{0.4, 0.1, 0.4}, {0.7, 0.4, 0.0}};
  CollisionProbability before;
  before.probability = 0.0;
  double first = 1.0;
  for (const double radius : {0.0, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35}) {
    const auto found = collisionProbability(NoisyPointCloud::build(points, radius, 0.1), mesh,
                                            Isometry3d::Identity(), accurateTo(0.03));
    EXPECT_GE(found.upper, before.lower);
    EXPECT_GT(found.probability, before.probability - 0.03);
    before = found;
    first = std::min(first, found.probability);
  }
  EXPECT_LT(first, 0.1);
  EXPECT_GT(before.probability, 0.9);
}

TEST(CollisionProbability, ThresholdsOfClouds) {
  const auto a = NoisyPointCloud::build({{Vector3d::Zero()}}, 0.05, 0.1);
  const auto b = NoisyPointCloud::build({{Vector3d(0.2, 0.0, 0.0)}}, 0.05, 0.0);
  const double truth = noncentralChi(0.2, 0.1, 0.1);
  const auto answer = [&](double threshold) {
    return probabilityExceeds(a, b, Isometry3d::Identity(), threshold).answer;
  };
  EXPECT_EQ(answer(truth - 0.001), Exceeds::Yes);
  EXPECT_EQ(answer(truth + 0.001), Exceeds::No);
  EXPECT_EQ(answer(1.0), Exceeds::No);
  EXPECT_EQ(answer(-0.1), Exceeds::Yes);
  EXPECT_EQ(answer(kNaN), Exceeds::Undecided);
}

TEST(CollisionProbability, APoseThatIsNotFiniteTellsNothing) {
  const auto cloud = NoisyPointCloud::build({{Vector3d::Zero()}}, 0.05, 0.1);
  for (const double bad : {kNaN, kInfinity}) {
    Isometry3d pose = Isometry3d::Identity();
    pose.translation().y() = bad;
    for (const bool clouds : {false, true}) {
      const auto found = clouds ? collisionProbability(cloud, cloud, pose)
                                : collisionProbability(cloud, makeSphere(1.0), pose);
      EXPECT_EQ(found.lower, 0.0);
      EXPECT_EQ(found.upper, 1.0);
    }
    EXPECT_EQ(probabilityExceeds(cloud, cloud, pose, 0.5).answer, Exceeds::Undecided);
    EXPECT_EQ(probabilityExceeds(cloud, makeSphere(1.0), pose, 0.5).answer, Exceeds::Undecided);
  }
}

/// With little effort the bounds are wide, but hold.
TEST(CollisionProbability, EffortIsLimited) {
  const auto cloud = NoisyPointCloud::build({{Vector3d(0.0, 0.0, 0.1)}}, 0.0, 0.1);
  const Shape wall = makeHalfSpace({0, 0, 1}, 0.0);
  const double truth = cdf(-1.0);
  double width = 1.0;
  for (const int looks : {1, 30, 200, 2000}) {
    CollisionProbabilityOptions options = accurateTo(0.0);
    options.maxLooks = looks;
    const auto found = collisionProbability(cloud, wall, Isometry3d::Identity(), options);
    EXPECT_LE(found.lower, truth);
    EXPECT_GE(found.upper, truth - 1e-15);
    EXPECT_LT(found.upper - found.lower, width);
    EXPECT_LE(found.effort.looks, looks + 40);
    width = found.upper - found.lower;
  }
  EXPECT_LT(width, 2e-3);
}

/// A count that the draws at a time do not divide is kept, too: up to the largest int they have to
/// end without going over it.
TEST(CollisionProbability, DrawsNoMoreThanAllowed) {
  const auto noisy = NoisyPointCloud::build({{Vector3d::Zero()}}, 0.0, 0.1);
  const std::vector<Vector3d> together{{0.15, 0.0, 0.0}, {0.15, 0.0, 0.0}};
  const auto known = NoisyPointCloud::build(together, 0.1, 0.0);
  for (const int samples : {0, 1, 63, 64, 65, 1000}) {
    CollisionProbabilityOptions options = accurateTo(0.0);
    options.maxSamples = samples;
    const auto found = collisionProbability(noisy, known, Isometry3d::Identity(), options);
    EXPECT_EQ(found.effort.samples, samples);
  }
}

/// Most of a hundred thousand points are far from a small body, and none of them is looked at.
TEST(CollisionProbability, FarPointsCostNothing) {
  std::mt19937 random(7);
  const test::Soup soup = test::blobSoup(random, 8, 10);
  const TriangleMesh mesh = TriangleMesh::build(soup.vertices, soup.triangles);
  std::vector<Vector3d> points, close;
  while (points.size() < 100'000) {
    const Vector3d at = test::uniformPoint(random, 20.0);
    if (at.norm() < 1.02) continue;
    points.push_back(at);
    if (at.norm() < 3.0) close.push_back(at);
  }
  for (int k = 0; k < 3; ++k) {
    const Vector3d direction = test::unitVector(random);
    Vector3d at = direction;
    while (distance(mesh, Sphere{0.08}, Isometry3d(Eigen::Translation3d(at))).lower > 0.0) {
      at -= 0.01 * direction;
    }
    points.push_back(at);
    close.push_back(at);
  }
  const auto of = [&](const std::vector<Vector3d>& some) {
    return collisionProbability(NoisyPointCloud::build(some, 0.01, 0.05), mesh,
                                Isometry3d::Identity(), accurateTo(0.05));
  };
  const auto all = of(points);
  const auto few = of(close);
  EXPECT_LT(all.effort.near, 100);
  EXPECT_LT(all.effort.nodes, 1000);
  EXPECT_GT(all.lower, 0.01);
  EXPECT_LE(all.lower, few.upper);
  EXPECT_LE(few.lower, all.upper);
  EXPECT_NEAR(all.probability, few.probability, 0.05);
}

std::string messageOf(const std::vector<Vector3d>& points, const std::vector<double>& radii,
                      const std::vector<Matrix3d>& covariances) {
  return test::messageOf([&] { NoisyPointCloud::build(points, radii, covariances); });
}

TEST(CollisionProbability, BadCloudsAreNamed) {
  const std::vector<Vector3d> points{Vector3d::Zero(), Vector3d::UnitX()};
  const std::vector<double> radii{0.0, 0.1};
  const Matrix3d zero = Matrix3d::Zero();
  EXPECT_EQ(messageOf(points, radii, {zero, Matrix3d::Ones()}), "");
  EXPECT_EQ(messageOf({}, {}, {}), "noisy point cloud has no points");
  EXPECT_EQ(messageOf({points[0], {0.0, kNaN, 2.0}}, radii, {zero, zero}),
            "point 1 of the noisy point cloud is (0, nan, 2); allowed: finite coordinates");
  EXPECT_EQ(messageOf(points, {0.1}, {zero, zero}), "noisy point cloud has 2 points, but 1 radii");
  EXPECT_EQ(messageOf(points, radii, {zero}), "noisy point cloud has 2 points, but 1 covariances");
  EXPECT_EQ(messageOf(points, {0.1, -0.5}, {zero, zero}),
            "radius 1 of the noisy point cloud is -0.5; allowed: finite and not negative");
}

TEST(CollisionProbability, BadCovariancesAreNamed) {
  const std::vector<Vector3d> points{Vector3d::Zero()};
  Matrix3d wrong = Matrix3d::Identity();
  wrong(2, 1) = kInfinity;
  EXPECT_EQ(messageOf(points, {0.1}, {wrong}),
            "covariance 0 of the noisy point cloud has inf at (2, 1); allowed: finite");
  wrong(2, 1) = 0.25;
  EXPECT_EQ(messageOf(points, {0.1}, {wrong}),
            "covariance 0 of the noisy point cloud is not symmetric: 0 at (1, 2), 0.25 at (2, 1)");
  wrong = Vector3d(1.0, 2.0, -0.5).asDiagonal();
  EXPECT_EQ(messageOf(points, {0.1}, {wrong}),
            "covariance 0 of the noisy point cloud is not positive semidefinite: least eigenvalue "
            "-0.5");
}

TEST(CollisionProbability, BadDeviationsAreNamed) {
  const auto message = [](double radius, double deviation) {
    return test::messageOf(
        [&] { NoisyPointCloud::build({{Vector3d::Zero()}}, radius, deviation); });
  };
  EXPECT_EQ(message(0.1, 0.0), "");
  EXPECT_EQ(message(kNaN, 0.0),
            "radius of the noisy point cloud is nan; allowed: finite and not negative");
  EXPECT_EQ(message(0.1, -2.0),
            "standard deviation of the noisy point cloud is -2; allowed: finite and not negative");
}

}  // namespace
}  // namespace swept
