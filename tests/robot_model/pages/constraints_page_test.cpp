// SPDX-License-Identifier: BSD-3-Clause
// Pages name constraints: in the words of `swept verify`, whose code is another, and where one does
// not hold.
#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "slide_page.hpp"
#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/path_certificate.hpp"

namespace swept {
namespace {

using Eigen::Isometry3d;
using Eigen::Translation3d;
using nlohmann::json;
using test::dataOf;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A carriage on a slide, an arm that turns on it, and a cart in the plane.
std::shared_ptr<const Robot> robot() {
  return Robot::parse(
      "<robot name='r'><link name='base'/><link name='slide'/><link name='arm'><collision>"
      "<geometry><sphere radius='0.1'/></geometry></collision></link><link name='cart'/>"
      "<joint name='x' type='prismatic'><parent link='base'/><child link='slide'/><axis "
      "xyz='1 0 0'/><limit lower='-3' upper='3' effort='1' velocity='1'/></joint>"
      "<joint name='turn' type='continuous'><parent link='slide'/><child link='arm'/><axis "
      "xyz='0 1 0'/></joint><joint name='drive' type='planar'><parent link='base'/><child "
      "link='cart'/><axis xyz='0 0 1'/></joint></robot>",
      "r.urdf");
}

/// Of every kind, from every kind of frame; all hold from 0 to 1 m and rad.
TaskConstraint everyKind() {
  const Isometry3d turned =
      Translation3d(0.1, -0.25, 0.0) * Eigen::AngleAxisd(0.5, Eigen::Vector3d(1, 2, 2) / 3.0);
  using Type = ConstraintRegion::Type;
  return {
      .joints = {{.joint = "x", .position = 0.5, .above = 0.75, .below = kInfinity},
                 {.joint = "turn", .position = 0.0, .above = 2.0, .below = 1.0},
                 {.joint = "drive/theta", .position = 0.0, .above = 2.0, .below = 1.0},
                 {.joint = "drive/y", .position = 0.0, .above = 2.0, .below = 1.0}},
      .positions = {{.frame = {.body = "cup", .body_from_frame = turned},
                     .reference = {.body = "base", .body_from_frame = turned},
                     .regions = {{.type = Type::Box, .size = {40.0, 50.0, kInfinity}},
                                 {.type = Type::Sphere, .size = {0.125, 0, 0}}}},
                    {.frame = {.body = "arm"},
                     .regions = {{.type = Type::Cylinder,
                                  .size = {10.0 / 3.0, 7.0, 0},
                                  .reference_from_region = turned}}}},
      .orientations = {{.frame = {.body = "arm"},
                        .orientation =
                            Eigen::Quaterniond(Eigen::AngleAxisd(0.25, Eigen::Vector3d::UnitY())),
                        .tolerance = {0.5, 1.5, kInfinity}},
                       {.frame = {.body = "cup"},
                        .reference = {.body = "slide"},
                        .tolerance = {0.5, 2.0, 0.5},
                        .parameterization =
                            OrientationConstraint::Parameterization::RotationVector}},
      .axes = {
          {.frame = {.body = "arm"}, .axis = {0, -3, 0}, .direction = {0, -1, 1e-3}, .angle = 0.1},
          {.frame = {.body = "cup", .body_from_frame = turned},
           .reference = {.body = "slide"},
           .axis = {0, 0, 1},
           .direction = {1, 2, 3},
           .angle = 7.0}}};
}

std::vector<std::string> wordsOf(const json& data) {
  std::vector<std::string> words;
  for (const json& constraint : data["constraints"]) words.push_back(constraint["text"]);
  return words;
}

TEST(ConstraintsPageTest, AreInTheWordsOfTheVerifier) {
  const auto world = std::make_shared<World>();
  world->add(WorldBody{.name = "wall",
                       .parts = {{makeBox({0.1, 1, 1}), Isometry3d(Translation3d(5, 0, 0))}}});
  const auto checker = std::make_shared<const Checker>(
      Checker(robot(), "all", world)
          .withAttached("cup", "arm", makeSphere(0.05), Isometry3d(Translation3d(0, 0, 0.2)), {})
          .withConstraints(everyKind()));
  const std::vector<std::vector<double>> states{std::vector<double>(5, 0.0),
                                                std::vector<double>(5, 1.0)};
  Page page(checker);
  page.addPath("path", states);
  const json data = dataOf(page);
  EXPECT_EQ(data["headline"], "path: free");

  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "path.json";
  EXPECT_EQ(writeProof(file, *checker, states, certifyPath(*checker, states)).missing, "");
  const CheckedProof proof = verifyProof(file);
  EXPECT_EQ(proof.refusal, "");
  ASSERT_EQ(proof.constraints.size(), everyKind().size());
  EXPECT_EQ(wordsOf(data), proof.constraints);
  EXPECT_EQ(proof.constraints.front(), "joint x from -inf to 1.25");
  for (const json& motion : data["motions"]) EXPECT_EQ(motion["violation"], nullptr);
}

TEST(ConstraintsPageTest, SayWhereOneDoesNotHold) {
  const auto checker = std::make_shared<const Checker>(test::slide(5.0)->withConstraints(
      {.joints = {{.joint = "x", .position = 0.0, .above = 0.5, .below = 0.5}}}));
  Page path(checker);
  path.addPath("there", std::vector<std::vector<double>>{{0.0}, {0.4}, {0.9}});
  json data = dataOf(path);
  EXPECT_EQ(data["headline"], "path: off a constraint");
  EXPECT_EQ(data["tone"], "bad");
  EXPECT_EQ(data["motions"][0]["violation"], nullptr);
  EXPECT_NEAR(data["motions"][1]["violation"]["t"].get<double>(), 0.2, 0.02);
  EXPECT_TRUE(
      data["motions"][1]["violation"]["text"].get<std::string>().starts_with("joint 'x' is"));
  std::size_t off = 0;
  for (const json& tier : data["motions"][1]["pieces"]["tiers"]) off += tier == "violation";
  EXPECT_GT(off, data["motions"][1]["pieces"]["tiers"].size() / 2);
  EXPECT_EQ(data["motions"][0]["pieces"]["tiers"][0], "lanes");

  Page ride(checker);
  ride.addTrajectory("ride", test::rideTo(1.0));
  data = dataOf(ride);
  const double t = data["motions"][0]["violation"]["t"];
  EXPECT_NEAR(t * 3.25, 1.0, 0.02) << "half of the way, in half of the first 2 s";

  Page states(checker);
  states.addState("in", std::vector<double>{0.25});
  states.addState("out", std::vector<double>{0.75});
  data = dataOf(states);
  EXPECT_EQ(data["states"][0]["violations"], json::array());
  EXPECT_EQ(data["states"][1]["violations"], json({"joint 'x' is 0.25 beyond its tolerance"}));
}

TEST(ConstraintsPageTest, AreNoneWithoutAny) {
  Page page(test::slide());
  page.addState("in", std::vector<double>{0.25});
  EXPECT_EQ(dataOf(page)["constraints"], json::array());
}

}  // namespace
}  // namespace swept
