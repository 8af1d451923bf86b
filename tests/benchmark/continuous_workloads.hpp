// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "continuous_link.hpp"
#include "continuous_truth.hpp"
#include "models_dir.hpp"
#include "workloads.hpp"

/// Motions that all hit, with first contacts known to about 1e-12 m from closed forms, triangle
/// tests or, for a cloud, every ball against every triangle.
namespace swept::benchmark {

constexpr int kSweepsPerCurve = 40;

struct CurveWorkload {
  std::string name;
  Shape still, moving;
  std::vector<Sweep> sweeps;
#ifdef SWEPT_HAS_FCL
  std::vector<FclBodies> peers = {};  ///< variants, of which the faster counts; may be empty
#endif
};

inline std::vector<Eigen::Vector3d> corners(const Eigen::Vector3d& half) {
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 8; ++i)
    points.emplace_back(i & 1 ? half.x() : -half.x(), i & 2 ? half.y() : -half.y(),
                        i & 4 ? half.z() : -half.z());
  return points;
}

inline Soup boxSoup(const Eigen::Vector3d& half) {
  return {corners(half),
          {{0, 2, 1},
           {1, 2, 3},
           {4, 5, 6},
           {5, 7, 6},
           {0, 1, 4},
           {1, 5, 4},
           {2, 6, 3},
           {3, 6, 7},
           {0, 4, 2},
           {2, 4, 6},
           {1, 3, 5},
           {3, 7, 5}}};
}

inline Soup hullSoup(const ConvexHull& hull) {
  return {hull.vertices(), hull.faces()};
}

/// Makes sweeps until enough hit, but not at the start.
inline void fill(CurveWorkload& work, const Probe& probe, std::span<const Eigen::Vector3d> points,
                 double reach, const std::function<Sweep()>& propose) {
  while (work.sweeps.size() < kSweepsPerCurve) {
    Sweep sweep = propose();
    sweep.still =
        std::make_shared<UniformMotion>(UniformMotion::still(Eigen::Isometry3d::Identity()));
    if (probe.touches(sweep.motion->at(0.0))) continue;
    sweep.speed = fastestPoint(*sweep.motion, points);
    sweep.truth = firstContact(probe, sweep, 1e-7);
    if (!sweep.truth.hit) continue;
#ifdef SWEPT_HAS_FCL
    if (addFclMotions(sweep, reach) > 1e-9)
      throw std::runtime_error(work.name + ": not the path of the other library");
#else
    static_cast<void>(reach);
#endif
    work.sweeps.push_back(sweep);
  }
}

/// From about `far` away through about the origin to the other side, turning by 0.3 to 2 rad.
inline Sweep pass(std::mt19937_64& random, double far, double miss) {
  const Eigen::Vector3d along = far * direction(random);
  Eigen::Isometry3d start = randomPose(random, Eigen::Vector3d::Constant(miss));
  start.translation() += along;
  Sweep sweep;
  sweep.kind = PathKind::Linear;
  sweep.motion = std::make_shared<UniformMotion>(
      UniformMotion::turning(start, uniform(random, 0.3, 2.0) * direction(random), -2.0 * along));
  return sweep;
}

/// 2 mm thick; the ball passes within a 50th of the motion.
inline CurveWorkload ballThroughPlate(std::mt19937_64& random) {
  const double radius = 0.02, half = 0.001;
  CurveWorkload work{"ball, thin plate", makeBox({4.0, 4.0, 2.0 * half}), makeSphere(radius), {}};
  const Probe probe{[=](const Eigen::Isometry3d& pose) {
                      return std::abs(pose.translation().z()) - radius - half;
                    },
                    [=](const Eigen::Isometry3d& pose) {
                      return std::abs(pose.translation().z()) <= radius + half;
                    }};
  fill(work, probe, std::vector<Eigen::Vector3d>{Eigen::Vector3d::Zero()}, radius, [&]() -> Sweep {
    Eigen::Isometry3d start = Eigen::Isometry3d::Identity();
    start.translation() = Eigen::Vector3d(uniform(random, -0.5, 0.5), uniform(random, -0.5, 0.5),
                                          uniform(random, 0.3, 1.0));
    const Eigen::Vector3d way(uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0), -2.0);
    Sweep sweep;
    sweep.motion = std::make_shared<UniformMotion>(UniformMotion::translation(start, way));
    return sweep;
  });
#ifdef SWEPT_HAS_FCL
  work.peers = {
      {std::make_shared<fcl::Sphered>(radius), std::make_shared<fcl::Boxd>(4.0, 4.0, 2.0 * half)}};
#endif
  return work;
}

