// SPDX-License-Identifier: BSD-3-Clause
// Clouds of balls of 1 cm around points of a room's walls: time to build and bytes per point, and
// ns per query of a robot's ball; then the same of grids of lower bounds. FCL's octree of cubes of
// 2 cm beside it, on the same points and balls. `cloud_benchmark [POINTS]`: up to so many points
// (1000000 without). Then two clouds: a gear over terrain, and with SWEPT_DATA the piano in the
// apartment.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "cloud_pair.hpp"
#include "data_folder.hpp"
#include "number_argument.hpp"
#include "swept/core/clearance_grid.hpp"
#include "swept/core/point_cloud.hpp"
#include "swept/core/segment_query.hpp"
#include "timing.hpp"
#include "workloads.hpp"

namespace swept::benchmark {
namespace {

using Eigen::Vector3d;

constexpr double kPointRadius = 0.01;  // m
constexpr double kBallRadius = 0.06;   // m, of the robot
constexpr std::size_t kBalls = 20'000;

class Room {
 public:
  /// On the six walls of a turned room of 4 x 3 x 2.5 m, with noise of 2 mm.
  Vector3d point() {
    const Vector3d half(2.0, 1.5, 1.25);
    Vector3d p(number(half.x()), number(half.y()), number(half.z()));
    const auto wall = static_cast<int>(random_() % 3);
    p[wall] = p[wall] < 0.0 ? -half[wall] : half[wall];
    return turn_ * (p + Vector3d(number(0.002), number(0.002), number(0.002)));
  }
  /// Up to half a metre from a wall.
  Vector3d ball() { return point() + 0.5 * Vector3d(number(1.0), number(1.0), number(1.0)); }

