// SPDX-License-Identifier: BSD-3-Clause
// Half a turn can be made either way: what is certified is the way that the space takes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "contract.hpp"

namespace swept::test {
namespace {

namespace ob = ompl::base;
using State = ob::ScopedState<>;

constexpr double kPi = std::numbers::pi;

class HalfATurn : protected Seeded, public testing::Test {
 protected:
  static constexpr int kTurn = 1, kTheta = 6, kRotation = 10;  // of the group `all`

  /// Largest angle between what is certified and what OMPL interpolates.
  double gap(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> qa(14), qb(14), there(14);
    State from(space_), to(space_), at(space_);
    conversion_.toState(a, from.get());
    conversion_.toState(b, to.get());
    conversion_.toConfiguration(from.get(), qa);
    conversion_.toConfiguration(to.get(), qb);
    double largest = 0.0;
    for (const double t : {0.25, 0.5, 0.8}) {
      space_->interpolate(from.get(), to.get(), t, at.get());
      conversion_.toConfiguration(at.get(), there);
      const Eigen::VectorXd ours = checker_.interpolate(qa, qb, t);
      for (const int angle : {kTurn, kTheta})
        largest =
            std::max(largest, std::abs(std::remainder(ours[angle] - there[angle], 2.0 * kPi)));
      largest = std::max(largest,
                         rotation(&ours[kRotation]).angularDistance(rotation(&there[kRotation])));
    }
    return largest;
  }
  static Eigen::Quaterniond rotation(const double* xyzw) {
    return {xyzw[3], xyzw[0], xyzw[1], xyzw[2]};
  }
  std::vector<double> random() const {
    State state(space_);
    state.random();
    std::vector<double> q(14);
    conversion_.toConfiguration(state.get(), q);
    return q;
  }

  std::shared_ptr<const Robot> robot_ = everyJoint();
  Checker checker_{robot_, "all", std::make_shared<const World>()};
  ob::StateSpacePtr space_ = makeStateSpace(*robot_, checker_.group());
  StateConversion conversion_{*robot_, checker_.group()};
};

TEST_F(HalfATurn, OfAnAngle) {
  int exact = 0;
  for (int i = 0; i < 500; ++i) {
    std::vector<double> a = random();
    if (i < 8) a[kTurn] = a[kTheta] = -kPi + i * 0.25 * kPi;
    std::vector<double> b = a;
    for (const int angle : {kTurn, kTheta}) b[angle] += b[angle] < 0.0 ? kPi : -kPi;
    exact += std::abs(b[kTurn] - a[kTurn]) == kPi;
    EXPECT_LT(gap(a, b), 1e-9) << i;
  }
  EXPECT_GT(exact, 100);
}

/// Between any two of these the product is exactly zero.
TEST_F(HalfATurn, OfABodyAboutItsAxes) {
  std::vector<double> a = random(), b = a;
  for (int from = 0; from < 4; ++from) {
    for (int to = 0; to < 4; ++to) {
      for (int k = 0; k < 4; ++k) {
        a[kRotation + k] = k == from;
        b[kRotation + k] = k == to;
      }
      EXPECT_LT(gap(a, b), 1e-9) << from << " to " << to;
      b[kRotation + to] = -1.0;
      EXPECT_LT(gap(a, b), 1e-9) << from << " to -" << to;
    }
  }
}

/// Here rounding decides on the sign of the product, and so on the way round.
TEST_F(HalfATurn, OfABodyAboutAnyAxis) {
  std::mt19937 engine(8);
  std::normal_distribution<double> normal;
  int other = 0, zero = 0;
  constexpr int kTurns = 500;
  for (int i = 0; i < kTurns; ++i) {
    std::vector<double> a = random(), b = a;
    const Eigen::Vector3d axis(normal(engine), normal(engine), normal(engine));
    const Eigen::Quaterniond from = rotation(&a[kRotation]);
    const Eigen::Quaterniond to = from * Eigen::AngleAxisd(kPi, axis.normalized());
    std::copy_n(to.coeffs().data(), 4, &b[kRotation]);
    zero += std::abs(from.dot(to)) < 1e-15;
    other += gap(a, b) > 1e-7;
  }
  EXPECT_EQ(zero, kTurns);
  EXPECT_EQ(other, 0) << "go the other way round";
}

}  // namespace
}  // namespace swept::test
