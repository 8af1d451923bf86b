// SPDX-License-Identifier: BSD-3-Clause
// The witness of a first contact is the first contact. Random motions of whole robots are gone
// through in many small steps, each step with a state check of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "model_robots.hpp"
#include "swept/robot_model/checker.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using BodyNames = std::pair<std::string, std::string>;

std::set<BodyNames> contactsOf(const StateReport& report) {
  std::set<BodyNames> pairs;
  for (const Witness& contact : report.contacts) pairs.emplace(contact.bodyA, contact.bodyB);
  return pairs;
}

struct Tally {
  int first = 0;    ///< contacts that do not begin with the motion
  int several = 0;  ///< of these: several pairs are in contact somewhere on the motion
  int passing = 0;  ///< of these: another pair ends the proof before, without a contact
};

struct Scene {
  const char* robot;
  const char* group;
  const char* world;
  /// m. The base of a robot that drives or floats goes so far from the origin.
  double room;
};

class FirstContactWitness : public testing::TestWithParam<Scene> {
 protected:
  static constexpr int kSteps = 1000;
  /// Of t. What halving leaves where points move 0.3 m or more during the motion.
  static constexpr double kHalving = 2e-4;

  FirstContactWitness()
      : robot_(test::modelRobot(GetParam().robot)),
        world_(std::make_shared<const World>(
            World::load(modelsDir() + "/scenes/" + GetParam().world))),
        checker_(robot_, GetParam().group, world_),
        near_(robot_, GetParam().group, world_, {.margin = checker_.options().tolerance}),
        workspace_(checker_),
        nearWorkspace_(near_) {}

  std::vector<double> randomState(std::mt19937& random) const {
    std::vector<double> q;
    for (const int v : checker_.group().variables) {
      const Variable& variable = robot_->variables()[static_cast<std::size_t>(v)];
      const double most = variable.cyclic ? 3.1 : GetParam().room;
      const double low = std::max(variable.cyclic ? -most : variable.lower, -most);
      const double high = std::min(variable.cyclic ? most : variable.upper, most);
      q.push_back(std::uniform_real_distribution<double>(low, high)(random));
    }
    return q;
  }

  StateReport reportAt(const std::vector<double>& from, const std::vector<double>& to, double t) {
    const Eigen::VectorXd q = checker_.interpolate(from, to, t);
    return checker_.reportState(q, workspace_);
  }

  bool collidesAt(const std::vector<double>& from, const std::vector<double>& to, double t) {
    const Eigen::VectorXd q = checker_.interpolate(from, to, t);
    return checker_.checkState(q, workspace_) == Verdict::Collision;
  }

  /// Pairs within the tolerance.
  std::set<BodyNames> nearAt(const std::vector<double>& from, const std::vector<double>& to,
                             double t) {
    const Eigen::VectorXd q = checker_.interpolate(from, to, t);
    return contactsOf(near_.reportState(q, nearWorkspace_));
  }

  void ask(const std::vector<double>& from, const std::vector<double>& to, Tally& tally) {
    const MotionCertificate found = checker_.certifyMotion(from, to, workspace_);
    if (found.verdict != Verdict::Collision) return;
    ASSERT_TRUE(found.witness);
    const Witness& witness = *found.witness;
    ASSERT_LE(found.freeUntil, witness.t);
    const StateReport there = reportAt(from, to, witness.t);
    const BodyNames pair(witness.bodyA, witness.bodyB);
    ASSERT_TRUE(contactsOf(there).contains(pair)) << pair.first << " - " << pair.second;
    ASSERT_LE(witness.distance, 0.0 + 1e-9);
    for (int i = 0; i < kSteps; ++i) {
      const double t = i / double{kSteps};
      if (t < witness.t - kHalving) {
        ASSERT_FALSE(collidesAt(from, to, t)) << t << " is before " << witness.t;
      }
    }
    for (double t = witness.t - 1.0 / kSteps; t < witness.t - kHalving; t += 1e-4)
      if (t >= 0.0) {
        ASSERT_FALSE(collidesAt(from, to, t)) << t << " is before " << witness.t;
      }
    if (collidesAt(from, to, 0.0)) {
      ASSERT_EQ(witness.t, 0.0);
    }
    if (witness.t == 0.0) return;
    ++tally.first;
    std::set<BodyNames> all;
    for (double t = witness.t; t <= 1.0; t += 0.02) all.merge(contactsOf(reportAt(from, to, t)));
    tally.several += all.size() > 1;
    // What ends the proof is near, and it is the pair that meets but for pairs that pass.
    const std::set<BodyNames> near = nearAt(from, to, found.freeUntil);
    ASSERT_FALSE(near.empty());
    tally.passing += !near.contains(pair);
  }

