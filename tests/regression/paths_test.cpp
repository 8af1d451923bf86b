// SPDX-License-Identifier: BSD-3-Clause
/// Planned paths, stored as `swept plan -o` wrote them: every segment must still be proven free,
/// and must not be once something stands in its way. Files are named ROBOT.SCENE.GROUP.NUMBER.csv.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "swept/robot_model/checker.hpp"

namespace {

using swept::Verdict;

const std::filesystem::path kModels = SWEPT_MODELS_DIR;

struct StoredPath {
  std::string file, robot, scene, group;
  std::vector<std::string> names;
  std::vector<std::vector<double>> states;
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

StoredPath read(const std::filesystem::path& file) {
  StoredPath path;
  path.file = file.filename().string();
  const auto parts = split(path.file, '.');
  path.robot = parts.at(0);
  path.scene = parts.at(1);
  path.group = parts.at(2);
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  path.names = split(line, ',');
  while (std::getline(stream, line)) {
    std::vector<double> q;
    for (const std::string& value : split(line, ',')) q.push_back(std::stod(value));
    path.states.push_back(std::move(q));
  }
  return path;
}

std::vector<StoredPath> storedPaths() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(SWEPT_PATHS_DIR)) {
    files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<StoredPath> paths;
  for (const auto& file : files) paths.push_back(read(file));
  return paths;
}

std::shared_ptr<const swept::Robot> robotOf(const StoredPath& path) {
  const auto folder = kModels / "robots" / path.robot;
  return swept::Robot::load(folder / (path.robot + ".urdf"), folder / (path.robot + ".srdf"));
}

TEST(StoredPaths, EverySegmentIsStillProvenFree) {
  const auto paths = storedPaths();
  ASSERT_GE(paths.size(), 10U);
  for (const StoredPath& path : paths) {
    const auto robot = robotOf(path);
    const auto world = std::make_shared<swept::World>(
        swept::World::load(kModels / "scenes" / (path.scene + ".yaml")));
    const swept::Checker checker(robot, path.group, world);
    swept::Workspace workspace(checker);
    std::vector<std::string> names;
    for (const int v : checker.group().variables) names.push_back(robot->variables()[v].name);
    ASSERT_EQ(names, path.names) << path.file;
    ASSERT_GE(path.states.size(), 3U) << path.file << ": a direct connection is no regression test";
    for (std::size_t i = 0; i + 1 < path.states.size(); ++i) {
      const auto certificate = checker.certifyMotion(path.states[i], path.states[i + 1], workspace);
      EXPECT_EQ(certificate.verdict, Verdict::Free)
          << path.file << ": segment " << i << " is " << swept::toString(certificate.verdict);
      EXPECT_TRUE(checker.withinLimits(path.states[i])) << path.file << ": state " << i;
    }
  }
}

/// The same segments with a 1 cm ball put where the robot will be: none may pass.
TEST(StoredPaths, ABallInTheWayIsAlwaysFound) {
  for (const StoredPath& path : storedPaths()) {
    const auto robot = robotOf(path);
    const swept::Checker empty(robot, path.group, std::make_shared<swept::World>());
    swept::Workspace probe(empty);
    for (std::size_t i = 0; i + 1 < path.states.size(); ++i) {
      const Eigen::VectorXd q = empty.interpolate(path.states[i], path.states[i + 1], 0.37);
      // A witness between the robot and a far ball is a point of a link that moves in the world.
      auto far = std::make_shared<swept::World>();
      Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
      pose.translation() = Eigen::Vector3d(1.2, 0.8, 0.9);
      far->add("probe", swept::Sphere{0.01}, pose);
      swept::CheckerOptions near;
      near.margin = 10.0;
      const swept::Checker seeker(robot, path.group, far, near);
      swept::Workspace seeking(seeker);
      const auto report =
          seeker.reportState({q.data(), static_cast<std::size_t>(q.size())}, seeking);
      const swept::Witness* nearest = nullptr;
      for (const swept::Witness& witness : report.contacts) {
        if (witness.bodyB != "probe") continue;
        if (nearest == nullptr || witness.distance < nearest->distance) nearest = &witness;
      }
      ASSERT_NE(nearest, nullptr);
      auto blocked = std::make_shared<swept::World>();
      pose.translation() = nearest->pointA;
      blocked->add("ball", swept::Sphere{0.01}, pose);
      const swept::Checker checker(robot, path.group, blocked);
      swept::Workspace workspace(checker);
      const auto certificate = checker.certifyMotion(path.states[i], path.states[i + 1], workspace);
      EXPECT_EQ(certificate.verdict, Verdict::Collision) << path.file << ": segment " << i;
    }
  }
}

}  // namespace
