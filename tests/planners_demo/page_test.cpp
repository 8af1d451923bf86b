// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "../robot_model/model_robots.hpp"
#include "models_dir.hpp"
#include "page_data.hpp"
#include "swept/core/distance.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/inverse_kinematics.hpp"
#include "swept/robot_model/problems.hpp"

/// What a page holds is what the library says.
namespace swept::test {
namespace {

using nlohmann::json;

const std::string kRook = "models/robots/rook7/rook7.urdf";
const std::string kShelf = "models/scenes/shelf.yaml";

/// The same robot and world as the program's, loaded here.
std::shared_ptr<const Robot> rook() {
  static const auto robot = modelRobot("rook7");
  return robot;
}

std::vector<double> valuesOf(const json& array) {
  return array.get<std::vector<double>>();
}

std::vector<double> at(const Checker& checker, const json& motion, double t) {
  const Eigen::VectorXd q =
      checker.interpolate(valuesOf(motion["from"]), valuesOf(motion["to"]), t);
  return {q.begin(), q.end()};
}

/// A path in the shelf, planned once.
class PlannedPage : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!programHasPages()) return;
    const TemporaryFolder folder;
    sharedRun =
        runSwept({"plan", kRook, "--group", "arm", "--problems", "models/problems.json", "--set",
                  "shelf", "--index", "1", "--seed", "2", "--html", folder.path("page.html")});
    sharedLine = "page written to " + folder.path("page.html") + "\n";
    sharedHtml = folder.read("page.html");
    sharedData = pageData(sharedHtml);
    const PlanningProblem problem =
        ProblemFile::load(modelsDir() + "/problems.json").problem("shelf", 1);
    sharedChecker =
        std::make_unique<Checker>(rook(), "arm", std::make_shared<World>(problem.world));
  }
  static void TearDownTestSuite() { sharedChecker.reset(); }
  void SetUp() override {
    if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  }

  static inline Outcome sharedRun;
  static inline std::string sharedHtml, sharedLine;
  static inline json sharedData;
  static inline std::unique_ptr<Checker> sharedChecker;
};

TEST_F(PlannedPage, IsWrittenAndSaysSo) {
  EXPECT_EQ(sharedRun.exitCode, 0) << sharedRun.err;
  EXPECT_THAT(sharedRun.out, testing::EndsWith(sharedLine));
  EXPECT_LT(sharedHtml.size(), 5'000'000u);
  EXPECT_EQ(sharedData["tone"], "good");
  const auto segments = sharedData["motions"].size();
  EXPECT_EQ(sharedData["headline"],
            "solved: " + std::to_string(segments) + " segments, all proven free");
}

TEST_F(PlannedPage, NeedsNoNetwork) {
  EXPECT_THAT(sharedHtml, testing::HasSubstr("default-src 'none'"));
  EXPECT_THAT(sharedHtml, testing::HasSubstr("Copyright (c) 2010-2019 three.js authors"));
  EXPECT_THAT(sharedHtml, testing::Not(testing::HasSubstr("<link")));
  EXPECT_THAT(sharedHtml, testing::Not(testing::HasSubstr("<script src")));
  EXPECT_THAT(sharedHtml, testing::Not(testing::HasSubstr("@import")));
  EXPECT_THAT(sharedHtml, testing::Not(testing::ContainsRegex("(src|href) *= *[\"']https?:")));
}

TEST_F(PlannedPage, LinksAreWhereForwardKinematicsPutsThem) {
  for (const char* const link : {"link7", "link4", "hand"}) {
    const InverseKinematics kinematics(rook(), "arm", link);
    for (const json& motion : sharedData["motions"]) {
      const int steps = motion["steps"];
      for (int i = 0; i <= steps; ++i) {
        const Eigen::Isometry3d expected =
            kinematics.pose(at(*sharedChecker, motion, static_cast<double>(i) / steps));
        const std::size_t frame = motion["first_frame"].get<std::size_t>() + std::size_t(i);
        EXPECT_LT(poseError(linkPose(sharedData, frame, link), expected).position, 1e-6);
        EXPECT_LT(poseError(linkPose(sharedData, frame, link), expected).angle, 1e-5);
      }
    }
  }
  EXPECT_EQ(sharedData["tip"], "link7");
}

