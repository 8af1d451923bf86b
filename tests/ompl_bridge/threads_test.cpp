// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <barrier>
#include <thread>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"
#include "workspace_pool.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

struct Answer {
  bool state;
  double clearance;
  bool motion;
  double lastValid;
  Eigen::Vector3d projection;
  bool operator==(const Answer&) const = default;
};

// One set of validators and one space for all threads, and what they say of motion i.
class Queries {
 public:
  Queries(const std::shared_ptr<const Checker>& checker, std::size_t count)
      : space_(makeStateSpace(checker->robot(), checker->group())),
        si_(std::make_shared<ob::SpaceInformation>(space_)),
        validity_(si_, checker),
        motions_(si_, checker) {
    space_->setup();
    const auto sampler = space_->allocStateSampler();
    for (std::size_t i = 0; i < 2 * count; ++i) {
      states_.emplace_back(space_);
      sampler->sampleUniform(states_.back().get());
    }
  }
  Answer ask(std::size_t i) const {
    const ob::State* from = states_[2 * i].get();
    const ob::State* to = states_[2 * i + 1].get();
    std::pair<ob::State*, double> lastValid{nullptr, -7.0};
    Answer answer{};
    answer.state = validity_.isValid(from, answer.clearance);
    answer.motion = motions_.checkMotion(from, to, lastValid);
    answer.lastValid = lastValid.second;
    space_->getDefaultProjection()->project(from, answer.projection);
    return answer;
  }
  unsigned int projected() const { return space_->getDefaultProjection()->getDimension(); }
  const CertifiedMotionValidator& motions() const { return motions_; }

 private:
  ob::StateSpacePtr space_;
  ob::SpaceInformationPtr si_;
  ValidityChecker validity_;
  CertifiedMotionValidator motions_;
  std::vector<ob::ScopedState<>> states_;
};

TEST(Threads, EightAnswerAsOneDoes) {
  constexpr std::size_t kMotions = 1000, kThreads = 8;
  const Queries queries(std::make_shared<const Checker>(gantry(), "all", worldOf(boxes())),
                        kMotions);
  ASSERT_EQ(queries.projected(), 3u);  // the place of the tip
  std::vector<Answer> expected;
  for (std::size_t i = 0; i < kMotions; ++i) expected.push_back(queries.ask(i));
  const unsigned int validOnce = queries.motions().getValidMotionCount();
  ASSERT_GT(validOnce, kMotions / 20);
  ASSERT_LT(validOnce, kMotions * 19 / 20);

  std::vector<std::vector<Answer>> answers(kThreads, std::vector<Answer>(kMotions));
  std::barrier start(kThreads);
  std::vector<std::thread> threads;
  for (std::size_t thread = 0; thread < kThreads; ++thread) {
    threads.emplace_back([&, thread] {
      start.arrive_and_wait();
      for (std::size_t k = 0; k < kMotions; ++k) {
        const std::size_t i = (k + thread * 37) % kMotions;  // each with another history
        answers[thread][i] = queries.ask(i);
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& answer : answers) EXPECT_TRUE(answer == expected);
  EXPECT_EQ(queries.motions().getValidMotionCount(), (kThreads + 1) * validOnce);
  EXPECT_EQ(queries.motions().getCheckedMotionCount(), (kThreads + 1) * kMotions);
}

TEST(WorkspacePool, LeasesAreDistinctAndReused) {
  const Checker checker(gantry(), "all", worldOf(boxes()));
  WorkspacePool pool(checker);
  const WorkspacePool::Scratch* first = nullptr;
  {
    const auto a = pool.lease();
    const auto b = pool.lease();
    EXPECT_NE(a.get(), b.get());
    EXPECT_EQ(a->from.size(), 3u);
    EXPECT_EQ(a->to.size(), 3u);
    first = a.get();  // returned last
  }
  EXPECT_EQ(pool.lease().get(), first);
  EXPECT_EQ(pool.lease().get(), first);
}

}  // namespace
}  // namespace swept::test
