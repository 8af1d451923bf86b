// SPDX-License-Identifier: BSD-3-Clause
/// Planned paths (see paths/README.md): every segment must get the verdict that is stored for it,
/// up to the same place, and a free one must not be free once something stands in its way. Files
/// are named ROBOT.SCENE.GROUP.PLANNER.NUMBER.csv.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include "first_hit.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/checker.hpp"

namespace {

using swept::Checker;
using swept::MotionCertificate;
using swept::Verdict;
using swept::Workspace;

const std::filesystem::path kModels = modelsDir();
const std::filesystem::path kPaths = SWEPT_PATHS_DIR;
constexpr char kVerdicts[] = "verdicts.csv";

/// Of t: three digits are stored, and of the last millimetre before a contact more or less may be
/// proven.
constexpr double kSamePlace = 2e-3;

struct Expected {
  Verdict verdict;
  double freeUntil;
};

struct StoredPath {
  std::string file, robot, scene, group, planner;
  bool discrete;  ///< planned with motions checked at samples only
  std::vector<std::string> names;
  std::vector<std::vector<double>> states;
  std::vector<Expected> segments;  ///< one fewer than states
};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
  return parts;
}

Verdict verdictFrom(const std::string& text) {
  for (const Verdict verdict : {Verdict::Free, Verdict::Collision, Verdict::Undecided})
    if (toString(verdict) == text) return verdict;
  throw std::runtime_error(std::string(kVerdicts) + ": no verdict is called '" + text + "'");
}

using Verdicts = std::map<std::string, std::vector<Expected>>;

/// Lines `file,segment,verdict,free_until`, the segments of a file in order.
Verdicts readVerdicts() {
  Verdicts verdicts;
  std::ifstream stream(kPaths / kVerdicts);
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    const auto fields = split(line, ',');
    std::vector<Expected>& segments = verdicts[fields.at(0)];
    if (std::stoul(fields.at(1)) != segments.size())
      throw std::runtime_error(std::string(kVerdicts) + ": a segment is missing before: " + line);
    segments.push_back({verdictFrom(fields.at(2)), std::stod(fields.at(3))});
  }
  return verdicts;
}

