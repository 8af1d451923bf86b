// SPDX-License-Identifier: BSD-3-Clause
// The next version of a checker (rook7) for the next frame of a sensor: a cloud, or boxes, as one
// body each or as parts of one body. An argument N stops at N points and boxes.
#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

#include "box_worlds.hpp"
#include "models_dir.hpp"
#include "number_argument.hpp"
#include "swept/robot_model/checker.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

using Eigen::Vector3d;

constexpr int kTurns = 5;

double clockSeconds(clockid_t clock) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The least of all turns, s, on all threads.
struct Times {
  double wall = std::numeric_limits<double>::infinity();
  double cpu = std::numeric_limits<double>::infinity();
};

/// `run` is told the number of the turn.
template <typename Run>
Times least(const Run& run) {
  Times times;
  for (int turn = 0; turn < kTurns; ++turn) {
    const double wall = clockSeconds(CLOCK_MONOTONIC);
    const double cpu = clockSeconds(CLOCK_PROCESS_CPUTIME_ID);
    run(turn);
    times.wall = std::min(times.wall, clockSeconds(CLOCK_MONOTONIC) - wall);
    times.cpu = std::min(times.cpu, clockSeconds(CLOCK_PROCESS_CPUTIME_ID) - cpu);
  }
  return times;
}

std::string milliseconds(const Times& times) {
  return number(1e3 * times.wall) + " (" + number(1e3 * times.cpu) + ")";
}

/// Points at random on the surfaces of the twelve boxes, which move a little with each frame.
std::vector<Vector3d> pointsOf(int count, int frame) {
  const std::vector<PlacedBox> boxes = twelveBoxes();
  std::vector<double> areas;
  for (const PlacedBox& box : boxes) areas.push_back(surfaceArea(box.size));
  std::mt19937 random(static_cast<unsigned>(frame));
  std::discrete_distribution<std::size_t> boxAt(areas.begin(), areas.end());
  std::uniform_real_distribution<double> along(-0.5, 0.5);
  std::vector<Vector3d> points;
  for (int i = 0; i < count; ++i) {
    const PlacedBox& box = boxes[boxAt(random)];
    const Vector3d& s = box.size;
    std::discrete_distribution<int> sides({s.y() * s.z(), s.z() * s.x(), s.x() * s.y()});
    Vector3d at(along(random), along(random), along(random));
    const int axis = sides(random);
    at[axis] = at[axis] < 0.0 ? -0.5 : 0.5;
    points.emplace_back(box.world_from_box * s.cwiseProduct(at) + Vector3d(0.001 * frame, 0, 0));
  }
  return points;
}

/// Cubes of a map.
std::vector<Eigen::Isometry3d> placesOf(int count, int frame) {
  std::vector<Eigen::Isometry3d> places;
  for (const Vector3d& point : pointsOf(count, frame))
    places.push_back(Eigen::Isometry3d(Eigen::Translation3d(point)));
  return places;
}

Checker emptyChecker() {
  const std::string rook7 = modelsDir() + "/robots/rook7/rook7";
  const auto robot = Robot::load(rook7 + ".urdf", rook7 + ".srdf");
  World world;
  world.add("table", makeBox({0.6, 0.6, 0.05}),
            Eigen::Isometry3d(Eigen::Translation3d(0, -0.7, 0)));
  return Checker(robot, robot->groups().front().name,
                 std::make_shared<const World>(std::move(world)));
}

void cloudRow(const MarkdownTable& table, const Checker& empty, int count) {
  std::vector<std::vector<Vector3d>> frames;
  for (int frame = 0; frame < kTurns + 1; ++frame) frames.push_back(pointsOf(count, frame));
  std::vector<PointCloud> clouds;
  const Times build =
      least([&](int turn) { clouds.push_back(PointCloud::build(frames[turn], 0.005)); });
  const auto bodyOf = [](const PointCloud& cloud) {
    return WorldBody{.name = "cloud", .parts = {{cloud, Eigen::Isometry3d::Identity()}}};
  };
  const Checker first = empty.withBody(bodyOf(PointCloud::build(frames.back(), 0.005)));
  const Times version = least([&](int turn) { (void)first.withReplaced(bodyOf(clouds[turn])); });
  table.row({std::to_string(frames[0].size()), milliseconds(build), milliseconds(version)});
}

void boxRow(const MarkdownTable& table, const Checker& empty, int count, bool parts) {
  std::vector<std::vector<Eigen::Isometry3d>> frames;
  for (int frame = 0; frame < kTurns + 1; ++frame) frames.push_back(placesOf(count, frame));
  const double side = squareSide(twelveBoxes(), count);
  const auto bodyOf = [&](int frame) {
    WorldBody body{.name = "map", .parts = {}};
    for (const Eigen::Isometry3d& place : frames[frame])
      body.parts.push_back({makeBox(Vector3d::Constant(side)), place});
    return body;
  };
  const auto worldOf = [&](int frame) {
    World world = empty.world();
    if (parts) {
      world.add(bodyOf(frame));
    } else {
      for (std::size_t i = 0; i < frames[frame].size(); ++i)
        world.add("box" + std::to_string(i), makeBox(Vector3d::Constant(side)), frames[frame][i]);
    }
    return world;
  };
  std::vector<std::shared_ptr<const World>> worlds;
  const double before = heapBytes();
  const Times build =
      least([&](int turn) { worlds.push_back(std::make_shared<const World>(worldOf(turn))); });
  const double worldBytes = (heapBytes() - before) / kTurns;
  const Checker first = empty.withWorld(std::make_shared<const World>(worldOf(kTurns)));
  double bytes = 0.0;
  const Times version = least([&](int turn) {
    const double without = heapBytes();
    const Checker next = first.withWorld(worlds[turn]);
    bytes = heapBytes() - without;
  });
  const auto all = static_cast<double>(frames[0].size());
  table.row({std::to_string(frames[0].size()), parts ? "parts" : "bodies", milliseconds(build),
             milliseconds(version), number(worldBytes / all), number(bytes / all)});
}

void report(std::size_t most) {
  const Checker empty = emptyChecker();
  const MarkdownTable clouds({"points", "cloud, ms wall (CPU)", "version, ms wall (CPU)"});
  for (const int count : {1000, 10'000, 100'000, 1'000'000})
    if (static_cast<std::size_t>(count) <= most) cloudRow(clouds, empty, count);
  std::puts("");
  const MarkdownTable boxes({"boxes", "as", "world, ms wall (CPU)", "version, ms wall (CPU)",
                             "world, bytes each", "version, bytes each"});
  for (const int count : {1000, 10'000, 100'000, 1'000'000})
    for (const bool parts : {false, true})
      if (static_cast<std::size_t>(count) <= most) boxRow(boxes, empty, count, parts);
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  const auto most = argc > 1 ? swept::benchmark::countOf(argv[1], SIZE_MAX) : SIZE_MAX;
  if (!most || *most < 1000 || argc > 2) {
    std::fputs("usage: sensed_versions_benchmark [N], points and boxes, N from 1000\n", stderr);
    return 2;
  }
  swept::benchmark::report(*most);
}
