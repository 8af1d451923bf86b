// SPDX-License-Identifier: BSD-3-Clause
// Robots of a cell against the same robots alone, and what a cell refuses.
#include "swept/robot_model/work_cell.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/link_motion.hpp"
#include "swept/robot_model/named_states.hpp"

namespace swept {
namespace {

using test::TemporaryFolder;

std::filesystem::path rook(const std::string& ending) {
  return std::filesystem::path(modelsDir()) / "robots/rook7" / ("rook7" + ending);
}

std::shared_ptr<const Robot> alone() {
  return Robot::load(rook(".urdf"), rook(".srdf"));
}

Eigen::Isometry3d placeOfRight() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Eigen::Vector3d(0.45, 0.1, 0.05);
  pose.linear() = (Eigen::AngleAxisd(2.5, Eigen::Vector3d::UnitZ()) *
                   Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitX()))
                      .toRotationMatrix();
  return pose;
}

WorkCell twoRooks() {
  WorkCell cell{.name = "pair",
                .robots = {{.name = "left", .urdf = rook(".urdf"), .srdf = rook(".srdf")},
                           {.name = "right",
                            .urdf = rook(".urdf"),
                            .srdf = rook(".srdf"),
                            .parent_from_robot = placeOfRight()}},
                .groups = {{.name = "both", .groups = {"left/arm", "right/arm"}}}};
  return cell;
}

std::vector<double> randomState(const Robot& robot, const Group& group, std::mt19937& random) {
  std::vector<double> q;
  for (const int v : group.variables) {
    const Variable& own = robot.variables()[static_cast<std::size_t>(v)];
    q.push_back(std::uniform_real_distribution<double>(own.lower, own.upper)(random));
  }
  return q;
}

TEST(WorkCell, LinksStandWhereThoseOfTheRobotsAloneDo) {
  const auto one = alone();
  const auto cell = loadWorkCell(twoRooks());
  EXPECT_EQ(cell->name(), "pair");
  EXPECT_EQ(cell->modelFrame(), "world");
  EXPECT_EQ(cell->links().size(), 2 * one->links().size() + 1);
  EXPECT_EQ(cell->variables().size(), 2 * one->variables().size());
  std::mt19937 random(5);
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> q = randomState(*one, *one->findGroup("arm"), random);
    for (const Link& link : one->links()) {
      const Eigen::Isometry3d own = linkPose(*one, "arm", link.name, q);
      EXPECT_TRUE(linkPose(*cell, "left/arm", "left/" + link.name, q).isApprox(own, 1e-12));
      EXPECT_TRUE(linkPose(*cell, "right/arm", "right/" + link.name, q)
                      .isApprox(placeOfRight() * own, 1e-12));
    }
  }
}

TEST(WorkCell, GroupsAndStatesAreThoseOfTheRobots) {
  const auto one = alone();
  const auto cell = loadWorkCell(twoRooks());
  std::set<std::string> names;
  for (const Group& group : cell->groups()) names.insert(group.name);
  for (const Group& group : one->groups()) {
    EXPECT_TRUE(names.contains("left/" + group.name));
    EXPECT_TRUE(names.contains("right/" + group.name));
  }
  EXPECT_EQ(cell->findGroup("left")->variables.size(), one->variables().size());
  const Group& both = *cell->findGroup("both");
  EXPECT_EQ(both.variables.size(), 14U);
  const auto ready = namedConfiguration(*one, *one->findGroup("arm"), "ready");
  const auto together = namedConfiguration(*cell, both, "ready");
  ASSERT_EQ(together.size(), 14U);
  EXPECT_TRUE(std::ranges::equal(std::span(together).first(7), ready));
  EXPECT_TRUE(std::ranges::equal(std::span(together).last(7), ready));
  EXPECT_EQ(cell->disabledPairs().size(), 2 * one->disabledPairs().size());
}

