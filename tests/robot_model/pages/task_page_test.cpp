// SPDX-License-Identifier: BSD-3-Clause
#include "swept/pages/task_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "input_files.hpp"
#include "message_of.hpp"
#include "sliding_cube.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "transcript.hpp"

namespace swept {
namespace {

using testing::HasSubstr;

class TaskPages : public testing::Test {
 protected:
  /// The cube moves along x at a height, from a time on, for a second.
  static PiecewisePolynomial curve(double from, double to, double height, double begin) {
    Eigen::MatrixXd ends(2, 2);
    ends << from, to, height, height;
    return PiecewisePolynomial({begin, begin + 1.0}, {ends});
  }
  static nlohmann::json dataOf(const std::string& html) {
    const std::string begin = "<script id=\"data\" type=\"application/json\">";
    const std::size_t at = html.find(begin) + begin.size();
    return nlohmann::json::parse(html.substr(at, html.find("</script>", at) - at));
  }
  std::shared_ptr<const Checker> beside_ =
      std::make_shared<const Checker>(test::slidingCube(), "all", test::worldWithCube());
  std::shared_ptr<const Checker> alone_ =
      std::make_shared<const Checker>(test::slidingCube(), "all", std::make_shared<const World>());
};

TEST_F(TaskPages, HaveAPhaseForEachAndSharedShapesOnce) {
  TaskPage page;
  page.addPhase("over", beside_, curve(-1, 1, 0.5, 2.0));
  page.addPhase("back <i>", alone_, curve(1, -1, 0.0, 3.0), {}, {"block gone"});
  const nlohmann::json data = dataOf(page.html());
  EXPECT_EQ(data["headline"], "2 phases: all free");
  EXPECT_EQ(data["tone"], "good");
  ASSERT_EQ(data["phases"].size(), 2U);
  EXPECT_EQ(data["phases"][1]["label"], "back <i>");
  EXPECT_EQ(data["phases"][1]["changes"], nlohmann::json({"block gone"}));
  EXPECT_EQ(data["phases"][0]["begin"], 2.0);
  EXPECT_EQ(data["phases"][1]["end"], 4.0);
  // The cube is in both phases, and is as large as the block.
  EXPECT_EQ(data["phases"][0]["data"]["geometries"], nlohmann::json({0, 0}));
  EXPECT_EQ(data["phases"][1]["data"]["geometries"], nlohmann::json::array({0}));
  EXPECT_EQ(data["phases"][0]["data"]["bodies"].size(),
            data["phases"][1]["data"]["bodies"].size() + 1);
}

TEST_F(TaskPages, SayWhatIsNotFree) {
  TaskPage page;
  page.addPhase("over", beside_, curve(-1, 1, 0.5, 0.0));
  page.addPhase("through", beside_, curve(1, -1, 0.0, 1.0));
  const nlohmann::json data = dataOf(page.html());
  EXPECT_EQ(data["headline"], "2 phases: 1 free, 1 in collision");
  EXPECT_EQ(data["tone"], "bad");
  EXPECT_EQ(data["phases"][0]["tone"], "good");
  EXPECT_EQ(data["phases"][1]["tone"], "bad");
}

TEST_F(TaskPages, ShowWhatMovesOnItsClock) {
  MovingObstacle cart{.name = "cart", .parts = {{Sphere{0.1}, Eigen::Isometry3d::Identity()}}};
  for (const double y : {-2.0, 2.0})
    cart.waypoints.push_back({y, Eigen::Isometry3d(Eigen::Translation3d(0, y, 0))});
  const auto moving = std::make_shared<const Checker>(alone_->withObstacle(cart));
  TaskPage page;
  page.addPhase("aside", moving, curve(1, 1, 0.0, 0.0), {.clock = -1.5});
  page.addPhase("met", moving, curve(0, 0, 0.0, 1.0), {.clock = -1.5});
  const nlohmann::json data = dataOf(page.html());
  EXPECT_EQ(data["headline"], "2 phases: 1 free, 1 in collision");
  EXPECT_EQ(data["phases"][1]["data"]["motions"][0]["curve"]["clock"], -1.5);
  EXPECT_TRUE(data["phases"][1]["data"]["bodies"].back().contains("motion"));
}

TEST_F(TaskPages, RefuseWhatIsNoTask) {
  TaskPage page;
  EXPECT_EQ(test::messageOf([&] { static_cast<void>(page.html()); }), "a page of nothing");
  EXPECT_EQ(test::messageOf([&] { page.addPhase("a", nullptr, curve(0, 1, 1, 0)); }),
            "a page without a checker");
  page.addPhase("over", beside_, curve(-1, 1, 0.5, 1.0));
  EXPECT_EQ(test::messageOf([&] { page.addPhase("early", beside_, curve(1, 0, 0.5, 1.5)); }),
            "'early' begins at 1.5 s, and the phase before ends at 2 s");
  EXPECT_EQ(dataOf(page.html())["phases"].size(), 1U);
  const test::TemporaryFolder folder;
  EXPECT_THROW(page.write(folder.path() / "page.txt"), UsageError);
  page.write(folder.path() / "page.html");
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "page.html"));
}

TEST_F(TaskPages, AreTheSameInEveryFloatingPointEnvironment) {
  test::expectSameInEveryEnvironment({{"html", [&](test::Transcript& t) {
                                         TaskPage page;
                                         page.addPhase("over", beside_, curve(-1, 1, 0.5, 0.0));
                                         t.add(page.html());
                                       }}});
}

}  // namespace
}  // namespace swept
