// SPDX-License-Identifier: BSD-3-Clause
// OMPL's valid-state samplers over the checker: what they give is valid, and where they say.
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/samplers/BridgeTestValidStateSampler.h>
#include <ompl/base/samplers/GaussianValidStateSampler.h>
#include <ompl/base/samplers/MaximizeClearanceValidStateSampler.h>
#include <ompl/base/samplers/ObstacleBasedValidStateSampler.h>
#include <ompl/base/samplers/UniformValidStateSampler.h>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

class Samplers : public testing::Test {
 protected:
  Samplers() { setup_->getSpaceInformation()->setup(); }

  /// m, mean over the samples. All are valid.
  template <typename Sampler>
  double meanClearance() {
    const ob::SpaceInformationPtr& si = setup_->getSpaceInformation();
    Sampler sampler(si.get());
    sampler.setNrAttempts(100);
    ob::ScopedState<> state(si->getStateSpace());
    double sum = 0.0;
    int count = 0;
    for (int i = 0; i < 500; ++i) {
      if (!sampler.sample(state.get())) continue;
      EXPECT_TRUE(si->isValid(state.get()));
      sum += si->getStateValidityChecker()->clearance(state.get());
      ++count;
    }
    EXPECT_GT(count, 250);
    return sum / count;
  }

  ompl::geometric::SimpleSetupPtr setup_ =
      makeSimpleSetup(std::make_shared<const Checker>(gantry(), "all", worldOf(boxes())));
};

TEST_F(Samplers, GoNearObstaclesOrAwayFromThem) {
  const double uniform = meanClearance<ob::UniformValidStateSampler>();
  EXPECT_LT(meanClearance<ob::ObstacleBasedValidStateSampler>(), 0.5 * uniform);
  EXPECT_LT(meanClearance<ob::GaussianValidStateSampler>(), uniform);
  EXPECT_LT(meanClearance<ob::BridgeTestValidStateSampler>(), uniform);
  EXPECT_GT(meanClearance<ob::MaximizeClearanceValidStateSampler>(), 1.2 * uniform);
}

}  // namespace
}  // namespace swept::test
