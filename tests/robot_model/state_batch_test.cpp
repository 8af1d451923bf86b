// SPDX-License-Identifier: BSD-3-Clause
// Many states at once, and the same checker in other worlds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "model_robots.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

struct Case {
  const char* robot;
  const char* group;
  double farthest;  ///< rad or m
};
/// Arms, a mobile base with prismatic and planar joints, and a floating body.
constexpr std::array<Case, 4> kCases{{{"rook7", "arm_with_gripper", 1.5},
                                      {"rook6", "arm", 1.5},
                                      {"rook6_cart", "whole_body", 1.5},
                                      {"drifter", "body", 0.6}}};

std::string models(const std::string& file) {
  return modelsDir() + "/" + file;
}

std::shared_ptr<const Robot> load(const Case& which) {
  return test::modelRobot(which.robot);
}

std::shared_ptr<const World> scene(const std::string& name) {
  return std::make_shared<const World>(World::load(models("scenes/" + name)));
}

std::vector<double> randomStates(std::mt19937& random, const Checker& checker, double farthest,
                                 int count) {
  std::vector<double> states;
  for (int i = 0; i < count; ++i) {
    for (const int index : checker.group().variables) {
      const Variable& variable = checker.robot().variables()[index];
      states.push_back(std::uniform_real_distribution<>(
          std::max(variable.lower, -farthest), std::min(variable.upper, farthest))(random));
    }
  }
  return states;
}

TEST(StateBatch, HasTheVerdictsOfTheStatesOneByOne) {
  std::mt19937 random(71);
  for (const Case& which : kCases) {
    SCOPED_TRACE(which.robot);
    const Checker checker(load(which), which.group, scene("cage.yaml"));
    const auto dimension = static_cast<std::size_t>(checker.dimension());
    Workspace batch(checker);
    Workspace single(checker);
    int free = 0;
    int collisions = 0;
    for (const int count : {0, 1, 2, 7, 8, 9, 64, 501}) {
      const std::vector<double> states = randomStates(random, checker, which.farthest, count);
      std::vector<Verdict> verdicts(static_cast<std::size_t>(count), Verdict::Undecided);
      checker.checkStates(states, verdicts, batch);
      for (std::size_t i = 0; i < verdicts.size(); ++i) {
        const std::span<const double> q(states.data() + i * dimension, dimension);
        ASSERT_EQ(verdicts[i], checker.checkState(q, single)) << "state " << i << " of " << count;
        free += verdicts[i] == Verdict::Free ? 1 : 0;
        collisions += verdicts[i] == Verdict::Collision ? 1 : 0;
      }
    }
    EXPECT_GT(free, 50);
    EXPECT_GT(collisions, 50);
  }
}

/// One that is no state spoils none of its neighbours.
TEST(StateBatch, LeavesWhatIsNoStateUndecided) {
  std::mt19937 random(72);
  const Checker checker(load(kCases[0]), kCases[0].group, scene("shelf.yaml"));
  const auto dimension = static_cast<std::size_t>(checker.dimension());
  Workspace workspace(checker);
  std::vector<double> states = randomStates(random, checker, 1.5, 8);
  states[3 * dimension + 2] = std::numeric_limits<double>::quiet_NaN();
  states[5 * dimension] = std::numeric_limits<double>::infinity();
  std::vector<Verdict> verdicts(8);
  checker.checkStates(states, verdicts, workspace);
  for (std::size_t i = 0; i < 8; ++i) {
    const std::span<const double> q(states.data() + i * dimension, dimension);
    EXPECT_EQ(verdicts[i] == Verdict::Undecided, i == 3 || i == 5) << i;
    EXPECT_EQ(verdicts[i], checker.checkState(q, workspace)) << i;
  }
}

