// SPDX-License-Identifier: BSD-3-Clause
// Shapes, motions and the queries between two shapes are the same, bit for bit, in every
// floating-point environment.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "pair_samples_all.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/core/clearance_grid.hpp"
#include "swept/core/collision_probability.hpp"
#include "swept/core/contacts.hpp"
#include "swept/core/continuous/continuous_collide.hpp"
#include "swept/core/continuous/impact.hpp"
#include "swept/core/continuous/motions.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/height_field.hpp"
#include "swept/core/segment_query.hpp"
#include "swept/core/sensed_space.hpp"
#include "swept/core/separation.hpp"
#include "swept/core/signed_distance.hpp"
#include "swept/core/solid_depth.hpp"
#include "swept/core/sphere_cover.hpp"
#include "swept/core/triangle_pair.hpp"
#include "transcript.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using test::expectSameInEveryEnvironment;
using test::expectSameRefusals;
using test::Query;
using test::Transcript;

std::vector<Vector3d> manyPoints(std::mt19937& random, std::size_t count, double size) {
  std::vector<Vector3d> all;
  for (std::size_t i = 0; i < count; ++i) all.push_back(test::uniformPoint(random, size));
  return all;
}

/// m. Coordinates are denormal at the last one, and squares at the one before.
constexpr std::array kSizes{1.0, 3e-155, 2e-309};

void tell(Transcript& answers, const DistanceResult& d) {
  answers.add(d.lower, d.upper, d.pointA, d.pointB, d.normal, d.iterations);
}
void tell(Transcript& answers, const MotionState& state, const MotionRates& rates) {
  answers.add(state.pose, state.twist.linear, state.twist.angular, rates.speed, rates.acceleration,
              rates.angularSpeed, rates.angularAcceleration);
}
void tell(Transcript& answers, const ContinuousResult& r) {
  answers.add(r.verdict, r.freeUntil, r.contactBy, r.pointA, r.pointB, r.effort.intervals);
}
void tell(Transcript& answers, const ConvexHull& hull) {
  answers.add(hull.vertices(), hull.error(), hull.extent(), hull.ball().center, hull.ball().radius);
}
void tell(Transcript& answers, const Shape& shape) {
  const BoundingSphere ball = boundingSphere(shape);
  const Aabb box = boundingBox(shape);
  answers.add(shape.index(), ball.center, ball.radius, box.lower, box.upper);
}

/// All queries between two shapes.
void askPair(const Shape& a, const Shape& b, const Isometry3d& a_from_b, Transcript& answers) {
  tell(answers, distance(a, b, a_from_b));
  answers.add(collide(a, b, a_from_b));
  const SignedDistanceResult depth = signedDistance(a, b, a_from_b);
  answers.add(depth.lower, depth.upper, depth.pointA, depth.pointB, depth.normal);
  std::vector<ContactPoint> contacts;
  const ContactsResult found = findContacts(a, b, a_from_b, 20, contacts);
  answers.add(found.status, found.complete);
  for (const ContactPoint& c : contacts) answers.add(c.pointA, c.pointB, c.normal, c.depth);
  SeparationQuery query;
  query.approach.required = 1e-3;
  query.approach.travel = 0.01;
  const SeparationResult separation = separate(a, b, a_from_b, query);
  answers.add(separation.status, separation.upper, separation.pointA, separation.normal);
  tell(answers, a);
  tell(answers, b);
}

class EnvironmentOfPairs : public testing::TestWithParam<std::size_t> {};

TEST_P(EnvironmentOfPairs, IsTheDefault) {
  samples::Sampler sampler(7 + static_cast<unsigned>(GetParam()));
  std::vector<Query> queries;
  for (std::size_t other = 0; other < samples::kNames.size(); ++other) {
    for (int i = 0; i < 6; ++i) {
      const samples::Pair p = sampler.pair(GetParam(), other, i);
      queries.push_back({std::string(samples::kNames[other]) + " " + std::to_string(i),
                         [p](Transcript& answers) { askPair(p.a, p.b, p.a_from_b, answers); }});
    }
  }
  expectSameInEveryEnvironment(queries);
}

