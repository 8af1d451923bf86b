// SPDX-License-Identifier: BSD-3-Clause
// MotionValidator, by its contract (contract.hpp).
#include <gtest/gtest.h>

#include <sstream>
#include <utility>

#include "contract.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

INSTANTIATE_TEST_SUITE_P(Of, Contract, testing::ValuesIn(subjects()), nameOf);

/// s1 is valid, as the contract assumes.
TEST_P(Contract, MotionsAgreeWithTheirStates) {
  constexpr int kMotions = 400;
  int valid = 0, partly = 0;
  for (int i = 0; i < kMotions; ++i) {
    const State s1 = randomValid(), s2 = i % 2 == 0 ? random() : near(s1, 0.15);
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): states may change through get().
    const State before1(s1), before2(s2), untouched = random();
    State last(untouched);
    std::pair<ob::State*, double> lastValid{last.get(), -7.0};
    const bool answer = si_->checkMotion(s1.get(), s2.get());
    ASSERT_EQ(si_->checkMotion(s1.get(), s2.get(), lastValid), answer);
    ASSERT_EQ(lastValid.first, last.get());
    ASSERT_TRUE(same(s1, before1) && same(s2, before2));
    if (answer) {  // "should not be modified"
      ++valid;
      ASSERT_EQ(lastValid.second, -7.0);
      ASSERT_TRUE(same(last, untouched));
      State at(space_);
      for (int k = 0; k <= 40; ++k) {
        space_->interpolate(s1.get(), s2.get(), k / 40.0, at.get());
        ASSERT_TRUE(si_->isValid(at.get())) << k;
      }
      continue;
    }
    ASSERT_GE(lastValid.second, 0.0);
    ASSERT_LT(lastValid.second, 1.0);
    ASSERT_TRUE(si_->isValid(last.get())) << "t = " << lastValid.second;
    State at(space_);
    space_->interpolate(s1.get(), s2.get(), lastValid.second, at.get());
    ASSERT_LE(distance(last, at), noise());
    partly += lastValid.second > 0.0;
  }
  EXPECT_GT(valid, kMotions / 10);
  EXPECT_LT(valid, kMotions * 97 / 100);
  EXPECT_GT(partly, (kMotions - valid) / 2);
}

/// Planners go to the last valid state and take the way there for valid: asked about as a motion of
/// its own, it has to be, or their paths have segments that are not.
TEST_P(Contract, TheWayToTheLastValidStateIsValid) {
  Workspace workspace(*checker_);
  int asked = 0;
  std::ostringstream refused;
  for (int i = 0; i < 2000 && asked < 300; ++i) {
    const State s1 = randomValid(), s2 = random();
    State last(space_);
    std::pair<ob::State*, double> lastValid{last.get(), 0.0};
    if (si_->checkMotion(s1.get(), s2.get(), lastValid) || lastValid.second == 0.0) continue;
    ++asked;
    if (si_->checkMotion(s1.get(), last.get())) continue;
    const MotionCertificate there =
        checker_->certifyMotion(configuration(s1), configuration(last), workspace);
    refused << "t = " << lastValid.second << ": on the way there " << toString(there.verdict)
            << ", free until " << there.freeUntil << "\n";
  }
  EXPECT_GE(asked, 100);
  EXPECT_EQ(refused.str(), "") << "of " << asked;
}

/// Both overloads, where motions end next to a contact.
TEST_P(Contract, OverloadsAgreeNextToContacts) {
  int asked = 0;
  std::ostringstream differ;
  for (int i = 0; i < 2000 && asked < 300; ++i) {
    const State s1 = randomValid(), s2 = random();
    State last(space_);
    std::pair<ob::State*, double> lastValid{last.get(), 0.0}, again{nullptr, 1.0};
    if (si_->checkMotion(s1.get(), s2.get(), lastValid) || lastValid.second == 0.0) continue;
    ++asked;
    const bool one = si_->checkMotion(s1.get(), last.get());
    const bool other = si_->checkMotion(s1.get(), last.get(), again);
    if (one != other) differ << "valid: " << one << " and " << other << " to " << last << "\n";
  }
  EXPECT_GE(asked, 100);
  EXPECT_EQ(differ.str(), "") << "of " << asked;
}

