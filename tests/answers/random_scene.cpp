// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "site.hpp"
#include "swept/core/shapes.hpp"
#include "swept/robot_model/collision_rules.hpp"

namespace swept::answers {
namespace {

constexpr double kTurn = 6.28318530717958648;

/// A ring: closed, not convex.
TriangleMesh ring(Random& random, MeshInterior interior) {
  const int around = 8 + static_cast<int>(random.below(8));
  const int across = 5 + static_cast<int>(random.below(4));
  const double large = random.uniform(0.06, 0.2);
  const double small = large * random.uniform(0.1, 0.4);
  std::vector<Eigen::Vector3d> corners;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < around; ++i) {
    for (int k = 0; k < across; ++k) {
      const double a = kTurn * i / around;
      const double b = kTurn * k / across;
      const double r = large + small * std::cos(b);
      corners.emplace_back(r * std::cos(a), r * std::sin(a), small * std::sin(b));
      const int next = (i + 1) % around;
      const int up = (k + 1) % across;
      triangles.emplace_back(across * i + k, across * next + k, across * next + up);
      triangles.emplace_back(across * i + k, across * next + up, across * i + up);
    }
  }
  return TriangleMesh::build(corners, triangles, interior);
}

/// A sheet with hills: open.
TriangleMesh sheet(Random& random) {
  constexpr int kSide = 7;
  const double side = random.uniform(0.1, 0.4);
  std::vector<Eigen::Vector3d> corners;
  std::vector<Eigen::Vector3i> triangles;
  for (int i = 0; i < kSide; ++i) {
    for (int k = 0; k < kSide; ++k) {
      corners.emplace_back(side * i / kSide, side * k / kSide, random.uniform(0, 0.05));
      if (i + 1 == kSide || k + 1 == kSide) continue;
      triangles.emplace_back(kSide * i + k, kSide * (i + 1) + k, kSide * (i + 1) + k + 1);
      triangles.emplace_back(kSide * i + k, kSide * (i + 1) + k + 1, kSide * i + k + 1);
    }
  }
  return TriangleMesh::build(corners, triangles);
}

std::vector<Eigen::Vector3d> points(Random& random, std::size_t count, double half) {
  std::vector<Eigen::Vector3d> all;
  for (std::size_t i = 0; i < count; ++i)
    all.push_back(random.inBox({-half, -half, -half}, {half, half, half}));
  return all;
}

PointCloud cloud(Random& random) {
  const auto all = points(random, 50 + random.below(400), random.uniform(0.05, 0.25));
  if (random.oneIn(2)) return PointCloud::build(all, random.uniform(0, 0.02));
  std::vector<double> radii;
  for (std::size_t i = 0; i < all.size(); ++i) radii.push_back(random.uniform(0, 0.02));
  return PointCloud::build(all, radii);
}

const std::array kShapes{"spheres",    "boxes",       "cylinders",     "capsules", "cones",
                         "ellipsoids", "hulls",       "meshes",        "sheets",   "clouds",
                         "planes",     "half_spaces", "surface_rings", "triangles"};

Shape makeShape(const std::string& kind, Random& random) {
  const double size = random.uniform(0.02, 0.12);
  const double length = random.uniform(0.02, 0.5);
  if (kind == "spheres") return makeSphere(size);
  if (kind == "boxes") return makeBox(random.inBox({0.02, 0.02, 0.02}, {0.4, 0.3, 0.2}));
  if (kind == "cylinders") return makeCylinder(size, length);
  if (kind == "capsules") return makeCapsule(size, length);
  if (kind == "cones") return makeCone(size, length);
  if (kind == "ellipsoids")
    return makeEllipsoid(random.inBox({0.02, 0.02, 0.02}, {0.2, 0.15, 0.1}));
  if (kind == "hulls") return ConvexHull::of(points(random, 4 + random.below(60), size));
  if (kind == "meshes") return ring(random, MeshInterior::Solid);
  if (kind == "surface_rings") return ring(random, MeshInterior::Surface);
  if (kind == "sheets") return sheet(random);
  if (kind == "clouds") return cloud(random);
  if (kind == "triangles") {
    const auto corners = points(random, 3, 0.2);
    return makeTriangle(corners[0], corners[1], corners[2]);
  }
  // Below or beside most of the robot.
  const Eigen::Vector3d normal =
      random.inBox({-0.3, -0.3, 0.7}, {0.3, 0.3, 1.0}) * random.uniform(0.5, 2.0);
  if (kind == "planes") return makePlane(normal, 0.0);
  if (kind == "half_spaces") return makeHalfSpace(normal, 0.0);
  throw std::invalid_argument("no shapes '" + kind + "'");
}

Shape anyBounded(Random& random) {
  for (;;) {
    const std::string kind = kShapes[random.below(kShapes.size())];
    if (kind != "planes" && kind != "half_spaces") return makeShape(kind, random);
  }
}

Eigen::Isometry3d makePose(const Eigen::Vector3d& place, const Eigen::Matrix3d& turn) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = place;
  pose.linear() = turn;
  return pose;
}

