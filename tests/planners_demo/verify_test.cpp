// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <sstream>

#include "gantry.hpp"
#include "page_data.hpp"
#include "verify/check.hpp"

/// `swept plan -o` writes a proof, and `swept verify` accepts it as it is and no other.
namespace swept::test {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;
using testing::StartsWith;

std::string fileText(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

/// A path over the post.
class Verify : public testing::Test {
 protected:
  Verify() : file_(gantry_.folder().path("path.json")) {
    const Outcome run = gantry_.run("plan", {"left", "right", "-o", file_});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    path_ = Json::parse(gantry_.folder().read("path.json"));
  }

  /// What verify says of the path after a change.
  std::string refusal(const std::function<void(Json&)>& change) const {
    Json changed = path_;
    change(changed);
    EXPECT_NE(changed, path_);
    return refusalOf(gantry_.folder().write("changed.json", changed.dump()));
  }
  static std::string refusalOf(const std::string& file, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"verify", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = runSwept(arguments);
    EXPECT_EQ(run.exitCode, 1) << run.out;
    EXPECT_EQ(run.err, "");
    return run.out;
  }
  static Json& interval(Json& path, std::size_t segment, std::size_t i) {
    return path["proof"]["segments"][segment]["pairs"][0]["intervals"][i];
  }
  /// Makes the digests fit, as someone would who wants to deceive.
  static void sign(Json& path) {
    for (std::size_t i = 0; i + 1 < path["states"].size(); ++i) {
      Json& segment = path["proof"]["segments"][i];
      segment["states_digest"] = verify::stateDigest(path["states"][i], path["states"][i + 1]);
      for (Json& pair : segment["pairs"]) pair["digest"] = verify::pairDigest(pair);
    }
  }

  Gantry gantry_;
  std::string file_;
  Json path_;
};

constexpr const char* kChanged = ": is not as it was when the path was certified\n";

TEST_F(Verify, WhatWasPlannedHolds) {
  const Outcome run = runSwept({"verify", file_});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out,
              testing::MatchesRegex("verified: [0-9]+ segments, 1 pair of bodies, [0-9]+ "
                                    "intervals, [0-9]+ planes\n"
                                    "every pair keeps more than 0\\.[0-9]+ m; pairs with the "
                                    "world more than 0\\.[0-9]+ m, there is no pair of "
                                    "the robot's bodies\n"));
  const auto json = jsonOf(runSwept({"verify", file_, "--json"}));
  EXPECT_EQ(json["verified"], true);
  EXPECT_TRUE(json["refusal"].is_null());
  EXPECT_EQ(json["segments"], path_["segments"].size());
  // The proven clearance is below the true one, and at least half of what plan promised.
  double promised = INFINITY, least = INFINITY;
  for (const Json& segment : path_["segments"])
    promised = std::min(promised, segment["clearance"].get<double>());
  const auto states = path_["states"].get<std::vector<std::vector<double>>>();
  for (std::size_t i = 1; i < states.size(); ++i)
    least = std::min(least, Gantry::leastDistance(states[i - 1], states[i]));
  EXPECT_LE(json["clearance"].get<double>(), least);
  EXPECT_GE(json["clearance"].get<double>(), 0.5 * promised * (1.0 - 1e-9));
}

TEST_F(Verify, AChangedStateIsNamed) {
  ASSERT_GE(path_["states"].size(), 3u);
  for (std::size_t i = 0; i < path_["states"].size(); ++i)
    EXPECT_EQ(refusal([&](Json& path) {
                path["states"][i][1] = path["states"][i][1].get<double>() + 1e-9;
              }),
              "refused: state " + std::to_string(i + 1) + kChanged);
}

TEST_F(Verify, AChangedIntervalIsNamed) {
  const std::string end = interval(path_, 0, 0)[1].dump();
  EXPECT_THAT(refusal([](Json& path) { interval(path, 0, 0)[1] = 1e-3; }),
              testing::AnyOf(HasSubstr("does not begin at 0.001"), HasSubstr("from 0.001 to 1")));
  EXPECT_EQ(refusal([](Json& path) { interval(path, 0, 0)[0] = 1e-3; }),
            "refused: segment 1, cube - post: the interval from 0.001 to " +
                replaced(end, end.ends_with(".0") ? ".0" : "", "") +
                " does not begin at 0 and end later, at most at 1\n");
  EXPECT_THAT(
      refusal([](Json& path) { path["proof"]["segments"][1]["pairs"][0]["intervals"].erase(0); }),
      StartsWith("refused: segment 2, cube - post: "));
}

TEST_F(Verify, AChangedBoundIsNamed) {
  EXPECT_THAT(
      refusal([](Json& path) { interval(path, 1, 0)[2][3] = 5.0; }),
      testing::MatchesRegex("refused: segment 2, cube - post, 0 to [0-9.]+: the bound 5 m is "
                            "not proven, only 0\\.[0-9]+ m is\n"));
  EXPECT_THAT(refusal([](Json& path) { interval(path, 1, 0)[2][3] = 0.0; }),
              HasSubstr(": the bound 0 m is not above the margin, 0 m\n"));
  EXPECT_EQ(refusal([](Json& path) {
              Json& bound = interval(path, 1, 0)[2][3];
              bound = 0.5 * bound.get<double>();
            }),
            std::string("refused: segment 2, cube - post") + kChanged)
      << "still a proof, but not the one that was written";
}

TEST_F(Verify, ALeftOutPairOrSegmentIsNamed) {
  EXPECT_EQ(refusal([](Json& path) { path["proof"]["segments"][0]["pairs"].clear(); }),
            "refused: segment 1, cube - post: there is no proof of this pair in its place\n");
  EXPECT_THAT(refusal([](Json& path) { path["proof"]["segments"].erase(1); }),
              StartsWith("refused: proof, segments: "));
}

TEST_F(Verify, WhatIsSaidBesideTheProofIsNotChangedEither) {
  EXPECT_EQ(refusal([](Json& path) { path["segments"][0]["clearance"] = 5.0; }),
            std::string("refused: path file, segments") + kChanged);
  EXPECT_EQ(refusal([](Json& path) { path["group"] = "slider"; }),
            std::string("refused: path file, group") + kChanged);
  const auto signedAnew = [](Json& path) {
    path["proof"]["digests"]["claims"] = verify::claimDigests(path);
  };
  EXPECT_EQ(refusal([&](Json& path) {
              std::swap(path["joint_names"][0], path["joint_names"][1]);
              signedAnew(path);
            }),
            "refused: joint_names: they are not the variables of the group, in its order\n");
  EXPECT_EQ(refusal([&](Json& path) {
              path["margin"] = 0.01;
              signedAnew(path);
            }),
            "refused: margin: it is not that of the model\n");
}

/// Digests keep nobody from writing others; the proof does.
TEST_F(Verify, WhatIsNotTrueIsRefusedWhateverTheDigestsSay) {
  EXPECT_THAT(
      refusal([](Json& path) {
        path["states"][1] = {1.0, 0.0};  // into the post
        sign(path);
      }),
      testing::MatchesRegex("refused: segment 1, cube - post, [0-9.e-]+ to [0-9.]+: the bound "
                            ".* m is not proven, only .*\n"));
  EXPECT_THAT(refusal([](Json& path) {
                interval(path, 0, 0)[2][3] = 5.0;
                sign(path);
              }),
              HasSubstr("the bound 5 m is not proven"));
  EXPECT_EQ(refusal([](Json& path) {
              path["states"][1][1] = 7.0;
              sign(path);
            }),
            "refused: state 2, lift: beyond its limits\n");
  const Outcome fine = runSwept({"verify", gantry_.folder().write("signed.json", [&] {
                                   Json same = path_;
                                   sign(same);
                                   return same.dump();
                                 }())});
  EXPECT_EQ(fine.exitCode, 0) << "signing alone changes nothing";
}

TEST_F(Verify, AChangedRobotIsNamed) {
  const std::string urdf = fileText(gantry_.urdf);
  gantry_.folder().write("gantry.urdf", replaced(urdf, "0.2 0.2 0.2", "0.2 0.2 0.3"));
  EXPECT_EQ(refusalOf(file_), std::string("refused: body cube") + kChanged);
  gantry_.folder().write("gantry.urdf",
                         replaced(urdf, "<axis xyz=\"0 0 1\"/>", "<axis xyz=\"0 0 -1\"/>"));
  EXPECT_EQ(refusalOf(file_), std::string("refused: joint lift") + kChanged);
  gantry_.folder().write("gantry.urdf", replaced(urdf, "upper=\"2.5\"", "upper=\"2.6\""));
  EXPECT_EQ(
      refusalOf(file_),
      "refused: rules: the group, its limits, margins, tolerances or pairs that may touch are not as they "
      "were when the path was certified\n");
  gantry_.folder().write("gantry.urdf", replaced(urdf, "<robot ", "<!-- the same --><robot "));
  EXPECT_EQ(runSwept({"verify", file_}).exitCode, 0);
}

TEST_F(Verify, AChangedSceneIsNamed) {
  const std::string scene = fileText(gantry_.scene);
  gantry_.folder().write("post.yaml", replaced(scene, "[1, 0, 0]", "[1, 0, 0.001]"));
  EXPECT_EQ(refusalOf(file_), std::string("refused: body post") + kChanged);
  gantry_.folder().write("post.yaml", replaced(scene, "id: post", "id: pole"));
  EXPECT_EQ(refusalOf(file_), "refused: body pole: was not there when the path was certified\n");
  const std::string elsewhere = gantry_.folder().write("moved.yaml", scene);
  const Outcome run = runSwept({"verify", file_, "--scene", elsewhere});
  EXPECT_EQ(run.exitCode, 0) << run.out;
}

TEST_F(Verify, AnEmbeddedModelNeedsNoFiles) {
  const std::string file = gantry_.folder().path("embedded.json");
  ASSERT_EQ(gantry_.run("plan", {"left", "right", "--embed", "-o", file}).exitCode, 0);
  const std::string scene = fileText(gantry_.scene);
  gantry_.folder().write("post.yaml", replaced(scene, "[1, 0, 0]", "[1, 0, 0.001]"));
  EXPECT_EQ(runSwept({"verify", file}).exitCode, 0);
  EXPECT_EQ(refusalOf(file, {"--files"}), std::string("refused: body post") + kChanged);
  Json changed = Json::parse(gantry_.folder().read("embedded.json"));
  changed["model"]["bodies"][1]["shapes"][0]["half_extents"][0] = 0.05;
  EXPECT_EQ(refusalOf(gantry_.folder().write("changed.json", changed.dump())),
            std::string("refused: body post") + kChanged);
}

TEST_F(Verify, ChangedRulesAreNamed) {
  EXPECT_THAT(refusal([](Json& path) { path["inputs"]["margin"] = 1e-6; }),
              StartsWith("refused: rules: "));
  Json allowing = path_;
  allowing["inputs"]["allow"] = {"cube,post"};
  const Outcome run = runSwept({"verify", gantry_.folder().write("changed.json", allowing.dump())});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, StartsWith("refused: rules: "));
  EXPECT_THAT(run.err, StartsWith("swept: warning: nothing is checked: group 'both' moves "));
}

