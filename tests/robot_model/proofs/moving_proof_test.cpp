// SPDX-License-Identifier: BSD-3-Clause
// Proofs of trajectories beside obstacles that move: by hand, of random ones, and forged.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "model_robots.hpp"
#include "random_trajectories.hpp"
#include "sliding_cube.hpp"
#include "swept/proofs/path_proof.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "verify/check.hpp"

namespace swept::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Isometry3d;
using Eigen::Translation3d;
using Eigen::Vector3d;
using testing::HasSubstr;
using verify::Json;

Json jsonOf(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return Json::parse(std::string(std::istreambuf_iterator<char>(stream), {}));
}

/// A cube of 0.2 m stands at x = 0 for 4 s. A bar of 1 x 0.1 x 0.1 m comes along y from -2 m,
/// passes at z = 0.5 m at 2 s, where it has turned by a quarter, and goes on to 2 m at 4 s.
class MovingProof : public testing::Test {
 protected:
  static Checker checkerWith(double height, double turn) {
    const auto at = [&](double y, double angle) {
      return Isometry3d(Translation3d(0.0, y, height) * AngleAxisd(angle, Vector3d::UnitZ()));
    };
    return Checker(slidingCube(), "all", std::make_shared<const World>())
        .withObstacle(
            {.name = "bar",
             .parts = {{makeBox({1.0, 0.1, 0.1}), Isometry3d::Identity()}},
             .waypoints = {
                 {1.0, at(-2.0, 0.0)}, {3.0, at(0.0, 0.5 * turn)}, {5.0, at(2.0, turn)}}});
  }
  static JointTrajectory standing() {
    return {.variables = {"x", "z"}, .points = {{0.0, {0, 0}, {}, {}}, {4.0, {0, 0}, {}, {}}}};
  }
  static TrajectoryCertificate certify(const Checker& checker, const JointTrajectory& trajectory,
                                       double clock) {
    Workspace workspace(checker);
    return checker.certifyTrajectory(controllerCurve(trajectory), workspace,
                                     {.clock = clock, .clearances = true});
  }
  std::filesystem::path write(const Checker& checker, double clock = 1.0) const {
    const std::filesystem::path file = folder_.path() / "proof.json";
    EXPECT_EQ(writeTrajectoryProof(file, checker, standing(), certify(checker, standing(), clock),
                                   {}, clock)
                  .missing,
              "");
    return file;
  }
  std::string refusalOf(const Json& path) const {
    const std::filesystem::path file = folder_.path() / "changed.json";
    std::ofstream(file) << path.dump();
    return verifyProof(file).refusal;
  }
  /// What is said of a file whose model was changed and signed again.
  std::string refusalOfSigned(Json path, const std::function<void(Json&)>& change) const {
    change(path);
    Json& digests = path["proof"]["digests"];
    const Json own = verify::digestsOf(path["model"]);
    for (const auto& [key, digest] : own.items()) digests[key] = digest;
    digests["claims"] = verify::claimDigests(path);
    return refusalOf(path);
  }
  static std::string usageError(const std::function<void()>& action) {
    try {
      action();
    } catch (const UsageError& error) {
      return error.what();
    }
    return {};
  }

  TemporaryFolder folder_;
};

TEST_F(MovingProof, HoldsAndKeepsWhatIsTrue) {
  for (const double turn : {0.0, 2.0}) {
    const Checker checker = checkerWith(0.5, turn);
    const auto file = write(checker);
    for (const CheckedProof& proof : {verifyProof(file), verifyProof(file, checker)}) {
      EXPECT_EQ(proof.refusal, "");
      EXPECT_EQ(proof.pairs, 1U);
      EXPECT_EQ(proof.moving, std::vector<std::string>{"bar"});
      EXPECT_EQ(proof.clockBegin, 1.0);
      EXPECT_EQ(proof.clockEnd, 5.0);
      // 0.5 m less 0.1 and 0.05, where it passes.
      EXPECT_GT(proof.clearanceWorld, 0.5 * 0.35 - 0.01);
      EXPECT_LE(proof.clearanceWorld, 0.35);
    }
  }
}

