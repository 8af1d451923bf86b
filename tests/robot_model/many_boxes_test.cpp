// SPDX-License-Identifier: BSD-3-Clause
// A world of so many boxes that several threads compile it, against the same boxes in worlds of
// few, which one thread compiles.
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "certify/checker_model.hpp"
#include "simd/compile/obstacle_tree.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using detail::CheckerModel;
using detail::GeometryPair;
using detail::SimdWorldNode;

constexpr int kBoxes = 30'000;
constexpr int kOfFew = 1500;

/// An arm of two links on a base, which boxes touch.
std::shared_ptr<const Robot> armRobot() {
  return test::parseArm(
      "<robot name=\"arm\">" + test::urdfLink("base", {{test::sphere(0.3), {0, 0, 0}}}) +
      test::urdfLink("upper", {{test::sphere(0.05), {0.3, 0, 0}}}) +
      test::urdfLink("fore",
                     {{test::box(0.1, 0.1, 0.1), {0.2, 0, 0}}, {test::sphere(0.04), {0.3, 0, 0}}}) +
      test::urdfJoint("shoulder", "continuous", "base", "upper", "<axis xyz=\"0 0 1\"/>") +
      test::urdfJoint("elbow", "continuous", "upper", "fore",
                      "<origin xyz=\"0.5 0 0\"/><axis xyz=\"0 1 0\"/>") +
      "</robot>");
}

/// Turned boxes, many of them out of the arm's reach; some two are one body.
std::vector<WorldBody> boxes() {
  std::mt19937 random(17);
  std::uniform_real_distribution<double> place(-2.5, 2.5), size(0.002, 0.02), angle(-3.0, 3.0);
  std::vector<WorldBody> bodies;
  for (int i = 0; i < kBoxes; ++i) {
    if (i % 3 != 1) bodies.push_back({.name = "body" + std::to_string(i)});
    bodies.back().parts.push_back(
        {Box{{size(random), size(random), size(random)}},
         test::at(place(random), place(random), place(random)) *
             Eigen::AngleAxisd(angle(random), Eigen::Vector3d(1, 2, 3).normalized())});
  }
  return bodies;
}

std::shared_ptr<const CheckerModel> compiled(const std::shared_ptr<const Robot>& robot,
                                             const std::vector<WorldBody>& bodies,
                                             std::size_t first, std::size_t last,
                                             const CheckerOptions& options) {
  auto world = std::make_shared<World>();
  for (std::size_t i = first; i < last; ++i) world->add(bodies[i]);
  return detail::compileChecker(robot, *robot->findGroup("all"), world, options);
}