 private:
  double number(double most) { return std::uniform_real_distribution<>(-most, most)(random_); }
  std::mt19937_64 random_{17};
  Eigen::Matrix3d turn_ = Eigen::Quaterniond(0.9, 0.2, 0.3, 0.1).normalized().toRotationMatrix();
};

struct Work {
  std::vector<Vector3d> points;
  std::vector<Vector3d> balls;
};

/// s, the least of `turns`.
double bestOf(int turns, const std::function<void()>& run) {
  double least = std::numeric_limits<double>::infinity();
  for (int turn = 0; turn < turns; ++turn) {
    const double start = cpuSeconds();
    run();
    least = std::min(least, cpuSeconds() - start);
  }
  return least;
}

double nsEach(double seconds, std::size_t count) {
  return 1e9 * seconds / static_cast<double>(count);
}

void printOurs(const Work& work, const MarkdownTable& table) {
  std::optional<PointCloud> cloud;
  const double build = bestOf(3, [&] { cloud = PointCloud::build(work.points, kPointRadius); });
  std::size_t apart = 0;
  const double query = bestOf(5, [&] {
    apart = 0;
    for (const Vector3d& ball : work.balls) apart += isFarther(*cloud, {ball}, kBallRadius) ? 1 : 0;
  });
  double sum = 0.0;  // so that nothing is optimised away
  const double nearest = bestOf(3, [&] {
    for (const Vector3d& ball : work.balls) sum += clearance(*cloud, ball);
  });
  table.row(
      {std::to_string(work.points.size()), "swept", number(nsEach(build, work.points.size())),
       number(static_cast<double>(cloud->bytes()) / static_cast<double>(work.points.size())),
       number(nsEach(query, work.balls.size())), number(nsEach(nearest, work.balls.size())),
       number(100.0 * static_cast<double>(apart) / static_cast<double>(work.balls.size())) + " %"});
  if (std::isnan(sum)) std::printf("a clearance is no number\n");
}

#ifdef SWEPT_HAS_FCL
void printFcl(const Work& work, const MarkdownTable& table) {
  constexpr double kCube = 2.0 * kPointRadius;
  std::shared_ptr<octomap::OcTree> map;
  const double build = bestOf(1, [&] {
    map = std::make_shared<octomap::OcTree>(kCube);
    for (const Vector3d& p : work.points) map->updateNode(p.x(), p.y(), p.z(), true, true);
    map->updateInnerOccupancy();
    map->prune();
  });
  const fcl::CollisionObjectd tree(std::make_shared<fcl::OcTreed>(map));
  fcl::CollisionObjectd ball(std::make_shared<fcl::Sphered>(kBallRadius));
  std::size_t apart = 0;
  const std::size_t count = work.balls.size() / 10;
  const double query = bestOf(3, [&] {
    apart = 0;
    for (std::size_t i = 0; i < count; ++i) {
      ball.setTranslation(work.balls[i]);
      ball.computeAABB();
      fcl::CollisionResultd result;
      apart += fcl::collide(&tree, &ball, {}, result) == 0 ? 1 : 0;
    }
  });
  table.row(
      {std::to_string(work.points.size()), "FCL, octree", number(nsEach(build, work.points.size())),
       number(static_cast<double>(map->memoryUsage()) / static_cast<double>(work.points.size())),
       number(nsEach(query, count)), "-",
       number(100.0 * static_cast<double>(apart) / static_cast<double>(count)) + " %"});
}
#endif

Work workOf(std::size_t count) {
  Room room;
  Work work;
  for (std::size_t i = 0; i < count; ++i) work.points.push_back(room.point());
  for (std::size_t i = 0; i < kBalls; ++i) work.balls.push_back(room.ball());
  return work;
}

void run(std::size_t most) {
  const MarkdownTable table({"points", "", "build, ns per point", "bytes per point",
                             "is a ball apart?, ns", "its clearance, ns", "apart"});
  for (std::size_t count = 10'000; count <= most; count *= 10) {
    const Work work = workOf(count);
    printOurs(work, table);
#ifdef SWEPT_HAS_FCL
    printFcl(work, table);
#endif
    std::fflush(stdout);
  }
}

/// `decided`: of the balls that are apart.
void printGrid(const Work& work, std::size_t cells, const MarkdownTable& table) {
  const PointCloud cloud = PointCloud::build(work.points, kPointRadius);
  ClearanceGridOptions options;
  options.cells = cells;
  std::optional<ClearanceGrid> grid;
  const double build = bestOf(3, [&] { grid = ClearanceGrid::build(cloud, options); });
  std::size_t decided = 0;
  const double query = bestOf(20, [&] {
    decided = 0;
    for (const Vector3d& ball : work.balls) decided += grid->isFarther(ball, kBallRadius) ? 1 : 0;
  });
  double sum = 0.0;  // so that nothing is optimised away
  const double bound = bestOf(20, [&] {
    for (const Vector3d& ball : work.balls) sum += grid->clearance(ball);
  });
  std::vector<double> bounds(work.balls.size());
  const double together = bestOf(20, [&] { grid->clearances(work.balls, bounds); });
  std::size_t apart = 0;
  for (const Vector3d& ball : work.balls) apart += isFarther(cloud, {ball}, kBallRadius) ? 1 : 0;
  const double points = static_cast<double>(work.points.size());
  const double share = static_cast<double>(decided) / static_cast<double>(apart);
  table.row({std::to_string(work.points.size()), std::to_string(cells),
             number(1000.0 * grid->voxel()), number(nsEach(build, work.points.size())),
             number(static_cast<double>(grid->bytes()) / points),
             number(nsEach(query, work.balls.size())), number(nsEach(bound, work.balls.size())),
             number(nsEach(together, work.balls.size())), number(100.0 * share) + " %"});
  if (std::isnan(sum)) std::printf("a clearance is no number\n");
}

void runGrids(std::size_t most) {
  std::printf("\n");
  const MarkdownTable table({"points", "cells", "voxel, mm", "build, ns per point",
                             "bytes per point", "is a ball apart?, ns", "its clearance, ns",
                             "many at once, ns", "decided of those apart"});
  for (std::size_t count = 10'000; count <= most; count *= 10) {
    const Work work = workOf(count);
    for (const int exponent : {16, 19, 22}) printGrid(work, std::size_t{1} << exponent, table);
    std::fflush(stdout);
  }
}

CloudPairWork gearOverTerrain() {
  CloudPairWork work{"gear over terrain",
                     surfacePoints(terrain(200, 100, 4.0), 200'000, 1),
                     surfacePoints(gear(100, 25, 0.4, 12), 20'000, 2),
                     0.02,
                     {}};
  std::mt19937_64 random(3);
  for (int i = 0; i < 200; ++i) work.poses.push_back(randomPose(random, {3.5, 3.5, 0.6}));
  return work;
}

/// Lengths in inches. Near contact, then at random.
CloudPairWork pianoInApartment(const std::filesystem::path& data) {
  constexpr double kInch = 0.0254;  // m
  const nlohmann::json json = readJson(data / "seed_tables" / "piano_apartment.json");
  const auto soup = [&](const char* which) {
    return readObj(data / json.at("meshes").at(which).get<std::string>());
  };
  CloudPairWork work{"piano in apartment",
                     surfacePoints(soup("environment"), 200'000, 1),
                     surfacePoints(soup("robot"), 20'000, 2),
                     0.02 / kInch,
                     {}};
  for (const char* set : {"near_contact", "random"}) {
    for (const nlohmann::json& item : json.at("dcd").at(set).at("configurations"))
      work.poses.push_back(readPose(item.at("pose")));
  }
  return work;
}

void runPairs() {
  constexpr std::size_t kFew = 10;
  std::printf("\n");
  const MarkdownTable table({"clouds", "points", "points", "touching", "collide, ms", "FCL",
                             "ratio", "distance, ms", "FCL", "ratio"});
  printCloudPair(gearOverTerrain(), kFew, table);
  if (const auto data = dataFolder()) printCloudPair(pianoInApartment(*data), kFew, table);
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  const auto most = swept::benchmark::positiveNumber(argc > 1 ? argv[1] : "1000000");
  if (!most) {
    std::cerr << "usage: cloud_benchmark [POINTS]\n";
    return 2;
  }
  swept::benchmark::run(static_cast<std::size_t>(*most));
  swept::benchmark::runGrids(static_cast<std::size_t>(*most));
  swept::benchmark::runPairs();
}
