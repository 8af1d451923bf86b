// SPDX-License-Identifier: BSD-3-Clause
// States and straight motions in a tube: all queries agree, and no configuration of the tube
// refutes them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>
#include <string>
#include <vector>

#include "trajectories/errors.hpp"
#include "trajectories/pivot.hpp"
#include "trajectories/stage.hpp"

namespace {

using namespace trajectories;
using swept::MotionCertificate;
using swept::MotionQuery;
using swept::StateReport;
using swept::Verdict;
using State = std::vector<double>;

struct Tally {
  int all = 0, free = 0, collision = 0, undecided = 0, beside = 0, prefixes = 0;

  void note(Verdict verdict) {
    ++all;
    free += verdict == Verdict::Free ? 1 : 0;
    collision += verdict == Verdict::Collision ? 1 : 0;
    undecided += verdict == Verdict::Undecided ? 1 : 0;
  }
};

/// One stage, with what both of its checkers work in.
class Tubes {
 public:
  Tubes(std::uint64_t index, Random& random)
      : stage_(makeStage(2, index)),
        random_(random),
        workspace_(stage_.checker),
        plain_(stage_.plain) {}

  void lookAtStates(Tally& tally) {
    constexpr std::size_t kStates = 43;
    std::vector<State> states;
    State packed;
    for (std::size_t i = 0; i < kStates; ++i) {
      states.push_back(some());
      packed.insert(packed.end(), states.back().begin(), states.back().end());
    }
    std::vector<Verdict> together(kStates);
    stage_.checker.checkStates(packed, together, workspace_);
    for (std::size_t i = 0; i < kStates; ++i) {
      const Verdict verdict = stage_.checker.checkState(states[i], workspace_);
      tally.note(verdict);
      EXPECT_EQ(together[i], verdict) << stage_.scene;
      const StateReport report = stage_.checker.reportState(states[i], workspace_);
      EXPECT_EQ(report.verdict, verdict) << stage_.scene;
      if (verdict == Verdict::Free) refute(states[i], 60, true);
      for (const swept::Witness& contact : report.contacts) {
        judge(contact, states[i]);
        tally.beside += contact.configuration.empty() ? 0 : 1;
      }
      for (const MotionQuery query : {MotionQuery::FirstContact, MotionQuery::VerdictOnly}) {
        const MotionCertificate still =
            stage_.checker.certifyMotion(states[i], states[i], workspace_, query);
        // A motion has a tolerance, which a state has not.
        EXPECT_TRUE(still.verdict == verdict || still.verdict == Verdict::Undecided)
            << stage_.scene;
      }
    }
  }

  void lookAtMotions(Tally& tally) {
    constexpr std::size_t kMotions = 14;
    std::vector<State> from, to;
    State allFrom, allTo;
    for (std::size_t i = 0; i < kMotions; ++i) {
      from.push_back(some());
      to.push_back(towards(from.back(), some()));
      allFrom.insert(allFrom.end(), from.back().begin(), from.back().end());
      allTo.insert(allTo.end(), to.back().begin(), to.back().end());
    }
    std::vector<MotionCertificate> together(kMotions);
    stage_.checker.certifyMotions(allFrom, allTo, together, MotionQuery::FirstContact, 1);
    for (std::size_t i = 0; i < kMotions; ++i) {
      const MotionCertificate found =
          stage_.checker.certifyMotion(from[i], to[i], workspace_, MotionQuery::FirstContact);
      const MotionCertificate brief =
          stage_.checker.certifyMotion(from[i], to[i], workspace_, MotionQuery::VerdictOnly);
      tally.note(found.verdict);
      EXPECT_EQ(together[i].verdict, found.verdict);
      EXPECT_EQ(together[i].freeUntil, found.freeUntil);
      EXPECT_EQ(brief.verdict, found.verdict) << stage_.scene;
      tally.prefixes += found.verdict != Verdict::Free && found.freeUntil > 0.0 ? 1 : 0;
      for (int k = 0; k < 40 && found.freeUntil > 0.0; ++k) {
        const double t = found.freeUntil * random_.uniform(0.0, 1.0);
        refute(between(from[i], to[i], t), 4, k % 8 == 0);
      }
      for (const MotionCertificate& one : {found, brief}) {
        if (!one.witness) continue;
        judge(*one.witness, between(from[i], to[i], one.witness->t));
        tally.beside += one.witness->configuration.empty() ? 0 : 1;
      }
    }
  }

