// SPDX-License-Identifier: BSD-3-Clause
// Files of graphs: what comes back, and what is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "output/whole_file.hpp"
#include "swept/robot_model/proven_graph.hpp"
#include "swept/robot_model/text_file.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "version_arms.hpp"

namespace swept {
namespace {

using test::at;

class GraphFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("swept_graph_file_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    file_ = folder_ / "roadmap.json";
    std::mt19937 random(7);
    std::vector<ProvenGraph::Motion> motions;
    for (int i = 0; i < 160; ++i) {
      graph_.addState(test::randomConfiguration(*checker_, random));
      if (i > 0)
        motions.push_back({static_cast<std::uint32_t>(i) - 1, static_cast<std::uint32_t>(i)});
    }
    graph_.addMotions(motions);
    graph_.save(file_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static void expectSame(const ProvenGraph& a, const ProvenGraph& b) {
    ASSERT_EQ(a.states(), b.states());
    ASSERT_EQ(a.motions(), b.motions());
    for (std::size_t i = 0; i < a.states(); ++i)
      EXPECT_TRUE(std::ranges::equal(a.state(i), b.state(i)));
    for (std::size_t i = 0; i < a.motions(); ++i) {
      EXPECT_EQ(a.motion(i).from, b.motion(i).from);
      EXPECT_EQ(a.motion(i).to, b.motion(i).to);
      EXPECT_EQ(a.verdict(i), b.verdict(i));
      std::vector<std::string> ofA = a.blockedBy(i), ofB = b.blockedBy(i);
      std::ranges::sort(ofA);
      std::ranges::sort(ofB);
      EXPECT_EQ(ofA, ofB);
    }
  }
  /// The message, without the file, of load() of the text.
  std::string refusal(const std::string& text,
                      const std::shared_ptr<const Checker>& checker) const {
    const std::filesystem::path broken = folder_ / "broken.json";
    std::ofstream(broken) << text;
    try {
      (void)ProvenGraph::load(broken, checker);
    } catch (const InputError& error) {
      EXPECT_EQ(error.file(), broken.string());
      return (error.line() > 0 ? std::to_string(error.line()) + ": " : "") + error.message();
    }
    return "loaded";
  }
  std::string refusal(const std::function<void(nlohmann::json&)>& change) const {
    nlohmann::json json = nlohmann::json::parse(readTextFile(file_));
    change(json);
    return refusal(json.dump(), checker_);
  }

  std::filesystem::path folder_, file_;
  std::shared_ptr<const Robot> robot_ = test::parseArm(test::armUrdf({}));
  std::shared_ptr<const Checker> checker_ =
      std::make_shared<const Checker>(robot_, "all", test::shared(test::clutter(3, 16)));
  ProvenGraph graph_{checker_};
};

TEST_F(GraphFile, ComesBack) {
  std::size_t blocked = 0;
  for (std::size_t i = 0; i < graph_.motions(); ++i) blocked += graph_.isFree(i) ? 0 : 1;
  ASSERT_GT(blocked, 5U);
  ASSERT_GT(graph_.motions(), blocked + 5);
  // Robot and world of another program, which shares nothing with this one's.
  const auto again = std::make_shared<const Checker>(test::parseArm(test::armUrdf({})), "all",
                                                     test::shared(test::clutter(3, 16)));
  const ProvenGraph loaded = ProvenGraph::load(file_, again);
  expectSame(graph_, loaded);
  const std::string text = readTextFile(file_);
  loaded.save(file_);
  EXPECT_EQ(readTextFile(file_), text);
}

TEST_F(GraphFile, ComesBackInAnotherWorld) {
  const auto moved = std::make_shared<const Checker>(
      checker_->withReplaced("body1", Sphere{0.1}, at(0.3, 0.3, 0.5))
          .withoutBody("body0")
          .withBody("new", Box{{0.1, 0.1, 0.1}}, at(-0.3, 0.3, 0.6)));
  const ProvenGraph::Updated loaded = ProvenGraph::loadChanged(file_, moved);
  const ProvenGraph::Change change = graph_.update(moved);
  expectSame(graph_, loaded.graph);
  EXPECT_EQ(loaded.change.bodiesGone, 2U);
  EXPECT_EQ(loaded.change.bodiesNew, 2U);
  EXPECT_EQ(loaded.change.asked, change.asked);
  EXPECT_EQ(loaded.change.freed, change.freed);
  EXPECT_EQ(loaded.change.blocked, change.blocked);
  EXPECT_GT(change.freed + change.blocked, 0U);
  // And is updated as one that was never in a file.
  ProvenGraph other = loaded.graph;
  other.update(checker_);
  graph_.update(checker_);
  expectSame(graph_, other);
}

TEST_F(GraphFile, OfAnotherRobotWorldOrQuestionIsRefused) {
  const std::string text = readTextFile(file_);
  const auto refusalFor = [&](const Checker& checker) {
    return refusal(text, std::make_shared<const Checker>(checker));
  };
  test::ArmGeometry geometry;
  geometry.hand[0].at.z() = 0.001;
  const World world = test::clutter(3, 16);
  EXPECT_EQ(
      refusalFor(Checker(test::parseArm(test::armUrdf(geometry)), "all", test::shared(world))),
      "the roadmap is of robot 'arm' as it was, which is not robot 'arm': links, joints, "
      "limits or pairs that are not checked differ");
  const std::string options =
      "the roadmap was made with other options: margins, tolerances, rules, attached bodies, "
      "constraints, or values of joints outside the group";
  EXPECT_EQ(refusalFor(Checker(robot_, "all", test::shared(world), {.margin = 1e-3})), options);
  EXPECT_EQ(refusalFor(checker_->withRules(CollisionRules().pad("hand", 0.01))), options);
  EXPECT_EQ(refusalFor(checker_->withAttached("tool", "hand", Sphere{0.01}, at(0, 0, 0))), options);
  EXPECT_EQ(refusalFor(checker_->withConstraints(TaskConstraint::upright("hand", 1.0))), options);
  EXPECT_EQ(refusalFor(checker_->withTracking({{.rotation = 0.01}})), options);
  const std::string start = "the roadmap is of another world: body ";
  const std::string end = "; 'swept roadmap update' takes it to this world";
  EXPECT_EQ(refusalFor(checker_->withoutBody("body2")), start + "'body2' is gone" + end);
  EXPECT_EQ(refusalFor(checker_->withBody("more", Sphere{0.1}, at(0, 0, 3))),
            start + "'more' is new" + end);
  EXPECT_EQ(refusalFor(checker_->withReplaced("body1", Sphere{0.1}, at(0, 0, 3))),
            start + "'body1' is not what it was" + end);
  EXPECT_EQ(refusalFor(checker_->withRules(CollisionRules().pad("body3", 0.01))),
            start + "'body3' is not what it was" + end);
}

TEST_F(GraphFile, BrokenIsRefused) {
  using nlohmann::json;
  const std::string text = readTextFile(file_);
  EXPECT_EQ(refusal("{\n\"swept_roadmap\": 1,\n", checker_),
            "3: malformed JSON: syntax error while parsing object key - unexpected end of input; "
            "expected string literal");
  EXPECT_EQ(refusal("[]", checker_), "a roadmap must be an object");
  EXPECT_EQ(refusal("{\"states\": []}", checker_),
            "swept_roadmap is missing; roadmaps are made by 'swept roadmap build'");
  EXPECT_EQ(refusal([](json& j) { j["swept_roadmap"] = 2; }), "swept_roadmap is 2; it must be 1");
  EXPECT_EQ(refusal([](json& j) { j["colour"] = 1; }),
            "the roadmap has the unknown key 'colour'; allowed are swept_roadmap, robot, group, "
            "robot_digest, options_digest, content_digest, bodies, states, motions and blocked");
  EXPECT_EQ(refusal([](json& j) { j["bodies"][3]["colour"] = 1; }),
            "bodies[3] has the unknown key 'colour'; allowed are name and digest");
  EXPECT_EQ(refusal([](json& j) { j["blocked"][1]["colour"] = 1; }),
            "blocked[1] has the unknown key 'colour'; allowed are motion and by");
  EXPECT_EQ(refusal([](json& j) { j["blocked"][1]["by"][0]["colour"] = 1; }),
            "blocked[1].by[0] has the unknown key 'colour'; allowed are body and verdict");
  EXPECT_EQ(refusal([](json& j) { j["bodies"][3] = 1; }), "bodies[3] must be an object");
  EXPECT_EQ(refusal([](json& j) { j.erase("motions"); }), "motions is missing");
  EXPECT_EQ(refusal([](json& j) { j["group"] = "legs"; }),
            "the roadmap is of group 'legs', not of group 'all'");
  EXPECT_EQ(refusal([](json& j) { j["bodies"].push_back(j["bodies"][0]); }),
            "bodies[16] is a second body 'body0'");
  EXPECT_EQ(refusal([](json& j) { j["states"][4].push_back(1.0); }),
            "states[4] holds 3 values; it must hold 2");
  EXPECT_EQ(refusal([](json& j) { j["states"][4][1] = "up"; }),
            "states[4][1] is \"up\"; it must be a finite number");
  EXPECT_EQ(refusal([](json& j) { j["motions"][0] = {1}; }),
            "motions[0] holds 1 values; it must hold 2");
  EXPECT_EQ(refusal([](json& j) { j["motions"][2][1] = 160; }),
            "motions[2][1] is 160; it must be the number of a state, from 0 to below 160");
  EXPECT_EQ(refusal([](json& j) { j["motions"][2][1] = -1; }),
            "motions[2][1] is -1; it must be the number of a state, from 0 to below 160");
  EXPECT_EQ(refusal([](json& j) { j["blocked"][0]["by"][0]["body"] = "ghost"; }),
            "blocked[0].by[0].body is \"ghost\", which is none of bodies");
  EXPECT_EQ(refusal([](json& j) { j["blocked"][0]["by"][0]["verdict"] = "free"; }),
            "blocked[0].by[0].verdict is \"free\"; it must be collision or undecided");
  const std::string other =
      "states, motions or what blocks them are not what was written: content_digest is of others";
  EXPECT_EQ(refusal([](json& j) { j["blocked"].erase(0); }), other);
  EXPECT_EQ(refusal([](json& j) { j["states"][3][0] = j["states"][3][0].get<double>() + 1e-9; }),
            other);
  EXPECT_EQ(refusal([](json& j) { j["blocked"][0]["by"].clear(); }), other);
  const std::string motion = nlohmann::json::parse(text)["blocked"][0]["motion"].dump();
  EXPECT_EQ(refusal([](json& j) { j["blocked"].push_back(j["blocked"][0]); }),
            "blocked[" + std::to_string(nlohmann::json::parse(text)["blocked"].size()) +
                "].motion is " + motion + " a second time");
  EXPECT_EQ(refusal(text, checker_), "loaded");
  EXPECT_THROW((void)ProvenGraph::load(folder_ / "none.json", checker_), InputError);
  EXPECT_THROW(graph_.save(folder_ / "no_folder" / "roadmap.json"), UsageError);
}

}  // namespace
}  // namespace swept
