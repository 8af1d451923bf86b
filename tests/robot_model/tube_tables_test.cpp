// SPDX-License-Identifier: BSD-3-Clause
// Tubes of arms that nearly touch themselves: what a joint table settles holds in the whole tube.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "swept/robot_model/checker.hpp"
#include "table_robots.hpp"

namespace swept::simd_test {
namespace {

using State = std::vector<double>;

constexpr double kTube = 0.05;  // rad

struct Tally {
  int free = 0, collision = 0, undecided = 0;

  void note(Verdict verdict) {
    ++(verdict == Verdict::Free ? free : verdict == Verdict::Collision ? collision : undecided);
  }
};

/// An arm beside nothing, with a tube and without.
class ArmInTube {
 public:
  ArmInTube(std::shared_ptr<const Robot> robot, const std::string& group, Random& random)
      : plain_(std::move(robot), group, std::make_shared<World>()),
        inTube_(plain_.withTracking({{.rotation = kTube, .translation = 0.0}, {}})),
        plainWorkspace_(plain_),
        workspace_(inTube_),
        random_(random) {}

  /// A state, and a short motion that begins there.
  void tryToRefute(Tally& states, Tally& motions) {
    const State q = nearContact();
    const Verdict verdict = inTube_.checkState(q, workspace_);
    states.note(verdict);
    if (verdict == Verdict::Free) refute(q, 60);
    const State to = towards(q, drawn(), random_.uniform(0.0, 0.3));
    const MotionCertificate motion =
        inTube_.certifyMotion(q, to, workspace_, MotionQuery::VerdictOnly);
    motions.note(motion.verdict);
    if (motion.verdict != Verdict::Free) return;
    for (const double t : {0.0, 0.2, 0.5, 0.7, 1.0}) refute(between(q, to, t), 12);
  }

 private:
  bool collides(const State& q) {
    return plain_.checkState(q, plainWorkspace_) == Verdict::Collision;
  }

  /// As far from the limits as the tube is wide.
  State drawn() {
    State q;
    for (const int index : plain_.group().variables) {
      const Variable& own = plain_.robot().variables()[static_cast<std::size_t>(index)];
      q.push_back(own.cyclic ? random_.uniform(-3.0, 3.0)
                             : random_.uniform(own.lower + kTube, own.upper - kTube));
    }
    return q;
  }

  static State between(const State& from, const State& to, double t) {
    State q = from;
    for (std::size_t i = 0; i < q.size(); ++i) q[i] += t * (to[i] - from[i]);
    return q;
  }

  /// `step`: rad, of the joint that moves most.
  static State towards(const State& from, const State& to, double step) {
    double most = step;
    for (std::size_t i = 0; i < from.size(); ++i) most = std::max(most, std::abs(to[i] - from[i]));
    return between(from, to, step / most);
  }

  /// Up to ten times the tube's width away from where the arm begins to touch itself.
  State nearContact() {
    State in = drawn();
    while (!collides(in)) in = drawn();
    State out = drawn();
    while (collides(out)) out = drawn();
    const State away = out;
    for (int halving = 0; halving < 12; ++halving) {
      const State middle = between(in, out, 0.5);
      (collides(middle) ? in : out) = middle;
    }
    return towards(out, away, random_.uniform(0.0, 10.0 * kTube));
  }

  /// By corners of the tube.
  void refute(const State& q, int tries) {
    for (int k = 0; k < tries; ++k) {
      State corner = q;
      for (double& value : corner) value += random_.chance(0.5) ? kTube : -kTube;
      ASSERT_FALSE(collides(corner)) << plain_.robot().name();
    }
  }

  Checker plain_, inTube_;
  Workspace plainWorkspace_, workspace_;
  Random& random_;
};

TEST(TubeTables, HoldForAllValuesOfTheTube) {
  Random random(46);
  Tally states, motions;
  for (int robot = 0; robot < 8 && !HasFailure(); ++robot) {
    // Tables settle most of what these have: bodies with one or two joints between them.
    ArmInTube arm(robot < 6 ? Robot::parse(randomWrist(random), "wrist.urdf")
                            : Robot::parse(randomCrab(random), "crab.urdf"),
                  "all", random);
    for (int i = 0; i < 200; ++i) arm.tryToRefute(states, motions);
  }
  EXPECT_GT(states.free, 300);
  EXPECT_GT(states.collision, 300);
  EXPECT_GT(motions.free, 200);
  EXPECT_GT(motions.collision, 300);
  // Contacts are sought at corners of the tube alone.
  EXPECT_LT(states.undecided, 450);
  EXPECT_LT(motions.undecided, 450);
}

}  // namespace
}  // namespace swept::simd_test
