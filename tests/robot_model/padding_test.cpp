// SPDX-License-Identifier: BSD-3-Clause
// A padded ball is a larger ball, and a scaled body one with larger numbers: so whether a padding
// or a scale is applied shows against a robot or a world that has it in its files.
#include <gtest/gtest.h>

#include "version_arms.hpp"

namespace swept {
namespace {

using test::agreementOf;
using test::ArmGeometry;
using test::armUrdf;
using test::at;
using test::box;
using test::parseArm;
using test::shared;
using test::sphere;

std::vector<test::UrdfPiece> grown(std::vector<double> radii, std::vector<test::UrdfPiece> pieces,
                                   double by) {
  for (std::size_t i = 0; i < pieces.size(); ++i) pieces[i].geometry = sphere(radii[i] + by);
  return pieces;
}

ArmGeometry withForePadded(double by) {
  ArmGeometry geometry;
  geometry.fore = grown({0.05, 0.04}, geometry.fore, by);
  return geometry;
}

/// Balls and rods only: what is padded stays a shape.
World roundWorld(double padding) {
  World world;
  world.add("near", Sphere{0.06 + padding}, at(0.3, 0.2, 0.6));
  world.add("rod", Capsule{0.02 + padding, 0.3}, at(-0.35, 0.0, 0.5));
  world.add("far", Sphere{0.1}, at(0.1, -0.4, 0.7));
  return world;
}

/// What the first one pads the second one has in its geometry; the plain one has nothing of it.
void expectApplied(const Checker& padded, const Checker& grown, const Checker& plain) {
  agreementOf(padded, grown, 500, 1).expectRepresentative(100);
  EXPECT_GT(agreementOf(padded, plain, 500, 1).differing, 10) << "the padding changes nothing";
}

TEST(Padding, OfALink) {
  const auto world = shared(roundWorld(0.0));
  const auto plain = parseArm(armUrdf({}));
  const auto thick = parseArm(armUrdf(withForePadded(0.05)));
  expectApplied(Checker(plain, "all", world, {.rules = CollisionRules().pad("fore", 0.05)}),
                Checker(thick, "all", world), Checker(plain, "all", world));
}

TEST(Padding, OfBodiesOfTheWorld) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared(roundWorld(0.0));
  const CollisionRules rules = CollisionRules().pad("near", 0.04).pad("rod", 0.04);
  expectApplied(Checker(robot, "all", world, {.rules = rules}),
                Checker(robot, "all", shared(roundWorld(0.04))), Checker(robot, "all", world));
}

TEST(Padding, OfBothAddsUpAndSoDoesTheMargin) {
  const auto world = shared(roundWorld(0.0));
  const auto plain = parseArm(armUrdf({}));
  const auto thick = parseArm(armUrdf(withForePadded(0.03)));
  const CollisionRules rules =
      CollisionRules().pad("fore", 0.03).pad("near", 0.02).pad("rod", 0.02);
  const Checker padded(plain, "all", world, {.margin = 0.01, .rules = rules});
  expectApplied(padded, Checker(thick, "all", shared(roundWorld(0.02)), {.margin = 0.01}),
                Checker(plain, "all", world, {.margin = 0.01}));
  for (const Checker::Pair& pair : padded.checkedPairs()) {
    const double expected = 0.01 + (pair.bodyA == "fore" || pair.bodyB == "fore" ? 0.03 : 0.0) +
                            (pair.bodyB == "near" || pair.bodyB == "rod" ? 0.02 : 0.0);
    EXPECT_DOUBLE_EQ(pair.margin, expected) << pair.bodyA << " - " << pair.bodyB;
  }
}

TEST(Padding, OfAnAttachedBody) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared(roundWorld(0.0));
  const auto tool = [](double radius) {
    AttachedBody body{.name = "tool", .link = "hand"};
    body.parts.push_back({Capsule{radius, 0.1}, at(0.0, 0.0, 0.12)});
    return std::vector<AttachedBody>{body};
  };
  expectApplied(Checker(robot, "all", world,
                        {.rules = CollisionRules().pad("tool", 0.05), .attached = tool(0.02)}),
                Checker(robot, "all", world, {.attached = tool(0.07)}),
                Checker(robot, "all", world, {.attached = tool(0.02)}));
}

TEST(Padding, OfLinksAgainstEachOther) {
  ArmGeometry geometry;
  const auto plain = parseArm(armUrdf(geometry));
  geometry.hand = grown({0.03}, geometry.hand, 0.12);
  const auto thick = parseArm(armUrdf(geometry));
  const auto world = shared({});
  expectApplied(Checker(plain, "all", world, {.rules = CollisionRules().pad("hand", 0.12)}),
                Checker(thick, "all", world), Checker(plain, "all", world));
}

