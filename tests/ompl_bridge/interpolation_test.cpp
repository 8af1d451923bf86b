// SPDX-License-Identifier: BSD-3-Clause
// What OMPL interpolates must be what the certificate covers.
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "fixtures.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;

constexpr int kTurn = 1, kTheta = 6, kRotation = 10;  // first indices in the group `all`

double angleBetween(double a, double b) {
  return std::abs(std::remainder(a - b, 2.0 * std::numbers::pi));
}

// Largest difference of two configurations of the group `all`, modulo turns and quaternion signs.
double difference(std::span<const double> a, std::span<const double> b) {
  double largest = std::max(angleBetween(a[kTurn], b[kTurn]), angleBetween(a[kTheta], b[kTheta]));
  for (int i = 0; i < kRotation; ++i) {
    if (i != kTurn && i != kTheta) largest = std::max(largest, std::abs(a[i] - b[i]));
  }
  const Eigen::Vector4d qa(a[10], a[11], a[12], a[13]), qb(b[10], b[11], b[12], b[13]);
  return std::max(largest,
                  std::min((qa - qb).cwiseAbs().maxCoeff(), (qa + qb).cwiseAbs().maxCoeff()));
}

class Interpolation : public testing::Test {
 protected:
  // The certified configuration at t, and OMPL's.
  std::pair<Eigen::VectorXd, std::vector<double>> both(double t) {
    conversion_.toConfiguration(from_.get(), a_);
    conversion_.toConfiguration(to_.get(), b_);
    space_->interpolate(from_.get(), to_.get(), t, at_.get());
    std::vector<double> ompl(conversion_.dimension());
    conversion_.toConfiguration(at_.get(), ompl);
    return {checker_.interpolate(a_, b_, t), ompl};
  }
  double gap(double t) {
    const auto [ours, ompl] = both(t);
    return difference({ours.data(), static_cast<std::size_t>(ours.size())}, ompl);
  }

  std::shared_ptr<const Robot> robot_ = everyJoint();
  Checker checker_{robot_, "all", std::make_shared<const World>()};
  ob::StateSpacePtr space_ = makeStateSpace(*robot_, checker_.group());
  StateConversion conversion_{*robot_, checker_.group()};
  ob::ScopedState<> from_{space_}, to_{space_}, at_{space_};
  std::vector<double> a_ = std::vector<double>(14), b_ = std::vector<double>(14);
};

TEST_F(Interpolation, EqualsTheCertifiedMotion) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  constexpr int kMotions = 2000;
  int wrapping = 0, flipping = 0;
  for (int i = 0; i < kMotions; ++i) {
    from_.random();
    to_.random();
    ASSERT_LT(gap(unit(random)), 1e-12);
    ASSERT_LT(gap(0.0), 1e-12);
    ASSERT_LT(gap(1.0), 1e-12);
    wrapping += std::abs(a_[kTurn] - b_[kTurn]) > std::numbers::pi;
    double dot = 0.0;
    for (int k = kRotation; k < 14; ++k) dot += a_[k] * b_[k];
    flipping += dot < 0.0;
  }
  EXPECT_GT(wrapping, kMotions / 10);
  EXPECT_GT(flipping, kMotions / 4);
}

// OMPL does not turn at all between orientations closer than 1e-4 rad; the certificate does. The
// gap stays that small.
TEST_F(Interpolation, CloseOrientationsStayClose) {
  std::mt19937 random(12);
  std::uniform_real_distribution<double> unit(-1.0, 1.0), exponent(-12.0, -2.0);
  int close = 0;
  for (int i = 0; i < 2000; ++i) {
    from_.random();
    conversion_.toConfiguration(from_.get(), b_);
    const double size = std::pow(10.0, exponent(random));
    for (int k = kRotation; k < 14; ++k) b_[k] += size * unit(random);
    conversion_.toState(b_, to_.get());
    close += size < 1e-5;
    ASSERT_LT(gap(0.5 + 0.5 * unit(random)), size < 1e-3 ? 1e-4 : 1e-10);
  }
  EXPECT_GT(close, 500);
}

}  // namespace
}  // namespace swept::test