TEST_F(Verify, WhatMayTouchIsSaid) {
  const std::string file = gantry_.folder().path("allowed.json");
  ASSERT_EQ(gantry_.run("plan", {"left", "right", "--allow", "cube,post", "-o", file}).exitCode, 0);
  EXPECT_EQ(runSwept({"verify", file}).out,
            "verified: 1 segment, 0 pairs of bodies, 0 intervals, 0 planes\n"
            "there is no pair to check\n"
            "not checked (allowed: --allow): cube - post\n");
}

TEST_F(Verify, APageShowsThePathAndWhetherItsProofHolds) {
  if (!programHasPages()) GTEST_SKIP() << "built without three.js";
  const std::string page = gantry_.folder().path("page.html");
  const auto dataOf = [&](const Json& path, int exitCode) {
    const std::string file = gantry_.folder().write("shown.json", path.dump());
    const Outcome run = runSwept({"verify", file, "--html", page});
    EXPECT_EQ(run.exitCode, exitCode) << run.err;
    EXPECT_THAT(run.out, testing::EndsWith("page written to " + page + "\n"));
    return pageData(gantry_.folder().read("page.html"));
  };
  const auto data = dataOf(path_, 0);
  EXPECT_EQ(data["title"], "swept verify");
  EXPECT_EQ(data["headline"], "verified");
  EXPECT_EQ(data["tone"], "good");
  EXPECT_EQ(data["motions"].size(), path_["states"].size() - 1);
  Json changed = path_;
  changed["states"][1][0] = changed["states"][1][0].get<double>() + 0.01;
  const auto refused = dataOf(changed, 1);
  EXPECT_THAT(refused["headline"].get<std::string>(), StartsWith("refused: state 2"));
  EXPECT_EQ(refused["tone"], "bad");
  changed["states"] = "none";
  EXPECT_EQ(dataOf(changed, 1)["tone"], "bad");
}

