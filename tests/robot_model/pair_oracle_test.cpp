// SPDX-License-Identifier: BSD-3-Clause
#include "certify/pair_oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "version_arms.hpp"

namespace swept {
namespace {

/// A slide of 1 m, with balls in its way at 0.2, 0.5 and 0.8 m.
std::shared_ptr<const detail::CheckerModel> slideBetweenBalls() {
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
  return detail::compileChecker(robot, *robot->findGroup("all"), world, {});
}

/// In whatever order they are found.
TEST(PairOracle, KeepsTheEarliestContact) {
  const auto model = slideBetweenBalls();
  ASSERT_EQ(model->pairs.size(), 3U);
  const std::vector<double> from{0.0};
  const std::vector<double> to{1.0};
  std::vector<double> times{0.2, 0.5, 0.8};
  do {
    detail::WorkspaceData workspace(*model);
    detail::PairQuery query(*model, workspace);
    MotionCertificate certificate;
    const detail::StraightPath path(model->kinematics, from, to);
    detail::PairOracle oracle(*model, path, query, certificate);
    double earliest = 1.0;
    for (const double t : times) {
      int contacts = 0;
      for (std::uint32_t pair = 0; pair < 3; ++pair) {
        contacts += oracle.look(pair, t, 0.0).kind == detail::ExactAnswer::Kind::Contact ? 1 : 0;
      }
      EXPECT_EQ(contacts, 1);
      earliest = std::min(earliest, t);
      ASSERT_TRUE(certificate.witness);
      EXPECT_EQ(certificate.witness->t, earliest);
      EXPECT_EQ(certificate.witness->bodyB, "ball at " + std::to_string(earliest));
    }
    EXPECT_EQ(certificate.effort.intervals, 9);
  } while (std::next_permutation(times.begin(), times.end()));
}

}  // namespace
}  // namespace swept
