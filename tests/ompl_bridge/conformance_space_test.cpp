// SPDX-License-Identifier: BSD-3-Clause
// StateSpace and StateSampler, by their contracts (contract.hpp).
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "contract.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

INSTANTIATE_TEST_SUITE_P(Of, Contract, testing::ValuesIn(subjects()), nameOf);

TEST_P(Contract, SpaceCopiesAndComparesStates) {
  int changes = 0;
  for (int i = 0; i < 50; ++i) {
    const State original = random();
    const std::vector<double> before = original.reals();
    State copy = random();
    EXPECT_FALSE(equal(copy, original));
    space_->copyState(copy.get(), original.get());
    EXPECT_TRUE(equal(copy, original));
    EXPECT_EQ(copy.reals(), before);
    EXPECT_EQ(original.reals(), before);
    ob::State* clone = space_->cloneState(original.get());
    EXPECT_TRUE(space_->equalStates(clone, original.get()));
    space_->freeState(clone);
    for (unsigned int k = 0; k < before.size(); ++k) {
      space_->copyState(copy.get(), original.get());
      *space_->getValueAddressAtIndex(copy.get(), k) += before[k] > 0.0 ? -0.02 : 0.02;
      EXPECT_EQ(original.reals(), before);
      space_->enforceBounds(copy.get());
      // Along the quaternion itself there is no change once it has unit length again.
      if (turnsInSpace() && k + 4 >= before.size() && std::abs(before[k]) > 0.7) continue;
      ++changes;
      EXPECT_FALSE(equal(copy, original)) << k;
      EXPECT_GT(distance(copy, original), 1e-6) << k;
    }
  }
  EXPECT_GE(changes, 50);
}

TEST_P(Contract, SpaceMeasuresWithAMetric) {
  EXPECT_TRUE(space_->isMetricSpace());
  EXPECT_TRUE(space_->hasSymmetricDistance());
  const double extent = space_->getMaximumExtent();
  ASSERT_TRUE(std::isfinite(extent));
  int far = 0, close = 0;
  double longest = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const State a = random(), b = random(), c = i % 2 == 0 ? random() : near(a, 0.02);
    const double ab = distance(a, b), bc = distance(b, c), ac = distance(a, c);
    EXPECT_EQ(distance(a, a), 0.0);
    EXPECT_NEAR(distance(b, a), ab, 1e-12);
    EXPECT_GT(ab, 0.0);
    EXPECT_LE(ab, extent);
    EXPECT_LE(ab, ac + bc + noise());
    EXPECT_LE(ac, ab + bc + noise());
    longest = std::max(longest, ab);
    far += ac > 0.2 * extent;
    close += ac < 0.05 * extent;
  }
  EXPECT_GT(far, 200);
  EXPECT_GT(close, 200);
  EXPECT_GT(longest, 0.4 * extent) << "the extent is no tight bound";
}

TEST_P(Contract, SpaceInterpolatesAtConstantSpeed) {
  EXPECT_TRUE(space_->hasSymmetricInterpolate());
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const State a = random(), b = i % 4 == 0 ? near(a, 0.1) : random();
    const double length = distance(a, b), t = unit(engine), u = unit(engine);
    State at(space_), other(space_);
    space_->interpolate(a.get(), b.get(), 0.0, at.get());
    EXPECT_LE(distance(a, at), 1e-9);
    space_->interpolate(a.get(), b.get(), 1.0, at.get());
    EXPECT_LE(distance(b, at), 1e-9);
    space_->interpolate(a.get(), b.get(), t, at.get());
    EXPECT_NEAR(distance(a, at), t * length, noise());
    EXPECT_NEAR(distance(at, b), (1.0 - t) * length, noise());
    EXPECT_TRUE(space_->satisfiesBounds(at.get()));
    space_->interpolate(a.get(), b.get(), u, other.get());
    EXPECT_NEAR(distance(at, other), std::abs(t - u) * length, noise());
    space_->interpolate(b.get(), a.get(), 1.0 - t, other.get());
    EXPECT_LE(distance(at, other), noise());
    // "The memory location of state is not required to be different from either from or to."
    State from(a), to(b);
    space_->interpolate(from.get(), to.get(), t, from.get());
    EXPECT_TRUE(same(from, at));
    from = a;
    space_->interpolate(from.get(), to.get(), t, to.get());
    EXPECT_TRUE(same(to, at));
  }
}

