// SPDX-License-Identifier: BSD-3-Clause
// OMPL's planners that search with several threads, over one set of validators.
#include <gtest/gtest.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/planners/AnytimePathShortening.h>
#include <ompl/geometric/planners/cforest/CForest.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/pRRT.h>
#include <ompl/geometric/planners/sbl/pSBL.h>
#include <ompl/util/Console.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <thread>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

constexpr double kSeconds = 60.0;  // that a search may take; all take far less

/// The threads, but the one that made this, that ask the validators. The first question of each
/// waits until all of them have one, so that none can solve the problem before the others begin.
/// After that nothing here may lock: it would order the threads, and hide from ThreadSanitizer
/// where the validators do not.
class Askers {
 public:
  explicit Askers(std::size_t expected) : expected_(expected) {}

  void enter() {
    thread_local bool entered = false;
    if (entered || std::this_thread::get_id() == maker_) return;
    entered = true;
    std::unique_lock lock(mutex_);
    ++count_;
    all_.notify_all();
    all_.wait_until(lock, std::chrono::system_clock::now() + std::chrono::seconds(10),
                    [this] { return count_ >= expected_; });
  }
  std::size_t count() {
    const std::lock_guard lock(mutex_);
    return count_;
  }

 private:
  const std::thread::id maker_ = std::this_thread::get_id();
  const std::size_t expected_;
  std::mutex mutex_;
  std::condition_variable all_;
  std::size_t count_ = 0;
};

class ObservedStates final : public ValidityChecker {
 public:
  ObservedStates(const ob::SpaceInformationPtr& si, const std::shared_ptr<const Checker>& checker,
                 Askers& askers)
      : ValidityChecker(si, checker), askers_(askers) {}
  bool isValid(const ob::State* state) const override {
    askers_.enter();
    return ValidityChecker::isValid(state);
  }

 private:
  Askers& askers_;
};

/// Counts the answers a second time.
class ObservedMotions final : public CertifiedMotionValidator {
 public:
  ObservedMotions(const ob::SpaceInformationPtr& si, const std::shared_ptr<const Checker>& checker,
                  Askers& askers)
      : CertifiedMotionValidator(si, checker), askers_(askers) {}
  bool checkMotion(const ob::State* s1, const ob::State* s2) const override {
    askers_.enter();
    return count(CertifiedMotionValidator::checkMotion(s1, s2));
  }
  bool checkMotion(const ob::State* s1, const ob::State* s2,
                   std::pair<ob::State*, double>& lastValid) const override {
    askers_.enter();
    return count(CertifiedMotionValidator::checkMotion(s1, s2, lastValid));
  }
  void expectCounts() const {
    EXPECT_EQ(getValidMotionCount(), free_);
    EXPECT_EQ(getInvalidMotionCount(), refused_);
    EXPECT_GT(free_, 0u);
    EXPECT_GT(refused_, 0u);
  }

 private:
  bool count(bool free) const {
    (free ? free_ : refused_).fetch_add(1, std::memory_order_relaxed);
    return free;
  }

  Askers& askers_;
  mutable std::atomic<unsigned int> free_ = 0, refused_ = 0;
};

/// The gantry from one side of a wall to the other, through its window.
class ParallelPlanners : public testing::Test {
 protected:
  void SetUp() override { ompl::msg::setLogLevel(ompl::msg::LOG_NONE); }

  /// For a planner that asks the validators with so many threads, those of its goal included.
  void prepare(std::size_t threads) {
    askers_ = std::make_unique<Askers>(threads);
    threads_ = threads;
    setup_ = makeSimpleSetup(checker_);
    motions_ = std::make_shared<ObservedMotions>(si(), checker_, *askers_);
    si()->setMotionValidator(motions_);
    si()->setStateValidityChecker(std::make_shared<ObservedStates>(si(), checker_, *askers_));
    setup_->setStartState(at(kStart));
  }

  const ob::SpaceInformationPtr& si() const { return setup_->getSpaceInformation(); }

  ob::ScopedState<> at(const Eigen::Vector3d& ball) const {
    ob::ScopedState<> state(si());
    StateConversion(checker_->robot(), checker_->group())
        .toState({ball.data(), std::size_t{3}}, state.get());
    return state;
  }

  /// Planners that look for ever better paths are to end.
  void shorterSuffices() {
    const auto length = std::make_shared<ob::PathLengthOptimizationObjective>(si());
    length->setCostThreshold(ob::Cost(kShort));
    setup_->setOptimizationObjective(length);
  }

  std::shared_ptr<PoseGoal> poseGoal() {
    auto goal = std::make_shared<PoseGoal>(si(), checker_, "ball",
                                           Eigen::Isometry3d(Eigen::Translation3d(kGoal)));
    setup_->setGoal(goal);
    return goal;
  }

  /// By all the threads; every answer is counted once, whoever got it.
  void expectSolved(const ob::PlannerPtr& planner) {
    setup_->setPlanner(planner);
    ASSERT_TRUE(setup_->solve(kSeconds) == ob::PlannerStatus::EXACT_SOLUTION);
    EXPECT_EQ(askers_->count(), threads_);
    motions_->expectCounts();
    expectProven();
  }

