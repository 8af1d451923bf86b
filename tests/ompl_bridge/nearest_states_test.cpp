// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <random>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// As planners have them.
struct Node {
  ob::State* state = nullptr;
};

/// States of a space, and the structure under test beside a list that is searched through.
class Forest {
 public:
  /// `factors`: of the joints of a JointSpace without weights; none: the metric of the space.
  explicit Forest(ob::StateSpacePtr space, std::vector<double> factors = {})
      : space_(std::move(space)), factors_(std::move(factors)) {
    constexpr unsigned seed = 1;
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);  // of seeding anew
    ompl::RNG::setSeed(seed);
    space_->setup();
    nearest_.setDistanceFunction(distance());
    nearest_.setJointFactors(factors_);
  }
  ~Forest() {
    for (const Node& node : nodes_) space_->freeState(node.state);
  }
  Forest(const Forest&) = delete;
  Forest& operator=(const Forest&) = delete;

  std::function<double(Node* const&, Node* const&)> distance() const {
    return [this](Node* const& a, Node* const& b) { return measure(a, b); };
  }
  /// Anywhere, near one of the last ones as trees grow, or at the very place of one.
  Node* draw() {
    Node* const node = make();
    const auto sampler = space_->allocStateSampler();
    const auto kind = std::uniform_int_distribution<int>(0, 9)(random_);
    if (kind < 4 || listed_.empty()) {
      sampler->sampleUniform(node->state);
    } else if (kind < 9) {
      sampler->sampleUniformNear(node->state, any()->state, 0.05);
    } else {
      space_->copyState(node->state, any()->state);
    }
    return node;
  }
  Node* make() {
    nodes_.push_back(Node{space_->allocState()});
    return &nodes_.back();
  }
  void add(Node* node) {
    listed_.push_back(node);
    nearest_.add(node);
  }
  void removeAny() {
    Node* const node = any();
    listed_.erase(std::ranges::find(listed_, node));
    EXPECT_TRUE(nearest_.remove(node));
  }
  Node* any() {
    return listed_[std::uniform_int_distribution<std::size_t>(0, listed_.size() - 1)(random_)];
  }

  double measure(const Node* a, const Node* b) const {
    if (factors_.empty()) return space_->distance(a->state, b->state);
    double squares = 0.0;
    for (std::size_t i = 0; i < factors_.size(); ++i) {
      const double difference = factors_[i] * (valueOf(*a, i) - valueOf(*b, i));
      squares += difference * difference;
    }
    return std::sqrt(squares);
  }

  /// Distances of what is asked for, by looking at all.
  std::vector<double> sorted(Node* query) const {
    std::vector<double> all;
    for (Node* const node : listed_) all.push_back(measure(node, query));
    std::ranges::sort(all);
    return all;
  }
  std::vector<double> distances(const std::vector<Node*>& nodes, Node* query) const {
    std::vector<double> all;
    for (Node* const node : nodes) all.push_back(measure(node, query));
    return all;
  }
  void compare(Node* query) const {
    const std::vector<double> all = sorted(query);
    EXPECT_EQ(distances({nearest_.nearest(query)}, query).front(), all.front());
    std::vector<Node*> found;
    for (const std::size_t k : {std::size_t{1}, std::size_t{7}, 2 * all.size()}) {
      nearest_.nearestK(query, k, found);
      const auto end = all.begin() + static_cast<std::ptrdiff_t>(std::min(k, all.size()));
      EXPECT_EQ(distances(found, query), std::vector<double>(all.begin(), end));
    }
    const double radius = all[all.size() / 3];
    nearest_.nearestR(query, radius, found);
    const auto end = std::ranges::upper_bound(all, radius);
    EXPECT_EQ(distances(found, query), std::vector<double>(all.begin(), end));
    std::ranges::sort(found);
    EXPECT_EQ(std::ranges::adjacent_find(found), found.end());
  }
  std::vector<Node*> listed() const { return listed_; }
  NearestStates<Node*>& nearest() { return nearest_; }
  ob::StateSpace& space() { return *space_; }

 private:
  static double valueOf(const Node& node, std::size_t i) {
    return node.state->as<ob::RealVectorStateSpace::StateType>()->values[i];
  }

  std::mt19937 random_{1};
  ob::StateSpacePtr space_;
  std::vector<double> factors_;
  std::deque<Node> nodes_;
  std::vector<Node*> listed_;
  NearestStates<Node*> nearest_;
};

