// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "simd_obstacles_test.cpp"  // compiled once for each instruction set
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/kernels/f8.hpp"
#include "simd/kernels/obstacle_kernels.hpp"

HWY_BEFORE_NAMESPACE();
namespace swept::detail::HWY_NAMESPACE {
namespace {

void measureSquared(const SimdObstacles& world, const Row (&x)[3], const Row (&g)[3],
                    Row& squared) {
  store(squaredDistance(world, world.obstacles.front(), Segment{load3(x), load3(g)}), squared);
}

void compareRows(const Row& a, const Row& b, Row& most, Row& least) {
  store(larger(load(a), load(b)), most);
  store(smaller(load(a), load(b)), least);
}

}  // namespace
}  // namespace swept::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <bit>
#include <limits>
#include <map>

#include "rounding/error_model.hpp"
#include "simd_robots.hpp"
#include "simd_targets.hpp"
#include "swept/core/axis_frame.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/simd_dispatch.hpp"

namespace swept::detail {
SWEPT_DISPATCH_TABLE(measureSquared);
SWEPT_DISPATCH_TABLE(compareRows);

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;
using simd_test::OnTarget;
using simd_test::Random;
using simd_test::worldGeometry;

enum class Kind {
  Ball,
  Box,
  Capsule,
  Cylinder,
  Cone,
  HalfSpace,
  Plane,
  Hull,
  Triangle,
  Ellipsoid,
};
constexpr int kKinds = 10;
constexpr std::array<const char*, kKinds> kNames{"ball",     "box",        "capsule", "cylinder",
                                                 "cone",     "half_space", "plane",   "hull",
                                                 "triangle", "ellipsoid"};

std::vector<Vector3d> somePoints(Random& random, int count, double size) {
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) points.push_back(random.vector(size));
  return points;
}

Shape shapeOf(Random& random, Kind kind, double size) {
  const auto length = [&] { return size * random.scale(1e-2, 1.0); };
  switch (kind) {
    case Kind::Ball:
      return Sphere{length()};
    case Kind::Box:
      return Box{{length(), length(), length()}};
    case Kind::Capsule:
      return Capsule{length(), length()};
    case Kind::Cylinder:
      return Cylinder{length(), length()};
    case Kind::Cone:
      return Cone{length(), length()};
    case Kind::HalfSpace:
      return HalfSpace{random.direction(), random.uniform(-size, size)};
    case Kind::Plane:
      return Plane{random.direction(), random.uniform(-size, size)};
    case Kind::Hull:
      return ConvexHull::of(somePoints(random, 4 + random.below(40), size));
    case Kind::Triangle:
      return Triangle{{random.vector(size), random.vector(size), random.vector(size)}};
    case Kind::Ellipsoid:
      return Ellipsoid{{length(), length(), length()}};
  }
  return Sphere{size};
}

/// An obstacle somewhere, and a robot that reaches it.
struct Scene {
  Shape shape;
  Isometry3d world_from_shape;
  double size;   ///< m
  double reach;  ///< m
  double slack;  ///< m, by which the compiled sets are larger
  SimdObstacles world;
};

Scene sceneOf(Random& random, Kind kind) {
  Scene scene;
  scene.size = random.scale(1e-3, 1e2);
  scene.shape = shapeOf(random, kind, scene.size);
  const double offset = std::array{0.0, 1.0, 1e3}[random.below(3)];
  scene.world_from_shape = random.pose(offset);
  const WorldGeometry geometry = worldGeometry(scene.shape, scene.world_from_shape);
  scene.reach = scene.world_from_shape.translation().norm() + 8.0 * scene.size;
  scene.slack = obstacleRounding(scene.reach, geometry.magnitude);
  scene.world = compileObstacles({geometry}, scene.reach, true);
  return scene;
}

/// A point near the obstacle, most of them outside, some about to touch it.
Vector3d pointNear(Random& random, const Scene& scene) {
  Vector3d point = scene.world_from_shape * random.vector(scene.size * random.scale(0.3, 3.0));
  if (random.chance(0.5)) return point;
  const Isometry3d point_from_shape = Eigen::Translation3d(-point) * scene.world_from_shape;
  const DistanceResult found = distance(Sphere{0.0}, scene.shape, point_from_shape);
  if (!(found.upper > 0.0)) return point;
  return point + (1.0 - random.scale(1e-5, 0.3)) * found.pointB;
}

Vector3d asSingle(const Vector3d& value) {
  return value.cast<float>().cast<double>();
}

/// m; not below the least distance between the segment and the obstacle.
double exactDistance(const Scene& scene, const Vector3d& x, const Vector3d& g) {
  Isometry3d world_from_segment = Isometry3d::Identity();
  world_from_segment.translation() = x;
  const double length = g.norm();
  if (length > 0.0) world_from_segment.linear() = axisFrame(g);
  const Shape segment = length > 0.0 ? Shape(Capsule{0.0, length}) : Shape(Sphere{0.0});
  return distance(segment, scene.shape, world_from_segment.inverse() * scene.world_from_shape)
      .upper;
}

