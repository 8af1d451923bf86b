// SPDX-License-Identifier: BSD-3-Clause
// What OMPL is told, and the paths that a setup finds, are the same, bit for bit, in whatever
// floating-point environment a program plans.
#include <gtest/gtest.h>
#include <ompl/base/PlannerData.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include "fixtures.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "transcript.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using States = std::vector<ob::ScopedState<>>;

std::shared_ptr<const Checker> gantryChecker() {
  return std::make_shared<const Checker>(gantry(), "all", worldOf(wallWithWindow()));
}
std::shared_ptr<const Checker> jointsChecker() {
  auto world = std::make_shared<World>();
  world->add("ball", Sphere{0.2}, Eigen::Isometry3d(Eigen::Translation3d(0.5, 0.0, 0.0)));
  return std::make_shared<const Checker>(everyJoint(), "all", world);
}

std::vector<std::vector<double>> configurations(const Checker& checker, int count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-0.9, 0.9);
  std::vector<std::vector<double>> all(static_cast<std::size_t>(count));
  for (std::vector<double>& q : all) {
    for (int i = 0; i < checker.dimension(); ++i) q.push_back(unit(random));
  }
  return all;
}

States statesOf(const ob::StateSpacePtr& space, const Checker& checker,
                const std::vector<std::vector<double>>& configurations) {
  const StateConversion conversion(checker.robot(), checker.group());
  States states;
  for (const std::vector<double>& q : configurations) {
    states.emplace_back(space);
    conversion.toState(q, states.back().get());
  }
  return states;
}

class EnvironmentOfPlanning : public testing::TestWithParam<bool> {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }  // of seeding anew

  const std::shared_ptr<const Checker> checker_ = GetParam() ? jointsChecker() : gantryChecker();
  const og::SimpleSetupPtr setup_ = makeSimpleSetup(checker_);
  const ob::StateSpacePtr space_ = setup_->getStateSpace();
  const ob::SpaceInformationPtr si_ = setup_->getSpaceInformation();
  const std::vector<std::vector<double>> configurations_ = configurations(*checker_, 30);
  const States states_ = statesOf(space_, *checker_, configurations_);
};

TEST_P(EnvironmentOfPlanning, IsTheDefaultForStatesAndMotions) {
  space_->setup();
  const ValidityChecker validity(si_, checker_);
  const CertifiedMotionValidator motions(si_, checker_);
  const CertifiedClearanceObjective objective(si_, checker_);
  const StateConversion conversion(checker_->robot(), checker_->group());
  std::vector<double> q(static_cast<std::size_t>(checker_->dimension()));
  const auto tell = [&](Transcript& t, const ob::State* state) {
    conversion.toConfiguration(state, q);
    t.add(q);
  };
  int valid = 0;
  for (const auto& state : states_) valid += validity.isValid(state.get()) ? 1 : 0;
  EXPECT_GT(valid, 3);
  EXPECT_LT(valid, 27);
  expectSameInEveryEnvironment(
      {{"states",
        [&](Transcript& t) {
          ob::ScopedState<> found(space_);
          for (const auto& state : states_) {
            bool available = false;
            t.add(validity.isValid(state.get()), validity.clearance(state.get()),
                  validity.clearance(state.get(), found.get(), available), available,
                  objective.stateCost(state.get()).value());
            if (available) tell(t, found.get());
          }
        }},
       {"motions",
        [&](Transcript& t) {
          ob::ScopedState<> last(space_);
          for (std::size_t i = 0; i + 1 < states_.size(); ++i) {
            const ob::State *from = states_[i].get(), *to = states_[i + 1].get();
            std::pair<ob::State*, double> lastValid{last.get(), -1.0};
            t.add(motions.checkMotion(from, to), motions.checkMotion(from, to, lastValid),
                  lastValid.second);
            if (lastValid.second >= 0.0) tell(t, last.get());
            if (i < 4) t.add(objective.motionCost(from, to).value());
          }
        }},
       {"space",
        [&](Transcript& t) {
          ob::ScopedState<> between(space_);
          t.add(space_->getMaximumExtent(), space_->getMeasure());
          for (std::size_t i = 0; i + 1 < states_.size(); ++i) {
            const ob::State *from = states_[i].get(), *to = states_[i + 1].get();
            space_->interpolate(from, to, 1.0 / 3.0, between.get());
            t.add(space_->distance(from, to), space_->satisfiesBounds(to));
            space_->enforceBounds(between.get());
            tell(t, between.get());
          }
        }},
       {"samples",
        [&](Transcript& t) {
          ompl::RNG::setSeed(3);
          const ob::StateSamplerPtr sampler = space_->allocStateSampler();
          ob::ScopedState<> sample(space_);
          for (const auto& state : states_) {
            sampler->sampleUniform(sample.get());
            tell(t, sample.get());
            sampler->sampleUniformNear(sample.get(), state.get(), 0.3);
            tell(t, sample.get());
            sampler->sampleGaussian(sample.get(), state.get(), 0.3);
            tell(t, sample.get());
          }
        }},
       {"made", [&](Transcript& t) {
          const auto setup = makeSimpleSetup(checker_);
          const ob::StateSpacePtr space = setup->getStateSpace();
          space->setup();
          const States states = statesOf(space, *checker_, configurations_);
          for (const auto& state : states) {
            tell(t, state.get());
            t.add(space->distance(state.get(), states.front().get()),
                  setup->getSpaceInformation()->isValid(state.get()));
          }
        }}});
}