void growAndCompare(Forest& forest, int count) {
  for (int i = 0; i < count; ++i) {
    forest.add(forest.draw());
    if (i % 5 == 4) forest.removeAny();
    if (i % 97 == 0) forest.compare(forest.draw());
  }
  for (int i = 0; i < 50; ++i) forest.compare(forest.draw());
  std::vector<Node*> listed, expected = forest.listed();
  forest.nearest().list(listed);
  std::ranges::sort(listed);
  std::ranges::sort(expected);
  EXPECT_EQ(listed, expected);
  EXPECT_EQ(forest.nearest().size(), expected.size());
}

StateSpaceOptions weighed() {
  StateSpaceOptions options;
  options.weights["x"] = 30.0;
  options.weights["z"] = 1e-3;
  return options;
}

/// Thousands of states, so that the tree has many leaves; a weighted space too.
TEST(NearestStates, AreThoseOfASearchThroughAll) {
  const auto robot = gantry();
  for (const StateSpaceOptions& options : {StateSpaceOptions{}, weighed()}) {
    Forest forest(makeStateSpace(*robot, *robot->findGroup("all"), options));
    growAndCompare(forest, 5000);
  }
}

/// The factors change which states are near: with them the last axis does not matter next to the
/// first.
TEST(NearestStates, AreThoseOfAMetricWithFactors) {
  const auto robot = gantry();
  Forest forest(makeStateSpace(*robot, *robot->findGroup("all")), {2.0, 0.5, 1e-2});
  growAndCompare(forest, 2000);
  // For another number of joints there is no tree, and a search through others' structure.
  Forest fewer(makeStateSpace(*robot, *robot->findGroup("all")), {2.0, 0.5});
  growAndCompare(fewer, 300);
}

/// States that single precision cannot tell apart.
TEST(NearestStates, AreExactWhereFloatsAreNot) {
  const auto robot = gantry();
  Forest forest(makeStateSpace(*robot, *robot->findGroup("all")));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> within(0.7, 0.7 + 2e-6);  // some tens of floats
  const auto draw = [&] {
    Node* const node = forest.make();
    double* values = node->state->as<ob::RealVectorStateSpace::StateType>()->values;
    for (int d = 0; d < 3; ++d) values[d] = within(random);
    return node;
  };
  for (int i = 0; i < 2000; ++i) forest.add(draw());
  for (int i = 0; i < 200; ++i) forest.compare(draw());
}

TEST(NearestStates, MayAllBeAtOnePlaceOrNoNumbers) {
  const auto robot = gantry();
  Forest forest(makeStateSpace(*robot, *robot->findGroup("all")));
  Node* const here = forest.draw();
  for (int i = 0; i < 1500; ++i) {
    Node* const node = forest.make();
    forest.space().copyState(node->state, here->state);
    forest.add(node);
  }
  forest.compare(forest.draw());
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e300}) {
    Node* const lost = forest.make();
    forest.space().copyState(lost->state, here->state);
    lost->state->as<ob::RealVectorStateSpace::StateType>()->values[1] = bad;
    EXPECT_NE(forest.nearest().nearest(lost), nullptr);
    forest.nearest().add(lost);
    EXPECT_NE(forest.nearest().nearest(here), lost);
    EXPECT_TRUE(forest.nearest().remove(lost));
  }
}

