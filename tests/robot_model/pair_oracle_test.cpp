// SPDX-License-Identifier: BSD-3-Clause
#include "certify/pair_oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "kinematics/chord_path.hpp"
#include "simd/kernels/simd_motion.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

/// A slide of 1 m, with balls in its way at 0.2, 0.5 and 0.8 m.
std::shared_ptr<const detail::CheckerModel> slideBetweenBalls(const CheckerOptions& options = {}) {
  const auto robot =
      Robot::parse("<robot name='slide'>" + test::urdfLink("base", {}) +
                       test::urdfLink("tip", {{test::sphere(0.05), {0, 0, 0}}}) +
                       test::urdfJoint("slide", "prismatic", "base", "tip",
                                       "<axis xyz='1 0 0'/><limit lower='0' upper='1' effort='1' "
                                       "velocity='1'/>") +
                       "</robot>",
                   "slide.urdf");
  auto world = std::make_shared<World>();
  for (const double x : {0.2, 0.5, 0.8}) {
    world->add("ball at " + std::to_string(x), Sphere{0.03}, test::at(x, 0, 0));
  }
  return detail::compileChecker(robot, *robot->findGroup("all"), world, options);
}

/// In whatever order they are found.
TEST(PairOracle, KeepsTheEarliestContact) {
  const auto model = slideBetweenBalls();
  ASSERT_EQ(model->pairCount(), 3U);
  const std::vector<double> from{0.0};
  const std::vector<double> to{1.0};
  std::vector<double> times{0.2, 0.5, 0.8};
  do {
    detail::WorkspaceData workspace(*model);
    detail::PairQuery query(*model, workspace);
    detail::ConfirmedContacts contacts(MotionQuery::FirstContact);
    Effort effort;
    const detail::StraightPath path(model->kinematics, from, to);
    detail::PairOracle oracle(*model, path, query, contacts, effort);
    double earliest = 1.0;
    for (const double t : times) {
      int met = 0;
      for (std::uint32_t pair = 0; pair < 3; ++pair) {
        met += oracle.look(pair, t, 0.0).kind == detail::ExactAnswer::Kind::Contact ? 1 : 0;
      }
      EXPECT_EQ(met, 1);
      earliest = std::min(earliest, t);
      ASSERT_TRUE(contacts.any());
      EXPECT_EQ(contacts.horizon(), earliest);
      EXPECT_EQ(contacts.earliest()->bodyB, "ball at " + std::to_string(earliest));
    }
    EXPECT_EQ(effort.intervals, 9);
  } while (std::next_permutation(times.begin(), times.end()));
}

/// Single precision linearizes paths in the same place, and knows no tube there.
TEST(PairQuery, HasTheRangesOfItsTubeAfterSinglePrecision) {
  CheckerOptions options;
  options.tracking.translation = 0.01;
  const auto model = slideBetweenBalls(options);
  detail::WorkspaceData workspace(*model);
  const std::vector<double> from{0.3}, to{0.4};
  const detail::ChordPath path(model->kinematics, from, to, 0.0);
  detail::PairQuery query(*model, workspace);
  ASSERT_TRUE(query.start(path));
  detail::SimdMotion motion(model->simd, model->kinematics, path, workspace.motion, workspace.simd);
  ASSERT_TRUE(motion.compile());
  query.moveTo(0.5, 0.25);
  const auto slide =
      std::ranges::find(model->kinematics.bodies, JointType::Prismatic, &detail::MovingBody::type);
  ASSERT_NE(slide, model->kinematics.bodies.end());
  const detail::JointMotion& joint =
      workspace.motion[static_cast<std::size_t>(slide - model->kinematics.bodies.begin())];
  EXPECT_LE(joint.low, 0.29 + 1e-12);
  EXPECT_GE(joint.high, 0.41 - 1e-12);
}

/// A box of 0.2 m on the base, and a ball of 0.1 m on a link that slides along x.
class ClaimsOfTwoLinks : public testing::Test {
 protected:
  static constexpr double kHalf = 0.1;    // m, of the box
  static constexpr double kRadius = 0.1;  // m

