// SPDX-License-Identifier: BSD-3-Clause
// What the lemma of chain_bounds says about points of two links, against sampled joint values.
#include "matrix/chain_bounds.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "matrix_robots.hpp"

namespace swept {
namespace {

using detail::ChainBounds;
using detail::JointBox;
using detail::LinkChain;

struct Case {
  std::shared_ptr<const Robot> robot;
  detail::KinematicModel model;
};

Case makeCase(const std::string& parts) {
  Case made{matrix_test::robotOf(parts), {}};
  Group all;
  all.variables.resize(made.robot->variables().size());
  std::iota(all.variables.begin(), all.variables.end(), 0);
  made.model = detail::compileKinematics(*made.robot, all, made.robot->defaultState());
  return made;
}

Eigen::Vector3d randomPoint(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> range(-size, size);
  return {range(random), range(random), range(random)};
}

/// A box within the chain's, of any size; some variables at a point.
JointBox partOf(const JointBox& whole, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  JointBox box = whole;
  const double scale = std::pow(10.0, -3.0 * unit(random));
  for (std::size_t k = 0; k < box.lower.size(); ++k) {
    const double width = unit(random) < 0.2 ? 0.0 : scale * unit(random);
    const double range = whole.upper[k] - whole.lower[k];
    box.lower[k] = whole.lower[k] + unit(random) * (1.0 - width) * range;
    box.upper[k] = box.lower[k] + width * range;
  }
  return box;
}

std::vector<double> valuesIn(const JointBox& box, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-0.2, 1.2);  // often at the ends
  std::vector<double> values;
  for (std::size_t k = 0; k < box.lower.size(); ++k)
    values.push_back(box.lower[k] +
                     std::clamp(unit(random), 0.0, 1.0) * (box.upper[k] - box.lower[k]));
  return values;
}

TEST(ChainBounds, PointsComeNoNearerThanTheLemmaSays) {
  std::mt19937 random(3);
  int boxes = 0, directedIsLess = 0, tight = 0, manyJoints = 0;
  for (int robots = 0; robots < 12; ++robots) {
    const Case made = makeCase(matrix_test::randomChain(random));
    const int last = static_cast<int>(made.model.bodies.size()) - 1;
    const LinkChain chain(*made.robot, made.model, robots % 3, last);
    ASSERT_TRUE(chain.bounded());
    ChainBounds bounds(chain);
    LinkChain::Place middle, place;
    chain.startFrom(made.robot->defaultState(), middle);
    chain.startFrom(made.robot->defaultState(), place);
    for (int i = 0; i < 60; ++i) {
      const JointBox box = partOf(chain.box(), random);
      std::vector<double> values;
      for (std::size_t k = 0; k < box.lower.size(); ++k) values.push_back(box.middle(k));
      ASSERT_TRUE(chain.moveTo(values, middle));
      bounds.setBox(box, middle);
      // A ball on either link and two points of it.
      const double radius = i % 3 == 0 ? 0.02 : 0.0;
      const Eigen::Vector3d a = randomPoint(random, 0.3), b = randomPoint(random, 0.3);
      const ChainBounds::Ball ballA{middle.base_from_a * a, radius};
      const ChainBounds::Ball ballB{middle.base_from_b * b, radius};
      const Eigen::Vector3d n = (ballB.center - ballA.center).normalized();
      const double any = bounds.approach(ballA, ballB);
      const double directed = bounds.approachAlong(n, ballA, ballB);
      const double sharesSum = std::accumulate(bounds.shares().begin(), bounds.shares().end(), 0.0);
      EXPECT_NEAR(sharesSum, directed, 1e-6 * directed + 1e-15);

      double most = 0.0, mostAlong = 0.0;
      for (int s = 0; s < 150; ++s) {
        ASSERT_TRUE(chain.moveTo(valuesIn(box, random), place));
        const Eigen::Vector3d pointA = a + radius * randomPoint(random, 1.0).normalized();
        const Eigen::Vector3d pointB = b + radius * randomPoint(random, 1.0).normalized();
        const Eigen::Vector3d before = middle.base_from_b * pointB - middle.base_from_a * pointA;
        const double after = (place.base_from_b * pointB - place.base_from_a * pointA).norm();
        most = std::max(most, before.norm() - after);
        mostAlong = std::max(mostAlong, n.dot(before) - after);
      }
      EXPECT_LE(most, any + 1e-12);
      EXPECT_LE(mostAlong, directed + 1e-12);
      ++boxes;
      directedIsLess += directed < 0.8 * any ? 1 : 0;
      tight += mostAlong > 0.5 * directed ? 1 : 0;
      manyJoints += chain.joints().size() >= 3 ? 1 : 0;
    }
  }
  EXPECT_EQ(boxes, 720);
  EXPECT_GT(directedIsLess, boxes / 5);
  EXPECT_GT(tight, boxes / 10);
  EXPECT_GT(manyJoints, boxes / 4);
}

TEST(ChainBounds, AFullTurnIsNoMoreThanTheDiameter) {
  const Case made = makeCase(matrix_test::linkText("a", "") + matrix_test::linkText("b", "") +
                             matrix_test::jointText("j", "continuous", "a", "b"));
  const LinkChain chain(*made.robot, made.model, 0, 1);
  ChainBounds bounds(chain);
  LinkChain::Place place;
  chain.startFrom(made.robot->defaultState(), place);
  ASSERT_TRUE(chain.moveTo(std::vector<double>{0.0}, place));
  bounds.setBox(chain.box(), place);
  const ChainBounds::Ball far{Eigen::Vector3d(5.0, 0.0, 0.0), 0.0};
  const ChainBounds::Ball near{Eigen::Vector3d(0.0, 0.3, 1.0), 0.0};
  EXPECT_NEAR(bounds.approach(far, near), 0.6, 1e-8);
  EXPECT_NEAR(bounds.approach(near, far), 0.6, 1e-8);
}

}  // namespace
}  // namespace swept