TEST_P(Contract, SpaceKeepsItsBounds) {
  std::mt19937 engine(6);
  std::uniform_real_distribution<double> factor(-6.0, 6.0);
  int outside = 0;
  constexpr int kStates = 500;
  for (int i = 0; i < kStates; ++i) {
    State state = random();
    EXPECT_TRUE(space_->satisfiesBounds(state.get()));
    const std::vector<double> inside = state.reals();
    space_->enforceBounds(state.get());
    // A quaternion that is scaled to unit length again changes in its last digit.
    EXPECT_THAT(state.reals(), testing::Pointwise(testing::DoubleNear(1e-15), inside));

    std::vector<double> reals = inside;
    for (double& value : reals) value = factor(engine) * (std::abs(value) + 0.1);
    space_->copyFromReals(state.get(), reals);
    outside += !space_->satisfiesBounds(state.get());
    space_->enforceBounds(state.get());
    EXPECT_TRUE(space_->satisfiesBounds(state.get()));
    const std::vector<double> once = state.reals();
    space_->enforceBounds(state.get());
    EXPECT_THAT(state.reals(), testing::Pointwise(testing::DoubleNear(1e-15), once));
    for (std::size_t k = 0; k < reals.size(); ++k) {
      if (!robot_->variables()[group_.variables[k]].cyclic) continue;
      EXPECT_NEAR(std::remainder(once[k] - reals[k], 2.0 * kPi), 0.0, 1e-12);
    }
  }
  EXPECT_GT(outside, kStates / 4);
}

TEST_P(Contract, SpaceSerializesStates) {
  const unsigned int length = space_->getSerializationLength();
  EXPECT_EQ(length, sizeof(double) * group_.variables.size());
  for (int i = 0; i < 50; ++i) {
    const State state = random();
    State back = random();
    std::vector<unsigned char> bytes(length + 8, 0xa5);
    space_->serialize(bytes.data(), state.get());
    for (unsigned int k = length; k < bytes.size(); ++k) EXPECT_EQ(bytes[k], 0xa5);
    space_->deserialize(back.get(), bytes.data());
    EXPECT_TRUE(same(back, state));
  }
}

/// In the order of the group's configuration, and by the names of its variables.
TEST_P(Contract, SpaceGivesAccessToItsValues) {
  const auto count = static_cast<unsigned int>(group_.variables.size());
  ASSERT_EQ(space_->getValueLocations().size(), count);
  int named = 0;
  for (int i = 0; i < 50; ++i) {
    const State state = random();
    const std::vector<double> q = configuration(state);
    std::vector<double> reals;
    space_->copyToReals(reals, state.get());
    EXPECT_EQ(reals, q);
    State back = random();
    space_->copyFromReals(back.get(), reals);
    EXPECT_TRUE(same(back, state));
    for (unsigned int k = 0; k < count; ++k) {
      EXPECT_EQ(*space_->getValueAddressAtIndex(back.get(), k), q[k]);
      EXPECT_EQ(*space_->getValueAddressAtLocation(state.get(), space_->getValueLocations()[k]),
                q[k]);
      const std::string& name = robot_->variables()[group_.variables[k]].name;
      if (!space_->getValueLocationsByName().contains(name)) continue;
      ++named;
      EXPECT_EQ(*space_->getValueAddressAtName(state.get(), name), q[k]) << name;
    }
    EXPECT_EQ(space_->getValueAddressAtIndex(back.get(), count), nullptr);
  }
  EXPECT_GE(named, 50);
}

/// No piece of a motion is longer than the longest valid segment, and none is missing.
TEST_P(Contract, SpaceCountsValidSegments) {
  EXPECT_GT(space_->getLongestValidSegmentLength(), 0.0);
  EXPECT_NEAR(space_->getLongestValidSegmentLength(),
              space_->getLongestValidSegmentFraction() * space_->getMaximumExtent(), 1e-12);
  for (int i = 0; i < 200; ++i) {
    const State a = random(), b = i % 2 == 0 ? random() : near(a, 0.05);
    const unsigned int count = space_->validSegmentCount(a.get(), b.get());
    EXPECT_EQ(space_->validSegmentCount(b.get(), a.get()), count);
    EXPECT_GE(count, 1u);
    EXPECT_LE(distance(a, b), count * space_->getLongestValidSegmentLength() * (1.0 + 1e-12));
    if (!space_->isCompound()) {
      EXPECT_GT(distance(a, b), (count - 1) * space_->getLongestValidSegmentLength());
    }
    // OMPL's compounds count the segments of their parts, which do not hear of the factor.
    space_->setValidSegmentCountFactor(3);
    EXPECT_EQ(space_->validSegmentCount(a.get(), b.get()),
              space_->isCompound() ? count : 3 * count);
    space_->setValidSegmentCountFactor(1);
  }
}