StoredPath read(const std::filesystem::path& file) {
  StoredPath path;
  path.file = file.filename().string();
  const auto parts = split(path.file, '.');
  path.robot = parts.at(0);
  path.scene = parts.at(1);
  path.group = parts.at(2);
  path.planner = parts.at(3).substr(0, parts.at(3).find('-'));
  path.discrete = parts.at(3).ends_with("-discrete");
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

/// In the order of their names. Throws when paths and verdicts do not belong together.
std::vector<StoredPath> readPaths() {
  Verdicts verdicts = readVerdicts();
  std::vector<StoredPath> paths;
  for (const auto& entry : std::filesystem::directory_iterator(kPaths)) {
    const auto& file = entry.path();
    if (file.extension() != ".csv" || file.filename() == kVerdicts) continue;
    paths.push_back(read(file));
    paths.back().segments = std::move(verdicts[paths.back().file]);
    verdicts.erase(paths.back().file);
    if (paths.back().segments.size() + 1 != paths.back().states.size())
      throw std::runtime_error(std::string(kVerdicts) + ": not one verdict for each segment of " +
                               paths.back().file);
  }
  if (!verdicts.empty())
    throw std::runtime_error(std::string(kVerdicts) + ": no such file: " + verdicts.begin()->first);
  std::ranges::sort(paths, {}, &StoredPath::file);
  return paths;
}

const std::vector<StoredPath>& storedPaths() {
  static const std::vector<StoredPath> paths = readPaths();
  return paths;
}

std::shared_ptr<const swept::Robot> robotOf(const StoredPath& path) {
  static std::map<std::string, std::shared_ptr<const swept::Robot>> robots;
  auto& robot = robots[path.robot];
  const auto folder = kModels / "robots" / path.robot;
  if (!robot)
    robot = swept::Robot::load(folder / (path.robot + ".urdf"), folder / (path.robot + ".srdf"));
  return robot;
}

std::shared_ptr<const swept::World> worldOf(const StoredPath& path) {
  return std::make_shared<const swept::World>(
      swept::World::load(kModels / "scenes" / (path.scene + ".yaml")));
}

const Checker& emptyCheckerOf(const StoredPath& path) {
  static std::map<std::string, std::unique_ptr<const Checker>> checkers;
  auto& checker = checkers[path.robot + " " + path.group];
  if (!checker)
    checker = std::make_unique<const Checker>(robotOf(path), path.group,
                                              std::make_shared<const swept::World>());
  return *checker;
}

std::string told(Verdict verdict, double freeUntil) {
  char until[32];
  std::snprintf(until, sizeof until, ", free until %.3f", freeUntil);
  return std::string(toString(verdict)) + until;
}

/// What is no longer as it is stored, and where; empty when all is.
std::string change(const StoredPath& path, std::size_t segment, const MotionCertificate& now) {
  const Expected& was = path.segments[segment];
  if (now.verdict == was.verdict && std::abs(now.freeUntil - was.freeUntil) <= kSamePlace)
    return {};
  return path.file + ": segment " + std::to_string(segment) + " was " +
         told(was.verdict, was.freeUntil) + ", and is " + told(now.verdict, now.freeUntil);
}

TEST(StoredPaths, KeepTheVerdictOfEverySegment) {
  for (const StoredPath& path : storedPaths()) {
    const Checker checker(robotOf(path), path.group, worldOf(path));
    Workspace workspace(checker);
    std::vector<std::string> names;
    for (const int v : checker.group().variables)
      names.push_back(checker.robot().variables()[v].name);
    ASSERT_EQ(names, path.names) << path.file;
    ASSERT_GE(path.states.size(), 3U) << path.file << ": a direct connection is no regression test";
    for (std::size_t i = 0; i + 1 < path.states.size(); ++i) {
      EXPECT_EQ(
          change(path, i, checker.certifyMotion(path.states[i], path.states[i + 1], workspace)),
          "");
    }
    for (std::size_t i = 0; i < path.states.size(); ++i)
      EXPECT_TRUE(checker.withinLimits(path.states[i])) << path.file << ": state " << i;
  }
}

TEST(StoredPaths, AreOfManyRobotsScenesAndPlanners) {
  std::set<std::string> robots, scenes, groups, planners;
  std::map<Verdict, int> segments;
  int paths = 0, colliding = 0;
  for (const StoredPath& path : storedPaths()) {
    for (const Expected& segment : path.segments) ++segments[segment.verdict];
    const bool free = std::ranges::all_of(
        path.segments, [](const Expected& segment) { return segment.verdict == Verdict::Free; });
    EXPECT_EQ(free, !path.discrete) << path.file;
    if (path.planner == "unrecorded") continue;
    ++paths;
    colliding += !free;
    robots.insert(path.robot);
    scenes.insert(path.scene);
    groups.insert(path.robot + " " + path.group);
    planners.insert(path.planner);
  }
  EXPECT_GE(paths, 60);
  EXPECT_GE(colliding, 12);
  EXPECT_EQ(robots, (std::set<std::string>{"drifter", "rook6", "rook6_cart", "rook7"}));
  EXPECT_EQ(scenes, (std::set<std::string>{"bin", "cage", "empty", "narrow_slot", "shelf",
                                           "table_objects", "tunnel_trap"}));
  EXPECT_GE(groups.size(), 7U);
  EXPECT_GE(planners.size(), 20U);
  EXPECT_GE(segments[Verdict::Free], 250);
  EXPECT_GE(segments[Verdict::Collision], 20);
}

/// In a world without bodies most of what collides is free; the message says which segment it was.
TEST(StoredPaths, NameTheSegmentThatChanged) {
  int changed = 0, asked = 0;
  for (const StoredPath& path : storedPaths()) {
    const Checker& empty = emptyCheckerOf(path);
    Workspace workspace(empty);
    for (std::size_t i = 0; i < path.segments.size(); ++i) {
      if (path.segments[i].verdict != Verdict::Collision) continue;
      ++asked;
      const auto now = empty.certifyMotion(path.states[i], path.states[i + 1], workspace);
      if (now.verdict != Verdict::Free) continue;
      ++changed;
      char until[32];
      std::snprintf(until, sizeof until, "%.3f", path.segments[i].freeUntil);
      EXPECT_EQ(change(path, i, now), path.file + ": segment " + std::to_string(i) +
                                          " was collision, free until " + until +
                                          ", and is free, free until 1.000");
    }
  }
  EXPECT_GT(changed, asked / 2);
  StoredPath path = storedPaths().front();
  MotionCertificate now;
  now.verdict = path.segments[1].verdict = Verdict::Collision;
  path.segments[1].freeUntil = 0.25;
  now.freeUntil = 0.251;
  EXPECT_EQ(change(path, 1, now), "");
  now.freeUntil = 0.24;
  EXPECT_EQ(change(path, 1, now), path.file + ": segment 1 was collision, free until 0.250, and " +
                                      "is collision, free until 0.240");
}

/// The stored verdicts against states alone: no state of a free segment collides, and those of a
/// colliding one do from the stored place on, where there is hardly any room left.
TEST(StoredPaths, AreWhatTheirStatesAre) {
  int hit = 0, grazed = 0;
  for (const StoredPath& path : storedPaths()) {
    const Checker checker = emptyCheckerOf(path).withWorld(worldOf(path));
    Workspace workspace(checker);
    for (std::size_t i = 0; i < path.segments.size(); ++i) {
      SCOPED_TRACE(path.file + ": segment " + std::to_string(i));
      const Expected& segment = path.segments[i];
      const double t = firstHit(checker, path.states[i], path.states[i + 1], 1e-3, workspace);
      if (segment.verdict != Verdict::Collision) {
        EXPECT_EQ(t, 2.0);
        continue;
      }
      (t <= 1.0 ? hit : grazed) += 1;
      EXPECT_GE(t, segment.freeUntil - kSamePlace);
      const Eigen::VectorXd q =
          checker.interpolate(path.states[i], path.states[i + 1], segment.freeUntil);
      const std::span<const double> values(q.data(), static_cast<std::size_t>(q.size()));
      EXPECT_LT(checker.clearance(values, workspace), 0.01);
    }
  }
  EXPECT_GT(hit, 20);
  EXPECT_LT(grazed, 3);
}

/// A version for a margin within which everything is, with a ball to be near to.
Checker seekerOf(const StoredPath& path) {
  auto far = std::make_shared<swept::World>();
  far->add("probe", swept::Sphere{0.01}, Eigen::Isometry3d(Eigen::Translation3d(1.2, 0.8, 0.9)));
  swept::CheckerOptions near;
  near.margin = 10.0;
  return {robotOf(path), path.group, far, near};
}

/// The point of a link that moves in the world which is nearest to the seeker's ball.
Eigen::Vector3d pointOfALink(const Checker& seeker, const Eigen::VectorXd& q) {
  Workspace workspace(seeker);
  const auto report = seeker.reportState({q.data(), static_cast<std::size_t>(q.size())}, workspace);
  const swept::Witness* nearest = nullptr;
  for (const swept::Witness& witness : report.contacts) {
    if (witness.bodyB != "probe") continue;
    if (nearest == nullptr || witness.distance < nearest->distance) nearest = &witness;
  }
  if (nearest == nullptr) throw std::runtime_error("no link moves in the world");
  return nearest->pointA;
}

/// The same segments with a 1 cm ball put where the robot will be: none may pass.
TEST(StoredPaths, ABallInTheWayIsAlwaysFound) {
  for (const StoredPath& path : storedPaths()) {
    const Checker& empty = emptyCheckerOf(path);
    const Checker seeker = seekerOf(path);
    for (std::size_t i = 0; i + 1 < path.states.size(); ++i) {
      if (path.segments[i].verdict != Verdict::Free) continue;
      const Eigen::VectorXd q = empty.interpolate(path.states[i], path.states[i + 1], 0.37);
      auto blocked = std::make_shared<swept::World>();
      blocked->add("ball", swept::Sphere{0.01},
                   Eigen::Isometry3d(Eigen::Translation3d(pointOfALink(seeker, q))));
      const Checker checker = empty.withWorld(blocked);
      Workspace workspace(checker);
      const auto certificate = checker.certifyMotion(path.states[i], path.states[i + 1], workspace);
      EXPECT_EQ(certificate.verdict, Verdict::Collision) << path.file << ": segment " << i;
    }
  }
}

}  // namespace