  ClaimsOfTwoLinks() {
    const std::string limits = "<limit lower='-1' upper='1' effort='1' velocity='1'/>";
    const auto robot = Robot::parse(
        "<robot name='slide'>" +
            test::urdfLink("base", {{test::box(2 * kHalf, 2 * kHalf, 2 * kHalf), {0, 0, 0}}}) +
            test::urdfLink("between", {}) +
            test::urdfLink("tip", {{test::sphere(kRadius), {0, 0, 0}}}) +
            test::urdfJoint("x", "prismatic", "base", "between", "<axis xyz='1 0 0'/>" + limits) +
            test::urdfJoint("y", "prismatic", "between", "tip", "<axis xyz='0 1 0'/>" + limits) +
            "</robot>",
        "slide.urdf");
    model_ = detail::compileChecker(robot, *robot->findGroup("all"), std::make_shared<World>(), {});
  }

  /// What is made of a claim, at t = 0.5 of a motion that has the ball at x there.
  std::optional<Witness> confirmed(double x, const std::array<float, 3>& point) {
    const std::vector<double> from{x - 0.01, 0.0};
    const std::vector<double> to{x + 0.01, 0.0};
    detail::WorkspaceData workspace(*model_);
    detail::PairQuery query(*model_, workspace);
    detail::ConfirmedContacts contacts(MotionQuery::FirstContact);
    Effort effort;
    const detail::StraightPath path(model_->kinematics, from, to);
    detail::PairOracle oracle(*model_, path, query, contacts, effort);
    const detail::SimdContact claim{0, {point[0], point[1], point[2]}, 0.0F};
    const bool isContact = oracle.isContact(claim, 0.5);
    EXPECT_EQ(isContact, contacts.any());
    return contacts.earliest();
  }

  /// m, of a witness: how far its points are from the ball and from the box that they are said to
  /// be in.
  double apart(const Witness& witness, double x) const {
    const bool ballFirst = witness.bodyA == "tip";
    const Eigen::Vector3d& inBall = ballFirst ? witness.pointA : witness.pointB;
    const Eigen::Vector3d& inBox = ballFirst ? witness.pointB : witness.pointA;
    const double fromBall = (inBall - Eigen::Vector3d(x, 0.0, 0.0)).norm() - kRadius;
    const double fromBox = (inBox.cwiseAbs().array() - kHalf).maxCoeff();
    return std::max({0.0, fromBall, fromBox});
  }

  std::shared_ptr<const detail::CheckerModel> model_;
};

TEST_F(ClaimsOfTwoLinks, HoldWhereBothLinksAre) {
  ASSERT_EQ(model_->pairCount(), 1U);
  ASSERT_TRUE(model_->pair(0).self);
  const std::optional<Witness> witness = confirmed(0.15, {0.075F, 0.01F, -0.01F});
  ASSERT_TRUE(witness);
  EXPECT_EQ(witness->t, 0.5);
  EXPECT_EQ(witness->distance, 0.0);
  EXPECT_EQ(witness->pointA, Eigen::Vector3d(0.075F, 0.01F, -0.01F));
  EXPECT_EQ(witness->pointB, witness->pointA);
  EXPECT_TRUE(witness->selfPair);
}

/// Of links that are apart a point of neither was a witness, by single precision's word.
TEST_F(ClaimsOfTwoLinks, AreRefusedWhereTheLinksAreApart) {
  EXPECT_FALSE(confirmed(0.3, {0.15F, 0.0F, 0.0F}));
  EXPECT_FALSE(confirmed(0.3, {0.1F, 0.0F, 0.0F}));
  EXPECT_FALSE(confirmed(0.3, {0.25F, 0.0F, 0.0F}));
  EXPECT_FALSE(confirmed(0.2 + 1e-9, {0.1F, 0.0F, 0.0F}));
  const float none = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(confirmed(0.3, {none, 0.0F, 0.0F}));
}

/// As points of surfaces are in single precision.
TEST_F(ClaimsOfTwoLinks, HoldByPointsThatAreARoundingOff) {
  const double x = 0.15;
  for (const float point : {0.1F + 1e-6F, 0.05F - 1e-6F, 0.0500001F, 0.0999999F}) {
    SCOPED_TRACE(point);
    const std::optional<Witness> witness = confirmed(x, {point, 0.0F, 0.0F});
    ASSERT_TRUE(witness);
    EXPECT_LE(apart(*witness, x), 1e-15);
    EXPECT_EQ(witness->distance, (witness->pointB - witness->pointA).norm());
    EXPECT_EQ(witness->distance, 0.0);
  }
}

}  // namespace
}  // namespace swept
