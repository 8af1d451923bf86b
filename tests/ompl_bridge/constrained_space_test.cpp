// SPDX-License-Identifier: BSD-3-Clause
// Paths of OMPL's planners over its constrained spaces: each is proven by a checker of its own, and
// sampled.
#include "swept/ompl_bridge/constrained_space.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ompl/base/Constraint.h>
#include <ompl/base/spaces/constraint/ConstrainedStateSpace.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "message_of.hpp"
#include "models_dir.hpp"
#include "swept/ompl_bridge/setup.hpp"
#include "swept/robot_model/constraint_projection.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Path = std::vector<std::vector<double>>;

constexpr double kSeconds = 60.0;  // that a search may take; all take far less
constexpr double kDegree = std::numbers::pi / 180.0;

class ConstrainedSpaces : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }

  Eigen::Isometry3d poseAt(const std::vector<double>& q) const {
    return linkPose(*robot_, "arm", "link7", q);
  }
  /// A tall post where the hand is in the middle of its way about the base.
  std::shared_ptr<const World> withPost() const {
    auto world = std::make_shared<World>();
    const Eigen::Vector3d hand =
        Eigen::AngleAxisd(0.75, Eigen::Vector3d::UnitZ()) * poseAt(start_).translation();
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = Eigen::Vector3d(1.1 * hand.x(), 1.1 * hand.y(), 0.5);
    world->add("post", Box{{0.06, 0.06, 0.5}}, pose);
    return world;
  }
  TaskConstraint level(double degrees) const {
    return TaskConstraint::level("link7", poseAt(start_), degrees * kDegree);
  }
  std::shared_ptr<const Checker> with(const TaskConstraint& task) const {
    return std::make_shared<const Checker>(free_.withConstraints(task));
  }
  std::vector<double> turned(double angle) const {
    std::vector<double> q = start_;
    q[0] += angle;
    return q;
  }
  /// rad, of what points up at the start.
  double tiltAt(const std::vector<double>& q) const {
    const Eigen::Vector3d axis = poseAt(start_).linear().row(2);
    const Eigen::Vector3d up = poseAt(q).linear() * axis;
    return std::atan2(up.head<2>().norm(), up.z());
  }
  /// Of each chord: proven by another checker, and free and level at 50 states.
  void expectExecutable(const Path& path, const TaskConstraint& task, double degrees) const {
    const Checker judge = Checker(robot_, "arm", withPost()).withConstraints(task);
    Workspace proving(judge), sampling(free_);
    for (std::size_t i = 0; i + 1 < path.size(); ++i) {
      ASSERT_EQ(judge.certifyMotion(path[i], path[i + 1], proving).verdict, Verdict::Free) << i;
      for (int k = 0; k <= 50; ++k) {
        const Eigen::VectorXd x = judge.interpolate(path[i], path[i + 1], k / 50.0);
        const std::vector<double> q(x.begin(), x.end());
        ASSERT_LE(tiltAt(q), degrees * kDegree);
        ASSERT_EQ(free_.checkState(q, sampling), Verdict::Free);
      }
    }
  }
  static ob::PlannerPtr planner(const std::string& name, const ob::SpaceInformationPtr& si) {
    if (name == "RRT") return std::make_shared<og::RRT>(si);
    if (name == "KPIECE1") return std::make_shared<og::KPIECE1>(si);
    if (name == "PRM") return std::make_shared<og::PRM>(si);
    return std::make_shared<og::RRTConnect>(si);
  }

  const std::string rook_ = modelsDir() + "/robots/rook7/rook7";
  const std::shared_ptr<const Robot> robot_ = Robot::load(rook_ + ".urdf", rook_ + ".srdf");
  const std::vector<double> start_ =
      namedConfiguration(*robot_, *robot_->findGroup("arm"), "ready");
  const Checker free_{robot_, "arm", withPost()};
};