TEST_P(Contract, SpacePassesOmplsOwnChecks) {
  EXPECT_NO_THROW(space_->sanityChecks());
  EXPECT_FALSE(space_->isDiscrete());
  EXPECT_FALSE(space_->isHybrid());
  unsigned int freedom = 0;
  double measure = 1.0;
  for (const int j : group_.joints) {
    const JointType type = robot_->joints()[j].type;
    freedom += type == JointType::Floating ? 6 : type == JointType::Planar ? 3 : 1;
  }
  EXPECT_EQ(space_->getDimension(), freedom);
  if (!space_->isCompound()) {
    // In the space's own distance, whose weights it has.
    const ob::RealVectorBounds& bounds = space_->as<ob::RealVectorStateSpace>()->getBounds();
    for (unsigned int k = 0; k < freedom; ++k) {
      const State from = random(), to = random();
      double* low = from.get()->as<ob::RealVectorStateSpace::StateType>()->values;
      double* high = to.get()->as<ob::RealVectorStateSpace::StateType>()->values;
      std::ranges::copy(bounds.low, low);
      std::ranges::copy(bounds.low, high);
      high[k] = bounds.high[k];
      measure *= distance(from, to);
    }
    EXPECT_NEAR(space_->getMeasure(), measure, 1e-12 * measure);
  }
  EXPECT_GT(space_->getMeasure(), 0.0);
  EXPECT_TRUE(std::isfinite(space_->getMeasure()));
  EXPECT_TRUE(space_->includes(space_));
  EXPECT_TRUE(space_->covers(space_));
  std::ostringstream text;
  space_->printSettings(text);
  space_->printState(random().get(), text);
  space_->diagram(text);
  space_->list(text);
  EXPECT_THAT(text.str(), HasSubstr(group_.name));
}

TEST_P(Contract, SamplersStayInBounds) {
  const State centre = random();
  std::map<double, double> nearMean, gaussMean;
  for (const double reach : {0.0, 0.01, 0.3, 100.0}) {
    State state(space_);
    for (int i = 0; i < 300; ++i) {
      sampler_->sampleUniformNear(state.get(), centre.get(), reach);
      EXPECT_TRUE(space_->satisfiesBounds(state.get()));
      nearMean[reach] += distance(state, centre) / 300;
      sampler_->sampleGaussian(state.get(), centre.get(), reach);
      EXPECT_TRUE(space_->satisfiesBounds(state.get()));
      gaussMean[reach] += distance(state, centre) / 300;
    }
  }
  for (const auto& mean : {nearMean, gaussMean}) {
    EXPECT_LE(mean.at(0.0), noise());
    EXPECT_GT(mean.at(0.01), mean.at(0.0));
    EXPECT_LT(mean.at(0.01), 0.3 * mean.at(0.3));
    EXPECT_LT(mean.at(0.3), mean.at(100.0));
  }
}

/// What enforceBounds makes of values far outside are the ends of the space: uniform samples come
/// near them all. Angles without limits and orientations have theirs at half a turn.
TEST_P(Contract, UniformSamplesReachAllOfTheSpace) {
  const std::size_t count = group_.variables.size();
  std::vector<double> low(count, kInfinity), high(count, -kInfinity);
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> q = configuration(random());
    for (std::size_t k = 0; k < count; ++k) {
      low[k] = std::min(low[k], q[k]);
      high[k] = std::max(high[k], q[k]);
    }
  }
  State floor(space_), ceiling(space_);
  space_->copyFromReals(floor.get(), std::vector<double>(count, -1e3));
  space_->copyFromReals(ceiling.get(), std::vector<double>(count, 1e3));
  space_->enforceBounds(floor.get());
  space_->enforceBounds(ceiling.get());
  for (std::size_t k = 0; k < count; ++k) {
    const Variable& variable = robot_->variables()[group_.variables[k]];
    double least = configuration(floor)[k], most = configuration(ceiling)[k];
    if (variable.cyclic) least = -(most = kPi);
    if (variable.name.find("/rot_") != std::string::npos) least = -(most = 1.0);
    EXPECT_LT(low[k], least + 0.1 * (most - least)) << variable.name;
    EXPECT_GT(high[k], most - 0.1 * (most - least)) << variable.name;
  }
}

/// "Allocate a sampler that actually samples only components that are part of subspace."
TEST_P(Contract, SubspaceSamplersLeaveTheRestAlone) {
  if (!space_->isCompound()) {
    // The space is the only one of its subspaces: all of a state is sampled.
    const auto whole = space_->allocSubspaceStateSampler(space_);
    State state = random();
    const State before(state);
    whole->sampleUniform(state.get());
    EXPECT_TRUE(space_->satisfiesBounds(state.get()));
    const std::vector<double> was = configuration(before), is = configuration(state);
    for (std::size_t k = 0; k < was.size(); ++k) EXPECT_NE(was[k], is[k]) << k;
    return;
  }
  const auto* compound = space_->as<ob::CompoundStateSpace>();
  for (unsigned int part = 0; part < compound->getSubspaceCount(); ++part) {
    const auto sampler = space_->allocSubspaceStateSampler(compound->getSubspace(part));
    State state = random();
    const State before(state);
    sampler->sampleUniform(state.get());
    EXPECT_TRUE(space_->satisfiesBounds(state.get()));
    for (unsigned int k = 0; k < compound->getSubspaceCount(); ++k) {
      const auto& subspace = compound->getSubspace(k);
      const auto components = [&](const State& of) {
        return of.get()->as<ob::CompoundState>()->components[k];
      };
      EXPECT_EQ(subspace->equalStates(components(state), components(before)), k != part);
    }
  }
}

}  // namespace
}  // namespace swept::test