TEST_P(EnvironmentOfPairs, IsTheDefaultForMotions) {
  samples::Sampler sampler(70 + static_cast<unsigned>(GetParam()));
  std::vector<Query> queries;
  for (std::size_t other = 0; other < samples::kNames.size(); ++other) {
    const samples::Pair p = sampler.pair(GetParam(), other, 2);
    queries.push_back({samples::kNames[other], [p](Transcript& answers) {
                         const auto still = UniformMotion::still(Isometry3d::Identity());
                         const auto moving =
                             UniformMotion::turning(p.a_from_b, {0.1, 0.7, -0.3}, {0.3, -0.2, 0.1});
                         ContinuousOptions options;
                         options.maxIntervals = 200;
                         tell(answers, continuousCollide(p.a, still, p.b, moving, options));
                       }});
  }
  expectSameInEveryEnvironment(queries);
}

INSTANTIATE_TEST_SUITE_P(EnvironmentOfShapes, EnvironmentOfPairs,
                         testing::Range(std::size_t{0}, samples::kNames.size()),
                         [](const auto& tested) {
                           return std::string(samples::kNames[tested.param]);
                         });

TEST(EnvironmentOfShapes, IsTheDefaultForSmallOnes) {
  std::vector<Query> queries;
  for (const double size : kSizes) {
    std::mt19937 random(3);
    const std::vector<Vector3d> points = manyPoints(random, 12, size);
    const Isometry3d pose = test::randomPose(random, 2.0 * size);
    const double r = test::uniform(random, 0.1, 1.0) * size;
    const double s = r / 3.0;
    queries.push_back({"size " + std::to_string(std::log10(size)), [=](Transcript& answers) {
                         const std::vector<Shape> shapes{
                             makeSphere(r),
                             makeBox({r, s, s}),
                             makeCylinder(r, s),
                             makeCapsule(s, r),
                             makeCone(r, s),
                             makeEllipsoid({r, s, r}),
                             ConvexHull::of(points),
                             PointCloud::build(points, s),
                             makeTriangle(points[0], points[1], points[2])};
                         for (const Shape& a : shapes) {
                           for (const Shape& b : shapes) askPair(a, b, pose, answers);
                           tell(answers, scaled(a, 1.7));
                         }
                       }});
  }
  expectSameInEveryEnvironment(queries);
}

TEST(EnvironmentOfShapes, IsTheDefaultWhereTheyAreMade) {
  std::mt19937 random(4);
  const std::vector<Vector3d> points = manyPoints(random, 600, 1000.0);
  std::vector<double> radii;
  for (std::size_t i = 0; i < points.size(); ++i) radii.push_back(test::uniform(random, 0.0, 0.3));
  const Vector3d normal = test::uniformPoint(random, 1.0);
  const Vector3d axis = test::uniformPoint(random, 1e-3);
  Eigen::MatrixXd heights(4, 5);
  for (double& height : heights.reshaped()) height = test::uniform(random, 0.1, 1.0);
  expectSameInEveryEnvironment(
      {{"plane", [=](Transcript& t) { t.add(makePlane(normal, 0.1).normal); }},
       {"half-space", [=](Transcript& t) { t.add(makeHalfSpace(normal, 0.1).offset); }},
       {"axis frame", [=](Transcript& t) { t.add(axisFrame(axis)); }},
       {"hull",
        [=](Transcript& t) {
          const ConvexHull hull = ConvexHull::of(points);
          tell(t, hull);
          tell(t, ConvexHull::coarser(hull));
          tell(t, ConvexHull::scaled(hull, 1.1, axis));
        }},
       {"cloud",
        [=](Transcript& t) {
          const PointCloud one = PointCloud::build(points, 0.1);
          const PointCloud other = PointCloud::build(points, radii);
          t.add(one.points(), other.points(), other.largestRadius());
          tell(t, one.hull());
          t.add(neighborDistances(one, 3));
        }},
       {"height field",
        [=](Transcript& t) {
          const TriangleMesh mesh = heightField(1.1, 0.7, heights, 0.0);
          t.add(mesh.vertices(), mesh.concavity());
          tell(t, mesh.hull());
        }},
       {"occluded", [=](Transcript& t) {
          const Balls balls = occludedBalls(std::span(points).first(5), 0.5, axis, 2000.0);
          t.add(balls.centers, balls.radii);
        }}});
}

