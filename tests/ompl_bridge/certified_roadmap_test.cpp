// SPDX-License-Identifier: BSD-3-Clause
// Roadmaps whose motions stay proven while the world changes, and what OMPL gets from them.
#include "swept/ompl_bridge/certified_roadmap.hpp"

#include <gtest/gtest.h>
#include <ompl/util/Console.h>

#include <chrono>
#include <cmath>
#include <random>
#include <stop_token>
#include <thread>

#include "fixtures.hpp"
#include "message_of.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

using Path = std::vector<std::vector<double>>;

class CertifiedRoadmapTest : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }

  /// Between the two sides of the wall, and of states at random.
  void expectPaths(const CertifiedRoadmap& roadmap, bool through) const {
    Workspace workspace(*roadmap.graph().checker());
    const auto path = roadmap.path(kStart, kGoal, workspace);
    ASSERT_EQ(path.has_value(), through);
    if (path) expectProven(*path, *roadmap.graph().checker());
  }
  static void expectProven(const Path& path, const Checker& checker) {
    Workspace workspace(checker);
    for (std::size_t i = 0; i + 1 < path.size(); ++i)
      EXPECT_EQ(checker.certifyMotion(path[i], path[i + 1], workspace).verdict, Verdict::Free);
  }

  const std::vector<double> kStart{-0.8, -0.5, -0.5}, kGoal{0.8, -0.5, -0.5};
  std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf(wallWithWindow()));
};

TEST_F(CertifiedRoadmapTest, KeepsConstraintsThatNoSampleKeepsByItself) {
  // Within 1 mm of a plane through the window: of all states, one in a thousand or fewer.
  constexpr double kHeight = 0.5, kTolerance = 1e-3;
  const auto task =
      TaskConstraint::onPlane("ball", {0.0, 0.0, kHeight}, Eigen::Vector3d::UnitZ(), kTolerance);
  const auto onPlane = std::make_shared<const Checker>(checker_->withConstraints(task));
  CertifiedRoadmap roadmap(onPlane, {.states = 1500, .neighbours = 8});
  ASSERT_EQ(roadmap.graph().states(), 1500U);
  EXPECT_EQ(roadmap.components(), 1U);
  for (std::size_t i = 0; i < roadmap.graph().states(); ++i)
    EXPECT_LE(std::abs(roadmap.graph().state(i)[2] - kHeight), kTolerance);
  Workspace workspace(*onPlane);
  const std::vector<double> start{-0.8, -0.5, kHeight}, goal{0.8, -0.5, kHeight};
  const auto path = roadmap.path(start, goal, workspace);
  ASSERT_TRUE(path);
  EXPECT_GT(path->size(), 2U);
  expectProven(*path, *onPlane);
  EXPECT_FALSE(roadmap.path(kStart, kGoal, workspace));  // these are off the plane
  // In another world they are kept as they were.
  const auto shut = std::make_shared<const Checker>(onPlane->withBody(
      "shutter", makeBox({0.02, 0.5, 0.5}), Eigen::Isometry3d(Eigen::Translation3d(0, 0.5, 0.5))));
  const ProvenGraph::Change change = roadmap.update(shut);
  EXPECT_FALSE(change.everything);
  EXPECT_GT(change.blocked, 0U);
  EXPECT_FALSE(roadmap.path(start, goal, workspace));
}

TEST_F(CertifiedRoadmapTest, FindsTheWindowWhileItIsOpen) {
  CertifiedRoadmap roadmap(checker_, {.states = 3000, .neighbours = 8});
  ASSERT_EQ(roadmap.graph().states(), 3000U);
  EXPECT_EQ(roadmap.components(), 1U);
  expectPaths(roadmap, true);
  const std::size_t before = roadmap.freeMotions();
  const auto shut = std::make_shared<const Checker>(checker_->withBody(
      "shutter", makeBox({0.02, 0.5, 0.5}), Eigen::Isometry3d(Eigen::Translation3d(0, 0.5, 0.5))));
  const CertifiedRoadmap open = roadmap;
  ProvenGraph::Change change = roadmap.update(shut);
  EXPECT_GT(change.blocked, 0U);
  EXPECT_GT(change.byArithmetic, change.asked);
  EXPECT_GT(roadmap.components(), 1U);
  expectPaths(roadmap, false);
  expectPaths(open, true);
  // A wall less is two windows.
  change = roadmap.update(std::make_shared<const Checker>(shut->withoutBody("box1")));
  EXPECT_EQ(change.asked, 0U);
  EXPECT_GT(change.freed, 0U);
  expectPaths(roadmap, true);
  roadmap.update(checker_);
  EXPECT_EQ(roadmap.freeMotions(), before);
}