/// "first: may be nullptr; this need not be different from s1 or s2."
TEST_P(Contract, LastValidMayBeNullOrAnEnd) {
  int invalid = 0;
  for (int i = 0; i < 2000 && invalid < 50; ++i) {
    const State s1 = randomValid(), s2 = random();
    State last(space_);
    std::pair<ob::State*, double> apart{last.get(), 0.0}, none{nullptr, 0.0};
    if (si_->checkMotion(s1.get(), s2.get(), apart)) continue;
    ++invalid;
    EXPECT_FALSE(si_->checkMotion(s1.get(), s2.get(), none));
    EXPECT_EQ(none.first, nullptr);
    EXPECT_EQ(none.second, apart.second);
    for (const bool first : {true, false}) {
      State from(s1), to(s2);
      std::pair<ob::State*, double> end{first ? from.get() : to.get(), 0.0};
      EXPECT_FALSE(si_->checkMotion(from.get(), to.get(), end));
      EXPECT_EQ(end.second, apart.second);
      EXPECT_TRUE(same(first ? from : to, last));
      EXPECT_TRUE(first ? same(to, s2) : same(from, s1));
    }
  }
  EXPECT_EQ(invalid, 50);
}

/// Nothing is promised for a start that is not valid; no motion from it is, and the start is what
/// comes back.
TEST_P(Contract, MotionsFromAnInvalidStateAreInvalid) {
  for (int i = 0; i < 30; ++i) {
    const State s1 = randomThatIs(false), s2 = randomValid();
    State last(s2);
    std::pair<ob::State*, double> lastValid{last.get(), 0.5};
    EXPECT_FALSE(si_->checkMotion(s1.get(), s2.get()));
    EXPECT_FALSE(si_->checkMotion(s1.get(), s2.get(), lastValid));
    EXPECT_EQ(lastValid.second, 0.0);
    EXPECT_TRUE(same(last, s1));
  }
}

TEST_P(Contract, AMotionThatStaysIsAsValidAsItsState) {
  int valid = 0;
  constexpr int kStates = 300;
  for (int i = 0; i < kStates; ++i) {
    const State state = random();
    const bool answer = si_->isValid(state.get());
    valid += answer;
    EXPECT_EQ(si_->checkMotion(state.get(), state.get()), answer);
  }
  EXPECT_GT(valid, kStates / 50);
  EXPECT_LT(valid, kStates);
}

/// Interpolation is symmetric, so planners turn motions round. Only what is undecided one way may
/// be valid the other way.
TEST_P(Contract, MotionsAreAsValidBackwards) {
  Workspace workspace(*checker_);
  constexpr int kMotions = 300;
  int valid = 0, undecided = 0;
  for (int i = 0; i < kMotions; ++i) {
    const State s1 = randomValid(), s2 = i % 2 == 0 ? randomValid() : near(s1, 0.3);
    const bool there = si_->checkMotion(s1.get(), s2.get());
    const bool back = si_->checkMotion(s2.get(), s1.get());
    valid += there;
    if (there == back) continue;
    ++undecided;
    const State& from = there ? s2 : s1;
    const State& to = there ? s1 : s2;
    EXPECT_EQ(checker_->certifyMotion(configuration(from), configuration(to), workspace).verdict,
              Verdict::Undecided);
  }
  EXPECT_LT(undecided, kMotions / 20);
  EXPECT_GT(valid, kMotions / 20);
  EXPECT_LT(valid, kMotions * 98 / 100);
}

/// "This function updates the number of valid and invalid segments", by both overloads.
TEST_P(Contract, MotionsAreCounted) {
  ob::MotionValidator& motions = *si_->getMotionValidator();
  motions.resetMotionCounter();
  EXPECT_EQ(motions.getCheckedMotionCount(), 0u);
  EXPECT_EQ(motions.getValidMotionFraction(), 0.0);
  unsigned int valid = 0, invalid = 0;
  for (int i = 0; i < 100; ++i) {
    const State s1 = randomValid(), s2 = i % 2 == 0 ? random() : s1;
    std::pair<ob::State*, double> lastValid{nullptr, 0.0};
    const bool answer = i % 3 == 0 ? motions.checkMotion(s1.get(), s2.get())
                                   : motions.checkMotion(s1.get(), s2.get(), lastValid);
    (answer ? valid : invalid) += 1;
  }
  EXPECT_EQ(motions.getValidMotionCount(), valid);
  EXPECT_EQ(motions.getInvalidMotionCount(), invalid);
  EXPECT_EQ(motions.getCheckedMotionCount(), 100u);
  EXPECT_EQ(si_->getCheckedMotionCount(), 100u);
  EXPECT_DOUBLE_EQ(motions.getValidMotionFraction(), valid / 100.0);
  EXPECT_GT(invalid, 2u);
  motions.resetMotionCounter();
  EXPECT_EQ(motions.getValidMotionCount() + motions.getInvalidMotionCount(), 0u);
}

}  // namespace
}  // namespace swept::test