/// Of joints of every kind, whichever value it is. Of a planar joint a value that was no number went
/// into the lanes, where a walk compared with it: it met every box, or none.
TEST(StateBatch, LeavesNoValueThatIsNotFiniteToTheLanes) {
  std::mt19937 random(74);
  for (const Case& which : kCases) {
    const Checker checker(load(which), which.group, scene("shelf.yaml"));
    const auto dimension = static_cast<std::size_t>(checker.dimension());
    Workspace workspace(checker);
    const std::vector<double> fine = randomStates(random, checker, which.farthest, 8);
    const std::span<const double> first(fine.data(), dimension);
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
      for (std::size_t value = 0; value < dimension; ++value) {
        SCOPED_TRACE(testing::Message() << which.robot << ", value " << value << " is " << bad);
        std::vector<double> states = fine;
        states[5 * dimension + value] = bad;
        std::vector<Verdict> verdicts(8);
        checker.checkStates(states, verdicts, workspace);
        EXPECT_EQ(verdicts[5], Verdict::Undecided);
        const std::span<const double> q(states.data() + 5 * dimension, dimension);
        EXPECT_EQ(checker.checkState(q, workspace), Verdict::Undecided);
        for (const MotionQuery query : {MotionQuery::VerdictOnly, MotionQuery::FirstContact}) {
          EXPECT_EQ(checker.certifyMotion(first, q, workspace, query).verdict, Verdict::Undecided);
          EXPECT_EQ(checker.certifyMotion(q, first, workspace, query).verdict, Verdict::Undecided);
        }
      }
    }
  }
}

/// Components of a quaternion whose squares are no finite number say as little about its direction.
TEST(StateBatch, LeavesOrientationsThatOverflowUndecided) {
  const Checker checker(load(kCases[3]), kCases[3].group, scene("shelf.yaml"));
  Workspace workspace(checker);
  const std::vector<double> fine{0.5, 0.5, 3.0, 0.0, 0.0, 0.0, 1.0};
  ASSERT_EQ(checker.checkState(fine, workspace), Verdict::Free);
  for (const double large : {1e155, 1e200, 1e308}) {
    std::vector<double> turned = fine;
    turned[4] = large;
    EXPECT_EQ(checker.checkState(turned, workspace), Verdict::Undecided) << large;
    EXPECT_EQ(checker.reportState(turned, workspace).verdict, Verdict::Undecided) << large;
    EXPECT_EQ(checker.certifyMotion(fine, turned, workspace).verdict, Verdict::Undecided) << large;
  }
}

TEST(StateBatch, RefusesAWrongNumberOfValues) {
  const Checker checker(load(kCases[1]), kCases[1].group, scene("shelf.yaml"));
  Workspace workspace(checker);
  const std::vector<double> states(11);
  std::vector<Verdict> verdicts(2);
  try {
    checker.checkStates(states, verdicts, workspace);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(), "Checker: 2 states of group 'arm' have 12 values, not 11");
  }
}

TEST(WithWorld, IsTheSameAsACheckerOfItsOwn) {
  std::mt19937 random(73);
  for (const Case& which : kCases) {
    SCOPED_TRACE(which.robot);
    const auto robot = load(which);
    CheckerOptions options;
    options.margin = 0.003;
    const Checker first(robot, which.group, scene("shelf.yaml"), options);
    const Checker moved = first.withWorld(scene("bin.yaml"));
    const Checker own(robot, which.group, scene("bin.yaml"), options);
    EXPECT_EQ(moved.options().margin, options.margin);
    ASSERT_EQ(moved.checkedPairs().size(), own.checkedPairs().size());
    Workspace ofMoved(moved);
    Workspace ofOwn(own);
    const auto dimension = static_cast<std::size_t>(own.dimension());
    int free = 0;
    for (int i = 0; i < 200; ++i) {
      const std::vector<double> ends = randomStates(random, own, which.farthest, 2);
      const std::span<const double> from(ends.data(), dimension);
      const std::span<const double> to(ends.data() + dimension, dimension);
      const MotionCertificate a = moved.certifyMotion(from, to, ofMoved);
      const MotionCertificate b = own.certifyMotion(from, to, ofOwn);
      EXPECT_EQ(a.verdict, b.verdict);
      EXPECT_EQ(a.freeUntil, b.freeUntil);
      EXPECT_EQ(a.effort.lanes, b.effort.lanes);
      EXPECT_EQ(a.effort.distances, b.effort.distances);
      free += a.verdict == Verdict::Free ? 1 : 0;
    }
    EXPECT_GT(free, 10);
    EXPECT_LT(free, 190);
  }
  EXPECT_THROW(Checker(load(kCases[1]), "arm", scene("bin.yaml")).withWorld(nullptr),
               std::invalid_argument);
}

}  // namespace
}  // namespace swept