struct Segments {
  std::array<Vector3d, kLanes> x;
  std::array<Vector3d, kLanes> g;
};

Segments segmentsNear(Random& random, const Scene& scene, bool moving) {
  Segments segments;
  for (int lane = 0; lane < kLanes; ++lane) {
    segments.x[lane] = asSingle(pointNear(random, scene));
    segments.g[lane] = Vector3d::Zero();
    if (moving)
      segments.g[lane] = asSingle(random.direction() * scene.size * random.scale(1e-4, 2.0));
  }
  return segments;
}

/// m, of all lanes.
std::array<double, kLanes> laneDistances(const Scene& scene, const Segments& segments) {
  Row x[3];
  Row g[3];
  Row squared;
  for (int lane = 0; lane < kLanes; ++lane) {
    for (int i = 0; i < 3; ++i) {
      x[i].lane[lane] = static_cast<float>(segments.x[lane][i]);
      g[i].lane[lane] = static_cast<float>(segments.g[lane][i]);
    }
  }
  SWEPT_DISPATCH(measureSquared)(scene.world, x, g, squared);
  std::array<double, kLanes> distances{};
  for (int lane = 0; lane < kLanes; ++lane)
    distances[lane] = std::sqrt(static_cast<double>(squared.lane[lane]));
  return distances;
}

constexpr double kOutward = kBallOutward;

struct Tally {
  int apart = 0;     ///< segments that do not meet the obstacle
  int proven = 0;    ///< of these: more than zero is shown
  int near = 0;      ///< of these: within a hundredth of the size
  int meeting = 0;   ///< segments that do
  double ratio = 0;  ///< sum of bound over distance
};

void compare(Random& random, const Scene& scene, bool moving, Tally& tally) {
  const Segments segments = segmentsNear(random, scene, moving);
  const auto bounds = laneDistances(scene, segments);
  for (int lane = 0; lane < kLanes; ++lane) {
    const double exact = exactDistance(scene, segments.x[lane], segments.g[lane]);
    ASSERT_LE(bounds[lane], exact * kOutward + 1e-12 * scene.reach)
        << "size " << scene.size << ", reach " << scene.reach << ", x "
        << segments.x[lane].transpose() << ", g " << segments.g[lane].transpose();
    if (!(exact > 0.0)) {
      ++tally.meeting;
      continue;
    }
    if (exact < 4.0 * scene.slack) continue;
    ++tally.apart;
    tally.near += exact < 0.01 * scene.size ? 1 : 0;
    tally.proven += bounds[lane] > 0.0 ? 1 : 0;
    tally.ratio += bounds[lane] / exact;
  }
}

TEST(SimdObstacles, NoBoundIsAboveTheDistance) {
  for (const std::int64_t target : simd_test::simdTargets()) {
    const OnTarget on(target);
    Random random(31);
    for (int kind = 0; kind < kKinds; ++kind) {
      SCOPED_TRACE(kNames[kind]);
      for (const bool moving : {false, true}) {
        Tally tally;
        for (int round = 0; round < 400; ++round) {
          const Scene scene = sceneOf(random, static_cast<Kind>(kind));
          for (int i = 0; i < 2; ++i) compare(random, scene, moving, tally);
          if (HasFatalFailure()) return;
        }
        EXPECT_GT(tally.apart, 1500);
        EXPECT_GT(tally.near, 100);
        const bool surface =
            kind == static_cast<int>(Kind::Plane) || kind == static_cast<int>(Kind::Triangle);
        if (!surface || moving) {
          EXPECT_GT(tally.meeting, 60);
        }
        // Those with a kernel of their own show most of the distance, boxes around others some.
        const bool own = kind <= static_cast<int>(Kind::Hull);
        EXPECT_GT(tally.ratio, (own ? 0.7 : 0.1) * tally.apart);
        EXPECT_GT(tally.proven, (own ? 0.7 : 0.2) * tally.apart);
      }
    }
  }
}

/// Of points, the kernels of these kinds give the distance, less what rounding is allowed for.
TEST(SimdObstacles, PointsAreAsFarAsTheyAre) {
  for (const std::int64_t target : simd_test::simdTargets()) {
    const OnTarget on(target);
    Random random(32);
    for (const Kind kind :
         {Kind::Ball, Kind::Box, Kind::Capsule, Kind::Cylinder, Kind::HalfSpace, Kind::Plane}) {
      SCOPED_TRACE(kNames[static_cast<int>(kind)]);
      for (int round = 0; round < 400; ++round) {
        const Scene scene = sceneOf(random, kind);
        const Segments points = segmentsNear(random, scene, false);
        const auto bounds = laneDistances(scene, points);
        for (int lane = 0; lane < kLanes; ++lane) {
          const double exact = exactDistance(scene, points.x[lane], points.g[lane]);
          // A corner of the larger set is off by the slack in each of three coordinates.
          EXPECT_GE(bounds[lane], exact / kOutward - 2.5 * scene.slack)
              << "size " << scene.size << ", reach " << scene.reach;
        }
      }
    }
  }
}

