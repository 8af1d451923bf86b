// SPDX-License-Identifier: BSD-3-Clause
// The checker's motions are the oracle's motions: the same states at every t, the same places of
// the links, whatever joints a model has.
#include <gtest/gtest.h>

#include <random>

#include "models_under_test.hpp"
#include "random_motions.hpp"

namespace {

class Kinematics : public testing::TestWithParam<Model> {
 protected:
  static Scenario scenario() { return clutterScenario(filesOf(GetParam()), 3); }
};

/// Largest distance, over the links, between where two states put three points of each.
double apart(const oracle::Arm& arm, const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<Eigen::Isometry3d> p, q;
  arm.poses(a, p);
  arm.poses(b, q);
  double most = 0;
  for (size_t i = 0; i < p.size(); ++i)
    for (int k = 0; k < 3; ++k)
      most = std::max(most,
                      (p[i] * Eigen::Vector3d::Unit(k) - q[i] * Eigen::Vector3d::Unit(k)).norm());
  return most;
}

TEST_P(Kinematics, MotionsPassThroughTheSameStates) {
  const Scenario s = scenario();
  RandomMotions motions(s, 5, 1.0);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 300; ++i) {
    const auto [from, to] = motions.next();
    const double t = i % 10 == 0 ? i % 20 / 10.0 : unit(random);
    const auto a = s.groupOf(from), b = s.groupOf(to);
    const Eigen::VectorXd q = s.checker->interpolate(a, b, t);
    const auto theirs = s.full({q.data(), q.data() + q.size()});
    EXPECT_LT(apart(s.oracle->arm(), theirs, s.oracle->arm().between(from, to, t)), 1e-10);
  }
}

TEST_P(Kinematics, ContactsLieOnTheLinksTheyName) {
  const Scenario s = scenario();
  RandomMotions motions(s, 6, 1.0);
  swept::Workspace workspace(*s.checker);
  int contacts = 0;
  for (int i = 0; i < 300; ++i) {
    const auto motion = motions.next();
    for (const auto& q : {motion.first, motion.second}) {
      const swept::StateReport report = s.checker->reportState(s.groupOf(q), workspace);
      for (const swept::Witness& w : report.contacts) {
        EXPECT_LT(s.oracle->distanceTo(w.bodyA, q, w.pointA), 1e-6) << w.bodyA;
        EXPECT_LT(s.oracle->distanceTo(w.bodyB, q, w.pointB), 1e-6) << w.bodyB;
        ++contacts;
      }
    }
  }
  EXPECT_GT(contacts, 50);
}

/// The bound is proven, so it may not exceed what the oracle attains; and it is no empty promise.
TEST_P(Kinematics, ClearancesAgree) {
  const Scenario s = scenario();
  RandomMotions motions(s, 8, 1.0);
  swept::Workspace workspace(*s.checker);
  int close = 0, hits = 0;
  for (int i = 0; i < 400; ++i) {
    const auto q = motions.next().second;
    const oracle::Gap gap = s.oracle->clearance(q, 0.5);
    const swept::StateReport report = s.checker->reportState(s.groupOf(q), workspace);
    EXPECT_LE(report.clearance < 0.5 ? report.clearance : 0.5, gap.upper + 1e-9);
    EXPECT_GE(report.clearance, std::min(gap.lower, 0.5) - 1e-6);
    if (report.verdict == swept::Verdict::Free) {
      EXPECT_FALSE(s.oracle->hit(q));
    }
    if (report.verdict == swept::Verdict::Collision) {
      EXPECT_LT(gap.lower, 1e-6);
    }
    hits += report.verdict == swept::Verdict::Collision;
    close += gap.lower > 0 && gap.upper < 0.01;
  }
  EXPECT_GT(close, 20);
  EXPECT_GT(hits, 20);
  EXPECT_LT(hits, 380);
}

INSTANTIATE_TEST_SUITE_P(Models, Kinematics, modelsUnderTest(), modelName);

}  // namespace
