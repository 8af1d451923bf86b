// SPDX-License-Identifier: BSD-3-Clause
// Shortened paths: proven, never longer, as short as OMPL's simplifier makes them, with fewer
// motions.
#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/terminationconditions/IterationTerminationCondition.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "../robot_model/model_robots.hpp"
#include "fixtures.hpp"
#include "models_dir.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

class ShortenPath : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }

  static unsigned motionsOf(const og::PathGeometric& path) {
    return path.getSpaceInformation()->getMotionValidator()->getCheckedMotionCount();
  }
};

struct Problem {
  const char* robot;
  const char* group;
  const char* world;
};

TEST_F(ShortenPath, IsProvenAndAsShortAsSimplified) {
  double before = 0.0, shortened = 0.0, simplified = 0.0;
  unsigned few = 0, many = 0;
  int solved = 0;
  ompl::RNG::setSeed(7);
  for (const Problem& problem : {Problem{"rook7", "arm", "shelf"}, Problem{"rook7", "arm", "bin"},
                                 Problem{"rook6", "arm_with_tool", "bin"}}) {
    const auto checker = std::make_shared<const Checker>(
        modelRobot(problem.robot), problem.group,
        std::make_shared<const World>(
            World::load(modelsDir() + "/scenes/" + problem.world + ".yaml")));
    int solvedHere = 0;
    for (int i = 0; i < 200 && solvedHere < 8; ++i) {
      const auto setup = makeSimpleSetup(checker);
      ob::ScopedState<> start(setup->getStateSpace()), goal(setup->getStateSpace());
      do start.random();
      while (!setup->getSpaceInformation()->isValid(start.get()));
      do goal.random();
      while (!setup->getSpaceInformation()->isValid(goal.get()));
      setup->setStartAndGoalStates(start, goal);
      const auto planner = std::make_shared<CertifiedConnect>(setup->getSpaceInformation());
      planner->setSeed(static_cast<std::uint32_t>(i));
      setup->setPlanner(planner);
      ob::IterationTerminationCondition some(5000);
      if (setup->solve(some) != ob::PlannerStatus::EXACT_SOLUTION) continue;
      const og::PathGeometric path = setup->getSolutionPath();
      if (path.getStateCount() < 3) continue;
      ++solvedHere;
      ++solved;
      og::PathGeometric own(path), again(path), other(path);
      unsigned motions = motionsOf(path);
      shortenPath(own);
      few += motionsOf(path) - motions;
      shortenPath(again);
      motions = motionsOf(path);
      og::PathSimplifier(setup->getSpaceInformation()).simplifyMax(other);
      many += motionsOf(path) - motions;
      EXPECT_LE(own.length(), path.length() * (1.0 + 1e-12));
      for (const MotionCertificate& certificate : certifyPath(own, *checker))
        EXPECT_EQ(certificate.verdict, Verdict::Free);
      EXPECT_EQ(configurationsOf(own, *checker), configurationsOf(again, *checker));
      EXPECT_EQ(configurationsOf(own, *checker).front(), configurationsOf(path, *checker).front());
      EXPECT_EQ(configurationsOf(own, *checker).back(), configurationsOf(path, *checker).back());
      before += path.length();
      shortened += own.length();
      simplified += other.length();
    }
  }
  EXPECT_GT(solved, 15);
  EXPECT_LT(shortened, 0.8 * before);
  EXPECT_LT(shortened, 1.03 * simplified);
  EXPECT_LT(4 * few, many);
  RecordProperty("shortened", std::to_string(shortened / before));
  RecordProperty("simplified", std::to_string(simplified / before));
}

/// The plane, with a validator that a test makes.
class PlaneMotions final : public ob::MotionValidator {
 public:
  using Rule = std::function<bool(const double* from, const double* to)>;
  PlaneMotions(const ob::SpaceInformationPtr& si, Rule rule)
      : MotionValidator(si), rule_(std::move(rule)) {}
  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    ++asked;
    return rule_(from->as<ob::RealVectorStateSpace::StateType>()->values,
                 to->as<ob::RealVectorStateSpace::StateType>()->values);
  }
  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>&) const override {
    return checkMotion(from, to);
  }
  mutable int asked = 0;

 private:
  Rule rule_;
};

