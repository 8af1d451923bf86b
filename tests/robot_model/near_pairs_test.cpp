// SPDX-License-Identifier: BSD-3-Clause
// A large world, whose boxes are sorted, against the same cut into small ones, which are looked
// through.
#include <gtest/gtest.h>

#include <set>

#include "certify/near_pairs.hpp"
#include "certify/workspace_data.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using test::at;
using test::box;
using test::sphere;

/// With a planar joint behind one that turns: only the exact tier bounds how far that slides.
std::shared_ptr<const Robot> slidingRobot() {
  return test::parseArm(
      "<robot name=\"slider\">" + test::urdfLink("base", {{sphere(0.1), {0, 0, 0}}}) +
      test::urdfLink("arm", {{sphere(0.05), {0.3, 0, 0}}}) +
      test::urdfLink("cart", {{box(0.1, 0.1, 0.1), {0, 0, 0}}, {sphere(0.04), {0.1, 0, 0}}}) +
      test::urdfJoint("turn", "continuous", "base", "arm", "<axis xyz=\"0 0 1\"/>") +
      test::urdfJoint("drive", "planar", "arm", "cart",
                      "<origin xyz=\"0.4 0 0\"/><axis xyz=\"0 0 1\"/>") +
      "</robot>");
}

/// Bodies of all sizes, one without an end, and one of several parts.
std::vector<WorldBody> manyBodies(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-3.0, 3.0);
  std::uniform_real_distribution<double> size(0.005, 0.05);
  std::vector<WorldBody> bodies;
  for (int i = 0; i < 150; ++i) {
    const Eigen::Isometry3d pose = at(place(random), place(random), 0.2 * place(random));
    if (pose.translation().head<2>().norm() < 0.3) continue;
    WorldBody body{.name = "body" + std::to_string(i)};
    if (i % 2 == 0) body.parts.push_back({Sphere{size(random)}, pose});
    if (i % 2 != 0 || i % 10 == 0)
      body.parts.push_back({Box{{size(random), size(random), size(random)}},
                            pose * Eigen::AngleAxisd(place(random), Eigen::Vector3d::UnitX())});
    bodies.push_back(body);
  }
  bodies.push_back({.name = "floor", .parts = {{makeHalfSpace({0, 0, 1}, -0.2), at(0, 0, 0)}}});
  return bodies;
}

class Both {
 public:
  Both(const std::shared_ptr<const Robot>& robot, const CheckerOptions& options) {
    const std::vector<WorldBody> bodies = manyBodies(3);
    auto all = std::make_shared<World>();
    for (const WorldBody& body : bodies) all->add(body);
    whole.emplace(robot, "all", all, options);
    for (std::size_t i = 0; i < bodies.size(); i += 20) {
      auto some = std::make_shared<World>();
      for (std::size_t k = i; k < std::min(i + 20, bodies.size()); ++k) some->add(bodies[k]);
      parts.emplace_back(robot, "all", some, options);
    }
  }
  std::optional<Checker> whole;
  std::vector<Checker> parts;
};

std::vector<double> randomState(const Checker& checker, std::mt19937& random) {
  std::vector<double> q;
  for (int i = 0; i < checker.dimension(); ++i)
    q.push_back(std::uniform_real_distribution<double>(-1.5, 1.5)(random));
  return q;
}

Verdict worse(Verdict a, Verdict b) {
  if (a == Verdict::Collision || b == Verdict::Collision) return Verdict::Collision;
  return a == Verdict::Free ? b : a;
}

TEST(NearGeometries, LargeWorldsAnswerAsTheirParts) {
  const auto slider = slidingRobot();
  const Both both(slider,
                  {.rules = CollisionRules().pad("cart", 0.02).margin("arm", "body7*", 0.1)});
  Workspace workspace(*both.whole);
  std::mt19937 random(4);
  test::Agreement states;
  test::Agreement motions;
  for (int i = 0; i < 1000; ++i) {
    const std::vector<double> from = randomState(*both.whole, random);
    std::vector<double> to = randomState(*both.whole, random);
    for (std::size_t k = 0; k < to.size(); ++k) to[k] = from[k] + 0.4 * (to[k] - from[k]);
    Verdict state = Verdict::Free;
    Verdict motion = Verdict::Free;
    double clearance = std::numeric_limits<double>::infinity();
    std::set<std::pair<std::string, std::string>> contacts;
    for (const Checker& part : both.parts) {
      state = worse(state, part.checkState(from, workspace));
      motion = worse(motion, part.certifyMotion(from, to, workspace).verdict);
      clearance = std::min(clearance, part.clearance(from, workspace));
      for (const Witness& contact : part.reportState(from, workspace).contacts)
        contacts.emplace(contact.bodyA, contact.bodyB);
    }
    compare(both.whole->checkState(from, workspace), state, states);
    compare(both.whole->certifyMotion(from, to, workspace).verdict, motion, motions);
    EXPECT_NEAR(both.whole->clearance(from, workspace), clearance, 2e-6);
    const StateReport report = both.whole->reportState(from, workspace);
    EXPECT_NEAR(report.clearance, clearance, 2e-6);
    std::set<std::pair<std::string, std::string>> reported;
    for (const Witness& contact : report.contacts) reported.emplace(contact.bodyA, contact.bodyB);
    EXPECT_EQ(reported, contacts);
    EXPECT_FALSE(report.nearestA.empty());
  }
  states.expectRepresentative(40);
  motions.expectRepresentative(40);
}

TEST(NearGeometries, VersionsShareTheBoxesOfTheirWorld) {
  const auto robot = slidingRobot();
  auto world = std::make_shared<World>();
  for (const WorldBody& body : manyBodies(5)) world->add(body);
  const auto first = detail::compileChecker(robot, robot->groups().front(), world, {});
  ASSERT_NE(first->boxes, nullptr);
  EXPECT_EQ(first->boxes->size(), first->worldGeometry.size());
  CheckerOptions padded;
  padded.rules.pad("*", 0.01);
  const auto second =
      detail::compileChecker(robot, robot->groups().front(), world, padded, first.get());
  EXPECT_EQ(second->boxes, first->boxes);
  padded.rules.scale("body1", 2.0);
  const auto third =
      detail::compileChecker(robot, robot->groups().front(), world, padded, first.get());
  EXPECT_NE(third->boxes, first->boxes);
  const auto small = detail::compileChecker(robot, robot->groups().front(),
                                            std::make_shared<World>(), {}, first.get());
  EXPECT_EQ(small->boxes, nullptr);
}

TEST(NearGeometries, FewOfManyAreCollected) {
  const auto robot = slidingRobot();
  auto world = std::make_shared<World>();
  for (const WorldBody& body : manyBodies(6)) world->add(body);
  const auto model = detail::compileChecker(robot, robot->groups().front(), world, {});
  detail::WorkspaceData workspace(*model);
  detail::PairQuery query(*model, workspace);
  const std::vector<double> from{0.0, 0.0, 0.0, 0.0};
  const std::vector<double> to{0.3, 0.2, 0.1, 0.5};
  const detail::StraightPath path(model->kinematics, from, to);
  ASSERT_TRUE(query.start(path));
  query.moveTo(0.5, 0.5);
  std::vector<std::uint32_t> near;
  detail::NearGeometries(*model, query, workspace).collect(0.5, near);
  EXPECT_TRUE(std::ranges::is_sorted(near));
  EXPECT_LT(near.size(), model->pairCount() / 3);
  EXPECT_GT(near.size(), 3U);
}

}  // namespace
}  // namespace swept