inline CurveWorkload tumblingBox(std::mt19937_64& random) {
  const Eigen::Vector3d half(0.3, 0.2, 0.1);
  const std::vector<Eigen::Vector3d> points = corners(half);
  CurveWorkload work{"tumbling box, half-space",
                     makeHalfSpace(Eigen::Vector3d::UnitZ(), 0.0),
                     makeBox(2.0 * half),
                     {}};
  const auto height = [points](const Eigen::Isometry3d& pose) {
    double least = std::numeric_limits<double>::infinity();
    for (const Eigen::Vector3d& point : points) least = std::min(least, (pose * point).z());
    return least;
  };
  const Probe probe{height, [=](const Eigen::Isometry3d& pose) { return height(pose) <= 0.0; }};
  fill(work, probe, points, half.norm(), [&]() -> Sweep {
    Eigen::Isometry3d start = randomPose(random, Eigen::Vector3d::Constant(0.2));
    start.translation().z() += 0.8;
    Sweep sweep;
    sweep.kind = PathKind::Linear;
    sweep.motion = std::make_shared<UniformMotion>(UniformMotion::turning(
        start, uniform(random, 0.3, 3.0) * direction(random), Eigen::Vector3d(0.1, -0.2, -1.0)));
    return sweep;
  });
#ifdef SWEPT_HAS_FCL
  work.peers = {{std::make_shared<fcl::Boxd>(2.0 * half),
                 std::make_shared<fcl::Halfspaced>(Eigen::Vector3d(0.0, 0.0, 1.0), 0.0)}};
#endif
  return work;
}

/// The distance is brute force, with few points and triangles.
inline CurveWorkload linkPastCloud(std::mt19937_64& random) {
  const double radius = 0.01;
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 400; ++i) points.push_back(0.1 * direction(random));
  const Soup mesh = bumpySphere(108, 0.05);
  CurveWorkload work{"mesh, 400 points",
                     PointCloud::build(points, radius),
                     TriangleMesh::build(mesh.vertices, mesh.triangles),
                     {}};
  fill(work, cloudProbe(points, radius, mesh), mesh.vertices, 0.05,
       [&] { return pass(random, 0.5, 0.05); });
  return work;  // FCL has no cloud of balls
}

#ifdef SWEPT_HAS_FCL
/// Bodies of triangles: FCL's distance between them finds the first contact, its triangle test
/// sharpens it.
inline void fillMeshes(CurveWorkload& work, const Soup& still, const Soup& moving, double reach,
                       const std::function<Sweep()>& propose) {
  const FclBodies bodies{fclModel<fcl::OBBRSSd>(moving), fclModel<fcl::OBBRSSd>(still)};
  fill(work, fclProbe(bodies), moving.vertices, reach, propose);
  if (!work.peers.empty()) return;
  work.peers = {{fclModel<fcl::OBBd>(moving), fclModel<fcl::OBBd>(still)}, bodies};
}

inline std::vector<CurveWorkload> meshCurves(std::mt19937_64& random) {
  std::vector<CurveWorkload> list;
  const std::filesystem::path models = std::filesystem::path(modelsDir()) / "robots";
  const LinkUnderTest hand(models / "rook7" / "rook7", "arm", "hand");
  const LinkUnderTest wrist(models / "rook6" / "rook6", "arm", "wrist_1");
  const Soup handSoup = soupOf(hand.mesh()), wristSoup = soupOf(wrist.mesh());
  const double handReach = boundingSphere(hand.shape()).radius;
  const auto past = [&] { return pass(random, 0.4, 0.05); };

  const Eigen::Vector3d half(0.1, 0.075, 0.05);
  CurveWorkload& box =
      list.emplace_back(CurveWorkload{"link mesh, box", makeBox(2.0 * half), hand.shape(), {}, {}});
  const auto fclBox = std::make_shared<fcl::Boxd>(2.0 * half);
  box.peers = {{fclModel<fcl::OBBd>(handSoup), fclBox}, {fclModel<fcl::OBBRSSd>(handSoup), fclBox}};
  fillMeshes(box, boxSoup(half), handSoup, handReach, past);

  fillMeshes(
      list.emplace_back(CurveWorkload{"link mesh, link mesh", wrist.shape(), hand.shape(), {}, {}}),
      wristSoup, handSoup, handReach, past);

  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 40; ++i) points.push_back(0.1 * direction(random));
  const ConvexHull first = ConvexHull::of(std::span(points).first(20));
  const ConvexHull second = ConvexHull::of(std::span(points).last(20));
  fillMeshes(list.emplace_back(CurveWorkload{"convex, convex", first, second, {}, {}}),
             hullSoup(first), hullSoup(second), 0.1, past);

  const Soup torus = bumpyTorus(40, 16, 0.2, 0.06);
  const Shape shape = TriangleMesh::build(torus.vertices, torus.triangles);
  fillMeshes(list.emplace_back(CurveWorkload{"torus, torus", shape, shape, {}, {}}), torus, torus,
             0.3, [&] { return pass(random, 0.8, 0.1); });
  return list;
}
#endif

inline std::vector<CurveWorkload> curveWorkloads() {
  std::mt19937_64 random(31);
  std::vector<CurveWorkload> list;
  list.push_back(ballThroughPlate(random));
  list.push_back(tumblingBox(random));
  list.push_back(linkPastCloud(random));
#ifdef SWEPT_HAS_FCL
  for (CurveWorkload& work : meshCurves(random)) list.push_back(std::move(work));
#else
  std::printf("pairs of meshes skipped: what is true is found with FCL\n\n");
#endif
  return list;
}

}  // namespace swept::benchmark
