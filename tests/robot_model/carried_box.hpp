// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "sliding_cube.hpp"
#include "swept/proofs/task_proof.hpp"
#include "swept/robot_model/time_parameterization.hpp"

namespace swept::test {

inline Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

/// A task: a cube that slides carries a box over a block. It goes there along x, takes the box on
/// its side, lifts it along z, carries and lowers it, and leaves it along z. A map is sensed again
/// before the cube leaves.
struct CarriedBox {
  static constexpr double kBox = 0.1;  ///< m, side

  static std::shared_ptr<const Robot> robotOf(const std::shared_ptr<const Robot>& cube) {
    return cube->withGroup("along", std::vector<std::string>{"x"})
        ->withGroup("up", std::vector<std::string>{"z"});
  }
  static World world(double mapAt) {
    World world;
    world.add("block", makeBox({0.2, 0.2, 0.2}), at(0.2, 0, 0));
    world.add("map", makeSphere(0.1), at(mapAt, 2, 0));
    return world;
  }
  static CheckerOptions standing(double x, double z) {
    CheckerOptions options;
    options.reference = Eigen::Vector2d(x, z);
    return options;
  }
  Checker checker(const char* group, double x, double z, double mapAt = 0.0) const {
    return {robot_, group, std::make_shared<const World>(world(mapAt)), standing(x, z)};
  }
  static Checker beside(const Checker& checker, double x) {
    return checker.withBody("box", makeBox({kBox, kBox, kBox}), at(x, 0, 0));
  }
  static Checker carrying(const Checker& checker,
                          const Eigen::Isometry3d& cube_from_box = at(0.2, 0, 0)) {
    return checker.withAttached("box", "cube", makeBox({kBox, kBox, kBox}), cube_from_box);
  }
  /// One variable from a value to another, from a time on.
  static TaskPhase phase(const std::string& name, const Checker& checker, double from, double to,
                         double begin, std::vector<TaskChange> changes = {}) {
    const std::vector<std::vector<double>> way{{from}, {to}};
    const RateLimits limits{{1.0}, {2.0}, {1.0}};
    const TimedPath timed = timeParameterize(checker.robot(), checker.group(), way, limits);
    TaskPhase phase{.name = name,
                    .checker = std::make_shared<const Checker>(checker),
                    .trajectory = delayed(timed.trajectory, begin),
                    .certificate = {},
                    .changes = std::move(changes)};
    certify(phase);
    return phase;
  }
  static void certify(TaskPhase& phase) {
    Workspace workspace(*phase.checker);
    phase.certificate = phase.checker->certifyTrajectory(controllerCurve(phase.trajectory),
                                                         workspace, {.clearances = true});
    if (phase.certificate.verdict != Verdict::Free)
      throw std::logic_error("phase '" + phase.name + "' is not free");
  }
  static double endOf(const TaskPhase& phase) { return phase.trajectory.points.back().time; }

  std::vector<TaskPhase> phases() const {
    std::vector<TaskPhase> all;
    all.push_back(phase("reach", beside(checker("along", 0, 0.0), -1.0), -2.0, -1.2, 0.0));
    all.push_back(phase("lift", carrying(checker("up", -1.2, 0)), 0.0, 0.5, endOf(all[0]),
                        {{TaskChange::Kind::Attached, "box"}}));
    all.push_back(phase("carry", carrying(checker("along", 0, 0.5)), -1.2, 1.0, endOf(all[1])));
    all.push_back(phase("lower", carrying(checker("up", 1.0, 0)), 0.5, 0.0, endOf(all[2])));
    all.push_back(phase("leave", beside(checker("up", 1.0, 0, 0.3), 1.2), 0.0, 1.0, endOf(all[3]),
                        {{TaskChange::Kind::Placed, "box"}, {TaskChange::Kind::Sensed, "map"}}));
    return all;
  }
  std::shared_ptr<const Robot> robot_ = robotOf(slidingCube());
};

}  // namespace swept::test