  void expectProven() const {
    const og::PathGeometric& path = setup_->getSolutionPath();
    const auto certificates = certifyPath(path, *checker_);
    ASSERT_EQ(certificates.size() + 1, path.getStateCount());
    for (const MotionCertificate& certificate : certificates) {
      EXPECT_EQ(certificate.verdict, Verdict::Free);
    }
    EXPECT_TRUE(si()->equalStates(path.getState(0), at(kStart).get()));
    const auto last = static_cast<unsigned int>(path.getStateCount() - 1);
    EXPECT_TRUE(setup_->getGoal()->isSatisfied(path.getState(last)));
    expectOffTheWall(path);
  }

  /// By the closed form of the ball's distance.
  void expectOffTheWall(const og::PathGeometric& path) const {
    og::PathGeometric fine(path);
    fine.interpolate(20000);
    for (const ob::State* state : fine.getStates()) {
      const double* q = state->as<ob::RealVectorStateSpace::StateType>()->values;
      for (const Obstacle& box : wall_) {
        ASSERT_GT(box.distance({q[0], q[1], q[2]}), kBallRadius);
      }
    }
  }

  const Eigen::Vector3d kStart{-0.8, -0.5, -0.5}, kGoal{0.8, -0.5, -0.5};
  // m. The ball's centre goes through the window at (0, 0.4, 0.4) at best: 3.007 m.
  static constexpr double kShort = 3.3;
  static constexpr double kStep = 0.05;  // m, so that it takes 60 of them

  const std::vector<Obstacle> wall_ = wallWithWindow();
  const std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(gantry(), "all", worldOf(wall_));
  std::size_t threads_ = 0;
  std::unique_ptr<Askers> askers_;  // outlives those who ask
  std::shared_ptr<ObservedMotions> motions_;
  og::SimpleSetupPtr setup_;
};

/// Each valid motion becomes an edge of the one tree, each other none.
TEST_F(ParallelPlanners, EightThreadsGrowOneTree) {
  for (const bool own : {false, true}) {
    prepare(8);
    setup_->setGoalState(at(kGoal));
    const auto planner = std::make_shared<og::pRRT>(si());
    planner->setThreadCount(8);
    planner->setRange(kStep);
    if (own) planner->setNearestNeighbors<NearestStates>();
    expectSolved(planner);
    ob::PlannerData tree(si());
    planner->getPlannerData(tree);
    EXPECT_EQ(tree.numEdges(), motions_->getValidMotionCount());
    EXPECT_EQ(certifyEdges(tree, *checker_), tree.numEdges());
  }
}

TEST_F(ParallelPlanners, EightThreadsGrowTwoTreesLazily) {
  prepare(8);
  setup_->setGoalState(at(kGoal));
  const auto planner = std::make_shared<og::pSBL>(si());
  planner->setThreadCount(8);
  expectSolved(planner);
}

/// Each tree has a thread and a space information of its own, with these validators.
TEST_F(ParallelPlanners, AForestOptimises) {
  for (const bool own : {false, true}) {
    prepare(8);
    setup_->setGoalState(at(kGoal));
    shorterSuffices();
    const auto planner = std::make_shared<og::CForest>(si());
    planner->setNumThreads(8);
    setup_->setPlanner(planner);
    setup_->setup();
    for (std::size_t i = 0; own && i < 8; ++i) {
      planner->getPlannerInstance(i)->as<og::RRTstar>()->setNearestNeighbors<NearestStates>();
    }
    expectSolved(planner);
    EXPECT_LT(setup_->getSolutionPath().length(), kShort);
    EXPECT_NE(planner->getNumStatesShared(), "0");
  }
}

TEST_F(ParallelPlanners, PlannersOfSeveralKindsWorkTogether) {
  prepare(5);
  setup_->setGoalState(at(kGoal));
  shorterSuffices();
  const auto planner =
      og::AnytimePathShortening::createPlanner<og::RRTConnect, og::RRTConnect, og::KPIECE1, og::PRM,
                                               og::RRTstar>(si());
  expectSolved(planner);
  EXPECT_LT(setup_->getSolutionPath().length(), kShort);
}

TEST_F(ParallelPlanners, AGoalIsSampledMeanwhile) {
  prepare(1);
  const auto goal = poseGoal();
  const auto planner = std::make_shared<og::RRTConnect>(si());
  planner->setNearestNeighbors<NearestStates>();
  expectSolved(planner);
  EXPECT_GE(goal->getStateCount(), 1u);
}

TEST_F(ParallelPlanners, AGoalIsSampledWhileEightThreadsAskForIt) {
  prepare(9);
  const auto goal = poseGoal();
  const auto planner = std::make_shared<og::pRRT>(si());
  planner->setThreadCount(8);
  planner->setRange(kStep);
  expectSolved(planner);
  EXPECT_GE(goal->getStateCount(), 1u);
}

}  // namespace
}  // namespace swept::test
