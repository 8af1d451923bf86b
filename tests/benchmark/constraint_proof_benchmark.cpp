// SPDX-License-Identifier: BSD-3-Clause
// What a constraint adds to the proof of one straight motion. Random chords of an arm in a scene,
// at most L rad in each joint, under one constraint that holds in the middle of each: time of the
// verdict without the constraint and with it, of chords that keep it and of chords that leave it.
// rook7 in shelf.yaml; where SWEPT_DATA has the Panda, that too, in the same scene.
//   constraint_proof_benchmark [CHORDS]  (of each row, default 60)
#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "data_folder.hpp"
#include "exit_code.hpp"
#include "models_dir.hpp"
#include "number_argument.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "timing.hpp"

namespace swept::benchmark {
namespace {

using States = std::vector<double>;

constexpr int kRuns = 60;
constexpr int kRepeats = 20;  // of each chord in a run
constexpr int kTries = 600;

/// A kind of constraint, made for the pose (model frame) that a link has in the middle of a chord.
struct Kind {
  std::string name;
  TaskConstraint (*make)(const std::string& link, const Eigen::Isometry3d& pose);
};

TaskConstraint axisWithin(const std::string& link, const Eigen::Isometry3d& pose, double degrees) {
  AxisConstraint own{.frame = {.body = link}, .direction = pose.linear().col(2)};
  own.angle = degrees * std::numbers::pi / 180.0;
  return {.axes = {own}};
}

TaskConstraint turnWithin(const std::string& link, const Eigen::Isometry3d& pose,
                          OrientationConstraint::Parameterization parameterization,
                          const Eigen::Vector3d& tolerance) {
  return {.orientations = {{.frame = {.body = link},
                            .orientation = Eigen::Quaterniond(pose.linear()),
                            .tolerance = tolerance,
                            .parameterization = parameterization}}};
}

const std::vector<Kind>& kinds() {
  using Link = const std::string&;
  using Pose = const Eigen::Isometry3d&;
  using Parameterization = OrientationConstraint::Parameterization;
  static const std::vector<Kind> all = {
      {"axis within 10 degrees", [](Link link, Pose pose) { return axisWithin(link, pose, 10); }},
      {"axis within 5 degrees", [](Link link, Pose pose) { return axisWithin(link, pose, 5); }},
      {"axis within 1 degree", [](Link link, Pose pose) { return axisWithin(link, pose, 1); }},
      {"Euler angles 0.35, 0.35, any",
       [](Link link, Pose pose) {
         return turnWithin(link, pose, Parameterization::EulerAngles,
                           {0.35, 0.35, std::numbers::pi});
       }},
      {"rotation vector 0.35",
       [](Link link, Pose pose) {
         return turnWithin(link, pose, Parameterization::RotationVector, {0.35, 0.35, 0.35});
       }},
      {"box of 0.2 m",
       [](Link link, Pose pose) {
         return TaskConstraint::inside(link, Eigen::Vector3d::Constant(0.2), pose);
       }},
      {"0.02 m from a plane",
       [](Link link, Pose pose) {
         return TaskConstraint::onPlane(link, pose.translation(), Eigen::Vector3d::UnitZ(), 0.02);
       }},
  };
  return all;
}

struct Chord {
  States from, to;
  std::unique_ptr<const Checker> kept;
  int intervals = 0;
};

struct Chords {
  std::vector<Chord> keep, leave;
};

Chords chordsOf(const Checker& checker, const InverseKinematics& hand, const std::string& link,
                const Kind& kind, double length, std::size_t count) {
  Chords found;
  std::mt19937 random(1);
  const auto uniform = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  Workspace workspace(checker);
  const Robot& robot = checker.robot();
  for (int n = 0; n < kTries && (found.keep.size() < count || found.leave.size() < count); ++n) {
    Chord chord;
    for (const int variable : checker.group().variables) {
      const Variable& range = robot.variables()[static_cast<std::size_t>(variable)];
      chord.from.push_back(uniform(range.lower + length, range.upper - length));
      chord.to.push_back(chord.from.back() + uniform(-length, length));
    }
    if (checker.certifyMotion(chord.from, chord.to, workspace).verdict != Verdict::Free) continue;
    const Eigen::VectorXd middle = checker.interpolate(chord.from, chord.to, 0.5);
    const Eigen::Isometry3d pose = hand.pose({middle.data(), checker.group().variables.size()});
    chord.kept = std::make_unique<const Checker>(checker.withConstraints(kind.make(link, pose)));
    Workspace keeping(*chord.kept);
    const MotionCertificate own = chord.kept->certifyMotion(chord.from, chord.to, keeping);
    chord.intervals = own.effort.constrained;
    if (own.verdict == Verdict::Undecided) continue;
    std::vector<Chord>& list = own.verdict == Verdict::Free ? found.keep : found.leave;
    if (list.size() < count) list.push_back(std::move(chord));
  }
  return found;
}

/// us of one chord's verdict, the mean of the least of all runs.
double microseconds(const std::vector<Chord>& chords, const Checker* checker) {
  if (chords.empty()) return std::numeric_limits<double>::quiet_NaN();
  double sum = 0.0;
  for (const Chord& chord : chords) {
    const Checker& asked = checker == nullptr ? *chord.kept : *checker;
    Workspace workspace(asked);
    double least = std::numeric_limits<double>::infinity();
    for (int run = 0; run < kRuns; ++run) {
      const double begin = cpuSeconds();
      for (int i = 0; i < kRepeats; ++i)
        asked.certifyMotion(chord.from, chord.to, workspace, MotionQuery::VerdictOnly);
      least = std::min(least, cpuSeconds() - begin);
    }
    sum += least / kRepeats;
  }
  return 1e6 * sum / static_cast<double>(chords.size());
}

struct Arm {
  std::string name, urdf, srdf, group, link;
};

void run(const Arm& arm, std::size_t count) {
  const auto robot = Robot::load(arm.urdf, arm.srdf);
  const auto world = std::make_shared<const World>(World::load(modelsDir() + "/scenes/shelf.yaml"));
  const Checker checker(robot, arm.group, world);
  const InverseKinematics hand(robot, arm.group, arm.link);
  std::cout << "\n" << arm.name << ", " << count << " chords of each kind, us of CPU time\n\n";
  const MarkdownTable table(
      {"L", "constraint", "without", "with", "ratio", "intervals", "leaving"});
  for (const double length : {0.05, 0.2, 0.5})
    for (const Kind& kind : kinds()) {
      const Chords chords = chordsOf(checker, hand, arm.link, kind, length, count);
      double intervals = 0.0;
      for (const Chord& chord : chords.keep) intervals += chord.intervals;
      const double without = microseconds(chords.keep, &checker);
      const double with = microseconds(chords.keep, nullptr);
      table.row({number(length), kind.name, number(without), number(with), number(with / without),
                 number(intervals / static_cast<double>(chords.keep.size())),
                 number(microseconds(chords.leave, nullptr))});
    }
}

std::optional<std::size_t> optionsOf(int argc, char** argv) {
  if (argc > 2) return std::nullopt;
  return argc == 2 ? countOf(argv[1], 10000) : std::optional<std::size_t>(60);
}

}  // namespace
}  // namespace swept::benchmark

int main(int argc, char** argv) {
  using namespace swept::benchmark;
  return exitCodeOf(
      optionsOf(argc, argv), "constraint_proof_benchmark [CHORDS]", [](std::size_t count) {
        const std::string rook = modelsDir() + "/robots/rook7/rook7";
        run({"rook7", rook + ".urdf", rook + ".srdf", "arm", "tool"}, count);
        if (const auto data = dataFolder()) {
          const std::string panda = (*data / "robots" / "panda" / "panda").string();
          run({"Panda", panda + ".urdf", panda + ".srdf", "panda_arm", "panda_hand"}, count);
        }
        return true;
      });
}