class ShortenPathInPlane : public ShortenPath {
 protected:
  ShortenPathInPlane() {
    space_->setBounds(-10.0, 10.0);
    si_ = std::make_shared<ob::SpaceInformation>(space_);
    si_->setStateValidityChecker([](const ob::State*) { return true; });
  }
  std::shared_ptr<PlaneMotions> follow(PlaneMotions::Rule rule) {
    auto motions = std::make_shared<PlaneMotions>(si_, std::move(rule));
    si_->setMotionValidator(motions);
    si_->setup();
    return motions;
  }
  og::PathGeometric path(const std::vector<std::pair<double, double>>& points) const {
    og::PathGeometric result(si_);
    ob::ScopedState<ob::RealVectorStateSpace> state(space_);
    for (const auto& [x, y] : points) {
      state[0] = x, state[1] = y;
      result.append(state.get());
    }
    return result;
  }
  static std::vector<std::pair<double, double>> pointsOf(const og::PathGeometric& path) {
    std::vector<std::pair<double, double>> points;
    for (std::size_t i = 0; i < path.getStateCount(); ++i) {
      const auto* q = path.getState(static_cast<unsigned>(i))
                          ->as<ob::RealVectorStateSpace::StateType>()
                          ->values;
      points.emplace_back(q[0], q[1]);
    }
    return points;
  }

  std::shared_ptr<ob::RealVectorStateSpace> space_ = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::SpaceInformationPtr si_;
};

TEST_F(ShortenPathInPlane, LeavesShortPathsAlone) {
  const auto motions = follow([](const double*, const double*) { return true; });
  using Points = std::vector<std::pair<double, double>>;
  for (const Points& points :
       {Points{}, Points{{1.0, 2.0}}, Points{{0.0, 0.0}, {1.0, 2.0}}, Points{{1, 1}, {1, 1}}}) {
    og::PathGeometric own = path(points);
    shortenPath(own);
    EXPECT_EQ(pointsOf(own), points);
  }
  EXPECT_EQ(motions->asked, 0);
  og::PathGeometric own = path({{0, 0}, {1, 5}, {2, -3}, {2, -3}, {4, 0}});
  shortenPath(own);
  EXPECT_EQ(pointsOf(own), (Points{{0, 0}, {4, 0}}));
  EXPECT_EQ(motions->asked, 1);
}

/// Around the corner of a square: no motion may pass through x, y > 0.
TEST_F(ShortenPathInPlane, CutsCornersAsFarAsTheyAreFree) {
  const auto keepsOut = [](const double* from, const double* to) {
    for (int i = 0; i <= 1000; ++i) {
      const double t = i / 1000.0;
      const double x = from[0] + t * (to[0] - from[0]), y = from[1] + t * (to[1] - from[1]);
      if (x > 0.0 && y > 0.0) return false;
    }
    return true;
  };
  const auto motions = follow(keepsOut);
  og::PathGeometric own = path({{-1.0, 4.0}, {-1.0, -1.0}, {4.0, -1.0}});
  const double before = own.length();
  shortenPath(own, {.rounds = 1});
  // A quarter and a half are free, three quarters are not: bisection takes 1/4, then 3/8 ... of 5.
  EXPECT_EQ(own.getStateCount(), 4U);
  EXPECT_NEAR(own.length(), before - (2.0 - std::sqrt(2.0)) * 1.25, 1e-9);
  const int first = motions->asked;
  og::PathGeometric more = path({{-1.0, 4.0}, {-1.0, -1.0}, {4.0, -1.0}});
  shortenPath(more, {.rounds = 20, .leastGain = 1e-6});
  EXPECT_LT(more.length(), own.length() - 0.05);
  EXPECT_GT(more.length(), 2.0 * std::hypot(1.0, 4.0));
  EXPECT_GT(motions->asked - first, first);
  og::PathGeometric none = path({{-1.0, 4.0}, {-1.0, -1.0}, {4.0, -1.0}});
  shortenPath(none, {.rounds = 0});
  EXPECT_EQ(none.length(), before);
}

/// Right beside a contact a part of a free motion may be refused.
TEST_F(ShortenPathInPlane, KeepsThePathIfAPartOfAMotionIsRefused) {
  int refused = 0;
  follow([&](const double* from, const double* to) {
    const bool begins = from[0] == 0.0 && from[1] == 0.0;
    if (begins) ++refused;
    return !begins || (to[0] == 1.0 && to[1] == 1.0);
  });
  const std::vector<std::pair<double, double>> corner{{0, 0}, {1, 1}, {2, 0}};
  og::PathGeometric own = path(corner);
  shortenPath(own);
  EXPECT_EQ(pointsOf(own), corner);
  EXPECT_EQ(refused, 2);  // to the end of the path, and to the cut
}

}  // namespace
}  // namespace swept::test
