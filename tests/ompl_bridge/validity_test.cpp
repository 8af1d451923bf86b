// SPDX-License-Identifier: BSD-3-Clause
// States and motions of a ball on a gantry against the closed form of its clearance.
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
using Vector = ob::ScopedState<ob::RealVectorStateSpace>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Eigen::Vector3d pointOf(const Vector& state) {
  return {state[0], state[1], state[2]};
}

class Gantry : public testing::Test {
 protected:
  // The ball's true clearance.
  double clearanceAt(const Eigen::Vector3d& point) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : obstacles_) least = std::min(least, obstacle.distance(point));
    return least - kBallRadius;
  }
  // The least clearance on the segment: each box is convex, so its distance is, too.
  double clearanceAlong(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Obstacle& obstacle : obstacles_) {
      double low = 0.0, high = 1.0;
      for (int i = 0; i < 120; ++i) {
        const double left = low + (high - low) / 3.0, right = high - (high - low) / 3.0;
        const bool leftLess = obstacle.distance(from + left * (to - from)) <
                              obstacle.distance(from + right * (to - from));
        (leftLess ? high : low) = leftLess ? right : left;
      }
      least = std::min(least, obstacle.distance(from + low * (to - from)));
    }
    return least - kBallRadius;
  }
  void set(Vector& state, double x, double y, double z) const {
    state[0] = x;
    state[1] = y;
    state[2] = z;
  }

  std::vector<Obstacle> obstacles_ = boxes();
  std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf(obstacles_));
  ob::StateSpacePtr space_ = makeStateSpace(checker_->robot(), checker_->group());
  ob::SpaceInformationPtr si_ = std::make_shared<ob::SpaceInformation>(space_);
  ValidityChecker validity_{si_, checker_};
  CertifiedMotionValidator motions_{si_, checker_};
  Vector s1_{space_}, s2_{space_}, last_{space_};
};

TEST_F(Gantry, StatesAreValidWhenTheirClearanceIsPositive) {
  constexpr int kStates = 2000;
  int valid = 0, deep = 0;
  for (int i = 0; i < kStates; ++i) {
    s1_.random();
    const double truth = clearanceAt(pointOf(s1_));
    double distance = -1.0;
    const bool answer = validity_.isValid(s1_.get(), distance);
    ASSERT_EQ(answer, validity_.isValid(s1_.get()));
    ASSERT_EQ(distance, validity_.clearance(s1_.get()));
    if (std::abs(truth) > 1e-9) {
      ASSERT_EQ(answer, truth > 0.0);
    }
    ASSERT_LE(distance, truth + 1e-12);
    // The ball's depth, as long as its centre is outside.
    if (truth > -kBallRadius) {
      ASSERT_GE(distance, truth - 1e-6);
    } else {
      ++deep;
    }
    valid += answer;
  }
  EXPECT_GT(deep, kStates / 20);
  EXPECT_GT(valid, kStates / 5);
  EXPECT_LT(valid, kStates * 4 / 5);
}

TEST_F(Gantry, StatesOutOfBoundsOrNotFiniteAreInvalid) {
  set(s1_, 0.9, 0.0, -0.9);
  EXPECT_TRUE(validity_.isValid(s1_.get()));
  set(s1_, 1.001, 0.0, -0.9);
  EXPECT_FALSE(validity_.isValid(s1_.get()));
  for (const double bad : {kNan, std::numeric_limits<double>::infinity()}) {
    set(s1_, bad, 0.0, -0.9);
    EXPECT_FALSE(validity_.isValid(s1_.get()));
    EXPECT_EQ(validity_.clearance(s1_.get()), -std::numeric_limits<double>::infinity());
  }
}

TEST_F(Gantry, TellsWhatItsClearanceMeans) {
  EXPECT_EQ(validity_.getSpecs().clearanceComputationType,
            ob::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE);
  EXPECT_TRUE(validity_.getSpecs().hasValidDirectionComputation);
}