TEST_F(MovingProof, EachNumberOfAnObstacleIsSigned) {
  const Json path = jsonOf(write(checkerWith(0.5, 2.0)));
  const std::string changed = "body bar: is not as it was when the path was certified";
  const auto bar = [](Json& json) -> Json& { return json["model"]["bodies"][0]; };
  Json own = path;
  ASSERT_EQ(bar(own)["name"], "cube");
  const auto with = [&](const std::function<void(Json&)>& change) {
    Json json = path;
    change(json["model"]["bodies"][1]);
    return refusalOf(json);
  };
  EXPECT_EQ(with([](Json& body) { body["waypoints"][1]["time"] = 3.5; }), changed);
  EXPECT_EQ(with([](Json& body) { body["waypoints"][1]["position"][2] = 0.6; }), changed);
  EXPECT_EQ(with([](Json& body) { body["waypoints"][1]["orientation"][0] = 0.1; }), changed);
  EXPECT_EQ(with([](Json& body) { body["waypoints"].erase(2); }), changed);
  EXPECT_EQ(with([](Json& body) { body["shapes"][0]["half_extents"] = {0.1, 0.1, 0.1}; }), changed);
  EXPECT_EQ(with([](Json& body) { body["shapes"][0]["pose"][9] = 0.1; }), changed);
  EXPECT_EQ(with([](Json& body) {
              body.erase("waypoints");
              body["link"] = nullptr;
            }),
            changed);
  Json late = path;
  late["clock"] = 1.5;
  EXPECT_EQ(refusalOf(late), "path file, clock: is not as it was when the path was certified");
  late.erase("clock");
  EXPECT_EQ(refusalOf(late), "path file, clock: is not there, and was when the path was certified");
}

TEST_F(MovingProof, WhatIsSignedAgainHasToHold) {
  const Json path = jsonOf(write(checkerWith(0.5, 2.0)));
  const auto bar = [](Json& json) -> Json& { return json["model"]["bodies"][1]; };
  EXPECT_EQ(refusalOfSigned(path, [](Json&) {}), "");
  const std::string place = "segment 1, cube - bar, ";
  // It passes at 0.1 m, through the cube; at another height, on another way, at another time.
  EXPECT_THAT(
      refusalOfSigned(path, [&](Json& json) { bar(json)["waypoints"][1]["position"][2] = 0.1; }),
      HasSubstr(place));
  EXPECT_THAT(
      refusalOfSigned(path, [&](Json& json) { bar(json)["waypoints"][0]["position"][2] = -5.0; }),
      HasSubstr(place));
  EXPECT_THAT(refusalOfSigned(path, [&](Json& json) { json["clock"] = -2.0; }), HasSubstr(place));
  EXPECT_THAT(refusalOfSigned(path, [&](Json& json) { bar(json)["waypoints"][0]["time"] = 2.9; }),
              HasSubstr(place));
  EXPECT_THAT(refusalOfSigned(path,
                              [&](Json& json) {
                                bar(json)["waypoints"][1]["orientation"] = {0.0, 0.8, 0.0, 0.6};
                              }),
              HasSubstr(place));
  // What knows no waypoints does not take it for a body that stands.
  EXPECT_EQ(refusalOfSigned(path, [&](Json& json) { bar(json).erase("waypoints"); }),
            "body bar: there is no link");
  EXPECT_EQ(refusalOfSigned(path, [&](Json& json) { bar(json)["link"] = nullptr; }),
            "body bar: it has a link, and waypoints");
  EXPECT_EQ(refusalOfSigned(path, [&](Json& json) { json.erase("clock"); }),
            "path: there is no clock");
  EXPECT_EQ(refusalOfSigned(path,
                            [&](Json& json) {
                              json.erase("trajectory");
                              json["proof"]["digests"].erase("points");
                            }),
            "body bar: it moves, and a path without times does not say when");
  EXPECT_EQ(refusalOfSigned(path,
                            [&](Json& json) {
                              json["model"]["bodies"].erase(1);
                              json["proof"]["segments"][0]["pairs"].clear();
                            }),
            "clock: nothing moves but the robot");
}

