// SPDX-License-Identifier: BSD-3-Clause
// Paths that are planned under constraints keep them: by proof, and by samples of the poses.
#include <gtest/gtest.h>
#include <ompl/util/Console.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "fixtures.hpp"
#include "models_dir.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/constraint_projection.hpp"
#include "swept/robot_model/link_motion.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using Path = std::vector<std::vector<double>>;

constexpr double kSeconds = 60.0;  // that a search may take; all take far less
constexpr double kDegree = std::numbers::pi / 180.0;

class ConstrainedPlanning : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }

  /// A tall post behind the place that the hand is at in the middle of its way about the base.
  std::shared_ptr<const World> withPost() const {
    auto world = std::make_shared<World>();
    const Eigen::Vector3d hand =
        Eigen::AngleAxisd(0.75, Eigen::Vector3d::UnitZ()) * poseAt(start_).translation();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(1.1 * hand.x(), 1.1 * hand.y(), 0.5);
    world->add("post", Box{{0.06, 0.06, 0.5}}, pose);
    return world;
  }
  Eigen::Isometry3d poseAt(const std::vector<double>& q) const {
    return linkPose(*robot_, "arm", "link7", q);
  }
  std::shared_ptr<const Checker> level(double degrees) const {
    return std::make_shared<const Checker>(
        free_.withConstraints(TaskConstraint::level("link7", poseAt(start_), degrees * kDegree)));
  }
  /// rad, of what points up at the start.
  double tiltAt(const std::vector<double>& q) const {
    const Eigen::Vector3d axis = poseAt(start_).linear().row(2);
    const Eigen::Vector3d up = poseAt(q).linear() * axis;
    return std::atan2(up.head<2>().norm(), up.z());
  }
  static og::SimpleSetupPtr plannedBy(const std::shared_ptr<const Checker>& checker,
                                      const std::vector<double>& start,
                                      const std::vector<double>& goal, std::uint32_t seed) {
    auto setup = makeSimpleSetup(checker);
    setStartAndGoal(*setup, *checker, start, goal);
    const auto planner = std::make_shared<CertifiedConnect>(setup->getSpaceInformation());
    planner->setSeed(seed);
    setup->setPlanner(planner);
    setup->solve(kSeconds);
    return setup;
  }
  static void expectProven(const Path& path, const Checker& checker) {
    Workspace workspace(checker);
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      EXPECT_EQ(checker.certifyMotion(path[i], path[i + 1], workspace).verdict, Verdict::Free);
  }
  /// Calls `look` for states every 0.005 rad.
  template <typename Look>
  static void sample(const Path& path, const Checker& checker, const Look& look) {
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      double way = 0.0;
      for (std::size_t k = 0; k < path[i].size(); ++k)
        way = std::max(way, std::abs(path[i + 1][k] - path[i][k]));
      const int steps = 1 + static_cast<int>(way / 0.005);
      for (int k = 0; k <= steps; ++k) {
        const Eigen::VectorXd q =
            checker.interpolate(path[i], path[i + 1], static_cast<double>(k) / steps);
        look(std::vector<double>(q.data(), q.data() + q.size()));
      }
    }
  }
  double worstTilt(const Path& path, const Checker& checker) const {
    double worst = 0.0;
    sample(path, checker, [&](const auto& q) { worst = std::max(worst, tiltAt(q)); });
    return worst;
  }

  const std::string rook_ = modelsDir() + "/robots/rook7/rook7";
  const std::shared_ptr<const Robot> robot_ = Robot::load(rook_ + ".urdf", rook_ + ".srdf");
  const std::vector<double> start_ =
      namedConfiguration(*robot_, *robot_->findGroup("arm"), "ready");
  const Checker free_{robot_, "arm", withPost()};
};

/// Its paths have a space of CForest's own around that of the setup.
TEST_F(ConstrainedPlanning, ShortensThePathsOfAForest) {
  std::vector<double> goal = start_;
  goal[0] += 0.2;
  const auto checker = level(10.0);
  const auto setup = makeSimpleSetup(checker);
  setStartAndGoal(*setup, *checker, start_, goal);
  setup->setPlanner(makePlanner("CForest", setup->getSpaceInformation()));
  ASSERT_TRUE(setup->solve(0.5) == ob::PlannerStatus::EXACT_SOLUTION);
  shortenPath(setup->getSolutionPath());
  const Path path = configurationsOf(setup->getSolutionPath(), *checker);
  ASSERT_GE(path.size(), 2U);
  expectProven(path, *checker);
  EXPECT_LT(worstTilt(path, *checker), 10.0 * kDegree);
}