TEST(NearestStates, KeepTheContract) {
  const auto robot = gantry();
  Forest forest(makeStateSpace(*robot, *robot->findGroup("all")));
  NearestStates<Node*>& nearest = forest.nearest();
  Node* const query = forest.draw();
  EXPECT_TRUE(nearest.reportsSortedResults());
  EXPECT_THROW(nearest.nearest(query), ompl::Exception);
  EXPECT_FALSE(nearest.remove(query));
  std::vector<Node*> found{query};
  nearest.nearestK(query, 3, found);
  EXPECT_TRUE(found.empty());
  nearest.add(std::vector<Node*>{forest.draw(), forest.draw()});
  EXPECT_EQ(nearest.size(), 2u);
  EXPECT_FALSE(nearest.remove(query));
  nearest.nearestK(query, 0, found);
  EXPECT_TRUE(found.empty());
  nearest.nearestR(query, 0.0, found);
  EXPECT_TRUE(found.empty());
  nearest.clear();
  EXPECT_EQ(nearest.size(), 0u);
  nearest.add(query);
  EXPECT_EQ(nearest.nearest(forest.draw()), query);
}

/// Angles without limits, poses: another structure, and the same answers.
TEST(NearestStates, OfOtherSpacesAreFoundToo) {
  const auto robot = everyJoint();
  Forest forest(makeStateSpace(*robot, *robot->findGroup("all")));
  growAndCompare(forest, 600);
}

/// A state of the same numbers that the space did not make.
TEST(NearestStates, OfTwoSpacesAreFoundToo) {
  const auto robot = gantry();
  const Group& group = *robot->findGroup("all");
  Forest forest(makeStateSpace(*robot, group));
  const auto other = makeStateSpace(*robot, group);
  for (int i = 0; i < 300; ++i) forest.add(forest.draw());
  Node stranger{other->allocState()};
  other->allocStateSampler()->sampleUniform(stranger.state);
  forest.compare(&stranger);
  forest.add(&stranger);
  EXPECT_EQ(forest.nearest().nearest(&stranger), &stranger);
  for (int i = 0; i < 20; ++i) forest.compare(forest.draw());
  EXPECT_TRUE(forest.nearest().remove(&stranger));
  other->freeState(stranger.state);
}

TEST(NearestStates, OfNumbersAreFoundToo) {
  NearestStates<double> nearest;
  nearest.setDistanceFunction([](double a, double b) { return std::abs(a - b); });
  for (int i = 0; i < 100; ++i) nearest.add(std::sqrt(i));
  EXPECT_EQ(nearest.nearest(4.99), 5.0);
  std::vector<double> found;
  nearest.nearestK(3.0, 1, found);
  EXPECT_EQ(found, std::vector<double>{3.0});
}

/// The same path as with OMPL's own, from the same seed.
TEST(NearestStates, ServePlanners) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);  // of seeding anew
  const auto checker = std::make_shared<const Checker>(gantry(), "all", worldOf(wallWithWindow()));
  std::vector<std::vector<double>> paths;
  for (const bool own : {false, true}) {
    ompl::RNG::setSeed(11);
    const auto setup = makeSimpleSetup(checker);
    const StateConversion conversion(checker->robot(), checker->group());
    ob::ScopedState<> start(setup->getStateSpace()), goal(setup->getStateSpace());
    conversion.toState(std::vector<double>{-0.8, -0.5, -0.5}, start.get());
    conversion.toState(std::vector<double>{0.8, -0.5, -0.5}, goal.get());
    setup->setStartAndGoalStates(start, goal);
    const auto planner = std::make_shared<og::RRTConnect>(setup->getSpaceInformation());
    setup->setPlanner(planner);
    setup->setup();
    // Only now: OMPL's own has drawn its seed, and the samplers get the same ones.
    if (own) planner->setNearestNeighbors<NearestStates>();
    ASSERT_TRUE(setup->solve(20.0) == ob::PlannerStatus::EXACT_SOLUTION);
    std::vector<double>& path = paths.emplace_back();
    for (const ob::State* state : setup->getSolutionPath().getStates()) {
      for (unsigned d = 0; d < 3; ++d)
        path.push_back(state->as<ob::RealVectorStateSpace::StateType>()->values[d]);
    }
  }
  EXPECT_GT(paths[0].size(), 6u);
  EXPECT_EQ(paths[0], paths[1]);
}

}  // namespace
}  // namespace swept::test
