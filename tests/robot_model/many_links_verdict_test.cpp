// SPDX-License-Identifier: BSD-3-Clause
// Verdicts about a chain and a hand that are long enough for all that is done otherwise with many
// links, against the distances of all balls, one by one.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "long_robots.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

constexpr double kRadius = 0.02;

/// Forward kinematics of robots of long_robots.hpp, whose links are balls.
class Balls {
 public:
  explicit Balls(const Robot& robot) : robot_(robot) {
    connected_.assign(robot.links().size(), -1);
    for (const Joint& joint : robot.joints())
      if (joint.parentLink >= 0) connected_[joint.childLink] = joint.parentLink;
  }

  /// m, least distance of two balls that no joint connects; negative where they overlap.
  double clearance(const std::vector<double>& q) const {
    std::vector<Eigen::Isometry3d> poses(robot_.links().size(), Eigen::Isometry3d::Identity());
    for (const Joint& joint : robot_.joints()) {
      if (joint.parentLink < 0) continue;
      poses[joint.childLink] = poses[joint.parentLink] * joint.parent_from_joint *
                               Eigen::AngleAxisd(q[joint.firstVariable], joint.axis);
    }
    std::vector<Eigen::Vector3d> centers;
    for (const Eigen::Isometry3d& pose : poses)
      centers.push_back(pose * Eigen::Vector3d(0, 0, 0.05));
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t a = 1; a < centers.size(); ++a)
      for (std::size_t b = a + 1; b < centers.size(); ++b)
        if (connected_[b] != static_cast<int>(a))
          least = std::min(least, (centers[a] - centers[b]).norm() - 2.0 * kRadius);
    return least;
  }

 private:
  const Robot& robot_;
  std::vector<int> connected_;  ///< per link: its parent
};

struct Seen {
  int free = 0;
  int collision = 0;
  int undecided = 0;
};

std::vector<double> randomState(const Checker& checker, std::mt19937& random, double turn) {
  std::vector<double> q(static_cast<std::size_t>(checker.dimension()));
  for (double& value : q) value = std::uniform_real_distribution<double>(-turn, turn)(random);
  return q;
}

/// Joints' angles of which about half the states of such a robot are in contact.
void checkVerdicts(const std::shared_ptr<const Robot>& robot, double turn, double way) {
  const Checker checker(robot, "all", std::make_shared<World>());
  const Balls balls(*robot);
  Workspace workspace(checker);
  std::mt19937 random(9);
  Seen states, motions;
  for (int i = 0; i < 60; ++i) {
    const std::vector<double> from = randomState(
        checker, random, turn * std::uniform_real_distribution<double>(0.3, 1.5)(random));
    const double clearance = balls.clearance(from);
    const Verdict verdict = checker.checkState(from, workspace);
    if (verdict == Verdict::Undecided) {
      ++states.undecided;
    } else {
      ASSERT_EQ(verdict == Verdict::Free, clearance > 0.0) << clearance;
      ++(verdict == Verdict::Free ? states.free : states.collision);
    }
    std::vector<double> to = from;
    for (double& value : to) value += std::uniform_real_distribution<double>(-way, way)(random);
    const MotionCertificate motion = checker.certifyMotion(from, to, workspace);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k <= 50; ++k) {
      const Eigen::VectorXd q = checker.interpolate(from, to, k / 50.0);
      least = std::min(least, balls.clearance({q.begin(), q.end()}));
    }
    if (motion.verdict == Verdict::Free) {
      ++motions.free;
      ASSERT_GT(least, 0.0);
    } else if (motion.verdict == Verdict::Collision) {
      ++motions.collision;
      ASSERT_TRUE(motion.witness);
      const Eigen::VectorXd q = checker.interpolate(from, to, motion.witness->t);
      ASSERT_LE(balls.clearance({q.begin(), q.end()}), 1e-6);
    } else {
      ++motions.undecided;
    }
  }
  EXPECT_GT(states.free, 10);
  EXPECT_GT(states.collision, 10);
  EXPECT_LT(states.undecided, 3);
  EXPECT_GT(motions.free, 10);
  EXPECT_GT(motions.collision, 10);
  EXPECT_LT(motions.undecided, 6);
}

TEST(ManyLinksVerdicts, OfALongChainAreThoseOfItsBalls) {
  checkVerdicts(test::ballChain(180, 3.0, kRadius), 1.5, 0.01);
}

TEST(ManyLinksVerdicts, OfAHandOfLongFingersAreThoseOfItsBalls) {
  checkVerdicts(test::handOf(5, 140, 3.0), 0.15, 0.01);
}

}  // namespace
}  // namespace swept
