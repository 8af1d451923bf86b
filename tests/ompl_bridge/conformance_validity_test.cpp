// SPDX-License-Identifier: BSD-3-Clause
// StateValidityChecker, by its contract (contract.hpp).
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "contract.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

INSTANTIATE_TEST_SUITE_P(Of, Contract, testing::ValuesIn(subjects()), nameOf);

TEST_P(Contract, ValidityAgreesWithItself) {
  const ob::StateValidityChecker& validity = *si_->getStateValidityChecker();
  EXPECT_EQ(validity.getSpecs().clearanceComputationType,
            ob::StateValidityCheckerSpecs::BOUNDED_APPROXIMATE);
  EXPECT_TRUE(validity.getSpecs().hasValidDirectionComputation);
  constexpr int kStates = 150;
  int valid = 0, led = 0;
  for (int i = 0; i < kStates; ++i) {
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization): states may change through get().
    const State state = random(), before(state);
    const bool answer = validity.isValid(state.get());
    valid += answer;
    EXPECT_EQ(si_->isValid(state.get()), answer);
    const double clearance = validity.clearance(state.get());
    if (std::abs(clearance) > 1e-6) {
      EXPECT_EQ(clearance > 0.0, answer);
    }
    double told = 7.0;
    EXPECT_EQ(validity.isValid(state.get(), told), answer);
    EXPECT_EQ(told, clearance);

    const State untouched = random();
    State other(untouched);
    bool available = i % 2 == 0;
    EXPECT_EQ(validity.clearance(state.get(), other.get(), available), clearance);
    EXPECT_TRUE(available ? validity.isValid(other.get()) : same(other, untouched));
    EXPECT_FALSE(answer && available);
    led += available;
    State again(untouched);
    bool availableAgain = !available;
    EXPECT_EQ(validity.isValid(state.get(), told, again.get(), availableAgain), answer);
    EXPECT_EQ(told, clearance);
    EXPECT_EQ(availableAgain, available);
    EXPECT_TRUE(same(again, other));
    EXPECT_TRUE(same(state, before)) << "a question changed the state";
  }
  EXPECT_GT(valid, kStates / 50);
  EXPECT_LT(valid, kStates * 49 / 50);
  EXPECT_GT(led, 3);
}

/// "If interpolate() may return states that are outside of bounds, isValid should also call
/// satisfiesBounds()."
TEST_P(Contract, StatesOutsideTheBoundsAreInvalid) {
  const ob::StateValidityChecker& validity = *si_->getStateValidityChecker();
  int outside = 0;
  for (int i = 0; i < 5; ++i) {
    const State inside = randomValid();
    for (unsigned int k = 0; k < group_.variables.size(); ++k) {
      for (const double bad : {100.0, -100.0, kInfinity, std::nan("")}) {
        State state(inside);
        *space_->getValueAddressAtIndex(state.get(), k) = bad;
        ++outside;
        double distance = 0.0;
        bool available = true;
        State other(space_);
        EXPECT_FALSE(validity.isValid(state.get()));
        EXPECT_FALSE(validity.isValid(state.get(), distance));
        EXPECT_FALSE(validity.isValid(state.get(), distance, other.get(), available));
        EXPECT_TRUE(!available || validity.isValid(other.get()));
        EXPECT_FALSE(si_->checkMotion(inside.get(), state.get()));
        EXPECT_FALSE(si_->checkMotion(state.get(), inside.get()));
      }
    }
  }
  EXPECT_GE(outside, 20);
}

}  // namespace
}  // namespace swept::test