// What is not valid is led out of the nearest boxes, and not farther than it has to.
TEST_F(Gantry, InvalidStatesGetAValidOneNearby) {
  constexpr int kStates = 2000;
  int asked = 0, given = 0, near = 0;
  for (int i = 0; i < kStates; ++i) {
    s1_.random();
    const bool valid = validity_.isValid(s1_.get());
    set(s2_, 5.0, 5.0, 5.0);
    double distance = 7.0;
    bool available = true;
    ASSERT_EQ(validity_.isValid(s1_.get(), distance, s2_.get(), available), valid);
    ASSERT_EQ(distance, validity_.clearance(s1_.get()));
    if (valid || !available) {
      ASSERT_FALSE(valid && available);
      ASSERT_EQ(pointOf(s2_), Eigen::Vector3d(5.0, 5.0, 5.0));
      asked += !valid;
      continue;
    }
    ++asked;
    ++given;
    ASSERT_TRUE(validity_.isValid(s2_.get()));
    near += (pointOf(s2_) - pointOf(s1_)).norm() < 1.5 * -distance;
  }
  EXPECT_GT(asked, kStates / 5);
  EXPECT_GT(given, asked * 4 / 5);
  EXPECT_GT(near, given * 2 / 3);
}

// The start is valid, as OMPL promises.
TEST_F(Gantry, MotionsAreValidWhenAllOfThemIs) {
  constexpr int kMotions = 2000;
  const double tolerance = checker_->options().tolerance;
  int valid = 0, grazing = 0;
  for (int i = 0; i < kMotions; ++i) {
    do s1_.random();
    while (!validity_.isValid(s1_.get()));
    s2_.random();
    const double truth = clearanceAlong(pointOf(s1_), pointOf(s2_));
    std::pair<ob::State*, double> lastValid{last_.get(), -7.0};
    set(last_, 5.0, 5.0, 5.0);
    const bool answer = motions_.checkMotion(s1_.get(), s2_.get(), lastValid);
    ASSERT_EQ(answer, motions_.checkMotion(s1_.get(), s2_.get()));
    ASSERT_TRUE(answer || truth <= tolerance);
    ASSERT_TRUE(!answer || truth > -1e-9);
    valid += answer;
    grazing += truth > -10.0 * tolerance && truth < 10.0 * tolerance;
    if (answer) {  // left alone
      ASSERT_EQ(lastValid.second, -7.0);
      ASSERT_EQ(pointOf(last_), Eigen::Vector3d(5.0, 5.0, 5.0));
      continue;
    }
    const double t = lastValid.second;
    ASSERT_GE(t, 0.0);
    ASSERT_LT(t, 1.0);
    const Eigen::Vector3d there = pointOf(s1_) + t * (pointOf(s2_) - pointOf(s1_));
    ASSERT_LT((pointOf(last_) - there).norm(), 1e-12);
    ASSERT_TRUE(validity_.isValid(last_.get()));
    ASSERT_GT(clearanceAlong(pointOf(s1_), there), -1e-12);
    // Within the tolerance of motion there is a place that is not clear by the tolerance.
    ASSERT_LE(clearanceAt(there), 2.0 * tolerance) << "stopped early";
  }
  EXPECT_GT(valid, kMotions / 5);
  EXPECT_LT(valid, kMotions * 4 / 5);
  EXPECT_GT(grazing, 0);
}

TEST_F(Gantry, LastValidWithoutAState) {
  set(s1_, -0.9, 0.0, 0.0);
  set(s2_, 0.9, 0.0, 0.0);
  std::pair<ob::State*, double> lastValid{nullptr, -7.0};
  EXPECT_FALSE(motions_.checkMotion(s1_.get(), s2_.get(), lastValid));
  EXPECT_EQ(lastValid.first, nullptr);
  // The box starts at x = -0.15 and the ball reaches 0.1 ahead: contact at t = 0.65 / 1.8.
  EXPECT_LT(lastValid.second, 0.65 / 1.8);
  EXPECT_GT(lastValid.second, (0.65 - 2.0 * checker_->options().tolerance) / 1.8);
  set(s2_, -0.9, 0.9, 0.0);
  lastValid.second = -7.0;
  EXPECT_TRUE(motions_.checkMotion(s1_.get(), s2_.get(), lastValid));
  EXPECT_EQ(lastValid.second, -7.0);
}

