// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "simd/tables/table_motion.hpp"
#include "table_robots.hpp"

namespace swept::simd_test {
namespace {

using detail::SimdBodyPair;
using detail::TableMotion;
using Vector3 = Eigen::Matrix<Real, 3, 1>;

/// How the chain from one body to the other may run.
enum class Chain { OneOfA, OneOfB, TwoOfA, TwoOfB, OneEach };

Chain chainOf(const CheckerModel& model, const SimdBodyPair& bodies) {
  const int reference = model.simd.references[bodies.reference].body;
  const auto steps = [&](int body) {
    int count = 0;
    for (; body != reference; body = model.kinematics.bodies[body].parent) ++count;
    return count;
  };
  const int ofA = steps(bodies.bodyA);
  const int ofB = steps(bodies.bodyB);
  if (ofA == 1 && ofB == 1) return Chain::OneEach;
  if (ofB == 0) return ofA == 1 ? Chain::OneOfA : Chain::TwoOfA;
  return ofB == 1 ? Chain::OneOfB : Chain::TwoOfB;
}

/// One box of parts of cells, from a single part to several cells.
TableMotion::Parts randomParts(Random& random, const TableMotion& motion) {
  TableMotion::Parts parts;
  for (int k = 0; k < motion.joints(); ++k) {
    const int all = motion.axes()[k].cells * PairSeparationTable::kParts;
    const int width = std::min(all, 1 << random.below(10));
    parts.begin[k] = random.below(all - width + 1);
    parts.end[k] = parts.begin[k] + width;
  }
  return parts;
}

struct Tightness {
  int asked = 0;
  double most = 0.0;  ///< of what points do, relative to the bound
};

void compare(Random& random, const CheckerModel& model, const SimdBodyPair& bodies,
             const TableMotion& motion, Tightness& approach) {
  const Poses poses(model, motion.axes(), motion.joints());
  const auto& lanes = model.simd;
  const TableMotion::Parts parts = randomParts(random, motion);
  const TableMotion::Place place = motion.placeOf(parts);
  const Eigen::Vector3d a = random.vector(0.3);
  // Near to each other at times, and on a line through an axis.
  const Eigen::Vector3d towards = random.chance(0.5) ? random.vector(0.02) : random.vector(0.5);
  const Eigen::Vector3d inA = a + towards;
  const Eigen::Vector3d b = place.a_from_b.inverse() * inA;
  const double between = (place.a_from_b * b - a).norm();
  const TableMotion::Levers levers = motion.levers(a, b);
  const double nearer = motion.approach(place, a, place.a_from_b * b, between, levers);
  const double travel = TableMotion::travel(place, levers);
  EXPECT_LE(nearer, travel);
  for (int sample = 0; sample < 8; ++sample) {
    std::array<double, 2> values{};
    for (int k = 0; k < motion.joints(); ++k) {
      const PairSeparationTable::Axis& axis = motion.axes()[k];
      const double part = 1.0 / static_cast<double>(axis.partsPerUnit);
      const double low = static_cast<double>(axis.lower) + part * parts.begin[k];
      const double high = static_cast<double>(axis.lower) + part * parts.end[k];
      const int where = random.below(3);
      values[k] = where == 0 ? low : where == 1 ? high : random.uniform(low, high);
    }
    const Vector3 bodyA = lanes.bodyFromLane[bodies.bodyA].cast<Real>() * a.cast<Real>();
    const Vector3 bodyB = lanes.bodyFromLane[bodies.bodyB].cast<Real>() * b.cast<Real>();
    const Eigen::Isometry3d a_from_b = poses.between(bodies.bodyA, bodies.bodyB, values);
    const double found = (a_from_b * bodyB.cast<double>() - bodyA.cast<double>()).norm();
    EXPECT_GE(found, between - nearer - 1e-9);
    EXPECT_LE(found, between + travel + 1e-9);
    ++approach.asked;
    approach.most = std::max(approach.most, (between - found) / nearer);
  }
}

/// The lemma in the header, for each way in which a chain may run.
TEST(SimdTableMotion, PointsComeNoNearerThanBounded) {
  Random random(51);
  std::map<Chain, Tightness> chains;
  for (const Named& robot : robotsWithTables()) {
    SCOPED_TRACE(robot.name);
    for (const SimdBodyPair& bodies : robot.model->simd.bodyPairs) {
      const auto motion = TableMotion::between(*robot.model, robot.model->simd, bodies);
      if (!motion) continue;
      Tightness& approach = chains[chainOf(*robot.model, bodies)];
      for (int i = 0; i < 400; ++i) compare(random, *robot.model, bodies, *motion, approach);
    }
  }
  // The bound is one that some points all but attain.
  EXPECT_EQ(chains.size(), 5U);
  for (const auto& [chain, approach] : chains) {
    EXPECT_GT(approach.asked, 1000);
    EXPECT_GT(approach.most, 0.9) << static_cast<int>(chain);
    EXPECT_LE(approach.most, 1.0 + 1e-6) << static_cast<int>(chain);
  }
}

}  // namespace
}  // namespace swept::simd_test
