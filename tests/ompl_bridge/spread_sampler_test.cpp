// SPDX-License-Identifier: BSD-3-Clause
// Low-discrepancy samples against counts in boxes, moments, and random samples.
#include "spread_sampler.hpp"

#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>
#include <ompl/base/spaces/WrapperStateSpace.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "fixtures.hpp"
#include "swept/ompl_bridge/state_space.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

std::shared_ptr<ob::RealVectorStateSpace> boxSpace(unsigned dimensions) {
  auto space = std::make_shared<ob::RealVectorStateSpace>(dimensions);
  ob::RealVectorBounds bounds(dimensions);
  for (unsigned i = 0; i < dimensions; ++i) {
    bounds.low[i] = -1.0 - i;
    bounds.high[i] = 3.0 * i + 0.5;
  }
  space->setBounds(bounds);
  return space;
}

/// The largest difference, over many boxes with a corner at the origin of the unit cube, between
/// the share of points and the volume.
double discrepancy(const std::vector<std::vector<double>>& points, std::mt19937& random) {
  std::uniform_real_distribution<double> unit;
  double largest = 0.0;
  for (int i = 0; i < 2000; ++i) {
    double volume = 1.0;
    std::vector<double> corner;
    for (std::size_t d = 0; d < points[0].size(); ++d) {
      corner.push_back(std::pow(unit(random), 1.0 / static_cast<double>(points[0].size())));
      volume *= corner.back();
    }
    const auto inside = std::ranges::count_if(points, [&](const std::vector<double>& point) {
      return std::ranges::equal(point, corner, std::less<>());
    });
    largest = std::max(
        largest,
        std::abs(static_cast<double>(inside) / static_cast<double>(points.size()) - volume));
  }
  return largest;
}

TEST(SpreadSampler, SpreadsMoreEvenlyThanRandomNumbers) {
  for (const unsigned dimensions : {1U, 2U, 6U, 7U, 14U}) {
    SCOPED_TRACE(dimensions);
    const auto space = boxSpace(dimensions);
    const ob::RealVectorBounds& bounds = space->getBounds();
    for (const std::uint32_t seed : {1U, 2U, 77U}) {
      detail::SpreadSampler sampler(space, seed);
      std::mt19937 random(seed);
      std::uniform_real_distribution<double> unit;
      std::vector<std::vector<double>> spread, drawn;
      ob::ScopedState<ob::RealVectorStateSpace> state(space);
      for (int i = 0; i < 1000; ++i) {
        sampler.sample(state.get());
        ASSERT_TRUE(space->satisfiesBounds(state.get()));
        spread.emplace_back();
        drawn.emplace_back();
        for (unsigned d = 0; d < dimensions; ++d) {
          spread.back().push_back((state[d] - bounds.low[d]) / (bounds.high[d] - bounds.low[d]));
          drawn.back().push_back(unit(random));
        }
      }
      const double own = discrepancy(spread, random);
      EXPECT_LT(own, discrepancy(drawn, random));
      EXPECT_LT(own, 0.04);
    }
  }
}

/// Within the margins around two states, and within the bounds, and as even there.
TEST(SpreadSampler, DrawsFromABoxAroundTwoStates) {
  constexpr double kMargin = 0.4;
  const auto space = boxSpace(3);
  const ob::RealVectorBounds& bounds = space->getBounds();
  ob::ScopedState<ob::RealVectorStateSpace> from(space), to(space), state(space);
  from[0] = -0.9, to[0] = -0.2;  // the margin ends at the lower bound, -1
  from[1] = 1.5, to[1] = 1.0;
  from[2] = to[2] = 6.4;  // the upper bound is 6.5
  const std::vector<double> low{-1.0, 0.6, 6.0}, high{0.2, 1.9, 6.5};
  detail::SpreadSampler sampler(space, 1);
  std::vector<std::vector<double>> points;
  for (int i = 0; i < 1000; ++i) {
    sampler.sampleAround(from.get(), to.get(), kMargin, state.get());
    points.emplace_back();
    for (unsigned d = 0; d < 3; ++d) {
      points.back().push_back((state[d] - low[d]) / (high[d] - low[d]));
      EXPECT_GE(points.back().back(), -1e-12);
      EXPECT_LE(points.back().back(), 1.0 + 1e-12);
    }
  }
  std::mt19937 random(1);
  EXPECT_LT(discrepancy(points, random), 0.04);
  // A margin as wide as the space leaves nothing out.
  detail::SpreadSampler wide(space, 1), all(space, 1);
  ob::ScopedState<ob::RealVectorStateSpace> anywhere(space);
  for (int i = 0; i < 100; ++i) {
    wide.sampleAround(from.get(), to.get(), bounds.high[2] - bounds.low[2], state.get());
    all.sample(anywhere.get());
    for (unsigned d = 0; d < 3; ++d) EXPECT_NEAR(state[d], anywhere[d], 1e-12);
  }
}