TEST_F(Gantry, LastValidMayBeOneOfTheEnds) {
  for (const bool first : {true, false}) {
    set(s1_, -0.9, 0.0, 0.0);
    set(s2_, 0.9, 0.0, 0.0);
    Vector& end = first ? s1_ : s2_;
    std::pair<ob::State*, double> lastValid{end.get(), -7.0};
    ASSERT_FALSE(motions_.checkMotion(s1_.get(), s2_.get(), lastValid));
    EXPECT_NEAR(end[0], -0.9 + 1.8 * lastValid.second, 1e-12);
  }
}

TEST_F(Gantry, AnEndOutOfBoundsIsRefusedAtTheStart) {
  for (const double bad : {1.2, -1.2, kNan}) {
    set(s1_, 0.9, 0.0, -0.9);
    set(s2_, bad, 0.0, -0.9);
    std::pair<ob::State*, double> lastValid{last_.get(), -7.0};
    EXPECT_FALSE(motions_.checkMotion(s1_.get(), s2_.get()));
    EXPECT_FALSE(motions_.checkMotion(s1_.get(), s2_.get(), lastValid));
    EXPECT_EQ(lastValid.second, 0.0);
    EXPECT_EQ(pointOf(last_), pointOf(s1_));
  }
}

TEST_F(Gantry, CountsMotions) {
  set(s1_, -0.9, 0.0, 0.0);
  set(s2_, 0.9, 0.0, 0.0);
  std::pair<ob::State*, double> lastValid{nullptr, 0.0};
  EXPECT_TRUE(motions_.checkMotion(s1_.get(), s1_.get()));
  EXPECT_TRUE(motions_.checkMotion(s1_.get(), s1_.get(), lastValid));
  EXPECT_TRUE(motions_.checkMotion(s2_.get(), s2_.get()));
  EXPECT_FALSE(motions_.checkMotion(s1_.get(), s2_.get()));
  EXPECT_FALSE(motions_.checkMotion(s1_.get(), s2_.get(), lastValid));
  EXPECT_EQ(motions_.getValidMotionCount(), 3u);
  EXPECT_EQ(motions_.getInvalidMotionCount(), 2u);
  EXPECT_EQ(motions_.getCheckedMotionCount(), 5u);
  motions_.resetMotionCounter();
  EXPECT_EQ(motions_.getCheckedMotionCount(), 0u);
}

TEST_F(Gantry, RefusesASpaceOfAnotherGroup) {
  const auto other = std::make_shared<ob::SpaceInformation>(std::make_shared<ob::SE3StateSpace>());
  EXPECT_THROW(ValidityChecker(other, checker_), std::invalid_argument);
  EXPECT_THROW(CertifiedMotionValidator(other, checker_), std::invalid_argument);
  EXPECT_THROW(ValidityChecker(si_, nullptr), std::invalid_argument);
  EXPECT_THROW(makeSimpleSetup(nullptr), std::invalid_argument);
  EXPECT_THROW(certifyPath(ompl::geometric::PathGeometric(other), *checker_),
               std::invalid_argument);
}

TEST_F(Gantry, MovingObstaclesNeedTimeThatStatesDoNotHave) {
  MovingObstacle ball{.name = "drone", .parts = {{Sphere{0.1}, Eigen::Isometry3d::Identity()}}};
  ball.waypoints.push_back({0.0, Eigen::Isometry3d::Identity()});
  const auto moving = std::make_shared<const Checker>(checker_->withObstacle(ball));
  try {
    const ValidityChecker validity(si_, moving);
    ADD_FAILURE() << "nothing thrown";
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "the checker's world has a moving obstacle, `drone`, and states of the space have "
                 "no time");
  }
  EXPECT_THROW(CertifiedMotionValidator(si_, moving), std::invalid_argument);
}

}  // namespace
}  // namespace swept::test
