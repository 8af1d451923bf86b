// SPDX-License-Identifier: BSD-3-Clause
// Straight lines of a tool: ToolLinePlanner beside interpolation with inverse kinematics every 5
// mm, whose states alone are checked. Random lines of 0.3 m from free states, half of them with a
// turn, of robots among the bodies of a scene. `line_benchmark [LINES]` (default 300 per robot).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "data_folder.hpp"
#include "models_dir.hpp"
#include "number_argument.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/planning_scene.hpp"
#include "swept/robot_model/tool_line.hpp"

namespace {

using namespace swept;
using Eigen::Isometry3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;
using States = std::vector<std::vector<double>>;

constexpr double kLength = 0.3;    // m
constexpr double kSpacing = 5e-3;  // m, of the interpolation
constexpr double kJump = 0.2;      // rad, more than which from one sample to the next is a jump

double milliseconds(const auto& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
      .count();
}

struct Off {
  double position = 0.0, angle = 0.0;  // m, rad
};

/// By 100 samples between two states. `shares`: of the line.
Off sampledOff(const ToolLinePlanner& tool, const States& states, const std::vector<double>& shares,
               const Isometry3d& from, const Isometry3d& to) {
  Off off;
  const Vector3d way = to.translation() - from.translation();
  const Quaterniond r0(from.linear()), r1(to.linear());
  for (std::size_t i = 1; i < states.size(); ++i)
    for (int k = 0; k <= 100; ++k) {
      const double t = k / 100.0, share = shares[i - 1] + t * (shares[i] - shares[i - 1]);
      const Isometry3d pose = tool.pose(tool.checker().interpolate(states[i - 1], states[i], t));
      const Vector3d x = pose.translation() - from.translation();
      off.position = std::max(off.position, (x - x.dot(way) / way.squaredNorm() * way).norm());
      off.angle =
          std::max(off.angle, Quaterniond(pose.linear()).angularDistance(r0.slerp(share, r1)));
    }
  return off;
}

struct Tally {
  int complete = 0, missed = 0;
  std::vector<double> times;      // ms, of the complete ones
  std::vector<double> wayPoints;  // likewise
  Off most;
  void take(double time, std::size_t points, const Off& off) {
    ++complete;
    times.push_back(time);
    wayPoints.push_back(static_cast<double>(points));
    most.position = std::max(most.position, off.position);
    most.angle = std::max(most.angle, off.angle);
  }
  static double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0.0;
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
  }
  void print(const std::string& name, int lines) const {
    std::cout << "  " << name << ": complete " << complete << " of " << lines << ", median "
              << quantile(times, 0.5) << " ms, p95 " << quantile(times, 0.95) << " ms, way points "
              << quantile(wayPoints, 0.5) << ", p95 " << quantile(wayPoints, 0.95)
              << "; sampled, off by up to " << 1e3 * most.position << " mm, "
              << most.angle * 180.0 / std::numbers::pi << " degrees";
  }
};

/// Empty where a sample is not solved for, jumps, or is not free.
States interpolated(const Checker& checker, const InverseKinematics& solver,
                    InverseKinematics::Workspace& scratch, Workspace& workspace,
                    const std::vector<double>& start, const Isometry3d& from,
                    const Isometry3d& to) {
  const int count = static_cast<int>(std::ceil(kLength / kSpacing));
  const Quaterniond r0(from.linear()), r1(to.linear());
  States states{start};
  for (int i = 1; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    Isometry3d pose(
        Eigen::Translation3d((1.0 - share) * from.translation() + share * to.translation()));
    pose.rotate(r0.slerp(share, r1));
    std::vector<double> q = states.back();
    if (!solver.solve(pose, q, {}, scratch)) return {};
    for (std::size_t k = 0; k < q.size(); ++k)
      if (std::abs(std::remainder(q[k] - states.back()[k], 2.0 * std::numbers::pi)) > kJump)
        return {};
    if (checker.checkState(q, workspace) != Verdict::Free) return {};
    states.push_back(std::move(q));
  }
  return states;
}

void compare(const std::string& name, const std::shared_ptr<const Robot>& robot,
             const std::string& group, const std::shared_ptr<const World>& world, int lines) {
  const auto checker = std::make_shared<const Checker>(robot, group, world);
  const std::string tip = robot->links()[static_cast<std::size_t>(checker->group().tipLink)].name;
  const ToolLinePlanner planner(checker, {.body = tip});
  const InverseKinematics solver(robot, group, tip);
  InverseKinematics::Workspace scratch(solver);
  Workspace workspace(*checker);
  std::mt19937 random(1);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Tally proven, sampled;
  std::map<std::string, int> stops;
  for (int i = 0; i < lines;) {
    std::vector<double> q;
    for (const int v : checker->group().variables) {
      const Variable& variable = robot->variables()[static_cast<std::size_t>(v)];
      q.push_back(uniform(std::max(variable.lower, -std::numbers::pi),
                          std::min(variable.upper, std::numbers::pi)));
    }
    if (checker->checkState(q, workspace) != Verdict::Free) continue;
    ++i;
    const Isometry3d from = planner.pose(q);
    Isometry3d to = from;
    to.pretranslate(kLength *
                    Vector3d(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)).normalized());
    if (i % 2 == 0)
      to.rotate(Eigen::AngleAxisd(uniform(0.1, 0.8), Vector3d(uniform(-1, 1), 1, 1).normalized()));
    ToolLine line;
    const double time = milliseconds([&] { line = planner.plan(q, to, workspace); });
    if (line.complete())
      proven.take(time, line.wayPoints.size(),
                  sampledOff(planner, line.wayPoints, line.shares, from, to));
    else
      ++stops[toString(line.stop->reason)];
    States states;
    const double other = milliseconds(
        [&] { states = interpolated(*checker, solver, scratch, workspace, q, from, to); });
    if (states.empty()) continue;
    std::vector<double> shares;
    for (std::size_t k = 0; k < states.size(); ++k)
      shares.push_back(static_cast<double>(k) / static_cast<double>(states.size() - 1));
    sampled.take(other, states.size(), sampledOff(planner, states, shares, from, to));
    for (std::size_t k = 1; k < states.size(); ++k)
      if (checker->certifyMotion(states[k - 1], states[k], workspace).verdict ==
          Verdict::Collision) {
        ++sampled.missed;
        break;
      }
  }
  std::cout << name << '\n';
  proven.print("proven", lines);
  for (const auto& [reason, count] : stops) std::cout << ", " << reason << ' ' << count;
  std::cout << '\n';
  sampled.print("every 5 mm", lines);
  std::cout << "; in contact between samples " << sampled.missed << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const auto count = argc > 1 ? benchmark::countOf(argv[1], 1'000'000) : 300;
  if (!count || argc > 2) {
    std::cerr << "usage: line_benchmark [LINES]\n";
    return 3;
  }
  const int lines = static_cast<int>(*count);
  std::cout << std::setprecision(3);
  const auto run = [&](const std::string& urdf, const std::string& group,
                       const std::string& scene) {
    const auto robot = Robot::load(urdf, Robot::srdfBeside(urdf));
    compare(robot->name() + ", " + scene, robot, group,
            std::make_shared<const World>(
                PlanningScene::load(modelsDir() + "/scenes/" + scene + ".yaml", *robot).world),
            lines);
  };
  run(modelsDir() + "/robots/rook7/rook7.urdf", "arm", "shelf");
  run(modelsDir() + "/robots/rook6/rook6.urdf", "arm", "bin");
  if (const auto data = dataFolder())
    run((*data / "robots" / "panda" / "panda.urdf").string(), "panda_arm", "shelf");
  return 0;
}