/// One arm beside another that stands: its links as bodies of the world, placed by the robot alone.
TEST(WorkCell, VerdictsAreThoseAmongTheOthersLinks) {
  const auto one = alone();
  const auto cell = loadWorkCell(twoRooks());
  const std::vector<double> posture = namedConfiguration(*one, *one->findGroup("arm"), "ready");
  World world;
  for (std::size_t l = 0; l < one->links().size(); ++l) {
    const Link& link = one->links()[l];
    const Eigen::Isometry3d pose = placeOfRight() * linkPose(*one, "arm", link.name, posture);
    for (std::size_t i = 0; i < link.collision.size(); ++i)
      world.add("right " + link.name + " " + std::to_string(i), link.collision[i].shape,
                pose * link.collision[i].link_from_shape);
  }
  Eigen::VectorXd reference = cell->defaultState();
  const Group& right = *cell->findGroup("right/arm");
  for (std::size_t i = 0; i < posture.size(); ++i) reference[right.variables[i]] = posture[i];
  const Checker expected(one, "arm", std::make_shared<const World>(std::move(world)));
  const Checker checker(cell, "left/arm", std::make_shared<const World>(),
                        {.reference = reference});
  Workspace ofExpected(expected), own(checker);
  std::mt19937 random(6);
  int free = 0, collisions = 0, betweenRobots = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto from = randomState(*one, *one->findGroup("arm"), random);
    const auto to = randomState(*one, *one->findGroup("arm"), random);
    const Verdict verdict = expected.checkState(from, ofExpected);
    EXPECT_EQ(checker.checkState(from, own), verdict);
    free += verdict == Verdict::Free ? 1 : 0;
    collisions += verdict == Verdict::Collision ? 1 : 0;
    const MotionCertificate motion = checker.certifyMotion(from, to, own);
    EXPECT_EQ(motion.verdict, expected.certifyMotion(from, to, ofExpected).verdict);
    if (motion.witness && std::string(motion.witness->bodyB).starts_with("right/")) ++betweenRobots;
  }
  EXPECT_GT(free, 40);
  EXPECT_GT(collisions, 40);
  EXPECT_GT(betweenRobots, 40);
}

/// A cart that drives in the plane and carries an arm of one joint.
class CartAndArm : public testing::Test {
 protected:
  TemporaryFolder folder_;
  std::filesystem::path cart_ = folder_.write(
      "cart.urdf",
      "<robot name='cart'><link name='body'><collision><geometry><box size='1 1 0.2'/></geometry>"
      "</collision></link><link name='deck'/><joint name='up' type='fixed'><parent link='body'/>"
      "<child link='deck'/><origin xyz='0 0 0.5'/></joint></robot>");
  std::filesystem::path cartSrdf_ = folder_.write(
      "cart.srdf",
      "<robot name='cart'><virtual_joint name='floor' type='planar' parent_frame='odom' "
      "child_link='body'/><group name='base'><joint name='floor'/></group></robot>");
  std::filesystem::path arm_ = folder_.write(
      "arm.urdf",
      "<robot name='arm'><link name='foot'/><link name='rod'><visual><geometry><box size='1 1 1'/>"
      "</geometry><material name='red'/></visual><collision><geometry><box size='0.1 0.1 1'/>"
      "</geometry></collision></link><material name='red'><color rgba='1 0 0 1'/></material>"
      "<joint name='turn' type='revolute'><parent link='foot'/><child link='rod'/>"
      "<axis xyz='0 1 0'/><limit lower='-2' upper='2' velocity='1' effort='1'/></joint></robot>");
};