TEST_F(CertifiedRoadmapTest, DependsOnTheSeedAlone) {
  const CertifiedRoadmap one(checker_, {.states = 300, .threads = 1});
  const CertifiedRoadmap two(checker_, {.states = 300, .threads = 4});
  const CertifiedRoadmap other(checker_, {.states = 300, .seed = 2});
  Workspace workspace(*checker_);
  EXPECT_EQ(one.path(kStart, kGoal, workspace), two.path(kStart, kGoal, workspace));
  EXPECT_NE(one.path(kStart, kGoal, workspace), other.path(kStart, kGoal, workspace));
  ASSERT_EQ(one.graph().motions(), two.graph().motions());
  for (std::size_t i = 0; i < one.graph().motions(); ++i)
    EXPECT_EQ(one.graph().blockedBy(i), two.graph().blockedBy(i));
}

/// The ways that A* finds are those of a plain search.
TEST_F(CertifiedRoadmapTest, FindsTheShortestWay) {
  const auto among = std::make_shared<const Checker>(gantry(), "all", worldOf(boxes()));
  const CertifiedRoadmap roadmap(among, {.states = 200, .neighbours = 6});
  ob::PlannerData data(
      std::make_shared<ob::SpaceInformation>(makeStateSpace(among->robot(), among->group())));
  roadmap.getPlannerData(data);
  ASSERT_EQ(data.numVertices(), 200U);
  ASSERT_EQ(data.numEdges(), 2 * roadmap.freeMotions());
  EXPECT_EQ(certifyEdges(data, *among), data.numEdges());
  std::mt19937 random(3);
  Workspace workspace(*among);
  std::size_t compared = 0;
  for (int i = 0; i < 60; ++i) {
    const auto from = static_cast<unsigned>(random() % 200),
               to = static_cast<unsigned>(random() % 200);
    std::vector<double> least(200, std::numeric_limits<double>::infinity());
    least[from] = 0.0;
    for (bool changed = true; changed;) {
      changed = false;
      for (unsigned v = 0; v < 200; ++v) {
        std::vector<unsigned> next;
        data.getEdges(v, next);
        for (const unsigned w : next) {
          ob::Cost cost;
          data.getEdgeWeight(v, w, &cost);
          if (!(least[v] + cost.value() < least[w])) continue;
          least[w] = least[v] + cost.value();
          changed = true;
        }
      }
    }
    const auto path =
        roadmap.path(roadmap.graph().state(from), roadmap.graph().state(to), workspace);
    ASSERT_EQ(path.has_value(), std::isfinite(least[to]));
    if (!path || path->size() <= 2) continue;
    double length = 0.0;
    for (std::size_t k = 0; k + 1 < path->size(); ++k)
      length += (Eigen::Map<const Eigen::Vector3d>((*path)[k].data()) -
                 Eigen::Map<const Eigen::Vector3d>((*path)[k + 1].data()))
                    .norm();
    EXPECT_NEAR(length, least[to], 1e-9);
    expectProven(*path, *among);
    ++compared;
  }
  EXPECT_GT(compared, 10U);
}

