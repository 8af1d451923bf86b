// SPDX-License-Identifier: BSD-3-Clause
// What the lemma of chain_bounds says about points of two links, against sampled joint values.
#include "acm/chain_bounds.hpp"

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

/// A point of either link, and how much nearer to each other they come over the whole box.
struct Pair {
  std::string parts;
  int variables = 1;
  Eigen::Vector3d a;  ///< m, of the root link
  Eigen::Vector3d b;  ///< m, of the last link
  double radius = 0.0;
};

struct Approach {
  double any = 0.0, along = 0.0;            ///< m, of a grid of values with the ends
  double anyBound = 0.0, alongBound = 0.0;  ///< m
};

/// With the joints numbered from the root's side, or from the other one.
Approach approachOf(const Pair& pair, bool reversed) {
  const Case made = makeCase(pair.parts);
  const int last = made.model.bodyOfLink.back();
  const LinkChain chain(*made.robot, made.model, reversed ? last : 0, reversed ? 0 : last);
  EXPECT_TRUE(chain.bounded());
  EXPECT_EQ(chain.variables().size(), static_cast<std::size_t>(pair.variables));
  const Eigen::Vector3d& a = reversed ? pair.b : pair.a;
  const Eigen::Vector3d& b = reversed ? pair.a : pair.b;
  ChainBounds bounds(chain);
  LinkChain::Place middle, place;
  chain.startFrom(made.robot->defaultState(), middle);
  chain.startFrom(made.robot->defaultState(), place);
  std::vector<double> values;
  for (std::size_t k = 0; k < chain.variables().size(); ++k)
    values.push_back(chain.box().middle(k));
  EXPECT_TRUE(chain.moveTo(values, middle));
  bounds.setBox(chain.box(), middle);
  const ChainBounds::Ball ballA{middle.base_from_a * a, reversed ? pair.radius : 0.0};
  const ChainBounds::Ball ballB{middle.base_from_b * b, reversed ? 0.0 : pair.radius};
  const Eigen::Vector3d n = (ballB.center - ballA.center).normalized();
  Approach result;
  result.anyBound = bounds.approach(ballA, ballB);
  result.alongBound = bounds.approachAlong(n, ballA, ballB);

  constexpr int kSteps = 40;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  for (int i = 0; i < static_cast<int>(std::pow(kSteps + 1, values.size())); ++i) {
    for (int k = 0, rest = i; k < pair.variables; ++k, rest /= kSteps + 1)
      values[k] = chain.box().lower[k] +
                  (chain.box().upper[k] - chain.box().lower[k]) * (rest % (kSteps + 1)) / kSteps;
    EXPECT_TRUE(chain.moveTo(values, place));
    for (int corner = 0; corner < 6; ++corner) {
      const Eigen::Vector3d offset = (corner % 2 == 0 ? 1.0 : -1.0) * identity.col(corner / 2);
      const Eigen::Vector3d pointA = a + ballA.radius * offset, pointB = b + ballB.radius * offset;
      const Eigen::Vector3d before = middle.base_from_b * pointB - middle.base_from_a * pointA;
      const double after = (place.base_from_b * pointB - place.base_from_a * pointA).norm();
      result.any = std::max(result.any, before.norm() - after);
      result.along = std::max(result.along, n.dot(before) - after);
    }
  }
  return result;
}

/// The bounds hold, and at least these shares of them are reached: a bound that forgets what the
/// case is made of does not hold.
void expectReached(const Pair& pair, double anyShare, double alongShare) {
  for (const bool reversed : {false, true}) {
    const Approach found = approachOf(pair, reversed);
    EXPECT_LE(found.any, found.anyBound + 1e-12) << reversed;
    EXPECT_LE(found.along, found.alongBound + 1e-12) << reversed;
    EXPECT_GE(found.any, anyShare * found.anyBound) << reversed;
    EXPECT_GE(found.along, alongShare * found.alongBound) << reversed;
  }
}

std::string oneJoint(const std::string& joint) {
  return matrix_test::linkText("root", "") + joint + matrix_test::linkText("tip", "");
}

TEST(ChainBounds, ASlidingJointReachesThem) {
  const std::string slides =
      matrix_test::jointText("j", "prismatic", "root", "tip", "-0.3 0.5", "0 0 0", "1 0 0");
  expectReached({oneJoint(slides), 1, {2.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, 0.999, 0.999);
}

TEST(ChainBounds, ASmallTurnReachesThem) {
  const std::string turns = matrix_test::jointText("j", "revolute", "root", "tip", "-0.01 0.01");
  expectReached({oneJoint(turns), 1, {1.0, 5.0, 0.0}, {1.0, 0.0, 0.0}}, 0.99, 0.99);
}

TEST(ChainBounds, AMimickingJointReachesThem) {
  using matrix_test::jointText;
  using matrix_test::linkText;
  const std::string parts = linkText("root", "") + linkText("wheel", "") + linkText("tip", "") +
                            jointText("master", "revolute", "root", "wheel", "-0.01 0.01") +
                            jointText("j", "revolute", "root", "tip", "-0.1 0.1", "0 0 0", "0 0 1",
                                      "<mimic joint='master' multiplier='-3'/>");
  const Pair pair{parts, 1, {1.0, 5.0, 0.0}, {1.0, 0.0, 0.0}};
  expectReached(pair, 0.97, 0.97);
  EXPECT_GT(approachOf(pair, false).any, 0.0297);  // what the master alone does is 0.01
}

TEST(ChainBounds, PointsOfABallReachThem) {
  const std::string turns = matrix_test::jointText("j", "revolute", "root", "tip", "-0.01 0.01");
  expectReached({oneJoint(turns), 1, {1.2, 500.0, 0.0}, {1.0, 0.0, 0.0}, 0.2}, 0.98, 0.9);
}

TEST(ChainBounds, ATurnStraightAcrossComesNearerByItsHeight) {
  const std::string turns = matrix_test::jointText("j", "revolute", "root", "tip", "-1 1");
  expectReached({oneJoint(turns), 1, {-50.0, 0.0, 0.0}, {1.0, 0.0, 0.0}}, 0.4, 0.9);
}

/// An elbow folded so that each of the two points lies on the axis of the other link's joint:
/// neither joint alone brings the two nearer, both together nearly as much as their distance.
TEST(ChainBounds, LeverArmsThatAreZeroInTheMiddleReachThem) {
  using matrix_test::jointText;
  using matrix_test::linkText;
  const std::string parts = linkText("root", "") + linkText("upper", "") + linkText("tip", "") +
                            jointText("shoulder", "revolute", "root", "upper", "-1 1") +
                            jointText("elbow", "revolute", "upper", "tip", "-1 1", "1 0 0");
  const Pair pair{parts, 2, {1.0, 0.0, 0.0}, {-1.0, 0.0, 0.0}};
  expectReached(pair, 0.9, 0.9);
  EXPECT_GT(approachOf(pair, false).any, 0.9);
}

/// The first joint turns what the second one does towards the other point.
TEST(ChainBounds, JointsTurnEachOthersMotion) {
  using matrix_test::jointText;
  using matrix_test::linkText;
  const std::string parts =
      linkText("root", "") + linkText("upper", "") + linkText("tip", "") +
      jointText("first", "revolute", "root", "upper", "-0.5 0.5") +
      jointText("second", "prismatic", "upper", "tip", "-1 1", "0 0 0", "0 1 0");
  // The second slides across the line between the points, and through the first one's axis.
  expectReached({parts, 2, {50.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, 0.4, 0.9);
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