TEST_F(ConstrainedSpaces, FunctionsHaveTheirDerivatives) {
  TaskConstraint task = level(10.0);
  task.add(TaskConstraint::onPlane("link7", poseAt(start_).translation(), {0, 0, 1}, 0.05));
  const auto checker = with(task);
  const auto made = makeManifoldConstraint(*checker);
  const ob::Constraint& manifold = *made;
  EXPECT_EQ(manifold.getAmbientDimension(), 7U);
  EXPECT_EQ(manifold.getCoDimension(), 3U);
  EXPECT_EQ(manifold.getTolerance(), 0.5);
  const ConstraintProjection projection(*checker);
  ConstraintProjection::Workspace workspace(projection);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> off(-0.4, 0.4);
  double largest = 0.0;
  for (int i = 0; i < 30; ++i) {
    Eigen::VectorXd x = Eigen::Map<const Eigen::VectorXd>(start_.data(), 7);
    for (double& value : x) value += off(random);
    Eigen::VectorXd here(3), before(3), after(3);
    Eigen::MatrixXd slopes(3, 7);
    manifold.function(x, here);
    manifold.jacobian(x, slopes);
    EXPECT_NEAR(here.cwiseAbs().maxCoeff(),
                std::max({std::abs(here[0]), std::abs(here[1]), std::abs(here[2])}), 0.0);
    const double used = projection.usedShare({x.data(), 7}, workspace);
    EXPECT_LE(used, here.norm() + 1e-12);
    EXPECT_EQ(manifold.isSatisfied(x), here.norm() <= 0.5);
    largest = std::max(largest, slopes.cwiseAbs().maxCoeff());
    for (int k = 0; k < 7; ++k) {
      constexpr double kStep = 1e-6;
      Eigen::VectorXd moved = x;
      moved[k] += kStep;
      manifold.function(moved, after);
      moved[k] -= 2.0 * kStep;
      manifold.function(moved, before);
      EXPECT_LE(((after - before) / (2.0 * kStep) - slopes.col(k)).norm(), 1e-5) << i << ' ' << k;
    }
  }
  EXPECT_GT(largest, 1.0);
  Eigen::VectorXd nowhere = Eigen::VectorXd::Constant(7, NAN), values(3);
  manifold.function(nowhere, values);
  EXPECT_TRUE(values.hasNaN());
  EXPECT_FALSE(manifold.isSatisfied(nowhere));
}

/// Around the post, with planners that grow trees from one end and from both, and a roadmap.
TEST_F(ConstrainedSpaces, EveryPathOfEveryPlannerIsProven) {
  struct Way {
    std::string planner;
    double degrees;
  };
  for (const ConstrainedSpace space : {ConstrainedSpace::Projected, ConstrainedSpace::Atlas})
    for (const Way& way : {Way{"RRTConnect", 10.0}, Way{"RRTConnect", 3.0}, Way{"RRT", 10.0},
                           Way{"KPIECE1", 10.0}, Way{"PRM", 10.0}}) {
      SCOPED_TRACE(way.planner + (space == ConstrainedSpace::Atlas ? ", atlas" : ", projected"));
      // Shortening takes as many random numbers as the clock lets it. By chance KPIECE1 takes from
      // a second to more than a minute.
      ompl::RNG::setSeed(4);
      const TaskConstraint task = level(way.degrees);
      const auto checker = with(task);
      Workspace workspace(*checker);
      ASSERT_NE(checker->certifyMotion(start_, turned(1.5), workspace).verdict, Verdict::Free);
      const auto setup = makeConstrainedSetup(checker, space);
      setConstrainedStartAndGoal(*setup, start_, turned(1.5));
      setup->setPlanner(planner(way.planner, setup->getSpaceInformation()));
      ASSERT_EQ(setup->solve(kSeconds), ob::PlannerStatus::EXACT_SOLUTION);
      const Path path = provenWayPoints(setup->getSolutionPath());
      ASSERT_GE(path.size(), setup->getSolutionPath().getStateCount());
      EXPECT_EQ(path.front(), start_);
      EXPECT_EQ(path.back(), turned(1.5));
      expectExecutable(path, task, way.degrees);
      setup->simplifySolution(0.3);
      const Path shorter = provenWayPoints(setup->getSolutionPath());
      ASSERT_FALSE(shorter.empty());
      expectExecutable(shorter, task, way.degrees);
    }
}

TEST_F(ConstrainedSpaces, MotionsAreProvenChords) {
  const TaskConstraint task = level(3.0);
  const auto checker = with(task);
  const auto setup = makeConstrainedSetup(checker);
  const auto& si = setup->getSpaceInformation();
  const CertifiedGeodesicValidator validator(si, checker);
  // Between states that are level, beside the post or through it.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> off(-0.5, 0.5);
  const ConstraintProjection projection(*checker);
  ConstraintProjection::Workspace projecting(projection);
  Workspace workspace(*checker);
  int proven = 0, inserted = 0, refused = 0;
  for (int i = 0; i < 60; ++i) {
    Path ends(2, start_);
    bool usable = true;
    for (std::vector<double>& q : ends) {
      for (double& value : q) value += off(random);
      usable = usable && projection.project(q, {}, projecting) &&
               checker->checkState(q, workspace) == Verdict::Free;
    }
    if (!usable) continue;
    const Path there = validator.wayPoints(ends[0], ends[1]);
    Path back = validator.wayPoints(ends[1], ends[0]);
    std::ranges::reverse(back);
    EXPECT_EQ(there, back) << i;
    if (there.empty()) {
      ++refused;
      continue;
    }
    ++proven;
    inserted += there.size() > 2 ? 1 : 0;
    EXPECT_EQ(there.front(), ends[0]);
    EXPECT_EQ(there.back(), ends[1]);
    expectExecutable(there, task, 3.0);
  }
  EXPECT_GT(proven, 10);
  EXPECT_GT(inserted, 5);
  EXPECT_GT(proven + refused, 15);
}

