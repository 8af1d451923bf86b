// SPDX-License-Identifier: BSD-3-Clause
// OptimizationObjective, by its contract (contract.hpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "contract.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

INSTANTIATE_TEST_SUITE_P(Of, Contract, testing::ValuesIn(subjects()), nameOf);

TEST_P(Contract, ObjectiveCombinesTheLeastClearances) {
  const auto shared =
      std::make_shared<CertifiedClearanceObjective>(si_, checker_, 1e-3, ClearanceOf::All);
  CertifiedClearanceObjective& objective = *shared;
  const ob::Cost identity = objective.identityCost(), worst = objective.infiniteCost();
  int apart = 0, together = 0;
  for (int i = 0; i < 60; ++i) {
    const State a = i % 2 == 0 ? random() : randomValid(), b = near(a, 0.2);
    const ob::Cost ofA = objective.stateCost(a.get()), ofB = objective.stateCost(b.get());
    const ob::Cost between = objective.motionCost(a.get(), b.get());
    (ofA.value() > 0.0 ? apart : together) += 1;
    if (ofA.value() > 0.0) {
      EXPECT_NEAR(ofA.value(), si_->getStateValidityChecker()->clearance(a.get()), 1e-9);
    }
    // A motion is no better than its states are, and of a motion that stays no worse either.
    EXPECT_FALSE(objective.isCostBetterThan(between, ob::Cost(ofA.value() + 1e-6)));
    EXPECT_FALSE(objective.isCostBetterThan(between, ob::Cost(ofB.value() + 1e-6)));
    EXPECT_NEAR(objective.motionCost(a.get(), a.get()).value(), ofA.value(), 1e-3);
    EXPECT_NEAR(objective.motionCost(b.get(), a.get()).value(), between.value(), 2e-3);
    // "For all costs c, combineCosts(c, c_i) = combineCosts(c_i, c) = c."
    for (const ob::Cost c : {ofA, ofB, between, worst, identity}) {
      EXPECT_EQ(objective.combineCosts(c, identity).value(), c.value());
      EXPECT_EQ(objective.combineCosts(identity, c).value(), c.value());
      EXPECT_EQ(objective.combineCosts(worst, c).value(), worst.value());
      EXPECT_FALSE(objective.isCostBetterThan(c, c));
      EXPECT_FALSE(objective.isCostBetterThan(worst, c));
      EXPECT_TRUE(objective.isCostEquivalentTo(c, c));
    }
    EXPECT_EQ(objective.combineCosts(ofA, between).value(), std::min(ofA.value(), between.value()));
    EXPECT_EQ(objective.betterCost(ofA, ofB).value(), std::max(ofA.value(), ofB.value()));
    // "An admissible estimate always undervalues the true cost": nothing is better.
    EXPECT_FALSE(
        objective.isCostBetterThan(between, objective.motionCostHeuristic(a.get(), b.get())));
    og::PathGeometric path(si_);
    path.append(a.get());
    path.append(b.get());
    path.append(a.get());
    EXPECT_NEAR(path.cost(shared).value(), between.value(), 2e-3);
  }
  EXPECT_GT(apart, 5);
  EXPECT_GT(together, 0);
  EXPECT_TRUE(objective.isSymmetric());
  EXPECT_FALSE(objective.getDescription().empty());
  objective.setCostThreshold(ob::Cost(0.1));
  EXPECT_TRUE(objective.isSatisfied(ob::Cost(0.2)));
  EXPECT_FALSE(objective.isSatisfied(ob::Cost(0.05)));
}

}  // namespace
}  // namespace swept::test
