// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "input_files.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/problems.hpp"
#include "swept/robot_model/world.hpp"

/// Shapes with a size of 0 are the points, segments and surfaces that they are: closed sets, which
/// collide. Distances are closed forms.
namespace swept {
namespace {

/// In a link's frame, with how far it reaches along x, its middle being in it.
struct Flat {
  const char* urdf;
  double reach;  ///< m
};

constexpr std::array<Flat, 11> kFlats{{{"<sphere radius='0'/>", 0.0},
                                       {"<box size='0 0 0'/>", 0.0},
                                       {"<cylinder radius='0' length='0'/>", 0.0},
                                       {"<capsule radius='0' length='0'/>", 0.0},
                                       {"<box size='0.4 0 0'/>", 0.2},
                                       {"<box size='0 0.4 0'/>", 0.0},
                                       {"<cylinder radius='0' length='0.4'/>", 0.0},
                                       {"<capsule radius='0' length='0.4'/>", 0.0},
                                       {"<box size='0.4 0.2 0'/>", 0.2},
                                       {"<box size='0 0.4 0.2'/>", 0.0},
                                       {"<cylinder radius='0.2' length='0'/>", 0.2}}};

/// What it meets: its middle at x = 1 m.
struct Target {
  const char* urdf;
  double reach;  ///< m, along x
};

constexpr std::array<Target, 5> kTargets{{{"<sphere radius='0.3'/>", 0.3},
                                          {"<box size='0.6 0.8 0.8'/>", 0.3},
                                          {"<cylinder radius='0.3' length='0.8'/>", 0.3},
                                          {"<sphere radius='0'/>", 0.0},
                                          {"<box size='0 0.4 0.4'/>", 0.0}}};

std::string collision(const std::string& shape, const std::string& x) {
  return "<collision><origin xyz='" + x + " 0 0'/><geometry>" + shape + "</geometry></collision>";
}

/// A link that slides along x past the origin; the target is of the base or of the world.
struct Pair {
  Pair(const Flat& flat, const Target& target, bool ofWorld) {
    const std::string text = "<robot name='r'><link name='base'>" +
                             (ofWorld ? std::string() : collision(target.urdf, "1")) +
                             "</link><link name='mid'/><link name='l'>" +
                             collision(flat.urdf, "0") +
                             "</link><joint name='f' type='fixed'><parent link='base'/><child "
                             "link='mid'/></joint><joint name='s' type='prismatic'><parent "
                             "link='mid'/><child link='l'/><axis xyz='1 0 0'/><limit lower='-3' "
                             "upper='3'/></joint></robot>";
    const auto robot = Robot::parse(text, "r.urdf");
    auto world = std::make_shared<World>();
    if (ofWorld) {
      const auto other = Robot::parse(
          "<robot name='t'><link name='t'>" + collision(target.urdf, "1") + "</link></robot>",
          "t.urdf");
      const CollisionGeometry& part = other->links()[0].collision[0];
      world->add("target", part.shape, part.link_from_shape);
    }
    checker = std::make_unique<Checker>(robot, "all", world);
  }
  std::unique_ptr<Checker> checker;
};

class ZeroSizes : public testing::TestWithParam<std::tuple<Flat, Target, bool>> {};

TEST_P(ZeroSizes, StatesHaveTheDistanceByHand) {
  const auto& [flat, target, ofWorld] = GetParam();
  const Pair pair(flat, target, ofWorld);
  Workspace workspace(*pair.checker);
  const double sum = flat.reach + target.reach;
  for (const double gap : {1.5, 0.3, 1e-3, 1e-6, -1e-6, -0.1, -0.25}) {
    const double q = 1.0 - sum - gap;
    const double apart = std::max(0.0, std::abs(1.0 - q) - sum);
    const StateReport report = pair.checker->reportState(std::array{q}, workspace);
    EXPECT_EQ(report.verdict, apart > 0.0 ? Verdict::Free : Verdict::Collision) << q;
    EXPECT_LE(report.clearance, apart + 1e-12) << q;
    EXPECT_GE(report.clearance, apart - 1e-9) << q;
    EXPECT_EQ(pair.checker->checkState(std::array{q}, workspace), report.verdict) << q;
    const SignedClearance depth = pair.checker->signedClearance(std::array{q}, workspace);
    EXPECT_LE(depth.lower, depth.upper) << q;
    if (apart > 0.0) {
      EXPECT_NEAR(depth.upper, apart, 1e-9) << q;
    } else {
      EXPECT_LE(depth.lower, 0.0) << q;
    }
  }
}

TEST_P(ZeroSizes, MotionsStopWhereTheyMeet) {
  const auto& [flat, target, ofWorld] = GetParam();
  const Pair pair(flat, target, ofWorld);
  Workspace workspace(*pair.checker);
  const double sum = flat.reach + target.reach;
  // From 2 m before the target's middle to 0.7 m behind it.
  const double contact = (2.0 - sum) / 2.7;
  const MotionCertificate through =
      pair.checker->certifyMotion(std::array{-1.0}, std::array{1.7}, workspace);
  EXPECT_LE(through.freeUntil, contact + 1e-12);
  EXPECT_GE(through.freeUntil, contact - 2e-3);
  // Without volume on either side they may meet at one t alone, which rounding leaves undecided.
  EXPECT_NE(through.verdict, Verdict::Free);
  if (sum > 0.0) {
    ASSERT_EQ(through.verdict, Verdict::Collision);
    EXPECT_GE(through.witness->t, contact - 1e-9);
    EXPECT_LE(through.witness->t, contact + 2e-3);
  }
  const double last = 1.0 - sum - 0.01;
  const MotionCertificate before =
      pair.checker->certifyMotion(std::array{-1.0}, std::array{last}, workspace);
  EXPECT_EQ(before.verdict, Verdict::Free);
  const MotionClearance clearance =
      pair.checker->motionClearance(std::array{-1.0}, std::array{last}, 1e-5, workspace);
  EXPECT_LE(clearance.lower, 0.01 + 1e-12);
  EXPECT_GE(clearance.upper, 0.01 - 1e-12);
  EXPECT_LE(clearance.upper - clearance.lower, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(All, ZeroSizes,
                         testing::Combine(testing::ValuesIn(kFlats), testing::ValuesIn(kTargets),
                                          testing::Bool()));

TEST(ZeroSizesInUrdf, GiveOneWarningAndNegativeOnesAreRefused) {
  test::Warnings warnings;
  const auto load = [&](const std::string& shape) {
    return Robot::parse(
        "<robot name='r'>\n<link name='a'>" + collision(shape, "0") + "</link></robot>", "r.urdf",
        {}, {}, warnings.options());
  };
  load("<box size='1 1 1'/>");
  EXPECT_THAT(warnings.lines, testing::IsEmpty());
  for (const Flat& flat : kFlats) {
    warnings.lines.clear();
    const auto robot = load(std::string(flat.urdf));
    EXPECT_THAT(warnings.lines,
                testing::ElementsAre("r.urdf:2: warning: link 'a': a shape with a size of 0 is "
                                     "checked as the point, segment or surface that it is"))
        << flat.urdf;
    EXPECT_NE(robot->links()[0].collision[0].cover, nullptr);
  }
  for (const char* shape : {"<sphere radius='-0.1'/>", "<sphere radius='nan'/>",
                            "<box size='0 -1 0'/>", "<cylinder radius='1' length='-1e-9'/>"})
    EXPECT_THAT(test::inputError([&] { load(shape); }), testing::StartsWith("r.urdf:2: error: "));
}

/// A planning scene of one object for each primitive, as `type: dimensions`.
std::string sceneOf(const std::vector<std::pair<std::string, std::string>>& primitives) {
  std::string text = "name: s\nworld:\n  collision_objects:\n";
  for (std::size_t i = 0; i < primitives.size(); ++i)
    text += "    - id: o" + std::to_string(i) +
            "\n      primitives: [{type: " + primitives[i].first + ", dimensions: [" +
            primitives[i].second + "]}]\n      primitive_poses: [{position: [" +
            std::to_string(10 * i) + ", 0, 0], orientation: [0, 0, 0, 1]}]\n";
  return text;
}

struct Primitive {
  const char* type;
  const char* flat;  ///< dimensions, as a scene has them
  const char* thin;  ///< with 1e-9 m in place of 0
};

constexpr std::array<Primitive, 10> kPrimitives{{{"sphere", "0", "1e-9"},
                                                 {"box", "0, 0, 0", "1e-9, 1e-9, 1e-9"},
                                                 {"box", "0.4, 0, 0", "0.4, 1e-9, 1e-9"},
                                                 {"box", "0.4, 0.2, 0", "0.4, 0.2, 1e-9"},
                                                 {"cylinder", "0.4, 0", "0.4, 1e-9"},
                                                 {"cylinder", "0, 0.2", "1e-9, 0.2"},
                                                 {"cylinder", "0, 0", "1e-9, 1e-9"},
                                                 {"cone", "0.4, 0", "0.4, 1e-9"},
                                                 {"cone", "0, 0.2", "1e-9, 0.2"},
                                                 {"cone", "0, 0", "1e-9, 1e-9"}}};

TEST(ZeroSizesInScenes, AreReadWithOneWarning) {
  const test::TemporaryFolder folder;
  test::Warnings warnings;
  std::vector<std::pair<std::string, std::string>> all;
  for (const Primitive& primitive : kPrimitives) all.emplace_back(primitive.type, primitive.flat);
  const World world = World::load(folder.write("s.yaml", sceneOf(all)), warnings.options());
  EXPECT_EQ(world.bodies().size(), all.size());
  EXPECT_THAT(warnings.lines,
              testing::ElementsAre(testing::EndsWith(
                  "s.yaml:5: warning: 10 shapes with a size of 0 are checked as the points, "
                  "segments and surfaces that they are (first at line 5)")));
  warnings.lines.clear();
  World::load(folder.write("s.yaml", sceneOf({{"sphere", "1"}, {"box", "1, 0, 1"}})),
              warnings.options());
  EXPECT_THAT(warnings.lines,
              testing::ElementsAre(testing::EndsWith(
                  "s.yaml:8: warning: object 'o1': a shape with a size of 0 is checked as the "
                  "point, segment or surface that it is")));
  for (const auto& [type, sizes] : std::vector<std::pair<std::string, std::string>>{
           {"sphere", "-1e-300"}, {"sphere", ".nan"}, {"box", "0, -1, 0"}, {"cone", "1, -1"}})
    EXPECT_THAT(test::inputError([&, type = type, sizes = sizes] {
                  World::load(folder.write("s.yaml", sceneOf({{type, sizes}})));
                }),
                testing::HasSubstr("s.yaml:5: error: "))
        << sizes;
}

TEST(ZeroSizesInScenes, AreReadFromTextToo) {
  const test::TemporaryFolder folder;
  test::Warnings warnings;
  const std::string end = "0 0 0\n0 0 0 1\n0 0 0 0\n";
  const World world = World::load(
      folder.write("s.scene", "name\n* a\n1\nsphere\n0\n" + end + "* b\n1\nbox\n0 1 0\n" + end +
                                  "* c\n1\ncylinder\n0.2 0\n" + end + "* d\n1\ncone\n0.2 0\n" +
                                  end + "* e\n1\nbox\n1 1 1\n" + end + ".\n"),
      warnings.options());
  EXPECT_EQ(world.bodies().size(), 5);
  EXPECT_THAT(warnings.lines,
              testing::ElementsAre(testing::EndsWith(
                  "s.scene:5: warning: 4 shapes with a size of 0 are checked as the points, "
                  "segments and surfaces that they are (first at line 5)")));
}

TEST(ZeroSizesInProblems, AreReadAndNamed) {
  const test::TemporaryFolder folder;
  const auto load = [&](const std::string& radius, const std::string& halves) {
    return ProblemFile::load(folder.write(
        "p.json",
        R"({"s": [{"index": 1, "joint_names": ["j"], "start": [0], "goals": [[1]], "world": {
          "sphere": [{"name": "point", "position": [0, 0, 0], "radius": )" +
            radius + R"(}, {"name": "ball", "position": [0, 0, 0], "radius": 1}],
          "box": [{"name": "sheet", "position": [0, 0, 0], "orientation": [0, 0, 0, 1],
                   "half_extents": )" +
            halves + "}]}}]}"));
  };
  const PlanningProblem problem = load("0", "[0.5, 0, 1]").problem("s", 1);
  EXPECT_THAT(problem.withZeroSize, testing::ElementsAre("point", "sheet"));
  EXPECT_EQ(problem.world.bodies().size(), 3);
  EXPECT_THAT(test::inputError([&] { load("-1", "[1, 1, 1]"); }),
              testing::HasSubstr("radius is -1; it must be 0 or greater"));
  EXPECT_THAT(test::inputError([&] { load("1", "[1, -0.5, 1]"); }),
              testing::HasSubstr("is -0.5; it must be 0 or greater"));
}

/// A ball that slides past each of them answers as it does for the same shape with tiny sizes.
TEST(ZeroSizesInScenes, AreTheLimitOfSmallSizes) {
  const test::TemporaryFolder folder;
  const auto robot = Robot::parse(
      "<robot name='r'><link name='base'/><link name='l'>" +
          collision("<sphere radius='0.1'/>", "0") +
          "</link><joint name='s' type='prismatic'><parent link='base'/><child link='l'/><origin "
          "xyz='0.02 0.03 0'/><axis xyz='0 0 1'/><limit lower='-3' upper='3'/></joint></robot>",
      "r.urdf");
  for (const Primitive& primitive : kPrimitives) {
    const auto checker = [&](const std::string& sizes) {
      return Checker(robot, "all",
                     std::make_shared<const World>(
                         World::load(folder.write("s.yaml", sceneOf({{primitive.type, sizes}})))));
    };
    const Checker flat = checker(primitive.flat);
    const Checker thin = checker(primitive.thin);
    Workspace ofFlat(flat), ofThin(thin);
    int free = 0, hit = 0;
    for (double q = -0.6; q <= 0.6; q += 0.037) {
      const StateReport a = flat.reportState(std::array{q}, ofFlat);
      const StateReport b = thin.reportState(std::array{q}, ofThin);
      EXPECT_EQ(a.verdict, b.verdict) << primitive.flat << " at " << q;
      EXPECT_NEAR(a.clearance, b.clearance, 4e-9) << primitive.flat << " at " << q;
      EXPECT_EQ(flat.checkState(std::array{q}, ofFlat), a.verdict);
      (a.verdict == Verdict::Free ? free : hit) += 1;
    }
    EXPECT_GT(free, 5);
    EXPECT_GT(hit, 2);
    const MotionCertificate through = flat.certifyMotion(std::array{-1.0}, std::array{1.0}, ofFlat);
    const MotionCertificate throughThin =
        thin.certifyMotion(std::array{-1.0}, std::array{1.0}, ofThin);
    EXPECT_EQ(through.verdict, Verdict::Collision) << primitive.flat;
    EXPECT_EQ(throughThin.verdict, Verdict::Collision);
    EXPECT_NEAR(through.freeUntil, throughThin.freeUntil, 1e-3) << primitive.flat;
    EXPECT_EQ(flat.certifyMotion(std::array{1.0}, std::array{2.0}, ofFlat).verdict, Verdict::Free);
  }
}

}  // namespace
}  // namespace swept
