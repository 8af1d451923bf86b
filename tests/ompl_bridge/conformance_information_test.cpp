// SPDX-License-Identifier: BSD-3-Clause
// SpaceInformation and PathGeometric with what the bridge gives them, by their contracts
// (contract.hpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "contract.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using testing::HasSubstr;

INSTANTIATE_TEST_SUITE_P(Of, Contract, testing::ValuesIn(subjects()), nameOf);

class States {
 public:
  States(const ob::SpaceInformation& si, std::size_t count) : si_(si), states_(count) {
    si_.allocStates(states_);
  }
  ~States() { si_.freeStates(states_); }
  States(const States&) = delete;
  States& operator=(const States&) = delete;
  std::vector<ob::State*>& operator*() { return states_; }
  ob::State* operator[](std::size_t i) const { return states_[i]; }

 private:
  const ob::SpaceInformation& si_;
  std::vector<ob::State*> states_;
};

/// "Marks the index of the first invalid state. Unmodified if the function returns true." OMPL asks
/// about the states only; a path asks about its motions.
TEST_P(Contract, ListsOfStatesAndPathsAreChecked) {
  constexpr unsigned int kCount = 5;
  int states = 0, motions = 0, broken = 0;
  for (int i = 0; i < 200; ++i) {
    States list(*si_, kCount);
    State current = randomValid();
    for (unsigned int k = 0; k < kCount; ++k) {
      si_->copyState(list[k], current.get());
      current = k + 2 == kCount && i % 4 == 0 ? randomThatIs(false) : near(current, 0.02);
    }
    unsigned int expected = kCount;
    bool free = true;
    for (unsigned int k = kCount; k-- > 0;) {
      if (!si_->isValid(list[k])) expected = k;
      free = free && (k == 0 || si_->checkMotion(list[k - 1], list[k]));
    }
    unsigned int first = 77;
    const bool answer = si_->checkMotion(*list, kCount, first);
    EXPECT_EQ(answer, expected == kCount);
    EXPECT_EQ(first, answer ? 77 : expected);
    EXPECT_EQ(si_->checkMotion(*list, kCount), answer);
    og::PathGeometric path(si_);
    for (unsigned int k = 0; k < kCount; ++k) path.append(list[k]);
    EXPECT_EQ(path.check(), free);
    EXPECT_TRUE(answer || !free);
    states += answer;
    motions += free;
    broken += !answer;
  }
  EXPECT_GT(motions, 20);
  EXPECT_GE(states, motions);
  EXPECT_GT(broken, 10);
}

TEST_P(Contract, MotionStatesAreOnTheMotion) {
  for (const bool ends : {false, true}) {
    for (int i = 0; i < 20; ++i) {
      const State s1 = randomValid(), s2 = near(s1, 0.2);
      std::vector<ob::State*> states;
      const unsigned int inner = 9, count = inner + (ends ? 2 : 0);
      ASSERT_EQ(si_->getMotionStates(s1.get(), s2.get(), states, inner, ends, true), count);
      const bool valid = si_->checkMotion(s1.get(), s2.get());
      for (unsigned int k = 0; k < count; ++k) {
        State at(space_);
        space_->interpolate(s1.get(), s2.get(), (k + (ends ? 0.0 : 1.0)) / (inner + 1.0), at.get());
        EXPECT_LE(space_->distance(at.get(), states[k]), noise());
        EXPECT_TRUE(!valid || si_->isValid(states[k]));
      }
      si_->freeStates(states);
    }
  }
}

/// "If the given state is valid, it will be returned itself."
TEST_P(Contract, ValidStatesAreFoundNearby) {
  int invalid = 0, found = 0;
  for (int i = 0; i < 100; ++i) {
    State near = random(), state = random();
    const bool valid = si_->isValid(near.get());
    const bool answer = si_->searchValidNearby(state.get(), near.get(), 2.0, 50);
    EXPECT_TRUE(!valid || answer);
    EXPECT_TRUE(!valid || same(state, near));
    EXPECT_EQ(answer, si_->isValid(state.get()));
    invalid += !valid;
    found += answer && !valid;
    *space_->getValueAddressAtIndex(near.get(), 0) += 50.0;  // out of bounds
    if (si_->searchValidNearby(state.get(), near.get(), 2.0, 50)) {
      EXPECT_TRUE(si_->isValid(state.get()));
    }
    // "The two passed state pointers need not point to different memory."
    if (si_->searchValidNearby(near.get(), near.get(), 2.0, 50)) {
      EXPECT_TRUE(si_->isValid(near.get()));
    }
  }
  EXPECT_GT(invalid, 0);
  EXPECT_GT(found, invalid / 3);
}

/// "Produce a valid motion by randomly bouncing off of invalid states."
TEST_P(Contract, BouncesAreValidMotions) {
  int bounces = 0;
  for (int i = 0; i < 30; ++i) {
    constexpr unsigned int kSteps = 10;
    const State start = randomValid();
    std::vector<ob::State*> states;
    const unsigned int count = si_->randomBounceMotion(sampler_, start.get(), kSteps, states, true);
    ASSERT_LE(count, kSteps);
    const ob::State* previous = start.get();
    for (unsigned int k = 0; k < count; ++k) {
      ++bounces;
      EXPECT_TRUE(si_->checkMotion(previous, states[k])) << k;
      EXPECT_TRUE(si_->isValid(states[k]));
      previous = states[k];
    }
    si_->freeStates(states);
  }
  EXPECT_GT(bounces, 100);
}

TEST_P(Contract, SpaceInformationEstimatesAndPrints) {
  int valid = 0;
  for (int i = 0; i < 1000; ++i) valid += si_->isValid(random().get());
  EXPECT_NEAR(si_->probabilityOfValidState(1000), valid / 1000.0, 0.1);
  const double length = si_->averageValidMotionLength(200);
  EXPECT_GT(length, 0.0);
  EXPECT_LE(length, si_->getMaximumExtent());
  EXPECT_EQ(si_->getStateDimension(), space_->getDimension());
  EXPECT_EQ(si_->getSpaceMeasure(), space_->getMeasure());
  EXPECT_TRUE(si_->isSetup());
  EXPECT_NO_THROW(si_->setup());
  std::ostringstream text;
  EXPECT_NO_THROW(si_->printSettings(text));
  EXPECT_NO_THROW(si_->printProperties(text));
  EXPECT_NO_THROW(setup_->print(text));
  EXPECT_THAT(text.str(), HasSubstr(group_.name));
}

}  // namespace
}  // namespace swept::test