TEST_F(ConstrainedPlanning, KeepsTheHandLevelAroundAPost) {
  std::vector<double> goal = start_;
  goal[0] += 1.5;
  for (const double degrees : {10.0, 3.0, 1.0}) {
    const auto checker = level(degrees);
    Workspace workspace(*checker);
    ASSERT_NE(checker->certifyMotion(start_, goal, workspace).verdict, Verdict::Free);
    std::set<Path> paths;
    for (std::uint32_t seed = 1; seed <= 5; ++seed) {
      const auto setup = plannedBy(checker, start_, goal, seed);
      ASSERT_TRUE(setup->haveExactSolutionPath()) << degrees << " degrees, seed " << seed;
      const Path path = configurationsOf(setup->getSolutionPath(), *checker);
      EXPECT_EQ(path.front(), start_);
      EXPECT_EQ(path.back(), goal);
      expectProven(path, *checker);
      EXPECT_LE(worstTilt(path, *checker), degrees * kDegree);
      paths.insert(path);
      const auto again = plannedBy(checker, start_, goal, seed);
      EXPECT_EQ(configurationsOf(again->getSolutionPath(), *checker), path);
      const double length = setup->getSolutionPath().length();
      shortenPath(setup->getSolutionPath());
      EXPECT_LE(setup->getSolutionPath().length(), length);
      const Path shorter = configurationsOf(setup->getSolutionPath(), *checker);
      EXPECT_EQ(shorter.front(), start_);
      EXPECT_EQ(shorter.back(), goal);
      expectProven(shorter, *checker);
      EXPECT_LE(worstTilt(shorter, *checker), degrees * kDegree);
    }
    EXPECT_GT(paths.size(), 1U);
  }
}

TEST_F(ConstrainedPlanning, KeepsThePointOnAPlane) {
  const Eigen::Vector3d place = poseAt(start_).translation();
  const auto checker = std::make_shared<const Checker>(free_.withConstraints(
      TaskConstraint::onPlane("link7", place, Eigen::Vector3d::UnitZ(), 0.01)));
  std::vector<double> goal = start_;
  goal[0] += 1.5;
  const auto setup = plannedBy(checker, start_, goal, 1);
  ASSERT_TRUE(setup->haveExactSolutionPath());
  shortenPath(setup->getSolutionPath());
  const Path path = configurationsOf(setup->getSolutionPath(), *checker);
  expectProven(path, *checker);
  sample(path, *checker, [&](const auto& q) {
    EXPECT_LE(std::abs(poseAt(q).translation().z() - place.z()), 0.01);
  });
}

TEST_F(ConstrainedPlanning, ReachesAPoseUnderTheConstraint) {
  std::vector<double> there = start_;
  there[0] += 1.5;
  const Eigen::Isometry3d wanted = poseAt(there);
  TaskConstraint task = TaskConstraint::level("link7", poseAt(start_), 2.0 * kDegree);
  // Few solutions of inverse kinematics have the elbow there.
  task.joints.push_back({.joint = "joint3", .position = 0.6, .above = 0.1, .below = 0.7});
  const auto checker = std::make_shared<const Checker>(free_.withConstraints(task));
  const auto setup = makeSimpleSetup(checker);
  setStartAndGoal(*setup, *checker, start_, start_);
  const auto goal = std::make_shared<PoseGoal>(setup->getSpaceInformation(), checker, "link7",
                                               wanted, PoseGoalOptions{.maxSeeds = 200});
  setup->setGoal(goal);
  setup->getSpaceInformation()->setup();
  goal->startSampling();
  while (goal->isSampling()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_GE(goal->getStateCount(), 3U);
  setup->setPlanner(std::make_shared<CertifiedConnect>(setup->getSpaceInformation()));
  ASSERT_EQ(setup->solve(kSeconds), ob::PlannerStatus::EXACT_SOLUTION);
  const Path path = configurationsOf(setup->getSolutionPath(), *checker);
  expectProven(path, *checker);
  EXPECT_LE(worstTilt(path, *checker), 2.0 * kDegree);
  const PoseError error = poseError(poseAt(path.back()), wanted);
  EXPECT_LE(error.position, 1e-3);
  EXPECT_LE(error.angle, 1e-2);
}

/// Angles without limits, a base that drives and a body that flies are states of other spaces.
TEST_F(ConstrainedPlanning, TakesEveryJoint) {
  const auto robot = everyJoint();
  const Checker free(robot, "all", std::make_shared<const World>());
  const std::string tip = "l6";
  const Eigen::VectorXd still = robot->defaultState();
  const std::vector<double> start(still.data(), still.data() + still.size());
  const Eigen::Isometry3d pose = linkPose(*robot, "all", tip, start);
  const auto checker = std::make_shared<const Checker>(
      free.withConstraints(TaskConstraint::level(tip, pose, 5.0 * kDegree)));
  Workspace workspace(*checker);
  ASSERT_EQ(checker->checkState(start, workspace), Verdict::Free);
  // A state far away that keeps it.
  std::vector<double> goal = start;
  const ConstraintProjection projection(*checker);
  ConstraintProjection::Workspace projecting(projection);
  for (std::size_t i = 0; i + 4 < goal.size(); ++i) goal[i] += 0.7;
  ASSERT_TRUE(projection.project(goal, {}, projecting));
  ASSERT_EQ(checker->checkState(goal, workspace), Verdict::Free);
  const auto setup = plannedBy(checker, start, goal, 1);
  ASSERT_TRUE(setup->haveExactSolutionPath());
  shortenPath(setup->getSolutionPath());
  const Path path = configurationsOf(setup->getSolutionPath(), *checker);
  expectProven(path, *checker);
  const Eigen::Vector3d axis = pose.linear().row(2);
  sample(path, *checker, [&](const auto& q) {
    EXPECT_GE((linkPose(*robot, "all", tip, q).linear() * axis).z(), std::cos(5.0 * kDegree));
  });
}

}  // namespace
}  // namespace swept::test
