// SPDX-License-Identifier: BSD-3-Clause
// Motions of two and four equal arms at once, which stand on a circle and look to its middle:
// `cells_benchmark URDF SRDF GROUP [RADIUS [MOTIONS]]` (m, default 0.6; default 4000 motions). All
// joints of all arms move, over 0.1, 0.5, 1 or 2 rad in the norm of all values of one arm, from
// states without a collision. A motion that is Free is looked at once more each 0.01 rad.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <iomanip>
#include <iostream>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/work_cell.hpp"

namespace {

using namespace swept;

std::shared_ptr<const Robot> ring(int count, const char* urdf, const char* srdf,
                                  const std::string& group, double radius) {
  WorkCell cell{.name = "ring", .robots = {}, .groups = {{.name = "arms", .groups = {}}}};
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.linear() = Eigen::AngleAxisd(angle + std::numbers::pi, Eigen::Vector3d::UnitZ()).matrix();
    pose.translation() = radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    const std::string name = "arm" + std::to_string(i + 1);
    cell.robots.push_back({.name = name, .urdf = urdf, .srdf = srdf, .parent_from_robot = pose});
    cell.groups.front().groups.push_back(name + "/" + group);
  }
  return loadWorkCell(cell);
}

struct Motion {
  Eigen::VectorXd from, to;
};

std::vector<Motion> randomMotions(const Checker& checker, int arms, int count) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  Workspace workspace(checker);
  const Group& group = checker.group();
  const auto size = static_cast<Eigen::Index>(group.variables.size());
  std::vector<Motion> motions;
  while (std::ssize(motions) < count) {
    Motion motion{Eigen::VectorXd(size), Eigen::VectorXd(size)};
    for (Eigen::Index v = 0; v < size; ++v) {
      const Variable& variable = checker.robot().variables()[group.variables[v]];
      motion.from[v] =
          std::uniform_real_distribution<double>(variable.lower, variable.upper)(random);
      motion.to[v] = normal(random);
    }
    if (checker.checkState(motion.from, workspace) != Verdict::Free) continue;
    const double length = std::vector{0.1, 0.5, 1.0, 2.0}[motions.size() % 4];
    motion.to = motion.from + motion.to * (length * std::sqrt(arms) / motion.to.norm());
    for (Eigen::Index v = 0; v < size; ++v) {
      const Variable& variable = checker.robot().variables()[group.variables[v]];
      motion.to[v] = std::clamp(motion.to[v], variable.lower, variable.upper);
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

bool collidesAtSamples(const Checker& checker, const Motion& motion, Workspace& workspace) {
  const int steps = 1 + static_cast<int>((motion.to - motion.from).norm() / 0.01);
  for (int k = 0; k <= steps; ++k) {
    const Eigen::VectorXd q = motion.from + (motion.to - motion.from) * k / steps;
    if (checker.checkState(q, workspace) == Verdict::Collision) return true;
  }
  return false;
}

void measure(int arms, const std::shared_ptr<const Robot>& robot, int count) {
  const Checker checker(robot, "arms", std::make_shared<World>());
  Workspace workspace(checker);
  const std::vector<Motion> motions = randomMotions(checker, arms, count);
  struct Sum {
    int count = 0;
    double seconds = 0.0;
    double mean() const { return count > 0 ? 1e6 * seconds / count : 0.0; }
  };
  std::vector<Sum> sums(4);
  int missed = 0;
  for (const Motion& motion : motions) {
    double best = 1e9;
    Verdict verdict = Verdict::Undecided;
    for (int pass = 0; pass < 5; ++pass) {
      const auto begin = std::chrono::steady_clock::now();
      verdict = checker.certifyMotion(motion.from, motion.to, workspace, MotionQuery::VerdictOnly)
                    .verdict;
      best = std::min(
          best, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    }
    for (const int kind : {verdict == Verdict::Free        ? 0
                           : verdict == Verdict::Collision ? 1
                                                           : 2,
                           3}) {
      ++sums[static_cast<std::size_t>(kind)].count;
      sums[static_cast<std::size_t>(kind)].seconds += best;
    }
    if (verdict == Verdict::Free && collidesAtSamples(checker, motion, workspace)) ++missed;
  }
  std::cout << std::setw(2) << arms << " arms, " << checker.group().variables.size() << " joints: ";
  const char* const names[] = {"free", "colliding", "undecided", "all"};
  for (std::size_t i = 0; i < 4; ++i)
    std::cout << names[i] << ' ' << sums[i].count << ", mean " << std::setprecision(3)
              << sums[i].mean() << " us; ";
  std::cout << "missed " << missed << '\n';
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) {
    std::cerr << "usage: cells_benchmark URDF SRDF GROUP [RADIUS [MOTIONS]]\n";
    return 1;
  }
  const double radius = argc > 4 ? std::stod(argv[4]) : 0.6;
  const int count = argc > 5 ? std::stoi(argv[5]) : 4000;
  for (const int arms : {1, 2, 4})
    measure(arms, ring(arms, argv[1], argv[2], argv[3], radius), count);
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