TEST(EnvironmentOfShapes, IsTheDefaultForPointsAndSegments) {
  std::mt19937 random(5);
  Eigen::MatrixXd heights(12, 12);
  for (double& height : heights.reshaped()) height = test::uniform(random, 0.1, 0.4);
  const TriangleMesh mesh = heightField(2.0, 2.0, heights, 0.0);
  const PointCloud cloud = PointCloud::build(manyPoints(random, 300, 1.0), 0.03);
  const std::vector<Vector3d> asked = manyPoints(random, 64, 1.2);
  const double radius = 0.1 / 3.0;
  const Vector3d half = 0.1 * asked.front();
  expectSameInEveryEnvironment(
      {{"segments",
        [=](Transcript& t) {
          for (const Vector3d& p : asked) {
            const LineSegment segment{p, half};
            t.add(isFarther(mesh, segment, radius), isFarther(cloud, segment, radius),
                  clearance(cloud, p), mesh.encloses(p), solidDepth(mesh, p));
            for (const auto& found :
                 {pointWithin(mesh, p, radius), pointWithin(cloud, p, radius)}) {
              t.add(found.has_value(), found.value_or(Vector3d::Zero()));
            }
          }
        }},
       {"grid",
        [=](Transcript& t) {
          for (const Shape& shape : {Shape(mesh), Shape(cloud)}) {
            const auto grid = ClearanceGrid::build(shape, {.cells = 2000});
            std::vector<double> bounds(asked.size());
            grid.clearances(asked, bounds);
            t.add(grid.voxel(), grid.error(), grid.reach(), bounds);
            for (const Vector3d& p : asked) t.add(grid.clearance(p), grid.isFarther(p, radius));
          }
        }},
       {"cover", [=](Transcript& t) {
          for (const Shape& shape : {Shape(mesh), Shape(cloud), Shape(makeCone(0.3, 0.7))}) {
            const SphereCover cover = sphereCover(shape, {.mostBalls = 200});
            for (const SphereCover::Node& node : cover.nodes)
              t.add(node.ball.center, node.ball.radius, node.overhang, node.inside);
          }
        }}});
}

TEST(EnvironmentOfShapes, IsTheDefaultForProbabilities) {
  std::mt19937 random(6);
  const std::vector<Vector3d> points = manyPoints(random, 12, 0.3);
  const Isometry3d pose = test::randomPose(random, 0.3);
  const NoisyPointCloud cloud = NoisyPointCloud::build(points, 0.02, 0.05);
  expectSameInEveryEnvironment(
      {{"made",
        [=](Transcript& t) {
          const std::vector<double> radii(points.size(), 0.02);
          const std::vector<Eigen::Matrix3d> covariances(
              points.size(), Eigen::Vector3d(1e-4, 3e-4, 2e-5).asDiagonal());
          const auto made = NoisyPointCloud::build(points, radii, covariances);
          t.add(collisionProbability(made, makeSphere(0.1), pose).probability);
        }},
       {"asked", [=](Transcript& t) {
          const Shape box = makeBox({0.2, 0.1, 0.3});
          for (const CollisionProbability& p :
               {collisionProbability(cloud, box, pose), collisionProbability(cloud, cloud, pose)})
            t.add(p.probability, p.lower, p.upper, p.standardError);
          for (const ThresholdResult& r : {probabilityExceeds(cloud, box, pose, 0.3),
                                           probabilityExceeds(cloud, cloud, pose, 0.3)})
            t.add(r.answer, r.lower, r.upper);
        }}});
}

