// SPDX-License-Identifier: BSD-3-Clause
// A curve of degree 1 is the motions between its knots, and a tube of no width is none: both give
// the same answers to the last bit.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "../core/split_mix.hpp"
#include "model_robots.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {
namespace {

using test::SplitMix;

struct Case {
  const char* robot;
  const char* group;
  const char* scene;
  double margin = 0.0;   ///< m
  bool passing = false;  ///< beside a box that passes by
};

constexpr std::array<Case, 7> kCases{{
    {"rook7", "arm_with_gripper", "shelf"},
    {"rook7", "arm", "tunnel_trap", 0.01},
    {"rook6", "arm_with_tool", "bin"},
    {"rook6_cart", "whole_body", "cage"},
    {"drifter", "body", "table_objects"},
    {"rook7", "arm", "table_objects", 0.0, true},
    {"rook6_cart", "base", "shelf", 0.0, true},
}};
constexpr int kMotions = 21'000;

std::shared_ptr<const World> worldOf(const Case& which) {
  auto world =
      std::make_shared<World>(World::load(modelsDir() + "/scenes/" + which.scene + ".yaml"));
  if (!which.passing) return world;
  MovingObstacle box{.name = "passing",
                     .parts = {{makeBox({0.2, 0.2, 0.2}), Eigen::Isometry3d::Identity()}}};
  for (const double time : {0.0, 0.4, 1.0, 2.5})
    box.waypoints.push_back(
        {time, Eigen::Isometry3d(Eigen::Translation3d(0.6, 0.5 * time - 0.6, 0.4 + 0.1 * time))});
  world->add(box);
  return world;
}

/// A walk of configurations; no joint turns by half a turn at once.
std::vector<std::vector<double>> walk(const Checker& checker, std::size_t states,
                                      SplitMix& random) {
  const Robot& robot = checker.robot();
  const double step = random.decades(-2.0, 0.3);
  std::vector<std::vector<double>> all;
  for (std::size_t i = 0; i < states; ++i) {
    std::vector<double> q;
    for (std::size_t k = 0; k < checker.group().variables.size(); ++k) {
      const Variable& variable =
          robot.variables()[static_cast<std::size_t>(checker.group().variables[k])];
      const double low = std::max(variable.lower, -2.0);
      const double high = std::min(variable.upper, 2.0);
      const double before = i == 0 ? random.uniform(low, high) : all.back()[k];
      q.push_back(i == 0 ? before
                         : std::clamp(before + step * random.uniform(-1.0, 1.0), low, high));
    }
    all.push_back(q);
  }
  return all;
}

PiecewisePolynomial curveThrough(const std::vector<std::vector<double>>& states, SplitMix& random) {
  std::vector<double> knots{random.uniform(-1.0, 1.0)};
  std::vector<Eigen::MatrixXd> pieces;
  for (std::size_t i = 1; i < states.size(); ++i) {
    knots.push_back(knots.back() + random.decades(-3.0, 1.0));
    const auto size = static_cast<Eigen::Index>(states[i].size());
    Eigen::MatrixXd piece(size, 2);
    piece.col(0) = Eigen::Map<const Eigen::VectorXd>(states[i - 1].data(), size);
    piece.col(1) = Eigen::Map<const Eigen::VectorXd>(states[i].data(), size);
    pieces.push_back(piece);
  }
  return {knots, pieces};
}

void expectSame(const Effort& a, const Effort& b) {
  EXPECT_EQ(a.intervals, b.intervals);
  EXPECT_EQ(a.distances, b.distances);
  EXPECT_EQ(a.culled, b.culled);
  EXPECT_EQ(a.lanes, b.lanes);
}

/// All but the time.
void expectSame(const Witness& a, const Witness& b) {
  EXPECT_EQ(a.bodyA, b.bodyA);
  EXPECT_EQ(a.bodyB, b.bodyB);
  EXPECT_EQ(a.selfPair, b.selfPair);
  EXPECT_EQ(a.pointA, b.pointA);
  EXPECT_EQ(a.pointB, b.pointB);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.margin, b.margin);
  EXPECT_TRUE(a.configuration.empty() && b.configuration.empty());
}

void expectSame(const MotionCertificate& a, const MotionCertificate& b) {
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_EQ(a.freeUntil, b.freeUntil);
  EXPECT_EQ(a.undecidedAt, b.undecidedAt);
  expectSame(a.effort, b.effort);
  ASSERT_EQ(a.witness.has_value(), b.witness.has_value());
  if (!a.witness) return;
  EXPECT_EQ(a.witness->t, b.witness->t);
  expectSame(*a.witness, *b.witness);
}

/// What a curve should say that consists of these motions.
class Expected {
 public:
  Expected(const PiecewisePolynomial& curve, MotionQuery query)
      : curve_(curve), query_(query), freeUntil_(curve.begin()) {}

  void add(std::size_t piece, const MotionCertificate& own) {
    effort_.intervals += own.effort.intervals;
    effort_.distances += own.effort.distances;
    effort_.culled += own.effort.culled;
    effort_.lanes += own.effort.lanes;
    if (verdict_ == Verdict::Free) freeUntil_ = timeOf(piece, own.freeUntil);
    if (own.verdict == Verdict::Undecided && verdict_ == Verdict::Free) {
      verdict_ = own.verdict;
      undecided_ = timeOf(piece, own.undecidedAt);
    }
    if (own.verdict != Verdict::Collision) return;
    verdict_ = own.verdict;
    witness_ = own.witness;
    contact_ = timeOf(piece, own.witness->t);
  }