TEST_F(MovingProof, TheCheckersOwnWorldIsCompared) {
  const auto file = write(checkerWith(0.5, 2.0));
  EXPECT_EQ(verifyProof(file, checkerWith(0.6, 2.0)).refusal,
            "body bar: is not as it was when the path was certified");
  EXPECT_EQ(
      verifyProof(file, Checker(slidingCube(), "all", std::make_shared<const World>())).refusal,
      "body bar: is not there, and was when the path was certified");
}

TEST_F(MovingProof, IsNotWrittenOfWhatHasNone) {
  const std::filesystem::path file = folder_.path() / "proof.json";
  const Checker checker = checkerWith(0.5, 0.0);
  const std::vector<std::vector<double>> states{{0, 0, 0}, {0, 0.1, 1}};
  EXPECT_EQ(usageError([&] { writeProof(file, checker, states, certifyPath(checker, states)); }),
            "there is no proof of a path beside 'bar', which moves");
  // No time is between the two.
  const Isometry3d turned(AngleAxisd(3.1, Vector3d::UnitZ()));
  const Checker sudden =
      Checker(slidingCube(), "all", std::make_shared<const World>())
          .withObstacle(
              {.name = "bar",
               .parts = {{makeBox({1.0, 0.1, 0.1}), Isometry3d(Translation3d(0.0, 0.0, 9.0))}},
               .waypoints = {{1.0, Isometry3d::Identity()}, {std::nextafter(1.0, 2.0), turned}}});
  EXPECT_EQ(usageError([&] {
              writeTrajectoryProof(file, sudden, standing(), certify(sudden, standing(), 1.0), {},
                                   1.0);
            }),
            "'bar' turns by about half a turn from waypoint 1 to the next, and no time is between "
            "the two");
}

TEST_F(MovingProof, HoldsWhereABarTurnsByHalfATurn) {
  for (const double turn : {6.2, 2.0 * std::numbers::pi}) {
    const Checker checker = checkerWith(0.5, turn);
    const auto file = write(checker);
    for (const CheckedProof& proof : {verifyProof(file), verifyProof(file, checker)}) {
      EXPECT_EQ(proof.refusal, "");
      EXPECT_GT(proof.clearanceWorld, 0.5 * 0.35 - 0.01);
      EXPECT_LE(proof.clearanceWorld, 0.35);
    }
    // Half of each turn, on the way that the checker takes.
    const Json waypoints = jsonOf(file)["model"]["bodies"][1]["waypoints"];
    ASSERT_EQ(waypoints.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
      const double time = 1.0 + static_cast<double>(i);
      EXPECT_EQ(waypoints[i]["time"], time);
      const Isometry3d pose = checker.world().obstacles()[0].poseAt(time);
      const Json& turned = waypoints[i]["orientation"];
      const Eigen::Quaterniond own(turned[3], turned[0], turned[1], turned[2]);
      EXPECT_LT(own.angularDistance(Eigen::Quaterniond(pose.linear())), 1e-14);
      EXPECT_EQ(waypoints[i]["position"][1], pose.translation().y());
    }
  }
}

/// A bar that is hinged 0.6 m beside the cube, and reaches as far as its edge.
TEST_F(MovingProof, IsAboutTheWayRoundThatABarTurns) {
  const auto turning = [](double angle) {
    const auto at = [](double turned) {
      return Isometry3d(Translation3d(0.0, 0.6, 0.0) * AngleAxisd(turned, Vector3d::UnitZ()));
    };
    return Checker(slidingCube(), "all", std::make_shared<const World>())
        .withObstacle(
            {.name = "bar",
             .parts = {{makeBox({0.6, 0.05, 0.05}), Isometry3d(Translation3d(0.3, 0.0, 0.0))}},
             .waypoints = {{1.0, at(0.0)}, {5.0, at(angle)}}});
  };
  EXPECT_EQ(certify(turning(-3.1), standing(), 1.0).verdict, Verdict::Collision);
  const Checker checker = turning(3.1);
  const Json path = jsonOf(write(checker));
  EXPECT_EQ(verifyProof(folder_.path() / "proof.json", checker).refusal, "");
  const auto bar = [](Json& json) -> Json& { return json["model"]["bodies"][1]["waypoints"]; };
  EXPECT_EQ(refusalOfSigned(path, [&](Json&) {}), "");
  // The other way round, and without saying so.
  EXPECT_THAT(refusalOfSigned(path,
                              [&](Json& json) {
                                Json& turned = bar(json)[1]["orientation"];
                                turned[2] = -turned[2].get<double>();
                              }),
              HasSubstr("bar"));
  EXPECT_THAT(refusalOfSigned(path, [&](Json& json) { bar(json).erase(1); }),
              HasSubstr("which way round is not told"));
}

