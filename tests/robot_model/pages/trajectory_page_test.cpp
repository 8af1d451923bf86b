// SPDX-License-Identifier: BSD-3-Clause
// Pages of curves in time, against the polynomials that they are of and places on a line.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "slide_page.hpp"
#include "transcript.hpp"

namespace swept {
namespace {

using nlohmann::json;
using test::dataOf;
using test::rideTo;
using test::slide;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kParts = 96, kFrames = 193;

template <typename Number>
std::vector<Number> unpacked(const std::string& base64) {
  static const std::string kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned held = 0, bits = 0;
  for (const char c : base64.substr(0, base64.find('='))) {
    held = held << 6 | static_cast<unsigned>(kDigits.find(c));
    bits += 6;
    if (bits < 8) continue;
    bits -= 8;
    bytes += static_cast<char>(held >> bits & 255U);
  }
  std::vector<Number> numbers(bytes.size() / sizeof(Number));
  std::memcpy(numbers.data(), bytes.data(), numbers.size() * sizeof(Number));
  return numbers;
}

double placeOf(const PiecewisePolynomial& curve, double share) {
  return curve.position(curve.begin() + share * curve.duration())[0];
}

TEST(TrajectoryPageTest, CurvesAreThereBitForBit) {
  const PiecewisePolynomial curve = rideTo(std::numbers::pi / 3, 0.1);
  Page page(slide());
  page.addTrajectory("ride", curve);
  const json data = dataOf(page);
  ASSERT_EQ(data["motions"].size(), 1U);
  const json& own = data["motions"][0]["curve"];
  EXPECT_EQ(unpacked<double>(own["knots"]), curve.knots());
  EXPECT_EQ(own["degrees"], json({5, 2, 1}));
  EXPECT_EQ(unpacked<double>(own["coefficients"]),
            (std::vector<double>{0, 0, 0, 1, 1, 1, 1, 1, 1, 1, std::numbers::pi / 3}));
  EXPECT_EQ(unpacked<double>(own["polyline"]), std::vector<double>());
  EXPECT_EQ(data["motions"][0]["label"], "ride");
  EXPECT_EQ(data["motions"][0]["from"], json({0.0}));
  EXPECT_EQ(data["motions"][0]["to"], json({std::numbers::pi / 3}));
  EXPECT_EQ(data["headline"], "trajectory: free");
  EXPECT_EQ(data["tone"], "good");
  EXPECT_TRUE(data["states"].empty());
}

/// Coefficients are piece by piece, and in a piece value by value.
TEST(TrajectoryPageTest, ValuesFollowEachOther) {
  const auto robot = Robot::parse(
      "<robot name='r'><link name='a'/><link name='b'/><link name='c'><collision><geometry>"
      "<sphere radius='0.1'/></geometry></collision></link><joint name='x' type='continuous'>"
      "<parent link='a'/><child link='b'/></joint><joint name='y' type='continuous'><parent "
      "link='b'/><child link='c'/></joint></robot>",
      "r.urdf");
  Eigen::MatrixXd first(2, 3), second(2, 2);
  first << 1, 2, 3, 4, 5, 6;
  second << 3, 7, 6, 8;
  std::vector<Eigen::MatrixXd> pieces;
  pieces.push_back(first);
  pieces.push_back(second);
  Page page(std::make_shared<const Checker>(robot, "all", std::make_shared<const World>()));
  const std::vector<std::vector<double>> polyline{{1, 4}, {7, 8}};
  page.addTrajectory("t", {{0, 1, 2}, pieces}, {}, polyline);
  const json data = dataOf(page);
  const json& own = data["motions"][0]["curve"];
  EXPECT_EQ(unpacked<double>(own["coefficients"]),
            (std::vector<double>{1, 2, 3, 4, 5, 6, 3, 7, 6, 8}));
  EXPECT_EQ(unpacked<double>(own["polyline"]), (std::vector<double>{1, 4, 7, 8}));
  EXPECT_EQ(own["limits"]["lower"], json({nullptr, nullptr}));
  EXPECT_EQ(own["clearance"]["world"]["lower"], nullptr);
  EXPECT_EQ(data["headline"], "trajectory: free, nothing was checked");
}

/// The wall begins at 1.45 m, and the ball is 0.1 m ahead of its middle.
TEST(TrajectoryPageTest, PartsAreProvenByThemselves) {
  const PiecewisePolynomial curve = rideTo(1.32);
  Page page(slide());
  page.addTrajectory("ride", curve);
  const json data = dataOf(page);
  const json& pieces = data["motions"][0]["pieces"];
  ASSERT_EQ(pieces["tiers"].size(), kParts);
  double before = kInfinity;
  for (std::size_t i = 0; i < kParts; ++i) {
    EXPECT_TRUE(pieces["tiers"][i] == "lanes" || pieces["tiers"][i] == "exact");
    const double left = 1.35 - placeOf(curve, static_cast<double>(i + 1) / kParts);
    EXPECT_LE(pieces["lower"][i].get<double>(), left + 1e-12) << i;
    EXPECT_GE(pieces["lower"][i].get<double>(), left - 1.01e-4) << i;
    EXPECT_EQ(pieces["lower"][i], pieces["lower_world"][i]);
    EXPECT_EQ(pieces["lower_self"][i], nullptr);
    EXPECT_LE(left, before);
    before = left;
  }
  const json& least = data["motions"][0]["curve"]["clearance"]["world"];
  EXPECT_NEAR(least["lower"].get<double>(), 0.03, 1.01e-4);
  EXPECT_GE(least["upper"].get<double>(), 0.03 - 1e-12);
  EXPECT_EQ(least["body_a"], "ball");
  EXPECT_EQ(least["body_b"], "wall");
  EXPECT_EQ(least["piece"], 2);
  EXPECT_NEAR(least["time"].get<double>(), 3.25, 0.04);
}

TEST(TrajectoryPageTest, ContactsAreTheCheckers) {
  const PiecewisePolynomial curve = rideTo(2.0, 0.5);
  Page page(slide());
  page.addTrajectory("ride", curve);
  const json data = dataOf(page);
  EXPECT_EQ(data["headline"], "trajectory: in collision");
  EXPECT_EQ(data["tone"], "bad");
  const json& motion = data["motions"][0];
  EXPECT_EQ(motion["verdict"], "collision");
  // At 1.35 m, of 1 m within the last second.
  EXPECT_NEAR(motion["curve"]["contact"]["time"].get<double>(), 0.5 + 2.25 + 0.35, 1e-3);
  EXPECT_EQ(motion["curve"]["contact"]["piece"], 2);
  EXPECT_NEAR(motion["curve"]["contact"]["values"][0].get<double>(), 1.35, 1e-3);
  EXPECT_EQ(motion["curve"]["contact"]["beside"], false);
  EXPECT_NEAR(motion["curve"]["free_until"].get<double>(), 0.5 + 2.25 + 0.35, 1e-3);
  EXPECT_NEAR(motion["free_until"].get<double>(), 2.6 / 3.25, 1e-3);
  EXPECT_NEAR(motion["contacts"][0]["t"].get<double>(), 2.6 / 3.25, 1e-3);
  EXPECT_NEAR(motion["contacts"][0]["point_a"][0].get<double>(), 1.45, 1e-3);
  EXPECT_EQ(motion["contacts"][0]["body_b"], "wall");
  EXPECT_EQ(motion["curve"]["undecided"], nullptr);
  for (std::size_t i = 0; i < kParts; ++i) {
    // It is out on the other side 0.3 m later.
    const bool meets = placeOf(curve, static_cast<double>(i + 1) / kParts) > 1.35 &&
                       placeOf(curve, static_cast<double>(i) / kParts) < 1.65;
    EXPECT_EQ(motion["pieces"]["tiers"][i] == "collision", meets) << i;
    if (meets) {
      EXPECT_EQ(motion["pieces"]["lower"][i], 0.0);
    }
  }
}

TEST(TrajectoryPageTest, TubesAreThere) {
  CheckerOptions options;
  options.tracking.rotation = 0.5;
  options.tracking.joints["x"].translation = 0.1;
  Page page(slide(1.5, options));
  page.addTrajectory("near", rideTo(1.3));
  const json data = dataOf(page);
  const json& motion = data["motions"][0];
  EXPECT_EQ(motion["curve"]["tube"], json({0.1}));
  // The curve ends at 1.3 m; 0.1 m beside it the ball is in the wall from 1.25 m on.
  EXPECT_EQ(motion["verdict"], "collision");
  EXPECT_EQ(motion["curve"]["contact"]["beside"], true);
  EXPECT_NEAR(motion["curve"]["contact"]["values"][0].get<double>(), 1.35, 2e-3);
  // Distances are those of the curve itself.
  EXPECT_NEAR(motion["curve"]["clearance"]["world"]["lower"].get<double>(), 0.05, 1.01e-4);
  Page without(slide());
  without.addTrajectory("near", rideTo(1.3));
  EXPECT_EQ(dataOf(without)["motions"][0]["curve"]["tube"], nullptr);
}

TEST(TrajectoryPageTest, UndecidedPlacesAreTheCheckers) {
  const auto checker = slide();
  const PiecewisePolynomial curve = rideTo(1.35 - 1e-13);  // within rounding of the wall
  Page page(checker);
  page.addTrajectory("graze", curve);
  Workspace workspace(*checker);
  const TrajectoryCertificate found = checker->certifyTrajectory(curve, workspace);
  const json data = dataOf(page);
  const json& motion = data["motions"][0];
  ASSERT_EQ(found.verdict, Verdict::Undecided);
  EXPECT_EQ(motion["verdict"], "undecided");
  EXPECT_EQ(motion["curve"]["undecided"]["time"], found.undecided->time);
  EXPECT_EQ(motion["curve"]["undecided"]["piece"], 2);
  EXPECT_EQ(motion["curve"]["free_until"], found.freeUntil);
  EXPECT_EQ(motion["pieces"]["tiers"][kParts - 1], "undecided");
  EXPECT_EQ(data["headline"], "trajectory: undecided");
  EXPECT_EQ(data["tone"], "unsure");
}

TEST(TrajectoryPageTest, LimitsAndWhereTheyAreLeft) {
  Page page(slide(9.0));
  TrajectoryQuery query;
  query.limits = RateLimits{.velocity = {1.5}, .acceleration = {kInfinity}, .jerk = {100.0}};
  page.addTrajectory("fast", rideTo(3.5), query);
  const json data = dataOf(page);
  const json& own = data["motions"][0]["curve"];
  EXPECT_EQ(own["limits"]["lower"], json({-3.0}));
  EXPECT_EQ(own["limits"]["upper"], json({3.0}));
  EXPECT_EQ(own["limits"]["velocity"], json({1.5}));
  EXPECT_EQ(own["limits"]["acceleration"], json::array({nullptr}));
  EXPECT_EQ(own["limits"]["jerk"], json({100.0}));
  ASSERT_EQ(own["violations"].size(), 2U);
  EXPECT_EQ(own["violations"][0]["kind"], "position");
  EXPECT_EQ(own["violations"][0]["variable"], "x");
  EXPECT_EQ(own["violations"][0]["value"], 3.5);
  EXPECT_EQ(own["violations"][0]["limit"], 3.0);
  EXPECT_EQ(own["violations"][0]["time"], 3.25);
  EXPECT_EQ(own["violations"][1]["kind"], "velocity");
  EXPECT_EQ(own["violations"][1]["value"], 2.5);
  EXPECT_EQ(data["tone"], "unsure");
  EXPECT_EQ(data["headline"], "trajectory: undecided, beyond 2 limits");
  // What is free but too fast is not green either.
  Page tooFast(slide());
  query.limits->velocity = {0.25};
  tooFast.addTrajectory("fast", rideTo(1.3), query);
  EXPECT_EQ(dataOf(tooFast)["headline"], "trajectory: free, beyond 1 limit");
  EXPECT_EQ(dataOf(tooFast)["tone"], "unsure");
  Page unasked(slide());
  unasked.addTrajectory("fast", rideTo(1.3));
  EXPECT_EQ(dataOf(unasked)["motions"][0]["curve"]["limits"]["velocity"], nullptr);
}

/// Beyond a limit, too, where nothing is proven.
TEST(TrajectoryPageTest, FramesAreAtEvenTimes) {
  const PiecewisePolynomial curve = rideTo(4.0);
  Page page(slide(9.0));
  page.addTrajectory("ride", curve);
  const json data = dataOf(page);
  ASSERT_EQ(data["frames"]["count"], kFrames);
  EXPECT_EQ(data["motions"][0]["steps"], kFrames - 1);
  ASSERT_EQ(data["frames"]["links"], json({"ball"}));
  const std::vector<float> poses = unpacked<float>(data["frames"]["poses"]);
  ASSERT_EQ(poses.size(), 7U * kFrames);
  for (std::size_t i = 0; i < kFrames; ++i)
    EXPECT_NEAR(poses[7 * i], placeOf(curve, static_cast<double>(i) / (kFrames - 1)), 1e-6) << i;
}

TEST(TrajectoryPageTest, TrajectoriesAreShownInTurn) {
  Page page(slide());
  TrajectoryQuery query;
  query.limits = RateLimits{.velocity = {0.5}, .acceleration = {1.0}, .jerk = {kInfinity}};
  page.addTrajectory("there", rideTo(1.3));
  page.addTrajectory("through", rideTo(2.0));
  page.addTrajectory("fast", rideTo(1.3), query);
  const json data = dataOf(page);
  EXPECT_EQ(data["headline"], "3 trajectories: 2 free, 1 in collision; 1 beyond limits");
  ASSERT_EQ(data["paths"].size(), 3U);
  ASSERT_EQ(data["motions"].size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(data["motions"][i]["path"], i);
    EXPECT_EQ(data["motions"][i]["first_frame"], i * kFrames);
    EXPECT_EQ(data["paths"][i]["label"], data["motions"][i]["label"]);
  }
  EXPECT_EQ(data["paths"][0]["tone"], "good");
  EXPECT_EQ(data["paths"][1]["tone"], "bad");
}

/// A body on a floating joint that goes along x and turns by a right angle about z, then rests.
TEST(TrajectoryPageTest, OrientationsTurnEvenly) {
  const auto robot = Robot::parse(
      "<robot name='r'><link name='a'/><link name='b'><collision><geometry><sphere radius='0.1'/>"
      "</geometry></collision></link><joint name='j' type='floating'><parent link='a'/><child "
      "link='b'/></joint></robot>",
      "r.urdf");
  const double half = std::sqrt(0.5);
  Eigen::MatrixXd turns(7, 2), rests(7, 4);
  turns << 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, half, 1, half;
  for (int k = 0; k < 4; ++k) rests.col(k) = turns.col(1);
  std::vector<Eigen::MatrixXd> pieces;
  pieces.push_back(turns);
  pieces.push_back(rests);
  CheckerOptions options;
  options.tracking = {{.rotation = 0.1, .translation = 0.01}, {}};
  Page page(
      std::make_shared<const Checker>(robot, "all", std::make_shared<const World>(), options));
  page.addTrajectory("turn", {{0, 1, 2}, pieces});
  const json data = dataOf(page);
  EXPECT_EQ(data["motions"][0]["curve"]["tube"],
            json({0.01, 0.01, 0.01, nullptr, nullptr, nullptr, nullptr}));
  const std::vector<float> poses = unpacked<float>(data["frames"]["poses"]);
  ASSERT_EQ(poses.size(), 7U * kFrames);
  for (std::size_t i = 0; i < kFrames; ++i) {
    const double time = std::min(1.0, static_cast<double>(i) / 96);
    EXPECT_NEAR(poses[7 * i], time, 1e-6);
    EXPECT_NEAR(poses[7 * i + 5], std::sin(time * std::numbers::pi / 4), 1e-6) << i;
    EXPECT_NEAR(poses[7 * i + 6], std::cos(time * std::numbers::pi / 4), 1e-6) << i;
  }
}

TEST(TrajectoryPageTest, IsTheSameInEveryFloatingPointEnvironment) {
  test::expectSameInEveryEnvironment({{"html", [](test::Transcript& t) {
                                         Page page(slide());
                                         page.addTrajectory("ride", rideTo(1.7));
                                         t.add(page.html());
                                       }}});
}

}  // namespace
}  // namespace swept