/// With all other pairs allowed, the margin of the checker is that of the pair.
TEST(Padding, OfOnePairIsInsteadOfEverythingElse) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared(roundWorld(0.0));
  const CollisionRules only = CollisionRules().allow("*", "*").check("hand", "near");
  CollisionRules one = only;
  one.margin("near", "hand", 0.08).pad("hand", 0.3).pad("near", 0.4);
  const Checker byRule(robot, "all", world, {.margin = 0.5, .rules = one});
  const Checker byOption(robot, "all", world, {.margin = 0.08, .rules = only});
  const Checker without(robot, "all", world, {.rules = only});
  expectApplied(byRule, byOption, without);
  // The pair's margin may be less than that of all others, too.
  CollisionRules less = CollisionRules().margin("hand", "near", 0.0);
  const Checker all(robot, "all", world, {.margin = 0.05, .rules = less});
  const Checker near(robot, "all", world, {.margin = 0.05});
  const test::Agreement agreement = agreementOf(all, near, 3000, 5);
  EXPECT_GT(agreement.differing, 3);
  EXPECT_EQ(all.explain("near", "hand"),
            "near - hand: checked, keeps more than 0 m (a rule about the pair)");
}

TEST(Padding, ContactIsWithinThePairsOwnMargin) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared(roundWorld(0.0));
  const Checker padded(robot, "all", world, {.rules = CollisionRules().pad("near", 0.05)});
  Workspace workspace(padded);
  std::mt19937 random(7);
  int within = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::vector<double> q = test::randomConfiguration(padded, random);
    for (const Witness& contact : padded.reportState(q, workspace).contacts) {
      const double most = contact.bodyB == "near" ? 0.05 : 0.0;
      EXPECT_LE(contact.distance, most + 1e-9);
      EXPECT_NEAR((contact.pointB - contact.pointA).norm(), contact.distance, 1e-9);
      within += contact.distance > 0.01 ? 1 : 0;
    }
  }
  EXPECT_GT(within, 20);
}

TEST(Scale, OfALink) {
  ArmGeometry geometry;
  geometry.fore = {{box(0.06, 0.08, 0.2), {0, 0.01, 0.12}},
                   {R"(<cylinder radius="0.03" length="0.1"/>)", {0.03, 0, 0.24}}};
  const auto world = shared(test::clutter(4));
  const auto plain = parseArm(armUrdf(geometry));
  geometry.fore = {{box(0.09, 0.12, 0.3), {0, 0.01, 0.12}},
                   {R"(<cylinder radius="0.045" length="0.15"/>)", {0.03, 0, 0.24}}};
  const auto large = parseArm(armUrdf(geometry));
  expectApplied(Checker(plain, "all", world, {.rules = CollisionRules().scale("fore", 1.5)}),
                Checker(large, "all", world), Checker(plain, "all", world));
}

/// A closed box of triangles; its corner, not its middle, is the origin.
TriangleMesh boxMesh(const Eigen::Vector3d& lower, const Eigen::Vector3d& upper) {
  std::vector<Eigen::Vector3d> corners;
  for (int i = 0; i < 8; ++i)
    corners.emplace_back((i & 1) != 0 ? upper.x() : lower.x(), (i & 2) != 0 ? upper.y() : lower.y(),
                         (i & 4) != 0 ? upper.z() : lower.z());
  const std::vector<TriangleMesh::Triangle> faces{{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                                  {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                                  {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return TriangleMesh::build(corners, faces);
}

TEST(Scale, OfBodiesOfTheWorldIsAboutTheMiddleOfEachPart) {
  const auto robot = parseArm(armUrdf({}));
  World world;
  WorldBody shelf{.name = "shelf"};
  shelf.parts.push_back({boxMesh({0, 0, 0}, {0.2, 0.1, 0.3}), at(0.2, 0.1, 0.5)});
  shelf.parts.push_back({Box{{0.05, 0.1, 0.05}}, at(-0.4, 0.0, 0.4)});
  world.add(shelf);
  World large;
  WorldBody larger{.name = "shelf"};
  larger.parts.push_back(
      {boxMesh({-0.05, -0.025, -0.075}, {0.25, 0.125, 0.375}), at(0.2, 0.1, 0.5)});
  larger.parts.push_back({Box{{0.075, 0.15, 0.075}}, at(-0.4, 0.0, 0.4)});
  large.add(larger);
  const Checker scaled(robot, "all", shared(world),
                       {.rules = CollisionRules().scale("shelf", 1.5)});
  expectApplied(scaled, Checker(robot, "all", shared(large)), Checker(robot, "all", shared(world)));
}

TEST(Scale, OfAnAttachedBodyAndWithAPadding) {
  const auto robot = parseArm(armUrdf({}));
  const auto world = shared(roundWorld(0.0));
  const auto tool = [](double radius, double half) {
    AttachedBody body{.name = "tool", .link = "hand"};
    body.parts.push_back({Capsule{radius, half}, at(0.0, 0.05, 0.1)});
    return std::vector<AttachedBody>{body};
  };
  const CollisionRules rules = CollisionRules().scale("tool", 2.0).pad("tool", 0.01);
  expectApplied(Checker(robot, "all", world, {.rules = rules, .attached = tool(0.02, 0.05)}),
                Checker(robot, "all", world, {.attached = tool(0.05, 0.1)}),
                Checker(robot, "all", world, {.attached = tool(0.02, 0.05)}));
}

}  // namespace
}  // namespace swept