TEST_F(CertifiedRoadmapTest, OfEveryKindOfJoint) {
  const auto robot = everyJoint();
  World world;
  world.add("post", makeBox({0.2, 0.2, 3.0}), Eigen::Isometry3d(Eigen::Translation3d(0.5, 0, 0)));
  const auto checker =
      std::make_shared<const Checker>(robot, "all", std::make_shared<const World>(world));
  RoadmapOptions options{.states = 300, .neighbours = 6};
  for (const char* name : {"cart/x", "cart/y", "body/trans_x", "body/trans_y", "body/trans_z"})
    options.space.limits[name] = {-0.5, 0.5};
  CertifiedRoadmap roadmap(checker, options);
  Workspace workspace(*checker);
  std::size_t found = 0;
  for (std::size_t i = 0; i + 1 < 80; i += 2) {
    const auto path =
        roadmap.path(roadmap.graph().state(i), roadmap.graph().state(i + 1), workspace);
    if (!path) continue;
    found += path->size() > 2 ? 1 : 0;
    expectProven(*path, *checker);
  }
  EXPECT_GT(found, 3U);
  // A post, one that few motions pass, a sheet, a ball, points, and a tool that is carried.
  std::mt19937 random(6);
  std::uniform_real_distribution<double> place(-0.7, 0.7);
  std::vector<Eigen::Vector3d> points;
  for (int i = 0; i < 3000; ++i)
    points.emplace_back(0.2 * place(random), 0.02, 0.5 * place(random));
  const std::vector<Shape> shapes{makeBox({0.2, 0.2, 3.0}), makeBox({0.05, 0.05, 0.05}),
                                  makeBox({2.0, 0.01, 1.0}), makeSphere(0.15),
                                  PointCloud::build(points, 0.004)};
  auto now = std::make_shared<const Checker>(
      checker->withAttached("tool", "l6", makeBox({0.1, 0.02, 0.3}),
                            Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.1, 0.1))));
  EXPECT_TRUE(roadmap.update(now).everything);
  std::size_t free = 0, compared = 0, asked = 0;
  for (int round = 0; round < 20; ++round) {
    Eigen::Isometry3d pose(Eigen::Translation3d(place(random), place(random), place(random)));
    pose.rotate(Eigen::AngleAxisd(3.0 * place(random), Eigen::Vector3d(1, 1, 2).normalized()));
    now = std::make_shared<const Checker>(
        now->withReplaced("post", shapes[static_cast<std::size_t>(round) % shapes.size()], pose));
    asked += roadmap.update(now).asked;
    Workspace anew(*now);
    for (std::size_t i = 0; i < roadmap.graph().motions(); ++i) {
      const auto [from, to] = roadmap.graph().motion(i);
      const Verdict verdict =
          now->certifyMotion(roadmap.graph().state(from), roadmap.graph().state(to), anew).verdict;
      ASSERT_NE(verdict, roadmap.graph().isFree(i) ? Verdict::Collision : Verdict::Free)
          << "motion " << i << " in round " << round;
      ++compared;
      free += roadmap.graph().isFree(i) ? 1 : 0;
    }
  }
  EXPECT_GT(10 * free, compared);
  EXPECT_LT(free, compared);
  EXPECT_GT(10 * asked, compared);
}

TEST_F(CertifiedRoadmapTest, AnswersProblemsOfOmpl) {
  const auto roadmap = std::make_shared<const CertifiedRoadmap>(
      checker_, RoadmapOptions{.states = 3000, .neighbours = 8});
  const auto setup = makeSimpleSetup(checker_);
  setup->setPlanner(std::make_shared<RoadmapPlanner>(setup->getSpaceInformation(), roadmap));
  for (const auto& [start, goal] : {std::pair(kStart, kGoal), std::pair(kGoal, kStart)}) {
    setup->clear();
    setStartAndGoal(*setup, *checker_, start, goal);
    ASSERT_EQ(setup->solve(10.0), ob::PlannerStatus::EXACT_SOLUTION);
    const Path path = configurationsOf(setup->getSolutionPath(), *checker_);
    EXPECT_EQ(path.front(), start);
    EXPECT_EQ(path.back(), goal);
    expectProven(path, *checker_);
  }
  ob::PlannerData data(setup->getSpaceInformation());
  setup->getPlannerData(data);
  EXPECT_EQ(data.numEdges(), 2 * roadmap->freeMotions());
}