TEST(EnvironmentOfShapes, IsTheDefaultForTrianglesAndTheirImpacts) {
  std::vector<Query> queries;
  for (const double size : kSizes) {
    std::mt19937 random(8);
    const std::vector<Vector3d> points = manyPoints(random, 200, size);
    const double enough = size / 30.0;
    queries.push_back({"size " + std::to_string(std::log10(size)), [points, enough](Transcript& t) {
                         for (std::size_t i = 0; i + 8 <= points.size(); i += 4) {
                           const TriangleCorners a{points[i], points[i + 1], points[i + 2]};
                           const TriangleCorners b{points[i + 3], points[i + 4], points[i + 5]};
                           const TriangleDistance d = triangleDistance(a, b);
                           const TriangleContact c = triangleContact(a, b);
                           t.add(trianglesTouch(a, b), d.lower, d.upper, d.pointA, d.pointB,
                                 triangleDistance(a, b, enough).lower, c.point, c.normal, c.depth);
                           const auto path = [&](std::size_t k) {
                             return LinearPath{points[i + k], points[i + (k + 3) % 8]};
                           };
                           for (const Impact& hit :
                                {vertexFaceImpact(path(0), {path(1), path(2), path(3)}),
                                 edgeEdgeImpact({path(0), path(1)}, {path(2), path(3)})})
                             t.add(hit.verdict, hit.freeUntil, hit.contactBy);
                         }
                       }});
  }
  expectSameInEveryEnvironment(queries);
}

TEST(EnvironmentOfShapes, IsTheDefaultForMotions) {
  std::mt19937 random(9);
  const Isometry3d start = test::randomPose(random, 1.0), end = test::randomPose(random, 1.0);
  const Vector3d turn = test::uniformPoint(random, 2.0),
                 reference = test::uniformPoint(random, 0.3);
  std::vector<ControlPose> control;
  for (int i = 0; i < 6; ++i)
    control.push_back({test::uniformPoint(random, 1.0), test::uniformPoint(random, 1.0)});
  const BoundingSphere ball{test::uniformPoint(random, 0.1), 0.3};
  const Vector3d along = ball.center.normalized();
  const auto ask = [ball, along](const Motion& motion, Transcript& t) {
    for (const double at : {0.1, 1.0 / 3.0, 0.77}) {
      tell(t, motion.state(at), motion.rates(0.03, at));
      t.add(motion.at(at), motion.velocity(at).linear, motion.rounding(0.7), motion.reference());
      const MotionBound bound = motion.bound(ball, 0.01, at);
      t.add(bound.linear, bound.curvature, bound.most(), bound.along(along));
    }
  };
  expectSameInEveryEnvironment({{"even",
                                 [=](Transcript& t) {
                                   ask(UniformMotion::still(start), t);
                                   ask(UniformMotion::translation(start, turn), t);
                                   ask(UniformMotion::interpolation(start, end, reference), t);
                                   ask(UniformMotion::screw(start, end), t);
                                   ask(UniformMotion::turning(start, turn, reference, reference),
                                       t);
                                 }},
                                {"splines",
                                 [=](Transcript& t) {
                                   ask(SplineMotion::bezier(start.linear(), control), t);
                                   ask(SplineMotion::uniformCubic(start.linear(), control), t);
                                 }},
                                {"of others", [=](Transcript& t) {
                                   const auto screw = UniformMotion::screw(start, end);
                                   ask(MotionPart(screw, 0.1, 0.7), t);
                                   ask(AttachedFrame(screw, end), t);
                                 }}});
}

TEST(EnvironmentOfShapes, ComesBackAfterRefusals) {
  const std::vector<Vector3d> none;
  expectSameRefusals(
      {{"size", [](Transcript&) { makeSphere(-0.1); }},
       {"plane", [](Transcript&) { makePlane(Vector3d::Zero(), 0.1); }},
       {"hull", [=](Transcript&) { ConvexHull::of(none); }},
       {"cloud", [=](Transcript&) { PointCloud::build(none, 0.1); }},
       {"grid", [](Transcript&) { ClearanceGrid::build(makeSphere(0.1)); }},
       {"cover", [](Transcript&) { sphereCover(makePlane(Vector3d::UnitX(), 0.1)); }},
       {"scale", [](Transcript&) { scaled(makeSphere(0.1), -1.0 / 3.0); }},
       {"part", [](Transcript&) {
          const auto still = UniformMotion::still(Isometry3d::Identity());
          MotionPart(still, 1.0 / 3.0, 1.0 / 7.0);
        }}});
}

}  // namespace
}  // namespace swept