TEST_F(PlannedPage, MotionsFollowEachOtherFromStartToGoal) {
  const PlanningProblem problem =
      ProblemFile::load(modelsDir() + "/problems.json").problem("shelf", 1);
  const json& motions = sharedData["motions"];
  EXPECT_EQ(valuesOf(motions.front()["from"]), problem.start);
  EXPECT_THAT(problem.goals, testing::Contains(valuesOf(motions.back()["to"])));
  for (std::size_t i = 1; i < motions.size(); ++i)
    EXPECT_EQ(motions[i]["from"], motions[i - 1]["to"]);
}

/// The bound of a part holds at states within it, and is not far below what is attained.
TEST_F(PlannedPage, BoundsOfPartsHoldAndAreTight) {
  Workspace workspace(*sharedChecker);
  int exact = 0, parts = 0;
  for (const json& motion : sharedData["motions"]) {
    const auto steps = static_cast<int>(motion["pieces"]["tiers"].size());
    for (int i = 0; i < steps; ++i, ++parts) {
      const std::string tier = motion["pieces"]["tiers"][std::size_t(i)];
      exact += tier == "exact";
      EXPECT_TRUE(tier == "lanes" || tier == "exact") << tier;
      const double lower = motion["pieces"]["lower"][std::size_t(i)];
      EXPECT_EQ(lower, std::min(motion["pieces"]["lower_world"][std::size_t(i)].get<double>(),
                                motion["pieces"]["lower_self"][std::size_t(i)].get<double>()));
      double least = std::numeric_limits<double>::infinity();
      for (int k = 0; k <= 4; ++k) {
        const auto q = at(*sharedChecker, motion, (i + 0.25 * k) / steps);
        const double distance = sharedChecker->signedClearance(q, workspace).upper;
        EXPECT_LE(lower, distance + 1e-9);
        least = std::min(least, distance);
      }
      // 1e-4 m is the accuracy asked for; the rest is what the robot moves between the samples.
      EXPECT_GE(motion["pieces"]["upper"][std::size_t(i)].get<double>(), lower);
      EXPECT_LE(motion["pieces"]["upper"][std::size_t(i)].get<double>(), least + 1.1e-4);
    }
  }
  EXPECT_GT(exact, 0);
  EXPECT_LT(exact, parts / 2);
}

TEST_F(PlannedPage, NearestPairOfAFrameIsTheReports) {
  const json& table = sharedData["clearances"];
  ASSERT_EQ(table["stride"], 1);
  const std::vector<float> distance = floats(table["distance"]);
  const std::vector<std::int32_t> partner = integers(table["partner"]);
  const std::size_t bodies = sharedData["bodies"].size();
  ASSERT_EQ(distance.size(), bodies * sharedData["frames"]["count"].get<std::size_t>());
  Workspace workspace(*sharedChecker);
  for (const json& motion : sharedData["motions"])
    for (const int i : {0, 7, 48}) {
      const StateReport report =
          sharedChecker->reportState(at(*sharedChecker, motion, i / 48.0), workspace);
      const std::size_t row = (motion["first_frame"].get<std::size_t>() + std::size_t(i)) * bodies;
      const auto first = distance.begin() + static_cast<std::ptrdiff_t>(row);
      const auto least = std::min_element(first, first + static_cast<std::ptrdiff_t>(bodies));
      EXPECT_NEAR(*least, report.clearance, 3e-5);
      const auto leastOf = [&](const char* kind) {
        const std::vector<float> all = floats(table[kind]["distance"]);
        const auto begin = all.begin() + static_cast<std::ptrdiff_t>(row);
        return *std::min_element(begin, begin + static_cast<std::ptrdiff_t>(bodies));
      };
      EXPECT_NEAR(leastOf("world"), report.world.clearance, 3e-5);
      EXPECT_NEAR(leastOf("self"), report.self.clearance, 3e-5);
      const auto at = static_cast<std::size_t>(least - first);
      const std::string a = sharedData["bodies"][at]["name"];
      const std::string b =
          sharedData["bodies"][static_cast<std::size_t>(partner[row + at])]["name"];
      EXPECT_EQ(std::minmax(a, b), std::minmax(report.nearestA.str(), report.nearestB.str()));
    }
}

