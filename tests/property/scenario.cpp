// SPDX-License-Identifier: BSD-3-Clause
#include "scenario.hpp"

#include <random>
#include <stdexcept>
#include <string>

#include "oracle/scene.hpp"
#include "swept/robot_model/problems.hpp"

namespace {

Scenario assemble(const ScenarioFiles& files, std::shared_ptr<const swept::World> world,
                  std::vector<oracle::Body> bodies, const swept::CheckerOptions& options) {
  Scenario s;
  s.robot = files.robot;
  s.srdf = files.srdf;
  s.group = files.group;
  swept::LoadOptions load;
  // Some models call their own folder a package.
  load.packages.push_back({"meshes", files.robot.parent_path() / "meshes"});
  auto robot = swept::Robot::load(files.robot, files.srdf, load);
  s.checker = std::make_unique<swept::Checker>(robot, files.group, std::move(world), options);
  s.oracle = std::make_unique<oracle::Oracle>(oracle::Arm(files.robot, files.srdf),
                                              std::move(bodies), files.group);
  const auto& mine = s.oracle->arm().variables();
  for (const int v : s.checker->group().variables) {
    size_t at = 0;
    while (at < mine.size() && mine[at].name != robot->variables()[v].name) ++at;
    if (at == mine.size()) throw std::runtime_error("no variable " + robot->variables()[v].name);
    s.place.push_back(static_cast<int>(at));
  }
  if (s.place.size() != s.oracle->moving().size())
    throw std::runtime_error("checker and oracle disagree about the group's variables");
  return s;
}

Eigen::Isometry3d randomPose(std::mt19937_64& random) {
  std::uniform_real_distribution<double> unit(-1, 1);
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = Eigen::Quaterniond{unit(random), unit(random), unit(random), unit(random)}
                      .normalized()
                      .toRotationMatrix();
  // A ring around the base, so that most of the reach stays open and the base itself is not inside.
  const double angle = 3.141592653589793 * unit(random), r = 0.6 + 0.25 * unit(random);
  pose.translation() =
      Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0.55 + 0.5 * unit(random));
  return pose;
}

}  // namespace

std::vector<double> Scenario::full(const std::vector<double>& groupValues) const {
  if (groupValues.size() != place.size()) {
    throw std::invalid_argument("a configuration of group '" + group + "' has " +
                                std::to_string(place.size()) + " values, not " +
                                std::to_string(groupValues.size()));
  }
  std::vector<double> q = oracle->arm().home();
  for (size_t i = 0; i < place.size(); ++i) q[place[i]] = groupValues[i];
  return q;
}

std::vector<double> Scenario::groupOf(const std::vector<double>& full) const {
  std::vector<double> values;
  for (const int i : place) values.push_back(full[i]);
  return values;
}

Scenario loadScenario(const ScenarioFiles& files, const swept::CheckerOptions& options) {
  auto world = std::make_shared<swept::World>();
  std::vector<oracle::Body> bodies;
  std::string arguments;
  if (!files.scene.empty()) {
    *world = swept::World::load(files.scene);
    bodies = oracle::readScene(files.scene);
    arguments = "--scene " + files.scene.string();
  } else if (!files.problems.empty()) {
    *world = swept::ProblemFile::load(files.problems).problem(files.set, files.index).world;
    bodies = oracle::readProblem(files.problems, files.set, files.index).world;
    arguments = "--problems " + files.problems.string() + " --set " + files.set + " --index " +
                std::to_string(files.index);
  }
  Scenario s = assemble(files, world, std::move(bodies), options);
  s.worldArguments = arguments;
  return s;
}

Clutter makeClutter(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> size(0.03, 0.14);
  Clutter clutter;
  for (int i = 0; i < 20; ++i) {
    swept::WorldBody body;
    oracle::Body twin;
    body.name = twin.name = "clutter" + std::to_string(i);
    auto add = [&](swept::Shape shape, oracle::Piece piece) {
      const Eigen::Isometry3d pose = randomPose(random);
      body.parts.push_back({std::move(shape), pose});
      piece.body_from_piece = pose;
      twin.pieces.push_back(std::move(piece));
    };
    const double a = size(random), b = size(random), c = size(random);
    if (i % 5 == 0) {
      add(swept::makeSphere(a), oracle::Piece(oracle::Sphere{a}));
      add(swept::makeCapsule(0.3 * b, 2 * c), oracle::Piece(oracle::Capsule{0.3 * b, c}));
    } else if (i % 5 == 1) {
      add(swept::makeBox({2 * a, 2 * b, 0.004}), oracle::Piece(oracle::Box{{a, b, 0.002}}));
    } else if (i % 5 == 2) {
      add(swept::makeCylinder(a, 2 * b), oracle::Piece(oracle::Cylinder{a, b}));
      add(swept::makeCylinder(0.002, 6 * b), oracle::Piece(oracle::Cylinder{0.002, 3 * b}));
    } else {
      const std::vector<Eigen::Vector3d> corners{{a, a, a}, {-b, -a, c}, {-a, c, -b}, {b, -c, -a}};
      const std::vector<std::array<int, 3>> faces{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
      std::vector<Eigen::Vector3i> triangles;
      for (const auto& f : faces) triangles.emplace_back(f[0], f[1], f[2]);
      oracle::Piece piece(std::make_shared<oracle::Mesh>(corners, faces));
      if (i % 5 == 3)
        add(swept::ConvexHull::of(corners), std::move(piece));
      else
        add(swept::TriangleMesh::build(corners, triangles), std::move(piece));
    }
    clutter.world.add(std::move(body));
    clutter.twins.push_back(std::move(twin));
  }
  return clutter;
}

Scenario clutterScenario(const ScenarioFiles& files, std::uint64_t seed,
                         const swept::CheckerOptions& options) {
  Clutter clutter = makeClutter(seed);
  Scenario s = assemble(files, std::make_shared<const swept::World>(std::move(clutter.world)),
                        std::move(clutter.twins), options);
  s.worldArguments = "--clutter " + std::to_string(seed);
  s.onlyHere = true;
  return s;
}
