// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <functional>

#include "gantry.hpp"
#include "verify/check.hpp"
#include "verify/enclosed.hpp"
#include "verify/encoding.hpp"
#include "verify/intervals.hpp"
#include "verify/proof.hpp"

/// Files that somebody made in order to deceive the checker of proofs, or to end it.
namespace swept::test {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;
using testing::HasSubstr;

std::string refusalOf(const auto& check) {
  try {
    check();
  } catch (const verify::Refusal& refusal) {
    return refusal.what();
  }
  return "";
}

/// The square of 2.6e-162 is 1.4 of the smallest number there is, and rounds to one of it.
TEST(VerifyCrafted, DirectionsOfAnyLengthProveTheSame) {
  const Gantry gantry;
  const std::string file = gantry.folder().path("path.json");
  ASSERT_EQ(gantry.run("plan", {"left", "right", "--embed", "-o", file}).exitCode, 0);
  const Json path = Json::parse(gantry.folder().read("path.json"));
  const auto said = [&](double length, double share) {
    Json changed = path;
    Json& pair = changed["proof"]["segments"][0]["pairs"][0];
    Json& plane = pair["intervals"][0][2];
    Vector3d direction(plane[0].get<double>(), plane[1].get<double>(), plane[2].get<double>());
    direction *= length / direction.norm();
    for (std::size_t i = 0; i < 3; ++i) plane[i] = direction[static_cast<int>(i)];
    plane[3] = share * plane[3].get<double>();
    pair["digest"] = verify::pairDigest(pair);
    return refusalOf([&] { verify::checkProof(changed, changed["model"]); });
  };
  for (const double length : {1e-300, 2.6e-162, 1e-5, 1.0, 1e200}) {
    EXPECT_EQ(said(length, 1.0 - 1e-9), "") << length;
    EXPECT_THAT(said(length, 1.1), HasSubstr("is not proven, only")) << length;
  }
}

/// Of a model without variables.
verify::Motion standing(const verify::Model& model) {
  const std::vector<double> none;
  return {model, none, none};
}

/// Of the smallest numbers there are, squares are nothing and lengths have no digits.
TEST(VerifyCrafted, DirectionsOfTheSmallestNumbersHaveLengthOne) {
  verify::Model model;
  model.links = {"link"};
  model.jointOf = {-1};
  const std::vector<verify::Element> here{{.points = {Vector3d::Zero()}}};
  const std::vector<verify::Element> there{{.points = {Vector3d(3.0, 4.0, 0.0)}}};
  model.bodies.emplace_back("here", here, std::vector<verify::Flat>{},
                            std::vector<verify::Surface>{});
  model.bodies.emplace_back("there", there, std::vector<verify::Flat>{},
                            std::vector<verify::Surface>{});
  model.linkOf = {0, -1};
  model.paddings = {0.0, 0.0};
  const verify::PairMotion motion(model, standing(model), {0, 1}, 0.0, 1.0);
  for (const double unit : {5e-324, 1e-322, 1e-315, 1e-310, 1.0, 1e307})
    EXPECT_NEAR(motion.gap(0, 0, {3.0 * unit, 4.0 * unit, 0.0}), 5.0, 1e-9) << unit;
  EXPECT_NEAR(motion.gap(0, 0, {5e-324, 5e-324, 0.0}), 7.0 / std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(std::isnan(motion.gap(0, 0, Vector3d::Zero())));
}

verify::Surface tetrahedron() {
  return {{Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// A tetrahedron, from 0 to 1 m along z, and a half-space up to `height` m, or its surface.
verify::Model solidAndGround(double height, bool isSolid) {
  verify::Model model;
  model.links = {"link"};
  model.jointOf = {-1};
  std::vector<verify::Element> corners;
  for (const Vector3d& vertex : tetrahedron().vertices) corners.push_back({.points = {vertex}});
  model.bodies.emplace_back("solid", corners, std::vector<verify::Flat>{},
                            std::vector<verify::Surface>{tetrahedron()});
  model.bodies.emplace_back("ground", std::vector<verify::Element>{},
                            std::vector<verify::Flat>{{Vector3d::UnitZ(), height, isSolid}},
                            std::vector<verify::Surface>{});
  model.linkOf = {0, -1};
  model.paddings = {0.0, 0.0};
  return model;
}

std::string refusalOfFlat(const verify::Model& model, const Json& intervals) {
  const verify::Motion motion = standing(model);
  const Json proof = {{"flats", Json::array({intervals})}};
  return refusalOf([&] { checkPair(model, motion, {0, 1}, proof, "here"); });
}

TEST(VerifyCrafted, AMotionIsProvenFromItsBeginningToItsEnd) {
  const verify::Model model = solidAndGround(-1.0, true);
  const auto part = [](double begin, double end) {
    return Json::array({begin, end, Json::array({1, 0.9})});
  };
  EXPECT_EQ(refusalOfFlat(model, {part(0.0, 0.5), part(0.5, 1.0)}), "");
  EXPECT_EQ(refusalOfFlat(model, Json::array()), "here: nothing proves it from 0 to 1");
  EXPECT_EQ(refusalOfFlat(model, Json::array({part(0.0, 0.5)})),
            "here: nothing proves it from 0.5 to 1");
  EXPECT_THAT(refusalOfFlat(model, Json::array({part(0.5, 1.0)})),
              HasSubstr("does not begin at 0 and"));
}

TEST(VerifyCrafted, ABoundIsAboveWhatThePairHasToKeep) {
  verify::Model model = solidAndGround(-1.0, true);
  const Json intervals = Json::array({Json::array({0.0, 1.0, Json::array({1, 0.9})})});
  model.worldMargin = 0.25;
  model.paddings = {0.5, 0.125};
  EXPECT_EQ(refusalOfFlat(model, intervals), "");
  model.paddings[1] = 0.25;
  EXPECT_EQ(refusalOfFlat(model, intervals),
            "here, 0 to 1: the bound 0.9 m is not above the margin, 1 m");
}

TEST(VerifyCrafted, BelowTheGroundNothingIsFree) {
  const Json below = Json::array({Json::array({0.0, 1.0, Json::array({-1, 0.9})})});
  EXPECT_EQ(refusalOfFlat(solidAndGround(2.0, false), below), "");
  EXPECT_EQ(refusalOfFlat(solidAndGround(2.0, true), below),
            "here, 0 to 1: the bound 0.9 m is not proven, only -inf m is");
}

/// A plane of the world has no intervals, whatever the file has under that name.
TEST(VerifyCrafted, IntervalsThatProveNothingAreNotLookedAt) {
  const verify::Model model = solidAndGround(-1.0, true);
  const verify::Motion motion = standing(model);
  const Json flats = Json::array({Json::array({Json::array({0.0, 1.0, Json::array({1, 0.9})})})});
  for (const Json& intervals : {Json::array(), Json(5), Json::array({5})}) {
    const Json proof = {{"flats", flats}, {"intervals", intervals}};
    EXPECT_EQ(checkPair(model, motion, {0, 1}, proof, "here").planes, 1u);
    EXPECT_NO_THROW(requireNotEnclosed(model, motion, {0, 1}, proof, "here")) << intervals;
  }
}

/// Half a turn and less from a small angle to one that has no digits behind its point.
TEST(VerifyCrafted, LargeAnglesRoundAtEitherEnd) {
  verify::Model model;
  model.links = {"base", "arm"};
  model.jointOf = {-1, 0};
  model.joints = {{.name = "turn",
                   .kind = verify::JointKind::Revolute,
                   .parent = 0,
                   .child = 1,
                   .variable = 0}};
  model.variables = {{"turn", -INFINITY, INFINITY, true}};
  const std::vector<double> small{2.41}, large{1e15};
  for (const auto& [from, to] : {std::pair(small, large), std::pair(large, small)})
    EXPECT_GE(verify::Motion(model, from, to).bounds(1, -1, 1.0, 0.5, 0.5).turn, 1e15);
  EXPECT_LT(verify::Motion(model, small, small).bounds(1, -1, 1.0, 0.5, 0.5).turn, 3.0);
}

/// Of a model of a link that turns, after a change; empty: it is read.
std::string refusalOfModel(const std::function<void(Json&)>& change) {
  Json model = Json::parse(R"({
    "links": ["base", "arm"],
    "variables": [{"name": "turn", "lower": null, "upper": null, "cyclic": true}],
    "joints": [{"name": "turn", "type": "continuous", "parent": "base", "child": "arm",
                "pose": [1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0], "axis": [0, 0, 1],
                "variable": 0, "multiplier": 1.0, "offset": 0.0}],
    "bodies": [], "margin": 0.0, "paddings": {}, "allowed": []})");
  change(model);
  return refusalOf([&] {
    verify::digestsOf(model);
    verify::readModel(model);
  });
}

TEST(VerifyCrafted, NamesAreThereOnce) {
  EXPECT_EQ(refusalOfModel([](Json&) {}), "");
  // Digests are by name: the genuine joint's would stand for a forged one before it.
  EXPECT_EQ(refusalOfModel([](Json& model) {
              Json forged = model["joints"][0];
              forged["parent"] = nullptr;
              forged["child"] = "base";
              forged["pose"][9] = 100.0;
              model["joints"].insert(model["joints"].begin(), forged);
            }),
            "joints: there are two of the name \"turn\"");
  EXPECT_EQ(refusalOfModel([](Json& model) { model["links"].push_back("arm"); }),
            "link arm: there are two of this name");
  EXPECT_EQ(
      refusalOfModel([](Json& model) { model["variables"].push_back(model["variables"][0]); }),
      "variable turn: there are two of this name");
  const Json body = {{"name", "cup"}, {"link", nullptr}, {"shapes", Json::array()}};
  EXPECT_EQ(refusalOfModel([&](Json& model) {
              model["bodies"] = {body, body};
            }),
            "bodies: there are two of the name \"cup\"");
}

/// Added to its size, the largest number is a small one.
TEST(VerifyCrafted, AVariableIsOneThatIsThere) {
  for (const std::uint64_t variable : {std::uint64_t{1}, UINT64_MAX, UINT64_MAX - 6})
    for (const char* type : {"continuous", "floating"})
      EXPECT_EQ(refusalOfModel([&](Json& model) {
                  model["joints"][0]["variable"] = variable;
                  model["joints"][0]["type"] = type;
                }),
                "joint turn: no variable " + std::to_string(variable));
}

/// Otherwise a motion ends where the next one does not begin.
TEST(VerifyCrafted, WhatFollowsACyclicVariableComesBackAfterATurn) {
  const auto said = [](const char* type, double multiplier, bool cyclic) {
    return refusalOfModel([&](Json& model) {
      model["joints"][0]["type"] = type;
      model["joints"][0]["multiplier"] = multiplier;
      model["variables"][0]["cyclic"] = cyclic;
    });
  };
  const std::string elsewhere = "joint turn: a turn of its variable takes it somewhere else";
  for (const double multiplier : {-3.0, 0.0, 1.0, 2.0})
    EXPECT_EQ(said("continuous", multiplier, true), "") << multiplier;
  EXPECT_EQ(said("continuous", 0.5, true), elsewhere);
  EXPECT_EQ(said("revolute", 1.0 + 1e-15, true), elsewhere);
  EXPECT_EQ(said("prismatic", 1.0, true), elsewhere);
  EXPECT_EQ(said("continuous", 0.5, false), "");
  EXPECT_EQ(said("prismatic", 1.0, false), "");
}

TEST(VerifyCrafted, AQuaternionHasALength) {
  verify::Model model;
  model.links = {"base"};
  model.jointOf = {0};
  model.joints = {{.name = "fly", .kind = verify::JointKind::Floating, .child = 0, .variable = 0}};
  model.variables.resize(7, {"fly", -INFINITY, INFINITY, false});
  for (const double number : {0.0, 1e-7, 1e200}) {
    const std::vector<double> pose{0.0, 0.0, 0.0, 0.0, 0.0, number, number};
    EXPECT_EQ(refusalOf([&] { verify::Motion(model, pose, pose); }),
              "joint fly: a quaternion has no direction")
        << number;
  }
}

TEST(VerifyCrafted, ModelsThatWouldTakeHoursAreRefused) {
  EXPECT_EQ(refusalOfModel([](Json& model) {
              for (int i = 0; i < 9'999; ++i) model["links"].push_back(std::to_string(i));
            }),
            "model: more than 10000 links");
  EXPECT_EQ(refusalOfModel([](Json& model) {
              for (int i = 0; i < 3'163; ++i)
                model["bodies"].push_back(
                    {{"name", std::to_string(i)}, {"link", "arm"}, {"shapes", Json::array()}});
            }),
            "model: more than 10000000 pairs of bodies");
}

std::string refusalOfMesh(const verify::Surface& surface) {
  std::vector<double> numbers;
  std::vector<std::uint32_t> corners;
  for (const Vector3d& vertex : surface.vertices)
    numbers.insert(numbers.end(), vertex.begin(), vertex.end());
  for (const auto& triangle : surface.triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  const Json mesh = {{"type", "mesh"},
                     {"vertices", verify::base64Of(numbers)},
                     {"triangles", verify::base64Of(corners)},
                     {"solid", true}};
  verify::ShapeParts parts;
  return refusalOf(
      [&] { verify::readShape(mesh, Eigen::Isometry3d::Identity(), "body b", parts); });
}

/// By any of these a closed surface would seem to be an open one, which has no inside.
TEST(VerifyCrafted, ASolidMeshIsWelded) {
  EXPECT_EQ(refusalOfMesh(tetrahedron()), "");
  verify::Surface torn = tetrahedron();
  torn.vertices.emplace_back(-0.0, 0.0, 1.0);
  torn.triangles[3][2] = 4;
  EXPECT_EQ(refusalOfMesh(torn), "body b: two vertices of a solid mesh are at the same place");
  verify::Surface needle = tetrahedron();
  needle.triangles.push_back({0, 0, 1});
  EXPECT_EQ(refusalOfMesh(needle), "body b: a triangle of a solid mesh has a corner twice");
}

TEST(VerifyCrafted, AMeshWithoutTrianglesIsRefused) {
  for (const bool solid : {false, true}) {
    const Json mesh = {{"type", "mesh"}, {"vertices", ""}, {"triangles", ""}, {"solid", solid}};
    verify::ShapeParts parts;
    EXPECT_EQ(refusalOf([&] {
                verify::readShape(mesh, Eigen::Isometry3d::Identity(), "body b, shape 1", parts);
              }),
              "body b, shape 1: a mesh without triangles");
  }
}

}  // namespace
}  // namespace swept::test
