// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "verify/check.hpp"
#include "verify/encoding.hpp"
#include "verify/inside.hpp"
#include "verify/motion.hpp"

/// Files whose numbers take each other back, overflow or underflow: what doubles make of them is
/// not what they say.
namespace swept::test {
namespace {

using Eigen::Vector3d;
using Json = nlohmann::ordered_json;
using testing::HasSubstr;

const Json kHere = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0};

Json poseAt(double x, double y = 0.0) {
  Json pose = kHere;
  pose[9] = x;
  pose[10] = y;
  return pose;
}

Json sphere(double radius, const Json& pose) {
  return {{"type", "sphere"}, {"radius", radius}, {"pose", pose}};
}

Json hull(const std::vector<double>& numbers, const Json& pose) {
  return {{"type", "convex"},
          {"vertices", verify::base64Of(std::span<const double>(numbers))},
          {"error", 0.0},
          {"pose", pose}};
}

/// A link `tip` that slides along x by multiplier * value + offset, and a wall.
struct Forged {
  double value = 0.0, multiplier = 1.0, offset = 0.0;
  Json tip = sphere(0.1, kHere), wall = sphere(0.1, poseAt(1.0));
  Json direction = {1.0, 0.0, 0.0};
  double bound = 0.1;
  double margin = 0.0;

  Json model() const {
    Json model = {{"links", {"base", "tip"}},
                  {"variables",
                   {{{"name", "s"}, {"lower", nullptr}, {"upper", nullptr}, {"cyclic", false}}}}};
    model["joints"] = {{{"name", "s"},
                        {"type", "prismatic"},
                        {"parent", "base"},
                        {"child", "tip"},
                        {"pose", kHere},
                        {"axis", {1.0, 0.0, 0.0}},
                        {"variable", 0u},
                        {"multiplier", multiplier},
                        {"offset", offset}}};
    model["bodies"] = {{{"name", "tip"}, {"link", "tip"}, {"shapes", {tip}}},
                       {{"name", "wall"}, {"link", nullptr}, {"shapes", {wall}}}};
    model["margin"] = margin;
    model["paddings"] = Json::object();
    model["allowed"] = Json::array();
    return model;
  }

  /// With digests that fit.
  Json path() const {
    const Json state = Json::array({value});
    Json path = {{"joint_names", {"s"}}, {"margin", margin}, {"model", model()}};
    path["states"] = {state, state};
    Json pair = {{"a", "tip"}, {"b", "wall"}};
    if (wall.contains("normal")) {
      pair["flats"] = {Json::array({Json::array({0.0, 1.0, Json::array({1, bound})})})};
    } else {
      Json plane = direction;
      plane.push_back(bound);
      pair["intervals"] = Json::array({Json::array({0.0, 1.0, plane})});
    }
    pair["digest"] = verify::pairDigest(pair);
    path["proof"]["digests"] = verify::digestsOf(path["model"]);
    path["proof"]["digests"]["claims"] = verify::claimDigests(path);
    path["proof"]["segments"] = {
        {{"states_digest", verify::stateDigest(state, state)}, {"pairs", {pair}}}};
    return path;
  }