/// From 3 to -3 rad the shorter way is across pi.
TEST(SpreadSampler, DrawsAnglesAroundTheShorterWay) {
  const auto space = std::make_shared<ob::SO2StateSpace>();
  ob::ScopedState<ob::SO2StateSpace> from(space), to(space), state(space);
  from->value = 3.0;
  to->value = -3.0;
  detail::SpreadSampler sampler(space, 1);
  const double half = std::numbers::pi - 3.0 + 0.1;
  double least = 1.0, most = 0.0;
  for (int i = 0; i < 1000; ++i) {
    sampler.sampleAround(from.get(), to.get(), 0.1, state.get());
    ASSERT_TRUE(space->satisfiesBounds(state.get()));
    const double off = std::remainder(state->value - std::numbers::pi, 2.0 * std::numbers::pi);
    least = std::min(least, off);
    most = std::max(most, off);
    EXPECT_LE(std::abs(off), half + 1e-12);
  }
  EXPECT_LT(least, -0.98 * half);
  EXPECT_GT(most, 0.98 * half);
}

TEST(SpreadSampler, IsTheSameForASeed) {
  const auto space = boxSpace(3);
  detail::SpreadSampler first(space, 5), second(space, 5), other(space, 6);
  ob::ScopedState<> a(space), b(space), c(space);
  for (int i = 0; i < 100; ++i) {
    first.sample(a.get());
    second.sample(b.get());
    other.sample(c.get());
    EXPECT_EQ(a, b);
    EXPECT_NE(a, c);
  }
}

/// Each component of a uniformly drawn unit quaternion has the mean square 1/4, and each entry of
/// its matrix the mean 0 and the mean square 1/3.
TEST(SpreadSampler, TurnsUniformly) {
  const auto space = std::make_shared<ob::SE3StateSpace>();
  ob::RealVectorBounds bounds(3);
  bounds.setLow(-2.0);
  bounds.setHigh(1.0);
  space->setBounds(bounds);
  detail::SpreadSampler sampler(space, 1);
  ob::ScopedState<ob::SE3StateSpace> state(space);
  constexpr int kCount = 4000;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero(), squares = Eigen::Matrix3d::Zero();
  Eigen::Vector4d components = Eigen::Vector4d::Zero();
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  for (int i = 0; i < kCount; ++i) {
    sampler.sample(state.get());
    ASSERT_TRUE(space->satisfiesBounds(state.get()));
    const auto& turn = state->rotation();
    const Eigen::Quaterniond q(turn.w, turn.x, turn.y, turn.z);
    ASSERT_NEAR(q.norm(), 1.0, 1e-12);
    sum += q.toRotationMatrix();
    squares += q.toRotationMatrix().cwiseAbs2();
    components += q.coeffs().cwiseAbs2();
    place += Eigen::Vector3d(state->getX(), state->getY(), state->getZ());
  }
  EXPECT_LT((sum / kCount).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((squares / kCount - Eigen::Matrix3d::Constant(1.0 / 3.0)).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((components / kCount - Eigen::Vector4d::Constant(0.25)).cwiseAbs().maxCoeff(), 0.01);
  EXPECT_LT((place / kCount - Eigen::Vector3d::Constant(-0.5)).cwiseAbs().maxCoeff(), 0.01);
}

TEST(SpreadSampler, TakesGroupsOfEveryJoint) {
  const auto robot = everyJoint();
  for (const char* group : {"all", "turn_only", "limited"}) {
    const ob::StateSpacePtr space = makeStateSpace(*robot, *robot->findGroup(group));
    space->setup();
    detail::SpreadSampler first(space, 1), second(space, 1);
    ob::ScopedState<> a(space), b(space), before(space);
    for (int i = 0; i < 300; ++i) {
      first.sample(a.get());
      second.sample(b.get());
      EXPECT_TRUE(space->satisfiesBounds(a.get()));
      EXPECT_EQ(a, b);
      if (i > 0) {
        EXPECT_NE(a, before);
      }
      before = a;
    }
  }
}

double& valueOf(ob::State* state) {
  return state->as<ob::WrapperStateSpace::StateType>()
      ->getState()
      ->as<ob::RealVectorStateSpace::StateType>()
      ->values[0];
}

TEST(SpreadSampler, LeavesOtherSpacesToTheirOwnSampler) {
  class Fixed final : public ob::StateSampler {
   public:
    using StateSampler::StateSampler;
    void sampleUniform(ob::State* state) override { valueOf(state) = 0.25; }
    void sampleUniformNear(ob::State*, const ob::State*, double) override {}
    void sampleGaussian(ob::State*, const ob::State*, double) override {}
  };
  const auto space = std::make_shared<ob::WrapperStateSpace>(boxSpace(1));
  space->setStateSamplerAllocator(
      [](const ob::StateSpace* own) { return std::make_shared<Fixed>(own); });
  detail::SpreadSampler sampler(space, 1);
  ob::ScopedState<> state(space);
  sampler.sample(state.get());
  EXPECT_EQ(valueOf(state.get()), 0.25);
}

}  // namespace
}  // namespace swept::test