TEST_F(CartAndArm, ARobotIsCarriedAndDrives) {
  const auto file = folder_.write("cell.yaml",
                                  "name: porter\n"
                                  "robots:\n"
                                  "  - {name: cart, urdf: cart.urdf,\n"
                                  "     pose: {position: [5, 0, 0]}}\n"
                                  "  - name: arm\n"
                                  "    urdf: arm.urdf\n"
                                  "    srdf: none\n"
                                  "    parent: cart/deck\n"
                                  "    pose: {position: [0.2, 0, 0],\n"
                                  "           orientation: [0, 0, 0.7071067811865476, "
                                  "0.7071067811865476]}\n");
  const auto robot = loadWorkCell(WorkCell::read(file));
  EXPECT_EQ(robot->name(), "porter");
  std::vector<std::string> names;
  for (const Variable& variable : robot->variables()) names.push_back(variable.name);
  EXPECT_EQ(names, (std::vector<std::string>{"cart/floor/x", "cart/floor/y", "cart/floor/theta",
                                             "arm/turn"}));
  EXPECT_NE(robot->findGroup("cart/base"), nullptr);
  EXPECT_EQ(robot->findGroup("all")->variables.size(), 4U);
  // By hand: the cart is 2 m along y and turned by 90 degrees about its place at x = 5; its deck
  // carries the arm 0.2 m ahead of its middle.
  const double quarter = std::acos(0.0);
  const Eigen::Isometry3d rod =
      linkPose(*robot, "all", "arm/rod", std::vector<double>{0.0, 2.0, quarter, 0.0});
  EXPECT_TRUE(rod.translation().isApprox(Eigen::Vector3d(5.0, 2.2, 0.5), 1e-12));
  EXPECT_TRUE(rod.linear().col(0).isApprox(-Eigen::Vector3d::UnitX(), 1e-12));
}

TEST_F(CartAndArm, MessagesNameTheFilesOfTheRobots) {
  folder_.write("bad.stl", "no mesh");
  const auto bad =
      folder_.write("bad.urdf",
                    "<robot name='bad'>\n<link name='a'>\n<collision><geometry>\n"
                    "<mesh filename='bad.stl'/></geometry></collision></link></robot>");
  const WorkCell cell{.robots = {{.name = "x", .urdf = arm_}, {.name = "y", .urdf = bad}}};
  const std::string error = test::inputError([&] { loadWorkCell(cell); });
  EXPECT_TRUE(error.starts_with(bad.string() + ":4: error: ")) << error;
  EXPECT_NE(error.find("'y/a'"), std::string::npos) << error;

  test::Warnings warnings;
  const auto bare = folder_.write("bare.urdf",
                                  "<robot name='bare'>\n<link name='b'>\n<visual><geometry>"
                                  "<sphere radius='1'/></geometry></visual></link></robot>");
  loadWorkCell({.robots = {{.name = "x", .urdf = arm_}, {.name = "z", .urdf = bare}}},
               warnings.options());
  ASSERT_EQ(warnings.lines.size(), 1U);
  EXPECT_TRUE(warnings.lines[0].starts_with(bare.string() + ":2: warning: link 'z/b' has a "
                                                            "<visual> and no <collision>"))
      << warnings.lines[0];
}