TEST_P(EnvironmentOfPlanning, IsTheDefaultForPaths) {
  og::PathGeometric path(si_);
  for (const auto& state : states_) path.append(state.get());
  const auto tell = [](Transcript& t, const MotionCertificate& c) {
    t.add(c.verdict, c.freeUntil, c.undecidedAt);
  };
  expectSameInEveryEnvironment({{"path",
                                 [&](Transcript& t) {
                                   for (const MotionCertificate& c : certifyPath(path, *checker_))
                                     tell(t, c);
                                   t.add(configurationsOf(path, *checker_));
                                 }},
                                {"edges",
                                 [&](Transcript& t) {
                                   ob::PlannerData data(si_);
                                   for (std::size_t i = 0; i + 1 < states_.size(); ++i)
                                     data.addEdge(ob::PlannerDataVertex(states_[i].get()),
                                                  ob::PlannerDataVertex(states_[i + 1].get()));
                                   t.add(certifyEdges(data, *checker_));
                                 }},
                                {"limits", [&](Transcript& t) {
                                   const auto limits =
                                       limitsAround(checker_->robot(), checker_->group(),
                                                    configurationsOf(path, *checker_));
                                   for (const auto& [name, range] : limits)
                                     t.add(name, range.first, range.second);
                                   t.add(limits.size());
                                 }}});
}

struct Node {
  const ob::State* state;
};

TEST_P(EnvironmentOfPlanning, IsTheDefaultForNearestStates) {
  const auto fill = [&](NearestStates<const Node*>& nearest, std::vector<Node>& nodes) {
    nearest.setDistanceFunction([&](const Node* const& a, const Node* const& b) {
      return space_->distance(a->state, b->state);
    });
    for (const auto& state : states_) nodes.push_back({state.get()});
    for (const Node& node : nodes) nearest.add(&node);
  };
  expectSameInEveryEnvironment({{"nearest", [&](Transcript& t) {
                                   NearestStates<const Node*> nearest;
                                   std::vector<Node> nodes;
                                   nodes.reserve(states_.size());
                                   fill(nearest, nodes);
                                   nearest.remove(&nodes[3]);
                                   for (const Node& node : nodes) {
                                     std::vector<const Node*> found;
                                     nearest.nearestK(&node, 5, found);
                                     for (const Node* near : found) t.add(near - nodes.data());
                                     nearest.nearestR(&node, 1.0, found);
                                     t.add(nearest.nearest(&node) - nodes.data(), found.size());
                                   }
                                 }}});
}

// The sampler of a space that is made of several is OMPL's, put together here.
TEST_P(EnvironmentOfPlanning, LeavesOmplsSamplesAsTheyAre) {
  const auto* compound = dynamic_cast<const ob::CompoundStateSpace*>(space_.get());
  if (compound == nullptr) return;
  const StateConversion conversion(checker_->robot(), checker_->group());
  const auto drawn = [&](const auto& alloc) {
    ompl::RNG::setSeed(3);
    const ob::StateSamplerPtr sampler = alloc();
    ob::ScopedState<> sample(space_);
    std::vector<std::vector<double>> all;
    for (const auto& state : states_) {
      all.emplace_back(static_cast<std::size_t>(checker_->dimension()));
      sampler->sampleUniformNear(sample.get(), state.get(), 0.3);
      conversion.toConfiguration(sample.get(), all.back());
      all.emplace_back(all.back());
      sampler->sampleUniform(sample.get());
      conversion.toConfiguration(sample.get(), all.back());
    }
    return all;
  };
  EXPECT_EQ(drawn([&] { return compound->allocDefaultStateSampler(); }),
            drawn([&] { return compound->ob::CompoundStateSpace::allocDefaultStateSampler(); }));
}

