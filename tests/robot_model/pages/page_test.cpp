// SPDX-License-Identifier: BSD-3-Clause
#include "swept/pages/page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "input_files.hpp"
#include "slide_page.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "transcript.hpp"

/// Pages as a program of one's own writes them. What is on a page the tests of the program see to,
/// which has the same.
namespace swept {
namespace {

using nlohmann::json;
using testing::HasSubstr;

using test::dataOf;
using test::slide;

const std::vector<double> kStart{0.0}, kFree{1.0}, kHit{1.5}, kBeyond{2.5};

TEST(PageTest, StatesAreWhatTheCheckerSays) {
  const auto checker = slide();
  Page page(checker);
  page.addState("start", kStart);
  page.addState("in the wall", kHit);
  const json data = dataOf(page);
  EXPECT_EQ(data["headline"], "2 states: 1 free, 1 in collision");
  EXPECT_EQ(data["tone"], "bad");
  EXPECT_EQ(data["title"], "swept");
  ASSERT_EQ(data["states"].size(), 2U);
  EXPECT_EQ(data["states"][0]["label"], "start");
  EXPECT_EQ(data["states"][0]["verdict"], "free");
  EXPECT_NEAR(data["states"][0]["clearance"].get<double>(), 1.35, 1e-9);
  EXPECT_EQ(data["states"][1]["contacts"][0]["body_b"], "wall");
  EXPECT_TRUE(data["motions"].empty());
  EXPECT_TRUE(data["visuals"].empty());
}

TEST(PageTest, IsTheSameInEveryFloatingPointEnvironment) {
  test::expectSameInEveryEnvironment({{"html", [](test::Transcript& t) {
                                         Page states(slide()), motions(slide());
                                         states.addState("start", kStart);
                                         motions.addMotion("there", kFree, kBeyond);
                                         t.add(states.html(), motions.html());
                                       }}});
}

TEST(PageTest, MotionsFollowEachOther) {
  Page page(slide());
  page.addMotion("there", kStart, kFree);
  page.addMotion("and on", kFree, kBeyond);
  const json data = dataOf(page);
  EXPECT_EQ(data["headline"], "2 motions: 1 free, 1 in collision");
  ASSERT_EQ(data["motions"].size(), 2U);
  EXPECT_EQ(data["motions"][0]["label"], "there");
  EXPECT_EQ(data["motions"][0]["verdict"], "free");
  EXPECT_EQ(data["motions"][1]["verdict"], "collision");
  // The wall begins at 1.45 m, the ball at 0.1 m ahead of its middle: 0.35 m of 1.5 m.
  EXPECT_NEAR(data["motions"][1]["contacts"][0]["t"].get<double>(), 0.35 / 1.5, 1e-3);
  EXPECT_TRUE(data["paths"].empty());
}

TEST(PageTest, PathsAreShownInTurn) {
  Page page(slide());
  const std::vector<std::vector<double>> there{kStart, {0.5}, kFree}, through{kStart, kBeyond};
  page.addPath("there", there);
  page.addPath("through", through);
  page.addPath("stays", {&kStart, 1});
  const json data = dataOf(page);
  EXPECT_EQ(data["headline"], "3 paths: 2 free, 1 in collision");
  ASSERT_EQ(data["paths"].size(), 3U);
  EXPECT_EQ(data["paths"][0]["label"], "there");
  EXPECT_EQ(data["paths"][0]["tone"], "good");
  EXPECT_EQ(data["paths"][1]["tone"], "bad");
  std::vector<int> pathOf;
  for (const json& motion : data["motions"]) pathOf.push_back(motion["path"]);
  EXPECT_EQ(pathOf, (std::vector<int>{0, 0, 1, 2}));
}

/// Along y through the ball's slide, at x = 0 at 2 s.
std::shared_ptr<const Checker> besideCart() {
  const auto at = [](double y) { return Eigen::Isometry3d(Eigen::Translation3d(0, y, 0)); };
  return std::make_shared<const Checker>(
      slide()->withObstacle({.name = "cart",
                             .parts = {{Sphere{0.1}, Eigen::Isometry3d::Identity()}},
                             .waypoints = {{0.0, at(-2.0)}, {4.0, at(2.0)}}}));
}

TEST(PageTest, StatesBesideWhatMovesAreAtTheirTimes) {
  Page page(besideCart());
  page.addState("met", std::vector<double>{0.0, 2.0});
  page.addState("passed", std::vector<double>{0.0, 3.0});
  const json data = dataOf(page);
  EXPECT_EQ(data["headline"], "2 states: 1 free, 1 in collision");
  EXPECT_EQ(data["states"][0]["values"], json({0.0}));
  EXPECT_EQ(data["states"][0]["clock"], 2.0);
  EXPECT_EQ(data["states"][0]["contacts"][0]["body_b"], "cart");
  EXPECT_EQ(data["states"][1]["clock"], 3.0);
  EXPECT_NEAR(data["states"][1]["clearance"].get<double>(), 0.8, 1e-9);
  EXPECT_EQ(data["bodies"].back()["name"], "cart");
  EXPECT_TRUE(data["bodies"].back().contains("motion"));
  EXPECT_EQ(test::refusal([&] { page.addState("when", kStart); }),
            "'when' has 1 values; group 'all' has 1 variables, and the time of what moves comes "
            "after them");
}

TEST(PageTest, MotionsBesideWhatMovesHaveTheirTimes) {
  Page page(besideCart());
  page.addMotion("waits", std::vector<double>{0.0, 0.0}, std::vector<double>{0.0, 1.7});
  page.addMotion("is met", std::vector<double>{0.0, 1.7}, std::vector<double>{0.0, 2.7});
  const json data = dataOf(page);
  EXPECT_EQ(data["headline"], "2 motions: 1 free, 1 in collision");
  EXPECT_EQ(data["motions"][0]["from"], json({0.0}));
  EXPECT_EQ(data["motions"][0]["clock"], json({0.0, 1.7}));
  // It comes within 0.2 m at 1.8 s.
  EXPECT_NEAR(data["motions"][1]["free_until"].get<double>(), 0.1, 5e-3);
  const json lower = data["motions"][0]["pieces"]["lower"];
  EXPECT_NEAR(lower.back().get<double>(), 0.1, 1e-3);
  EXPECT_GT(lower.front().get<double>(), 1.0);
  EXPECT_FALSE(dataOf([] {
                 Page standing(slide());
                 standing.addMotion("there", kStart, kFree);
                 return standing;
               }())["motions"][0]
                   .contains("clock"));
}

TEST(PageTest, SaysWhatItIsTold) {
  PageOptions options{.title = "a </script><b> planner",
                      .headline = "the \"best\" path",
                      .facts = {{"time", "3 s"}},
                      .visuals = VisualModel::parse(
                          "<robot name='slide'><link name='ball'><visual><geometry><box size='0.1 "
                          "0.2 0.3'/></geometry></visual></link></robot>",
                          "slide.urdf")};
  Page page(slide(), options);
  page.addMotion("there", kStart, kFree);
  const json data = dataOf(page);
  EXPECT_EQ(data["title"], options.title);
  EXPECT_EQ(data["headline"], options.headline);
  EXPECT_EQ(data["facts"][0], json({"time", "3 s"}));
  EXPECT_EQ(data["visuals"].size(), 1U);
  EXPECT_EQ(data["facts"].dump().find("command"), std::string::npos);
}

/// Green says that something was proven.
TEST(PageTest, NothingCheckedIsNotGreen) {
  const auto robot = Robot::parse(
      "<robot name='r'><link name='a'/><link name='b'><collision><geometry><sphere radius='1'/>"
      "</geometry></collision></link><joint name='x' type='prismatic'><parent link='a'/><child "
      "link='b'/><limit lower='0' upper='1' effort='1' velocity='1'/></joint></robot>",
      "r.urdf");
  Page page(std::make_shared<const Checker>(robot, "all", std::make_shared<const World>()));
  page.addState("s", kStart);
  const json data = dataOf(page);
  EXPECT_EQ(data["tone"], "unsure");
  EXPECT_EQ(data["headline"], "state: free, nothing was checked");
}

TEST(PageTest, WhatCannotBeShownIsRefusedAndChangesNothing) {
  EXPECT_THROW(Page(nullptr), std::invalid_argument);
  Page page(slide());
  EXPECT_THROW(page.html(), std::invalid_argument);
  const auto refused = [&](const std::function<void()>& action) {
    try {
      action();
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::vector<double> two{0, 1}, none{std::numeric_limits<double>::quiet_NaN()};
  EXPECT_EQ(refused([&] { page.addState("s", two); }),
            "'s' has 2 values; group 'all' has 1 variables");
  EXPECT_EQ(refused([&] { page.addMotion("m", kStart, none); }),
            "'m' has a value that is not finite");
  EXPECT_EQ(refused([&] { page.addPath("p", {}); }), "path 'p' has no state");
  page.addState("start", kStart);
  EXPECT_EQ(refused([&] { page.addMotion("m", kStart, kFree); }),
            "a page has either states, or motions, or paths, or trajectories");
  EXPECT_EQ(dataOf(page)["states"].size(), 1U);
}

TEST(PageTest, IsWrittenWholeOrNotAtAll) {
  const test::TemporaryFolder folder;
  Page page(slide());
  page.addState("start", kStart);
  page.write(folder.path() / "page.html");
  std::ifstream file(folder.path() / "page.html");
  std::stringstream text;
  text << file.rdbuf();
  EXPECT_EQ(text.str(), page.html());
  EXPECT_THROW(page.write(folder.path() / "page.txt"), UsageError);
  EXPECT_THROW(page.write(folder.path() / "nowhere" / "page.html"), UsageError);
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "page.txt"));
}

}  // namespace
}  // namespace swept