Eigen::Isometry3d somewhere(Random& random) {
  const Eigen::Vector3d place = random.inBox({-1.0, -1.0, -0.1}, {1.0, 1.0, 1.7});
  return makePose(place, random.rotation());
}

bool isFlat(const std::string& kind) {
  return kind == "planes" || kind == "half_spaces";
}

WorldBody makeBody(const std::string& kind, std::string name, Random& random) {
  WorldBody body{.name = std::move(name)};
  if (isFlat(kind)) {
    const double depth = random.uniform(-0.6, -0.05);
    body.parts.push_back(
        {makeShape(kind, random), makePose({0, 0, depth}, Eigen::Matrix3d::Identity())});
    return body;
  }
  const Eigen::Isometry3d pose = somewhere(random);
  const std::size_t parts = random.oneIn(4) ? 1 + random.below(4) : 1;
  for (std::size_t i = 0; i < parts; ++i) {
    const Eigen::Vector3d aside = 0.1 * static_cast<double>(i) * random.direction();
    body.parts.push_back({makeShape(kind, random), pose * Eigen::Translation3d(aside)});
  }
  return body;
}

World makeWorld(const std::string& kind, Random& random) {
  World world;
  const std::size_t count = isFlat(kind) ? 2 : 4 + random.below(8);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string one = kind == "mixed" ? kShapes[random.below(kShapes.size())] : kind;
    world.add(makeBody(one, "body" + std::to_string(i), random));
  }
  return world;
}

MovingObstacle makeObstacle(std::string name, Random& random) {
  MovingObstacle obstacle{.name = std::move(name)};
  const std::size_t parts = 1 + random.below(2);
  for (std::size_t i = 0; i < parts; ++i) {
    const Eigen::Vector3d aside = 0.05 * random.direction();
    obstacle.parts.push_back({anyBounded(random), makePose(aside, random.rotation())});
  }
  double time = random.uniform(-1, 1);
  const std::size_t waypoints = 1 + random.below(20);
  for (std::size_t i = 0; i < waypoints; ++i) {
    obstacle.waypoints.push_back({time, somewhere(random)});
    time += random.uniform(0.1, 2.0);
  }
  return obstacle;
}

std::string carrierOf(const Robot& robot, const std::string& group, Random& random) {
  const Group& moved = *robot.findGroup(group);
  if (moved.tipLink >= 0 && !random.oneIn(3)) return robot.links()[moved.tipLink].name;
  return robot.links()[robot.joints()[moved.joints[random.below(moved.joints.size())]].childLink]
      .name;
}

AttachedBody makeAttached(std::string name, const Robot& robot, const std::string& group,
                          Random& random) {
  AttachedBody body{.name = std::move(name), .link = carrierOf(robot, group, random)};
  const std::size_t parts = 1 + random.below(3);
  for (std::size_t i = 0; i < parts; ++i) {
    const Eigen::Vector3d aside = random.inBox({-0.05, -0.05, 0.05}, {0.05, 0.05, 0.2});
    body.parts.push_back({anyBounded(random), makePose(aside, random.rotation())});
  }
  if (!random.oneIn(4)) body.touchLinks = {"*"};
  return body;
}