  std::shared_ptr<const Robot> robot_;
  std::shared_ptr<const World> world_;
  Checker checker_;
  Checker near_;  ///< with the tolerance as margin
  Workspace workspace_, nearWorkspace_;
};

TEST_P(FirstContactWitness, IsTheFirstContact) {
  std::mt19937 random(77);
  Tally tally;
  for (int i = 0; i < 150; ++i) {
    ask(randomState(random), randomState(random), tally);
    if (HasFatalFailure()) return;
  }
  RecordProperty("first", tally.first);
  RecordProperty("several", tally.several);
  RecordProperty("passing", tally.passing);
  EXPECT_GE(tally.first, 15);
  EXPECT_GE(tally.several, 10);
  EXPECT_LE(tally.passing, tally.first / 20);
}

INSTANTIATE_TEST_SUITE_P(Robots, FirstContactWitness,
                         testing::Values(Scene{"rook7", "arm", "cage.yaml", 4.0},
                                         Scene{"rook7", "arm", "shelf.yaml", 4.0},
                                         Scene{"rook6", "arm", "tunnel_trap.yaml", 4.0},
                                         Scene{"rook6_cart", "whole_body", "narrow_slot.yaml",
                                               1.0}),
                         [](const testing::TestParamInfo<Scene>& which) {
                           const std::string world = which.param.world;
                           return std::string(which.param.robot) + "_" +
                                  world.substr(0, world.find('.'));
                         });

/// Two balls on one slide, and posts beside it: the first one is passed within the tolerance, the
/// second one is met.
constexpr const char* kSlide = R"(<robot name='slide'>
  <link name='base'/>
  <link name='front'><collision><geometry><sphere radius='0.05'/></geometry></collision></link>
  <link name='back'><collision><origin xyz='-0.3 0 0'/>
    <geometry><sphere radius='0.05'/></geometry></collision></link>
  <joint name='x' type='prismatic'><parent link='base'/><child link='front'/>
    <axis xyz='1 0 0'/><limit lower='-2' upper='2' effort='1' velocity='1'/></joint>
  <joint name='fixed' type='fixed'><parent link='front'/><child link='back'/></joint>
</robot>)";

TEST(FirstContactPastAnother, IsOfThePairThatMeets) {
  // The front ball passes `gap` from the first post at x = 0, and meets the second at x = 0.4.
  for (const double gap : {1e-4, 3e-4, 6e-4, 9e-4}) {
    World world;
    world.add("passed", makeSphere(0.05), Eigen::Isometry3d(Eigen::Translation3d(0, 0.1 + gap, 0)));
    world.add("met", makeSphere(0.05), Eigen::Isometry3d(Eigen::Translation3d(0.5, 0, 0)));
    const Checker checker(Robot::parse(kSlide, "slide.urdf"), "all",
                          std::make_shared<const World>(std::move(world)));
    Workspace workspace(checker);
    const MotionCertificate found =
        checker.certifyMotion(std::vector{-1.0}, std::vector{1.0}, workspace);
    ASSERT_EQ(found.verdict, Verdict::Collision);
    EXPECT_EQ(found.witness->bodyA, "front") << gap;
    EXPECT_EQ(found.witness->bodyB, "met") << gap;
    EXPECT_NEAR(found.witness->t, 0.7, 1e-4) << gap;
    EXPECT_GE(found.witness->t, 0.7 - 1e-12) << gap;
    // A passing pair that keeps more than a sixteenth of the tolerance does not end the proof.
    EXPECT_NEAR(found.freeUntil, 0.7, 1e-4) << gap;
    EXPECT_LE(found.freeUntil, 0.7 + 1e-12) << gap;
  }
}

TEST(FirstContactPastAnother, IsFoundBehindWhatEndsTheProof) {
  World world;
  world.add("passed", makeSphere(0.05), Eigen::Isometry3d(Eigen::Translation3d(0, 0.1 + 1e-14, 0)));
  world.add("met", makeSphere(0.05), Eigen::Isometry3d(Eigen::Translation3d(0.5, 0, 0)));
  const Checker checker(Robot::parse(kSlide, "slide.urdf"), "all",
                        std::make_shared<const World>(std::move(world)));
  Workspace workspace(checker);
  const MotionCertificate found =
      checker.certifyMotion(std::vector{-1.0}, std::vector{1.0}, workspace);
  ASSERT_EQ(found.verdict, Verdict::Collision);
  EXPECT_LE(found.freeUntil, 0.5);
  EXPECT_GE(found.freeUntil, 0.49);
  EXPECT_EQ(found.witness->bodyB, "met");
  EXPECT_NEAR(found.witness->t, 0.7, 1e-4);
}

}  // namespace
}  // namespace swept
