// SPDX-License-Identifier: BSD-3-Clause
// How much room a state needs to be proven free in a tube, besides what the tube itself reaches.
// robot_model/README.md ("Tubes") has the table that this prints.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "models_dir.hpp"
#include "swept/robot_model/checker.hpp"
#include "trajectories/stage.hpp"

namespace {

using Eigen::Vector3d;
using swept::Checker;
using swept::SignedClearance;
using swept::Verdict;
using swept::Workspace;
using trajectories::Random;
using State = std::vector<double>;

enum class Obstacle { HalfSpace, Box };

constexpr double kFar = 10.0;  // m

/// Its face is at `c` (m) along a direction from the origin; the middle of a box's face is beside a
/// point.
swept::WorldBody wall(Obstacle kind, const Vector3d& n, double c, const Vector3d& beside) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  if (kind == Obstacle::HalfSpace)
    return {.name = "wall", .parts = {{swept::HalfSpace{-n, -c}, pose}}};
  constexpr double kSide = 0.25;  // m
  pose.linear() = Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), n).toRotationMatrix();
  pose.translation() = beside + (c + 0.5 * kSide - n.dot(beside)) * n;
  return {.name = "wall", .parts = {{swept::makeBox({kSide, kSide, kSide}), pose}}};
}

/// rook7 before a wall, of which only that is checked.
Checker armBefore(Obstacle kind, double tolerance) {
  const std::string urdf = modelsDir() + "/robots/rook7/rook7.urdf";
  const auto robot = swept::Robot::load(urdf, swept::Robot::srdfBeside(urdf));
  auto world = std::make_shared<swept::World>();
  world->add(wall(kind, Vector3d::UnitX(), kFar, Vector3d::Zero()));
  swept::CheckerOptions options;
  options.tracking.rotation = tolerance;
  for (const swept::Link& a : robot->links())
    for (const swept::Link& b : robot->links())
      if (a.name < b.name) options.rules.allow(a.name, b.name);
  return {robot, "arm", world, options};
}

/// m.
struct Room {
  double reach = 0.0;  ///< of the tube towards the wall
  double extra = 0.0;  ///< that a proof needs besides
};

/// The least c at which something holds, between two at which it does not and does.
template <typename Holds>
double bisect(double fails, double holds, const Holds& hold) {
  while (holds - fails > 1e-7) {
    const double middle = 0.5 * (fails + holds);
    (hold(middle) ? holds : fails) = middle;
  }
  return holds;
}

/// One configuration and one direction.
class Measurement {
 public:
  Measurement(const Checker& plain, const Checker& tube, Obstacle kind, double tolerance,
              Random& random)
      : plain_(plain), tube_(tube), kind_(kind), tolerance_(tolerance), random_(random) {
    for (const int index : plain.group().variables) {
      const swept::Variable& variable = plain.robot().variables()[static_cast<std::size_t>(index)];
      q_.push_back(random.uniform(variable.lower, variable.upper));
    }
    n_ = random.direction();
  }

  Room measure() {
    const Checker far = plain_.withReplaced(wall(Obstacle::HalfSpace, n_, kFar, {0, 0, 0}));
    Workspace workspace(far);
    const SignedClearance nearest = far.signedClearance(q_, workspace);
    nearest_ = nearest.pointA;
    const double touches = kFar - nearest.upper;
    const std::vector<State> corners = farthest(far, workspace);
    // No point of the arm is farther than this from any joint.
    const double most = touches + 1.5 * tolerance_ * static_cast<double>(q_.size()) + 1e-3;
    const double least = bisect(touches, most, [&](double c) { return stayApart(corners, c); });
    const double proven = bisect(touches, most, [&](double c) { return isFree(c); });
    return {least - touches, proven - least};
  }

 private:
  /// Corners of the tube that come far along the direction: from several on, each joint in turn
  /// goes to its other end as long as that is farther.
  std::vector<State> farthest(const Checker& far, Workspace& workspace) {
    std::vector<State> all;
    const auto clearance = [&](const State& q) { return far.signedClearance(q, workspace).upper; };
    for (int start = 0; start < 4; ++start) {
      State corner = q_;
      for (double& value : corner) value += tolerance_ * random_.sign();
      double least = clearance(corner);
      for (bool better = true; better;) {
        better = false;
        for (std::size_t i = 0; i < q_.size(); ++i) {
          State other = corner;
          other[i] = 2.0 * q_[i] - other[i];
          const double own = clearance(other);
          if (!(own < least)) continue;
          least = own;
          corner = other;
          better = true;
        }
      }
      all.push_back(corner);
    }
    return all;
  }

  bool stayApart(const std::vector<State>& corners, double c) const {
    const Checker checker = plain_.withReplaced(wall(kind_, n_, c, nearest_));
    Workspace workspace(checker);
    return std::ranges::all_of(
        corners, [&](const State& q) { return checker.checkState(q, workspace) == Verdict::Free; });
  }

  bool isFree(double c) const {
    const Checker checker = tube_.withReplaced(wall(kind_, n_, c, nearest_));
    Workspace workspace(checker);
    return checker.checkState(q_, workspace) == Verdict::Free;
  }

  const Checker& plain_;
  const Checker& tube_;
  const Obstacle kind_;
  const double tolerance_;  ///< rad
  Random& random_;
  State q_;
  Vector3d n_, nearest_;
};

struct Row {
  Obstacle obstacle;
  double tolerance;  ///< rad
  double most;       ///< 95 % of the shares are below
};

/// Shares of the reach that a proof needs besides, with a quarter more than is measured.
constexpr std::array kRows{
    Row{Obstacle::HalfSpace, 0.001, 0.46}, Row{Obstacle::HalfSpace, 0.005, 0.52},
    Row{Obstacle::HalfSpace, 0.01, 0.60},  Row{Obstacle::HalfSpace, 0.02, 1.02},
    Row{Obstacle::Box, 0.001, 0.41},       Row{Obstacle::Box, 0.005, 0.34},
    Row{Obstacle::Box, 0.01, 0.59},        Row{Obstacle::Box, 0.02, 0.74}};

TEST(TubeRoom, IsNoMoreThanWasMeasured) {
  constexpr std::size_t kConfigurations = 60;
  std::printf("| obstacle | tube, rad | reach, mm | median | 95 %% | largest |\n");
  for (const Row& row : kRows) {
    const Checker plain = armBefore(row.obstacle, 0.0);
    const Checker tube = armBefore(row.obstacle, row.tolerance);
    Random random(93, 0);
    std::vector<double> reaches, shares;
    while (shares.size() < kConfigurations) {
      const Room room = Measurement(plain, tube, row.obstacle, row.tolerance, random).measure();
      // Away from what is fixed there is no reach to compare with.
      if (room.reach < 0.2 * row.tolerance) continue;
      EXPECT_GE(room.extra, -1e-6);
      reaches.push_back(room.reach);
      shares.push_back(room.extra / room.reach);
    }
    std::ranges::sort(reaches);
    std::ranges::sort(shares);
    const double high = shares[kConfigurations * 95 / 100];
    std::printf("| %s | %g | %.3g | %.3g %% | %.3g %% | %.3g %% |\n",
                row.obstacle == Obstacle::Box ? "box" : "half-space", row.tolerance,
                1e3 * reaches[kConfigurations / 2], 100.0 * shares[kConfigurations / 2],
                100.0 * high, 100.0 * shares.back());
    EXPECT_LE(high, row.most);
  }
}

}  // namespace