/// Beside the edge of a flat ellipsoid: semi-axes that are longer by a slack would take the surface
/// there outwards by a small part of that.
TEST(SimdObstacles, NoBoundIsAboveTheDistanceFromAFlatEllipsoid) {
  for (const std::int64_t target : simd_test::simdTargets()) {
    const OnTarget on(target);
    Random random(34);
    int proven = 0;
    for (int round = 0; round < 2000; ++round) {
      const Ellipsoid shape{{1.0, 1.0, random.scale(1e-7, 1e-4)}};
      Scene scene;
      scene.size = 1.0;
      scene.shape = shape;
      scene.world_from_shape = random.pose(0.0);
      scene.reach = 1.1;
      scene.world =
          compileObstacles({worldGeometry(scene.shape, scene.world_from_shape)}, scene.reach, true);
      Segments points;
      points.g.fill(Vector3d::Zero());
      for (Vector3d& point : points.x) {
        const double way = random.uniform(-std::numbers::pi, std::numbers::pi);
        const double out = 1.0 + random.uniform(-1.0, 1.0) * random.scale(1e-8, 1e-5);
        const double up = random.scale(1e-8, 1e-4);
        point = asSingle(scene.world_from_shape *
                         Vector3d(out * std::cos(way), out * std::sin(way), up));
      }
      const auto bounds = laneDistances(scene, points);
      for (int lane = 0; lane < kLanes; ++lane) {
        const double exact = exactDistance(scene, points.x[lane], points.g[lane]);
        ASSERT_LE(bounds[lane], exact * kOutward) << round << ", semi-axis " << shape.semiAxes.z();
        proven += bounds[lane] > 0.0 ? 1 : 0;
      }
    }
    EXPECT_GT(proven, 3000);
  }
}

/// Motion along a face costs nothing: the bound of a segment beside a box is that of a point.
TEST(SimdObstacles, SlidingAlongAFaceIsExact) {
  Scene scene;
  scene.size = 1.0;
  scene.shape = Box{{0.5, 0.5, 0.5}};
  scene.world_from_shape = Isometry3d::Identity();
  scene.reach = 3.0;
  scene.world =
      compileObstacles({worldGeometry(scene.shape, scene.world_from_shape)}, scene.reach, true);
  Segments segments;
  segments.x.fill({0.0, 0.0, 0.75});
  segments.g.fill({0.4, 0.3, 0.0});
  for (const double bound : laneDistances(scene, segments)) EXPECT_NEAR(bound, 0.25, 2e-5);
}

/// No distance is shown where a coordinate is no number.
TEST(SimdObstacles, NothingIsShownForWhatIsNoNumber) {
  for (const std::int64_t target : simd_test::simdTargets()) {
    const OnTarget on(target);
    Random random(33);
    int shown = 0;
    for (int kind = 0; kind < kKinds; ++kind) {
      SCOPED_TRACE(kNames[kind]);
      for (int round = 0; round < 100; ++round) {
        const Scene scene = sceneOf(random, static_cast<Kind>(kind));
        Segments segments = segmentsNear(random, scene, true);
        const int lane = random.below(kLanes);
        Vector3d& spoilt = random.chance(0.5) ? segments.x[lane] : segments.g[lane];
        spoilt[random.below(3)] = std::numeric_limits<double>::quiet_NaN();
        const auto bounds = laneDistances(scene, segments);
        for (int i = 0; i < kLanes; ++i) {
          if (i == lane) {
            EXPECT_FALSE(bounds[i] > 0.0);
          } else {
            shown += bounds[i] > 0.0 ? 1 : 0;
          }
        }
      }
    }
    EXPECT_GT(shown, 2500);
  }
}

/// Of two numbers one of which is NaN, and of equal ones, it is the second, bit by bit.
TEST(SimdLanes, TheLargerAndTheSmallerAreTheSameOnEachInstructionSet) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Row a{{1.0F, -2.0F, kNan, 3.0F, 0.0F, -0.0F, kInfinity, -kInfinity}};
  const Row b{{2.0F, -3.0F, 3.0F, kNan, -0.0F, 0.0F, kNan, 5.0F}};
  for (const std::int64_t target : simd_test::simdTargets()) {
    const OnTarget on(target);
    Row most, least;
    SWEPT_DISPATCH(compareRows)(a, b, most, least);
    for (int i = 0; i < kLanes; ++i) {
      SCOPED_TRACE(i);
      const float x = a.lane[i], y = b.lane[i];
      EXPECT_EQ(std::bit_cast<std::uint32_t>(most.lane[i]),
                std::bit_cast<std::uint32_t>(x > y ? x : y));
      EXPECT_EQ(std::bit_cast<std::uint32_t>(least.lane[i]),
                std::bit_cast<std::uint32_t>(x < y ? x : y));
    }
  }
}

}  // namespace
}  // namespace swept::detail
#endif