  /// Empty: it is verified.
  std::string refusal() const {
    const Json forged = path();
    try {
      verify::checkProof(forged, forged["model"]);
    } catch (const verify::Refusal& refusal) {
      return refusal.what();
    }
    return "";
  }
};

const std::string kPlace = "segment 1, tip - wall, 0 to 1: the bound ";

/// 3 (10^15 + 1/8) - 3 10^15 is 3/8, and 1/2 in doubles. The spheres overlap by a centimetre, and
/// the plane between them was believed to leave 0.1 m.
TEST(VerifyRounding, AnOffsetThatTakesBackTheValueProvesNothing) {
  const Forged forged{.value = 1e15 + 0.125,
                      .multiplier = 3.0,
                      .offset = -3e15,
                      .wall = sphere(0.1, poseAt(0.185)),
                      .direction = {-1.0, 0.0, 0.0}};
  EXPECT_THAT(forged.refusal(), HasSubstr(kPlace + "0.1 m is not proven, only -"));
  EXPECT_EQ(forged.path()["model"]["joints"][0]["offset"], -3e15);
  // The same place, made of numbers that leave their digits.
  const Forged small{.value = 1.125,
                     .multiplier = 3.0,
                     .offset = -3.0,
                     .wall = sphere(0.1, poseAt(-0.01)),
                     .direction = {-1.0, 0.0, 0.0}};
  EXPECT_EQ(small.refusal(), "");
}

/// The turned corner 0.6 10^15 m from the origin of its shape is known to 0.06 m.
TEST(VerifyRounding, APoseThatTakesBackTheCoordinatesProvesNothing) {
  const auto refusal = [](double far) {
    Json pose = poseAt(-0.6 * far, -0.8 * far);
    pose[0] = pose[4] = 0.6;
    pose[1] = -0.8;
    pose[3] = 0.8;
    return Forged{.tip = hull({far, 0.0, 0.0}, pose)}.refusal();
  };
  EXPECT_EQ(refusal(1.0), "");
  EXPECT_EQ(refusal(1e6), "");
  EXPECT_THAT(refusal(1e15), HasSubstr(kPlace + "0.1 m is not proven, only -"));
}

TEST(VerifyRounding, APoseThatTakesBackTheOffsetOfAWallProvesNothing) {
  const auto refusal = [](double far) {
    const Json wall = {{"type", "half_space"},
                       {"normal", {0.6, 0.8, 0.0}},
                       {"offset", -far - 1.0},
                       {"pose", poseAt(0.6 * far, 0.8 * far)}};
    return Forged{.wall = wall}.refusal();
  };
  EXPECT_EQ(refusal(1.0), "");
  EXPECT_EQ(refusal(1e6), "");
  EXPECT_THAT(refusal(1e15), HasSubstr(kPlace + "0.1 m is not proven, only -"));
}

TEST(VerifyRounding, WhatOverflowsProvesNothing) {
  for (const double number : {1e31, 1e120, 1e160, 1.7e308}) {
    EXPECT_THAT((Forged{.value = number}).refusal(), HasSubstr("m is not proven, only ")) << number;
    EXPECT_THAT((Forged{.value = number, .multiplier = number, .offset = -number}).refusal(),
                HasSubstr("m is not proven, only "))
        << number;
  }
  // Turned, such a corner's coordinates are infinite or no numbers, which no plane would be above.
  Json turned = kHere;
  turned[0] = turned[4] = 0.6;
  turned[1] = -0.8;
  turned[3] = 0.8;
  for (const double number : {1.1e150, 1.7e308})
    EXPECT_EQ((Forged{.tip = hull({0.0, 0.0, 0.0, number, number, -number}, turned)}).refusal(),
              "body tip: it reaches farther than 1e150 m")
        << number;
}

/// Squares of 1e-170 are nothing, and lengths without them too: nothing would be taken off.
TEST(VerifyRounding, WhatUnderflowsProvesNothing) {
  const auto refusal = [](double unit) {
    return Forged{.tip = hull({0.0, 0.0, 0.0}, kHere),
                  .wall = hull({unit, 0.0, 0.0}, kHere),
                  .bound = 0.9 * unit}
        .refusal();
  };
  EXPECT_EQ(refusal(1e-90), "");
  EXPECT_THAT(refusal(1e-170), HasSubstr("m is not proven, only -1e-100 m is"));
}

/// Products of three lengths of 1e-107 m have no digits left, and many had the wrong sign.
TEST(VerifyRounding, WhatIsInsideIsNeverOutside) {
  std::mt19937_64 random(5);
  const auto drawn = [&random] {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    return Vector3d(uniform(random), uniform(random), uniform(random));
  };
  for (const double unit : {1.0, 1e-90, 1e-107}) {
    int inside = 0;
    for (int i = 0; i < 2000; ++i) {
      std::vector<Vector3d> corners{drawn(), drawn(), drawn(), drawn()};
      Vector3d sum = Vector3d::Zero();
      double weights = 0.0;
      for (Vector3d& corner : corners) {
        const double weight = drawn().cwiseAbs().prod();
        sum += weight * corner;
        weights += weight;
        corner *= unit;
      }
      const verify::Surface surface{corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
      const verify::Side side = verify::Enclosure(surface).sideOf(unit / weights * sum);
      EXPECT_NE(side, verify::Side::Outside) << unit << ", tetrahedron " << i;
      inside += side == verify::Side::Inside ? 1 : 0;
    }
    EXPECT_EQ(inside, unit < 1e-100 ? 0 : 2000) << unit;
  }
}

/// Of the axis itself, a turn by half would take a point away by four times the error.
TEST(VerifyRounding, AxesAreOfLengthOne) {
  Json model = Forged{}.model();
  model["joints"][0]["axis"] = {0.6 * (1.0 + 9e-13), 0.8 * (1.0 + 9e-13), 0.0};
  const Vector3d axis = verify::readModel(model).joints[0].axis;
  EXPECT_LE(std::abs(axis.norm() - 1.0), 4e-16);
}

/// Of joints that slide, at either end of a motion.
TEST(VerifyRounding, ExtentsCountWhatPlacesAreMadeOf) {
  verify::Model model;
  model.links = {"link"};
  model.jointOf = {0};
  model.joints = {{.name = "joint",
                   .kind = verify::JointKind::Prismatic,
                   .child = 0,
                   .variable = 0,
                   .multiplier = -2.0,
                   .offset = 8.0}};
  model.variables.resize(7, {"joint", -INFINITY, INFINITY, false});
  const auto extent = [&](const std::vector<double>& from, const std::vector<double>& to) {
    const auto extentOf = [](const verify::Motion& motion) {
      return motion.bounds(0, -1, 0.5, 0.5, 0.5).extent;
    };
    const double there = extentOf(verify::Motion(model, from, to));
    EXPECT_EQ(extentOf(verify::Motion(model, to, from)), there);
    return there;
  };
  EXPECT_EQ(extent({4.0}, {3.0}), 16.5);
  model.joints[0].multiplier = 1.0;
  model.joints[0].offset = 0.0;
  model.joints[0].kind = verify::JointKind::Planar;
  model.joints[0].planarX = Vector3d::UnitY();
  EXPECT_EQ(extent({3.0, -4.0, 0.0}, {0.0, 0.0, 0.0}), 7.5);
  model.joints[0].kind = verify::JointKind::Floating;
  EXPECT_EQ(extent({1.0, -2.0, 4.0, 0.0, 0.0, 0.0, 1.0}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0}), 7.5);
}

}  // namespace
}  // namespace swept::test
