// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "model_robots.hpp"
#include "random_trajectories.hpp"
#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"

/// Proofs of random trajectories of the models hold.
namespace swept::test {
namespace {

struct Subject {
  const char* robot;
  const char* group;
  const char* scene;
  std::vector<double> begin;  ///< empty: the default state
};

const Subject kSubjects[] = {
    {"rook7", "arm", "shelf", {0.0, -0.3, 0.0, 1.9, 0.0, 1.54, 0.0}},
    {"rook7", "arm_with_gripper", "empty", {}},
    {"rook6", "arm", "table_objects", {0.0, -0.5, 1.75, 0.32, -1.5708, 0.0}},
    {"rook6_cart", "whole_body", "table_objects", {-1.5, 0, 0, 0, -0.6, 1.2, -0.6, 0, 0}},
};

/// No tube, two of one size, and one that is another for each joint.
constexpr double kTubes[] = {0.0, 0.001, 0.005, -1.0};

TrackingTolerance trackingOf(const Robot& robot, const Group& group, double size) {
  TrackingTolerance tracking;
  if (size >= 0.0) {
    tracking.rotation = size;
    tracking.translation = 0.5 * size;
    return tracking;
  }
  for (std::size_t i = 0; i < group.joints.size(); ++i) {
    const Joint& joint = robot.joints()[static_cast<std::size_t>(group.joints[i])];
    const double own = 0.001 * static_cast<double>(i % 4);
    tracking.joints[joint.name] = {.rotation = own, .translation = 0.5 * own};
  }
  return tracking;
}

class RandomTrajectoryProof : public testing::TestWithParam<Subject> {
 protected:
  RandomTrajectoryProof()
      : robot_(modelRobot(GetParam().robot)),
        world_(std::make_shared<const World>(
            World::load(modelsDir() + "/scenes/" + GetParam().scene + ".yaml"))) {}

  Checker checkerWith(double tube) const {
    const Checker plain(robot_, GetParam().group, world_);
    CheckerOptions options;
    options.tracking = trackingOf(*robot_, plain.group(), tube);
    return {robot_, GetParam().group, world_, options};
  }

  void expectProof(const Checker& checker, const JointTrajectory& trajectory,
                   const TrajectoryCertificate& certificate) {
    const std::filesystem::path file = folder_.path() / "proof.json";
    const WrittenProof written = writeTrajectoryProof(file, checker, trajectory, certificate);
    EXPECT_EQ(written.missing, "");
    if (!written.isWritten()) return;
    const CheckedProof proof = verifyProof(file, checker);
    EXPECT_EQ(proof.refusal, "");
    EXPECT_EQ(proof.segments, trajectory.points.size() - 1);
    EXPECT_EQ(proof.duration, trajectory.points.back().time - trajectory.points.front().time);
    EXPECT_GT(proof.clearance, 0.0);
    EXPECT_LE(proof.clearanceWorld, certificate.world->upper);
    EXPECT_LE(proof.clearanceSelf, certificate.self->upper);
    planes_ += proof.planes;
    pieces_ += proof.segments;
  }

  std::shared_ptr<const Robot> robot_;
  std::shared_ptr<const World> world_;
  TemporaryFolder folder_;
  std::size_t planes_ = 0, pieces_ = 0;
};

TEST_P(RandomTrajectoryProof, HoldsOfWhatIsFree) {
  constexpr int kEach = 2;
  int made = 0, proven = 0, touching = 0;
  for (const double tube : kTubes) {
    const Checker checker = checkerWith(tube);
    Workspace workspace(checker);
    RandomTrajectories random(checker, 5);
    const std::vector<double> begin =
        GetParam().begin.empty() ? namedConfiguration(*robot_, checker.group(), kDefaultState)
                                 : GetParam().begin;
    for (const Spline spline : {Spline::Linear, Spline::Cubic, Spline::Quintic, Spline::Mixed}) {
      for (int i = 0; i < kEach; ++i) {
        const JointTrajectory trajectory = random.make(begin, 4, i == 0 ? 1.2 : 0.25, spline);
        const TrajectoryCertificate certificate =
            checker.certifyTrajectory(controllerCurve(trajectory), workspace, {.clearances = true});
        ++made;
        touching += certificate.verdict == Verdict::Collision ? 1 : 0;
        if (certificate.verdict != Verdict::Free || !certificate.violations.empty()) continue;
        ++proven;
        expectProof(checker, trajectory, certificate);
      }
    }
  }
  std::cout << made << " made, " << touching << " touch, " << proven << " proven, " << pieces_
            << " pieces, " << planes_ << " planes" << std::endl;
  EXPECT_GE(proven, made / 4);
  EXPECT_LT(proven, made);
}

/// A plate as near to what moves as the tube just leaves room for. There planes between whole
/// links show nothing, in intervals of any length: those between parts of them do.
TEST(TightTrajectoryProof, HoldsOfNearlyAllThatIsFree) {
  const auto robot = modelRobot("rook7");
  CheckerOptions options;
  options.tracking.rotation = 0.005;
  const Checker empty(robot, "arm", std::make_shared<const World>(), options);
  const TemporaryFolder folder;
  RandomTrajectories random(empty, 9);
  constexpr double kRoom = 2e-4;  // m
  int tight = 0, proven = 0;
  for (int i = 0; i < 24; ++i) {
    const JointTrajectory trajectory =
        random.make({0.0, -0.3, 0.0, 1.9, 0.0, 1.54, 0.0}, 2, 0.3, Spline::Cubic);
    const PiecewisePolynomial curve = controllerCurve(trajectory);
    const Eigen::Isometry3d wrist = linkPose(*robot, "arm", i % 2 == 0 ? "link5" : "hand",
                                             curve.position(0.5 * (curve.begin() + curve.end())));
    const auto checkerAt = [&](double distance) {
      return empty.withBody(
          "plate", makeBox({0.5, 0.5, 0.02}),
          wrist *
              Eigen::AngleAxisd(0.7 * i, Eigen::Vector3d(1.0, 0.3 * (i % 3), 0.2).normalized()) *
              Eigen::Translation3d(0.0, 0.0, distance));
    };
    const auto certify = [&](const Checker& checker) {
      Workspace workspace(checker);
      return checker.certifyTrajectory(curve, workspace, {.clearances = true});
    };
    double open = 0.0, free = 1.0;
    if (certify(checkerAt(free)).verdict != Verdict::Free) continue;
    while (free - open > 2e-5) {
      const double middle = 0.5 * (open + free);
      (certify(checkerAt(middle)).verdict == Verdict::Free ? free : open) = middle;
    }
    ++tight;
    const Checker checker = checkerAt(free + kRoom);
    const std::filesystem::path file = folder.path() / "proof.json";
    if (!writeTrajectoryProof(file, checker, trajectory, certify(checker)).isWritten()) continue;
    EXPECT_EQ(verifyProof(file, checker).refusal, "");
    ++proven;
  }
  std::cout << proven << " of " << tight << std::endl;
  EXPECT_GT(tight, 12);
  EXPECT_GE(5 * proven, 4 * tight);
}

INSTANTIATE_TEST_SUITE_P(Models, RandomTrajectoryProof, testing::ValuesIn(kSubjects));

}  // namespace
}  // namespace swept::test