TEST_F(PlannedPage, FactsAreTheRuns) {
  std::map<std::string, std::string> facts;
  for (const json& fact : sharedData["facts"]) facts[fact[0]] = fact[1];
  EXPECT_EQ(facts["planner"], "CertifiedConnect");
  EXPECT_EQ(facts["seed"], "2");
  EXPECT_EQ(facts["margin"], "0 m");
  EXPECT_EQ(facts["tolerance"], "0.001 m");
  EXPECT_EQ(facts["swept"], SWEPT_VERSION);
  EXPECT_THAT(sharedRun.out, testing::HasSubstr("\nclearance " +
                                                facts["least certified clearance"] + ", nearest "));
  EXPECT_THAT(facts["command"], testing::StartsWith("swept plan " + kRook + " --group arm"));
}

/// Every link's and body's triangles and sizes, as loaded.
TEST_F(PlannedPage, GeometryIsTheCheckedOne) {
  int meshes = 0;
  for (const Link& link : rook()->links())
    for (std::size_t k = 0; k < link.collision.size(); ++k) {
      const auto body = std::ranges::find_if(
          sharedData["bodies"], [&](const json& entry) { return entry["name"] == link.name; });
      ASSERT_NE(body, sharedData["bodies"].end()) << link.name;
      const json& part = (*body)["parts"][k];
      const Eigen::Isometry3d pose = poseOf(floats(part["pose"]), 0);
      EXPECT_LT(poseError(pose, link.collision[k].link_from_shape).position, 1e-6);
      const json& geometry = sharedData["geometries"][part["geometry"].get<std::size_t>()];
      const auto* mesh = std::get_if<TriangleMesh>(&link.collision[k].shape);
      if (mesh == nullptr) continue;
      ++meshes;
      ASSERT_EQ(geometry["kind"], "triangles");
      const std::vector<float> positions = floats(geometry["positions"]);
      const std::vector<std::uint16_t> indices = uint16s(geometry["indices16"]);
      ASSERT_EQ(indices.size(), 3 * mesh->triangles().size());
      for (std::size_t i = 0; i < indices.size(); ++i) {
        const int vertex = mesh->triangles()[i / 3][static_cast<int>(i % 3)];
        for (int axis = 0; axis < 3; ++axis)
          EXPECT_EQ(positions[3u * indices[i] + static_cast<unsigned>(axis)],
                    static_cast<float>(mesh->vertices()[static_cast<std::size_t>(vertex)][axis]));
      }
    }
  EXPECT_GE(meshes, 5);
}

TEST_F(PlannedPage, CoversCoverTheVertices) {
  for (const json& body : sharedData["bodies"])
    for (const json& part : body["parts"]) {
      EXPECT_EQ(part["cover"].is_null(), body["kind"] == "world") << body["name"];
      const json& geometry = sharedData["geometries"][part["geometry"].get<std::size_t>()];
      if (part["cover"].is_null() || geometry["kind"] != "triangles") continue;
      const std::vector<float> vertices = floats(geometry["positions"]);
      const std::vector<float> balls =
          floats(sharedData["covers"][part["cover"].get<std::size_t>()]["balls"]);
      EXPECT_LE(balls.size(), 4u * 96u);
      for (std::size_t v = 0; v < vertices.size(); v += 3) {
        bool covered = false;
        for (std::size_t b = 0; b < balls.size() && !covered; b += 4)
          covered = std::hypot(vertices[v] - balls[b], vertices[v + 1] - balls[b + 1],
                               vertices[v + 2] - balls[b + 2]) <= balls[b + 3] + 1e-6f;
        EXPECT_TRUE(covered) << body["name"];
      }
    }
}

}  // namespace
}  // namespace swept::test