  Verdict verdict() const { return verdict_; }

  void compare(const TrajectoryCertificate& found) const {
    EXPECT_EQ(found.verdict, verdict_);
    const bool asked = query_ == MotionQuery::FirstContact || verdict_ == Verdict::Free;
    EXPECT_EQ(found.freeUntil, asked ? freeUntil_ : curve_.begin());
    expectSame(found.effort, effort_);
    ASSERT_EQ(found.contact.has_value(), verdict_ == Verdict::Collision);
    ASSERT_EQ(found.undecided.has_value(), verdict_ == Verdict::Undecided);
    if (found.undecided) {
      EXPECT_EQ(found.undecided->time, undecided_);
    }
    if (!found.contact) return;
    EXPECT_EQ(found.contact->time, contact_);
    EXPECT_EQ(found.contact->witness.t, (contact_ - curve_.begin()) / curve_.duration());
    expectSame(found.contact->witness, *witness_);
  }

 private:
  double timeOf(std::size_t piece, double t) const {
    const double begin = curve_.knots()[piece];
    const double end = curve_.knots()[piece + 1];
    return t >= 1.0 ? end : begin + t * (end - begin);
  }

  const PiecewisePolynomial& curve_;
  const MotionQuery query_;
  Verdict verdict_ = Verdict::Free;
  double freeUntil_;
  double undecided_ = 0.0, contact_ = 0.0;
  std::optional<Witness> witness_;
  Effort effort_;
};

/// A tube of no width, in every way that it can be said.
TrackingTolerance noTube(const Robot& robot, const Group& group) {
  TrackingTolerance tracking;
  for (const int joint : group.joints)
    tracking.joints[robot.joints()[static_cast<std::size_t>(joint)].name] = {};
  tracking.joints.begin()->second.rotation = -0.0;
  return tracking;
}

struct Tally {
  int motions = 0, free = 0, collision = 0, curves = 0, later = 0;
};

class Comparison {
 public:
  explicit Comparison(const Case& which)
      : robot_(test::modelRobot(which.robot)),
        world_(worldOf(which)),
        plain_(robot_, which.group, world_, {.margin = which.margin}),
        inTube_(
            robot_, which.group, world_,
            {.margin = which.margin, .tracking = noTube(*robot_, *robot_->findGroup(which.group))}),
        workspace_(plain_),
        other_(inTube_),
        timed_(which.passing) {}

  void look(SplitMix& random, Tally& tally) {
    const auto states = walk(plain_, 2 + static_cast<std::size_t>(random.below(5)), random);
    const PiecewisePolynomial curve = curveThrough(states, random);
    const MotionQuery query =
        random.chance(0.5) ? MotionQuery::FirstContact : MotionQuery::VerdictOnly;
    const double clock = random.uniform(-0.5, 1.0);
    Expected expected(curve, query);
    for (std::size_t piece = 0; piece < curve.pieces(); ++piece) {
      std::vector<double> from = states[piece];
      std::vector<double> to = states[piece + 1];
      if (timed_) from.push_back(clock + curve.knots()[piece]);
      if (timed_) to.push_back(clock + curve.knots()[piece + 1]);
      const MotionCertificate own = plain_.certifyMotion(from, to, workspace_, query);
      expectSame(own, inTube_.certifyMotion(from, to, other_, query));
      EXPECT_EQ(plain_.checkState(from, workspace_), inTube_.checkState(from, other_));
      ++tally.motions;
      tally.free += own.verdict == Verdict::Free ? 1 : 0;
      tally.collision += own.verdict == Verdict::Collision ? 1 : 0;
      expected.add(piece, own);
      if (own.verdict != Verdict::Collision) continue;
      tally.later += piece > 0 ? 1 : 0;
      break;
    }
    ++tally.curves;
    const TrajectoryQuery asked{.contact = query, .clock = clock};
    expected.compare(plain_.certifyTrajectory(curve, workspace_, asked));
    expected.compare(inTube_.certifyTrajectory(curve, other_, asked));
  }

 private:
  const std::shared_ptr<const Robot> robot_;
  const std::shared_ptr<const World> world_;
  const Checker plain_, inTube_;
  Workspace workspace_, other_;
  const bool timed_;
};

TEST(StraightCurves, AreTheMotionsBetweenTheirKnots) {
  SplitMix random(81);
  Tally tally;
  for (const Case& which : kCases) {
    SCOPED_TRACE(std::string(which.robot) + " " + which.group);
    Comparison comparison(which);
    const int end = tally.motions + kMotions / static_cast<int>(kCases.size());
    while (tally.motions < end && !HasFailure()) comparison.look(random, tally);
  }
  EXPECT_GE(tally.motions, 20'000);
  EXPECT_GT(4 * tally.free, tally.motions);
  EXPECT_GT(10 * tally.collision, tally.motions);
  EXPECT_GT(25 * tally.later, tally.curves);
}

}  // namespace
}  // namespace swept