/// All that queries read of a pair, and the name of its body.
std::string textOf(const CheckerModel& model, std::size_t index) {
  const GeometryPair pair = model.pair(index);
  std::string text = model.nameOfB(pair).str();
  const detail::MotionBoundSlot& slot = model.motionBounds[pair.motionBoundA];
  for (const int number : {pair.a, model.worldGeometry[pair.b].part, pair.reference, slot.geometry,
                           static_cast<int>(slot.firstJoint), pair.motionBoundB, pair.self ? 1 : 0})
    text += ' ' + std::to_string(number);
  for (const double number : {pair.rounding, pair.margin, pair.sourceError, pair.tube}) {
    text += ' ';
    text.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  return text;
}

CheckerOptions someOptions() {
  CheckerOptions options;
  options.rules.pad("body1*", 0.01).margin("fore", "body2*", 0.03).allow("upper", "body3*");
  options.tracking.rotation = 0.01;
  return options;
}

TEST(ManyBoxes, HaveThePairsOfFew) {
  const auto robot = armRobot();
  const std::vector<WorldBody> bodies = boxes();
  const auto all = compiled(robot, bodies, 0, bodies.size(), someOptions());
  ASSERT_EQ(all->worldGeometry.size(), static_cast<std::size_t>(kBoxes));
  std::set<std::string> pairs, ofFew, touching, touchingOfFew;
  double margin = 0.0, rounding = 0.0;
  const auto add = [](const CheckerModel& model, std::set<std::string>& names,
                      std::set<std::string>& contacts) {
    for (std::size_t i = 0; i < model.worldPairs.size(); ++i) names.insert(textOf(model, i));
    for (const detail::BodyPair& pair : model.bodyPairs)
      if (pair.touching) contacts.insert(model.world->bodies()[pair.b].name);
  };
  add(*all, pairs, touching);
  for (std::size_t first = 0; first < bodies.size(); first += kOfFew) {
    const auto few =
        compiled(robot, bodies, first, std::min(first + kOfFew, bodies.size()), someOptions());
    add(*few, ofFew, touchingOfFew);
    margin = std::max(margin, few->largestMargin);
    rounding = std::max(rounding, few->largestRounding);
  }
  EXPECT_EQ(pairs.size(), all->worldPairs.size());
  EXPECT_EQ(pairs, ofFew);
  EXPECT_EQ(touching, touchingOfFew);
  EXPECT_EQ(all->largestMargin, margin);
  EXPECT_EQ(all->largestRounding, rounding);
  // Some boxes are in reach of some links, some touch the base.
  EXPECT_GT(pairs.size(), static_cast<std::size_t>(kBoxes) / 30);
  EXPECT_LT(pairs.size(), static_cast<std::size_t>(kBoxes) * 2);
  EXPECT_GT(touching.size(), 1U);
  EXPECT_LT(touching.size(), 1000U);
}

/// Rows of pairs, and where each pair is in them, in the exact tier and in the SIMD tier.
TEST(ManyBoxes, ArePairedByGeometryInOrder) {
  const auto robot = armRobot();
  const std::vector<WorldBody> bodies = boxes();
  const auto model = compiled(robot, bodies, 0, bodies.size(), {});
  const std::size_t geometries = model->robotGeometry.size();
  ASSERT_EQ(model->firstWorldPair.size(), geometries + 1);
  EXPECT_EQ(model->firstWorldPair.back(), model->worldPairs.size());
  EXPECT_EQ(model->firstSelfPair, model->worldPairs.size());
  int rows = 0;
  for (std::size_t i = 0; i < geometries; ++i) {
    int last = -1;
    for (std::size_t k = model->firstWorldPair[i]; k < model->firstWorldPair[i + 1]; ++k) {
      ASSERT_EQ(model->worldPairs[k].a, static_cast<int>(i));
      ASSERT_GT(model->worldPairs[k].b, last);
      last = model->worldPairs[k].b;
      const std::size_t at = i * model->worldGeometry.size() + static_cast<std::size_t>(last);
      ASSERT_EQ(model->simd.pairOf[at], static_cast<std::int32_t>(k));
      ASSERT_EQ(model->simd.sources[k].obstacle, last);
    }
    rows += last >= 0 ? 1 : 0;
  }
  EXPECT_EQ(rows, 3);
}

/// The nodes are in the order of a walk through the tree, whichever thread makes a part of it, and
/// each box is in the boxes above it.
class TreeCheck {
 public:
  explicit TreeCheck(const std::vector<SimdWorldNode>& nodes, std::size_t obstacles)
      : nodes_(nodes), seen_(obstacles, 0) {}

  void run() {
    visit(0);
    EXPECT_EQ(next_, nodes_.size());
    for (const int times : seen_) ASSERT_EQ(times, 1);
  }

 private:
  void visit(std::size_t node) {
    ASSERT_EQ(node, next_);
    ++next_;
    for (std::size_t lane = 0; lane < 8; ++lane) {
      const SimdWorldNode& of = nodes_[node];
      if (!(of.lower[0].lane[lane] <= of.upper[0].lane[lane])) {
        EXPECT_EQ(of.child[lane], 0);
        continue;
      }
      if (of.child[lane] < 0) {
        ++seen_[static_cast<std::size_t>(~of.child[lane])];
        continue;
      }
      const auto child = static_cast<std::size_t>(of.child[lane]);
      for (std::size_t k = 0; k < 8; ++k) {
        const SimdWorldNode& below = nodes_[child];
        if (!(below.lower[0].lane[k] <= below.upper[0].lane[k])) continue;
        for (int axis = 0; axis < 3; ++axis) {
          EXPECT_LE(of.lower[axis].lane[lane], below.lower[axis].lane[k]);
          EXPECT_GE(of.upper[axis].lane[lane], below.upper[axis].lane[k]);
        }
      }
      visit(child);
    }
  }

  const std::vector<SimdWorldNode>& nodes_;
  std::vector<int> seen_;
  std::size_t next_ = 0;
};

TEST(ManyBoxes, AreInATreeInOrder) {
  const auto robot = armRobot();
  const std::vector<WorldBody> bodies = boxes();
  for (const std::size_t count : {100UL, bodies.size()}) {
    const auto model = compiled(robot, bodies, 0, count, {});
    TreeCheck(detail::buildObstacleTree(model->worldGeometry, 1.0, {}), model->worldGeometry.size())
        .run();
  }
}

/// What the tiers answer, against worlds of few boxes.
TEST(ManyBoxes, AnswerAsWorldsOfFew) {
  const auto robot = armRobot();
  const std::vector<WorldBody> bodies = boxes();
  const auto worldOf = [&](std::size_t first, std::size_t last) {
    auto world = std::make_shared<World>();
    for (std::size_t i = first; i < last; ++i) world->add(bodies[i]);
    return world;
  };
  const Checker all(robot, "all", worldOf(0, bodies.size()));
  std::vector<Checker> few;
  for (std::size_t first = 0; first < bodies.size(); first += kOfFew)
    few.emplace_back(robot, "all", worldOf(first, std::min(first + kOfFew, bodies.size())));
  Workspace workspace(all);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> angle(-3.0, 3.0);
  int free = 0, collisions = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<double> q{angle(random), angle(random)};
    Verdict verdict = Verdict::Free;
    for (const Checker& part : few)
      if (part.checkState(q, workspace) != Verdict::Free) verdict = Verdict::Collision;
    const bool isFree = all.checkState(q, workspace) == Verdict::Free;
    EXPECT_EQ(isFree, verdict == Verdict::Free);
    ++(isFree ? free : collisions);
  }
  EXPECT_GT(collisions, 30);
  EXPECT_GT(free, 30);
}

}  // namespace
}  // namespace swept