TEST_F(CertifiedRoadmapTest, WhoeverStopsItGetsWhatIsProvenByThen) {
  std::stop_source stopped;
  stopped.request_stop();
  const CertifiedRoadmap empty(checker_, {.states = 3000, .stop = stopped.get_token()});
  EXPECT_EQ(empty.graph().states(), 0U);
  EXPECT_EQ(empty.components(), 0U);
  expectPaths(empty, false);
  const CertifiedRoadmap whole(checker_, {.states = 3000, .neighbours = 8});
  int partly = 0;
  for (int i = 0; i < 400 && partly < 3; ++i) {
    std::stop_source own;
    const std::jthread stopper([&own, i] {
      std::this_thread::sleep_for(std::chrono::microseconds(250 * i));
      own.request_stop();
    });
    const CertifiedRoadmap some(checker_,
                                {.states = 3000, .neighbours = 8, .stop = own.get_token()});
    if (some.graph().motions() == 0 || some.graph().motions() >= whole.graph().motions()) continue;
    ++partly;
    Workspace workspace(*checker_);
    for (std::size_t k = 0; k < some.graph().motions(); ++k) {
      const auto [from, to] = some.graph().motion(k);
      if (!some.graph().isFree(k)) continue;
      EXPECT_EQ(checker_->certifyMotion(some.graph().state(from), some.graph().state(to), workspace)
                    .verdict,
                Verdict::Free);
    }
  }
  EXPECT_EQ(partly, 3);

  CertifiedRoadmap roadmap = whole;
  const auto shut = std::make_shared<const Checker>(checker_->withBody(
      "shutter", makeBox({0.02, 0.5, 0.5}), Eigen::Isometry3d(Eigen::Translation3d(0, 0.5, 0.5))));
  EXPECT_TRUE(roadmap.update(shut, 1, stopped.get_token()).stopped);
  EXPECT_EQ(roadmap.freeMotions(), whole.freeMotions());
  expectPaths(roadmap, true);
  EXPECT_FALSE(roadmap.update(shut, 1, std::stop_source().get_token()).stopped);
  expectPaths(roadmap, false);
}

TEST_F(CertifiedRoadmapTest, RefusesWhatIsNoRoadmap) {
  EXPECT_EQ(messageOf([] { CertifiedRoadmap roadmap(nullptr); }),
            "CertifiedRoadmap: the checker must not be null");
  EXPECT_EQ(messageOf([&] { CertifiedRoadmap roadmap(checker_, {.states = 0}); }),
            "CertifiedRoadmap: 0 states and 10 neighbours are asked for; at least one of each is "
            "needed");
  World full;
  full.add("block", makeBox({9, 9, 9}), Eigen::Isometry3d::Identity());
  const auto inside =
      std::make_shared<const Checker>(checker_->withWorld(std::make_shared<const World>(full)));
  EXPECT_EQ(messageOf([&] { CertifiedRoadmap roadmap(inside, {.states = 20}); }),
            "CertifiedRoadmap: none of 2000 states is proven free");
  const CertifiedRoadmap roadmap(checker_, {.states = 20});
  Workspace workspace(*checker_);
  EXPECT_EQ(messageOf([&] { (void)roadmap.path({0.0}, kGoal, workspace); }),
            "Checker: a configuration of group 'all' has 3 values, not 1");
  const auto setup = makeSimpleSetup(
      std::make_shared<const Checker>(everyJoint(), "limited", std::make_shared<const World>()));
  EXPECT_EQ(messageOf([&] { RoadmapPlanner planner(setup->getSpaceInformation(), nullptr); }),
            "RoadmapPlanner: the roadmap must not be null");
  EXPECT_NE(messageOf([&] {
              RoadmapPlanner planner(setup->getSpaceInformation(),
                                     std::make_shared<const CertifiedRoadmap>(roadmap));
            }),
            "");
}

}  // namespace
}  // namespace swept::test