INSTANTIATE_TEST_SUITE_P(Groups, EnvironmentOfPlanning, testing::Bool(), [](const auto& tested) {
  return tested.param ? std::string("everyJoint") : std::string("gantry");
});

TEST(EnvironmentOfPlanners, IsTheDefaultOfASetup) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const auto checker = gantryChecker();
  expectSameInEveryEnvironment(
      {{"path", [&](Transcript& t) {
          ompl::RNG::setSeed(7);
          const auto setup = makeSimpleSetup(checker);
          setStartAndGoal(*setup, *checker, std::vector<double>{-0.8, -0.5, -0.5},
                          std::vector<double>{0.8, -0.5, -0.5});
          const auto planner = std::make_shared<og::RRTConnect>(setup->getSpaceInformation());
          // OMPL takes its range from the space here.
          inDefaultEnvironment([&] { planner->setNearestNeighbors<NearestStates>(); });
          setup->setPlanner(planner);
          t.add(setup->solve(60.0) == ob::PlannerStatus::EXACT_SOLUTION);
          t.add(configurationsOf(setup->getSolutionPath(), *checker));
          inDefaultEnvironment([&] { setup->getSolutionPath().interpolate(50); });
          t.add(configurationsOf(setup->getSolutionPath(), *checker));
        }}});
}

// OMPL computes by itself here, in the caller's environment: the path may be another, and is
// proven.
TEST(EnvironmentOfPlanners, IsOfNoAccountToWhatIsProven) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const auto checker = gantryChecker();
  for (const Environment& environment : foreignEnvironments()) {
    SCOPED_TRACE(environment.name);
    const auto setup = makeSimpleSetup(checker);
    setStartAndGoal(*setup, *checker, std::vector<double>{-0.8, -0.5, -0.5},
                    std::vector<double>{0.8, -0.5, -0.5});
    const auto planner = std::make_shared<og::RRTConnect>(setup->getSpaceInformation());
    setup->setPlanner(planner);
    setup->setup();
    EXPECT_TRUE(leavesAlone(environment, [&] {
      planner->solve(ob::timedPlannerTerminationCondition(60.0));
      setup->simplifySolution();
    }));
    for (const MotionCertificate& c : certifyPath(setup->getSolutionPath(), *checker))
      EXPECT_EQ(c.verdict, Verdict::Free);
  }
}

TEST(EnvironmentOfPlanners, IsTheDefaultForGoalsOfPoses) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  const auto checker = gantryChecker();
  const std::string tip =
      checker->robot().links()[static_cast<std::size_t>(checker->group().tipLink)].name;
  const auto asked = configurations(*checker, 10);
  const Eigen::Isometry3d wanted =
      linkPose(checker->robot(), "all", tip, std::vector{0.1, 0.7, 0.3});
  expectSameInEveryEnvironment(
      {{"goal", [&](Transcript& t) {
          const auto setup = makeSimpleSetup(checker);
          const auto& si = setup->getSpaceInformation();
          si->setup();
          PoseGoalOptions options;
          options.positionTolerance = 0.3;
          options.maxSeeds = 30;
          const auto goal = std::make_shared<PoseGoal>(si, checker, tip, wanted, options);
          while (goal->isSampling()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
          const States states = statesOf(setup->getStateSpace(), *checker, asked);
          for (const auto& state : states) t.add(goal->distanceGoal(state.get()));
          ob::ScopedState<> sample(setup->getStateSpace());
          std::vector<double> q(3);
          const StateConversion conversion(checker->robot(), checker->group());
          t.add(goal->getStateCount());
          for (std::size_t i = 0; i < goal->getStateCount(); ++i) {
            conversion.toConfiguration(goal->getState(static_cast<unsigned>(i)), q);
            t.add(q);
          }
        }}});
}

}  // namespace
}  // namespace swept::test