TEST_F(CartAndArm, WhatIsWrongIsRefused) {
  folder_.write("moved.srdf",
                "<robot name='cart'>\n<virtual_joint name='floor' type='floating' "
                "parent_frame='odom' child_link='deck'/></robot>");
  folder_.write("missing.urdf",
                "<robot name='m'>\n<link name='a'><collision><geometry>\n"
                "<mesh filename='none.stl'/></geometry></collision></link></robot>");
  folder_.write("broken.urdf", "<robot name='m'><link/></robot>");
  struct Case {
    const char* text;
    const char* message;  // behind the folder; its begin
  };
  const std::string arm = "  - {name: arm, urdf: arm.urdf, srdf: none}\n";
  for (const auto& [text, message] : std::vector<Case>{
           {"[]", "cell.yaml:1: error: a work cell must be a mapping with 'robots'"},
           {"name: a\n", "cell.yaml:1: error: robots is missing"},
           {"robots: []\n", "cell.yaml: error: a work cell needs a robot at least"},
           {"robots: 3\n", "cell.yaml:1: error: robots "},
           {"robots:\n  - {urdf: arm.urdf}\n", "cell.yaml:2: error: robots[0].name is missing"},
           {"robots:\n  - {name: arm}\n", "cell.yaml:2: error: robot 'arm'.urdf is missing"},
           {"robots:\n  - {name: arm, file: arm.urdf}\n", "cell.yaml:2: error: "},
           {"robot: 1\nrobots: []\n", "cell.yaml:1: error: "},
           {"robots:\n  - {name: a/b, urdf: arm.urdf, srdf: none}\n",
            "cell.yaml:2: error: robot 'a/b': a name must be of letters, digits, '_', '-' and '.', "
            "and not 'world'"},
           {"robots:\n  - {name: world, urdf: arm.urdf, srdf: none}\n",
            "cell.yaml:2: error: robot 'world': a name must be"},
           {"robots:\n  - {name: '', urdf: arm.urdf, srdf: none}\n",
            "cell.yaml:2: error: robot '': a name must be"},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none}\n"
            "  - {name: a, urdf: arm.urdf, srdf: none}\n",
            "cell.yaml:3: error: a second robot is named 'a'"},
           {"robots:\n  - {name: a, urdf: none.urdf}\n", "none.urdf: error: "},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none.srdf}\n", "none.srdf: error: "},
           {"robots:\n  - {name: a, urdf: broken.urdf}\n",
            "broken.urdf:1: error: <link> has no attribute 'name'"},
           {"robots:\n  - {name: a, urdf: missing.urdf}\n",
            "missing.urdf:3: error: mesh 'none.stl' of link 'a' not found"},
           {"robots:\n  - {name: a, urdf: cart.urdf, srdf: moved.srdf}\n",
            "moved.srdf:2: error: virtual joint 'floor': its child link must be the root 'body', "
            "not 'deck'"},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none, parent: b/rod}\n",
            "cell.yaml:2: error: robot 'a': parent 'b/rod' is no link of a robot before it; links "
            "are called ROBOT/LINK"},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none}\n"
            "  - {name: b, urdf: arm.urdf, srdf: none, parent: a/rot}\n",
            "cell.yaml:3: error: robot 'b': parent 'a/rot' is no link of a robot before it; links "
            "are called ROBOT/LINK; did you mean 'a/rod'?"},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none, pose: {orientation: [0, 0, 0, 0]}}"
            "\n",
            "cell.yaml:2: error: robot 'a'.pose.orientation"},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none, pose: {rpy: [0, 0, 0]}}\n",
            "cell.yaml:2: error: "},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none}\ngroups:\n  both: []\n",
            "cell.yaml:4: error: group 'both' must list a group of a robot at least"},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none}\ngroups:\n  both: [a, b]\n",
            "cell.yaml:4: error: group 'both': 'b' is no group of the cell's robots"},
           {"robots:\n  - {name: a, urdf: arm.urdf, srdf: none}\ngroups:\n  a: [a]\n",
            "cell.yaml:4: error: a second group is named 'a'"},
       }) {
    const auto file = folder_.write("cell.yaml", text);
    const std::string error = test::inputError([&] { loadWorkCell(WorkCell::read(file)); });
    const std::string expected = (folder_.path() / message).string();
    EXPECT_EQ(error.substr(0, expected.size()), expected) << text;
  }
  WorkCell skewed = {.robots = {{.name = "a", .urdf = arm_}}};
  skewed.robots[0].parent_from_robot.linear() *= 2.0;
  EXPECT_EQ(test::inputError([&] { compose(skewed); }),
            "work cell: error: robot 'a': its pose must be rigid");
}

TEST_F(CartAndArm, WithoutAnSrdfBesideItARemarkSaysSo) {
  test::Warnings warnings;
  const auto file = folder_.write("cell.yaml", "robots:\n  - name: arm\n    urdf: arm.urdf\n");
  WorkCell::read(file, warnings.options());
  ASSERT_EQ(warnings.lines.size(), 1U);
  EXPECT_TRUE(warnings.lines[0].starts_with(file.string() +
                                            ":2: warning: robot 'arm' has no SRDF beside its URDF"))
      << warnings.lines[0];
}

}  // namespace
}  // namespace swept