CollisionRules makeRules(const Robot& robot, const World& world, Random& random) {
  const auto link = [&] { return robot.links()[random.below(robot.links().size())].name; };
  const auto body = [&] { return world.bodies()[random.below(world.bodies().size())].name; };
  CollisionRules rules;
  rules.pad(link(), random.uniform(0, 0.02)).pad(body(), random.uniform(0, 0.05));
  rules.scale(link(), random.uniform(0.8, 1.2)).scale(body(), random.uniform(0.7, 1.4));
  rules.margin(link(), body(), random.uniform(0, 0.1)).margin("*", body(), 0.01);
  rules.allow(link(), body()).allow(body(), "*", "out of the way").check(link(), body());
  CollisionRules weaker;
  weaker.allow("*", body()).pad("*", random.uniform(0, 0.005));
  return rules.over(weaker);
}

/// Margins of each kind or none, and how hard to try.
CheckerOptions makeOptions(const Robot& robot, Random& random) {
  CheckerOptions options;
  switch (random.below(4)) {
    case 0:
      options.margin = random.uniform(0, 0.03);
      break;
    case 1:
      options.selfMargin = random.uniform(0, 0.005);
      options.worldMargin = random.uniform(0, 0.05);
      break;
    default:
      break;
  }
  const std::array tolerances{1e-4, 1e-3, 1e-2};
  if (random.oneIn(3)) options.tolerance = tolerances[random.below(tolerances.size())];
  const std::array intervals{8, 64, 1024};
  if (random.oneIn(6)) options.maxIntervals = intervals[random.below(intervals.size())];
  if (random.oneIn(3)) {
    Eigen::VectorXd reference = robot.defaultState();
    for (std::size_t i = 0; i < robot.variables().size(); ++i) {
      const Variable& variable = robot.variables()[i];
      if (variable.lower > -10 && variable.upper < 10 && random.oneIn(2))
        reference[static_cast<Eigen::Index>(i)] = random.uniform(variable.lower, variable.upper);
    }
    options.reference = reference;
  }
  return options;
}

/// One after the other: what changes made of a first version.
Checker makeVersions(const Checker& first, const std::string& group, Random& random) {
  const Robot& robot = first.robot();
  Checker checker = first.withBody(makeBody("boxes", "box", random));
  checker = checker.withBody("ring", ring(random, MeshInterior::Solid), somewhere(random));
  checker = checker.withBody(makeBody("clouds", "cloud", random));
  checker = checker.withAttached(makeAttached("held", robot, group, random));
  checker = checker.withReplaced(makeBody("capsules", "box", random));
  checker = checker.withReplaced("cloud", cloud(random), somewhere(random));
  checker = checker.withAttached(makeAttached("spare", robot, group, random));
  checker = checker.withRules(makeRules(robot, checker.world(), random));
  checker = checker.withoutBody("body1").withoutAttached("held");
  return checker.withWorld(std::make_shared<const World>(checker.world()));
}

}  // namespace

const std::vector<std::string>& randomScenes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all(kShapes.begin(), kShapes.end());
    for (const char* name : {"mixed", "moving", "carrying", "ruled", "versions", "everything"})
      all.emplace_back(name);
    return all;
  }();
  return names;
}

Checker makeRandomScene(const std::string& scene, const std::shared_ptr<const Robot>& robot,
                        const std::string& group, Random random) {
  const bool plain = std::ranges::find(kShapes, scene) != kShapes.end();
  World world = makeWorld(plain ? scene : "mixed", random);
  CheckerOptions options = makeOptions(*robot, random);
  const bool everything = scene == "everything";
  if (everything || scene == "moving") {
    world.add(makeObstacle("shuttle", random));
    world.add(makeObstacle("shuttle2", random));
  }
  if (everything || scene == "carrying")
    options.attached = {makeAttached("held", *robot, group, random)};
  if (everything || scene == "ruled") options.rules = makeRules(*robot, world, random);
  Checker checker(robot, group, std::make_shared<const World>(std::move(world)), options);
  return scene == "versions" ? makeVersions(checker, group, random) : checker;
}

}  // namespace swept::answers