TEST_F(Verify, FilesThatAreNoPathAreBadInput) {
  const auto message = [&](const std::string& text) {
    const std::string file = gantry_.folder().write("bad.json", text);
    const Outcome run = runSwept({"verify", file});
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "");
    return replaced(run.err, file, "F");
  };
  EXPECT_EQ(message("{}"), "F: error: there is no proof in it\n");
  EXPECT_EQ(message("{\"proof\": null}"), "F: error: there is no proof in it\n");
  EXPECT_EQ(message("{\"proof\": {}}"), "F: error: it does not say which files it is for\n");
  EXPECT_EQ(message("{\"proof\": {}, \"inputs\": {\"robot\": 3}}"),
            "F: error: inputs.robot is 3; it must be text\n");
  EXPECT_THAT(message("{\"proof\":\n {"), StartsWith("F:2: error: malformed JSON: "));
  // Deep enough to exhaust the stack of what would print it.
  EXPECT_EQ(message("{\"group\":\n" + std::string(400'000, '[') + std::string(400'000, ']') + "}"),
            "F:2: error: objects and arrays are nested deeper than 500\n");
  EXPECT_THAT(runSwept({"verify", "no/such.json"}).err, HasSubstr("no/such.json"));
}

/// The ball passes a post that it misses by 1 mm wherever it is, so that the pair is not checked,
/// and keeps half a metre from all that is. Planes beside the post cannot show as much as that.
TEST(VerifyReach, WhatIsOutOfReachMayBeNearerThanWhatIsChecked) {
  const TemporaryFolder folder;
  const std::string urdf = folder.write(
      "arm.urdf",
      "<robot name='r'><link name='base'/><link name='arm'><collision><origin xyz='0.3 0 0'/>"
      "<geometry><sphere radius='0.1'/></geometry></collision></link>"
      "<joint name='j' type='revolute'><parent link='base'/><child link='arm'/><axis xyz='0 0 1'/>"
      "<limit lower='-2' upper='2' effort='1' velocity='1'/></joint></robot>");
  const auto ball = [](const std::string& name, const std::string& x) {
    return "    - {header: {frame_id: base}, id: " + name +
           ", primitives: [{type: sphere, dimensions: [0.1]}], primitive_poses: [{position: [" + x +
           ", 0, 0], orientation: [0, 0, 0, 1]}]}\n";
  };
  const std::string scene =
      folder.write("scene.yaml", "name: s\nworld:\n  collision_objects:\n" + ball("post", "0.501") +
                                     ball("wall", "-0.45"));
  const std::string file = folder.path("path.json");
  const Outcome run =
      runSwept({"plan", urdf, "--scene", scene, "-q", "-o", file, "--", "-0.5", "0.5"});
  ASSERT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_GT(Json::parse(folder.read("path.json"))["segments"][0]["clearance"], 0.5);
  const auto json = jsonOf(runSwept({"verify", file, "--json"}));
  EXPECT_EQ(json["verified"], true) << json["refusal"];
  EXPECT_EQ(json["pairs"], 2);
  EXPECT_GT(json["clearance"], 0.0);
  EXPECT_LE(json["clearance"], 1e-3);
}