 private:
  State some() {
    State q = makePivot(stage_, workspace_, plain_, random_);
    // Motions take the shorter way.
    for (std::size_t i = 0; i < q.size(); ++i)
      if (stage_.variables[i].cyclic) q[i] = std::remainder(q[i], 2.0 * std::numbers::pi);
    if (random_.chance(0.6)) moveOn(q);
    if (stage_.timed) q.push_back(random_.uniform(0.0, 3.0));
    return q;
  }

  /// Into what the configuration is near, perhaps.
  void moveOn(State& q) {
    const double step = random_.decades(-2.0, 0.0);
    for (std::size_t i = 0; i < q.size(); ++i) {
      const StageVariable& variable = stage_.variables[i];
      if (!variable.orientation)
        q[i] = std::clamp(q[i] + step * random_.uniform(-1.0, 1.0), variable.lower, variable.upper);
    }
  }

  State towards(const State& from, const State& target) {
    return between(from, target, random_.decades(-2.0, 0.0));
  }

  State between(const State& from, const State& to, double t) const {
    const Eigen::VectorXd q = stage_.checker.interpolate(from, to, t);
    return {q.begin(), q.end()};
  }

  /// By corners of the tube and configurations inside of it. `steepest`: also by the corners at
  /// which the nearest pair is nearest.
  void refute(const State& q, int tries, bool steepest) {
    for (int k = 0; k < tries; ++k) {
      State beside = q;
      displace(stage_, kErrors[static_cast<std::size_t>(k) % kErrors.size()], random_, beside);
      ASSERT_NE(stage_.plain.checkState(beside, plain_), Verdict::Collision) << stage_.scene;
    }
    State gradient(q.size());
    State beside = q;
    for (int k = 0; k < 2 && steepest; ++k) {
      stage_.plain.signedClearance(beside, plain_, gradient);
      beside = q;
      displaceAgainst(stage_, gradient, random_, beside);
      ASSERT_NE(stage_.plain.checkState(beside, plain_), Verdict::Collision) << stage_.scene;
    }
  }

  /// A contact is of a configuration of the tube, and is one.
  void judge(const swept::Witness& contact, const State& around) {
    const State& q = contact.configuration.empty() ? around : contact.configuration;
    EXPECT_LE(beyondTube(stage_, q, around), 1e-9) << stage_.scene;
    EXPECT_NE(stage_.plain.checkState(q, plain_), Verdict::Free) << stage_.scene;
    EXPECT_LE(contact.distance, contact.margin + 1e-9);
  }

  const Stage stage_;
  Random& random_;
  swept::Workspace workspace_, plain_;
};

void print(const char* what, const Tally& tally) {
  std::cout << tally.all << ' ' << what << ": " << tally.free << " free, " << tally.collision
            << " collision, " << tally.undecided << " undecided; " << tally.beside
            << " contacts that only the tube has; " << tally.prefixes << " prefixes" << std::endl;
}

TEST(Tube, EveryQueryAboutAStateAgreesAndIsTrue) {
  Random random(91, 0);
  Tally tally;
  for (std::uint64_t index = 0; index < scenes().size() * kTubes; ++index)
    Tubes(index, random).lookAtStates(tally);
  print("states", tally);
  EXPECT_GT(5 * tally.free, tally.all);
  EXPECT_GT(5 * tally.collision, tally.all);
  EXPECT_LT(20 * tally.undecided, tally.all);
  EXPECT_GT(20 * tally.beside, tally.all);
}

TEST(Tube, EveryQueryAboutAMotionAgreesAndIsTrue) {
  Random random(92, 0);
  Tally tally;
  for (std::uint64_t index = 0; index < scenes().size() * kTubes; ++index)
    Tubes(index, random).lookAtMotions(tally);
  print("motions", tally);
  EXPECT_GT(5 * tally.free, tally.all);
  EXPECT_GT(5 * tally.collision, tally.all);
  EXPECT_LT(20 * tally.undecided, tally.all);
  EXPECT_GT(20 * tally.beside, tally.all);
  EXPECT_GT(20 * tally.prefixes, tally.all);
}

}  // namespace