/// Through the post no way point helps.
TEST_F(ConstrainedSpaces, WhatIsNotProvenIsInvalid) {
  const auto checker = with(level(10.0));
  const auto setup = makeConstrainedSetup(checker);
  setConstrainedStartAndGoal(*setup, start_, turned(1.5));
  const auto& si = setup->getSpaceInformation();
  ob::ScopedState<> from(si), to(si), last(si);
  const auto put = [](const std::vector<double>& q, ob::ScopedState<>& state) {
    state->as<ob::ConstrainedStateSpace::StateType>()->copy(
        Eigen::Map<const Eigen::VectorXd>(q.data(), 7));
  };
  put(start_, from);
  put(turned(1.5), to);
  std::pair<ob::State*, double> valid{last.get(), 0.5};
  EXPECT_FALSE(si->checkMotion(from.get(), to.get()));
  EXPECT_FALSE(si->checkMotion(from.get(), to.get(), valid));
  EXPECT_EQ(valid.second, 0.0);
  EXPECT_TRUE(si->equalStates(last.get(), from.get()));
  put(turned(0.05), to);
  EXPECT_TRUE(si->checkMotion(from.get(), to.get()));
  valid.second = 0.5;
  EXPECT_TRUE(si->checkMotion(from.get(), to.get(), valid));
  EXPECT_EQ(valid.second, 0.5);
  put(turned(0.75), to);
  EXPECT_FALSE(si->isValid(to.get())) << "in the post";
  std::vector<double> bent = start_;
  bent[5] += 0.5;
  put(bent, to);
  EXPECT_FALSE(si->isValid(to.get())) << "not level";
  put(turned(9.0), to);
  EXPECT_FALSE(si->isValid(to.get())) << "beyond a limit";
  EXPECT_FALSE(si->checkMotion(from.get(), to.get()));
}

TEST_F(ConstrainedSpaces, RefuseWhatTheyCannotBe) {
  const std::string begin = "constrained space: ";
  const auto made = [](const std::shared_ptr<const Checker>& checker, double share = 0.5) {
    return messageOf([&] { makeConstrainedSetup(checker, ConstrainedSpace::Projected, share); });
  };
  EXPECT_EQ(made(nullptr), begin + "no checker given");
  EXPECT_EQ(made(std::make_shared<const Checker>(free_)), begin + "the checker has no constraint");
  const auto checker = with(level(5.0));
  EXPECT_EQ(made(checker, 1.0),
            begin + "the share of tolerances is 1, allowed are numbers between 0 and 1");
  TaskConstraint all;
  for (const char* joint : {"joint1", "joint2", "joint3", "joint4", "joint5", "joint6", "joint7"})
    all.joints.push_back({.joint = joint, .position = 0.0, .above = 1.0, .below = 1.0});
  EXPECT_EQ(made(with(all)),
            begin +
                "the constraints limit 7 values, and the group has 7 variables: nothing is left to "
                "move");
  const auto wheel = Robot::parse(
      "<robot name='w'><link name='a'/><link name='b'><collision><geometry><sphere radius='0.1'/>"
      "</geometry></collision></link><joint name='spin' type='continuous'><parent link='a'/><child "
      "link='b'/><axis xyz='0 0 1'/></joint></robot>",
      "w.urdf");
  EXPECT_EQ(made(std::make_shared<const Checker>(
                Checker(wheel, "all", std::make_shared<const World>())
                    .withConstraints(TaskConstraint::upright("b", 0.1)))),
            begin + "joint 'spin' is neither revolute nor prismatic");

  const auto setup = makeConstrainedSetup(checker);
  const std::vector<double> six(6, 0.0);
  EXPECT_EQ(messageOf([&] { setConstrainedStartAndGoal(*setup, six, start_); }),
            begin + "the start has 6 values; there are 7 variables");
  std::vector<double> bent = start_;
  bent[5] += 4.0 * kDegree;
  EXPECT_THAT(messageOf([&] { setConstrainedStartAndGoal(*setup, start_, bent); }),
              testing::MatchesRegex(begin + "the goal uses 0[.]8[0-9]* of the constraints' "
                                            "tolerances, and the space has states that use 0.5 or "
                                            "less"));
  const auto plain = makeSimpleSetup(checker);
  EXPECT_THAT(messageOf([&] { setConstrainedStartAndGoal(*plain, start_, start_); }),
              testing::HasSubstr("is none of OMPL's constrained spaces"));
  EXPECT_THAT(messageOf([&] { CertifiedGeodesicValidator(plain->getSpaceInformation(), checker); }),
              testing::HasSubstr("is none of OMPL's constrained spaces"));
  EXPECT_EQ(messageOf([&] {
              CertifiedGeodesicValidator(setup->getSpaceInformation(),
                                         std::make_shared<const Checker>(free_));
            }),
            begin + "the checker has no constraint");
  EXPECT_EQ(messageOf([&] { provenWayPoints(og::PathGeometric(plain->getSpaceInformation())); }),
            begin + "the motions of the path are not those of a CertifiedGeodesicValidator");
}

}  // namespace
}  // namespace swept::test