/// Meshes that are not convex and clouds: planes between parts of them.
TEST(VerifyModels, ProofsOfAllScenesHold) {
  const TemporaryFolder folder;
  const std::string file = folder.path("path.json");
  std::size_t planes = 0, intervals = 0;
  const auto planAndVerify = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{
        "plan", "models/robots/rook7/rook7.urdf", "--group", "arm", "--time", "200", "-q", "-o",
        file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome run = runSwept(arguments);
    EXPECT_EQ(run.err, "") << testing::PrintToString(more);
    ASSERT_EQ(run.exitCode, 0) << testing::PrintToString(more);
    const auto json = jsonOf(runSwept({"verify", file, "--json"}));
    EXPECT_EQ(json["verified"], true) << json["refusal"];
    planes += json["planes"].get<std::size_t>();
    intervals += json["intervals"].get<std::size_t>();
  };
  for (const std::string set : {"bin", "cage", "empty", "narrow_slot", "shelf", "tunnel_trap"})
    planAndVerify({"--problems", "models/problems.json", "--set", set, "--index", "1"});
  const std::string from = "-0.9,0.4,0,1.9,0,0.8,0", to = "0.9,0.4,0,1.9,0,0.8,0";
  planAndVerify({from, to, "--cloud", "models/clouds/shelf.bt"});
  planAndVerify({from, to, "--cloud", "models/clouds/shelf.pcd", "--point-radius", "0.02"});
  planAndVerify({from, to, "--scene", "models/scenes/shelf.yaml", "--pad", "hand=0.01", "--scale",
                 "link4=1.02", "--margin", "0.002"});
  EXPECT_GT(planes, intervals) << "some intervals take several planes";
}

}  // namespace
}  // namespace swept::test