/// Bars that fly past an arm, turning, with waypoints within the pieces of its curve. Refuted by
/// distances at many times, which the checker computes otherwise.
TEST(RandomMovingProof, HoldsOfNearlyAllThatIsFree) {
  const Checker plain(modelRobot("rook7"), "arm", std::make_shared<const World>());
  RandomTrajectories random(plain, 11);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "proof.json";
  int made = 0, touching = 0, free = 0, proven = 0;
  for (int i = 0; i < 40; ++i) {
    const Spline spline = i % 3 == 0   ? Spline::Linear
                          : i % 3 == 1 ? Spline::Cubic
                                       : Spline::Quintic;
    const JointTrajectory trajectory =
        random.make({0.0, -0.3, 0.0, 1.9, 0.0, 1.54, 0.0}, 3, 0.4, spline);
    const double clock = random.uniform(-2.0, 2.0);
    const double begin = clock + trajectory.points.front().time;
    const double end = clock + trajectory.points.back().time;
    MovingObstacle bar{.name = "bar",
                       .parts = {{makeBox({0.5, 0.08, 0.08}), Isometry3d::Identity()}},
                       .waypoints = {}};
    AngleAxisd turn = AngleAxisd::Identity();
    double time = begin - random.uniform(0.0, 0.3);
    for (int k = 0; k < 4; ++k) {
      const Vector3d axis(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      turn = AngleAxisd(random.uniform(0.0, i % 4 == 0 ? 0.0 : 1.5), axis.normalized()) * turn;
      bar.waypoints.push_back(
          {time, Translation3d(random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9),
                               random.uniform(0.2, 1.2)) *
                     turn});
      time += random.uniform(0.2, 0.6) * (end - begin);
    }
    const Checker checker = plain.withObstacle(bar);
    Workspace workspace(checker);
    const TrajectoryCertificate certificate = checker.certifyTrajectory(
        controllerCurve(trajectory), workspace, {.clock = clock, .clearances = true});
    ++made;
    touching += certificate.verdict == Verdict::Collision ? 1 : 0;
    if (certificate.verdict != Verdict::Free || !certificate.violations.empty()) continue;
    ++free;
    if (!writeTrajectoryProof(file, checker, trajectory, certificate, {}, clock).isWritten())
      continue;
    ++proven;
    const CheckedProof proof = verifyProof(file, checker);
    EXPECT_EQ(proof.refusal, "");
    EXPECT_GT(proof.clearance, 0.0);
    EXPECT_LE(proof.clearanceWorld, certificate.world->upper);
    const PiecewisePolynomial curve = controllerCurve(trajectory);
    for (int k = 0; k <= 100; ++k) {
      const double at = curve.begin() + 0.01 * k * curve.duration();
      const Eigen::VectorXd q = curve.position(at);
      std::vector<double> state(q.begin(), q.end());
      state.push_back(clock + at);
      EXPECT_GT(checker.reportState(state, workspace).world.clearance + 1e-6, proof.clearanceWorld);
    }
    // At another time of the clock it is another proof.
    EXPECT_EQ(verifyProof(file).moving.size(), 1U);
  }
  std::cout << made << " made, " << touching << " touch, " << free << " free, " << proven
            << " proven" << std::endl;
  EXPECT_GE(touching, 4);
  EXPECT_GE(free, 10);
  EXPECT_GE(10 * proven, 9 * free);
}

}  // namespace
}  // namespace swept::test
