// SPDX-License-Identifier: BSD-3-Clause
// Values up to 1e-5 beyond a limit are taken to it with one remark, wherever they are given; others
// are refused, with numbers that look different.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "gantry.hpp"
#include "verify/check.hpp"

namespace swept::test {
namespace {

using Json = nlohmann::ordered_json;
using testing::HasSubstr;

const std::string kWarning = "swept: warning: ";
const std::string kError = "swept: error: ";
const std::string kTaken = ": taken to the limit\n";

/// A box of 0.1 m that turns, at 0.3 m, as far as pi is in six digits.
std::string turningArm() {
  return R"(<robot name="arm">
  <link name="base"><collision><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <link name="flange"/><joint name="fixed" type="fixed"><parent link="base"/><child link="flange"/></joint>
  <link name="tool"><collision><origin xyz="0.3 0 0"/><geometry><box size="0.1 0.1 0.1"/></geometry></collision></link>
  <joint name="turn" type="revolute"><origin xyz="0 0 0.3"/><parent link="flange"/><child link="tool"/><axis xyz="0 0 1"/>
  <limit lower="-3.14159" upper="3.14159" effort="1" velocity="1"/></joint></robot>)";
}

TEST(HairBeyond, OnTheCommandLine) {
  const TemporaryFolder folder;
  const std::string arm = folder.write("arm.urdf", turningArm());
  struct Case {
    std::string value, remark;
  };
  for (const Case& one : {Case{"3.1415926", "3.1415926 rad, 2.6e-06 beyond its limit 3.14159"},
                          {"-3.1415926", "-3.1415926 rad, 2.6e-06 beyond its limit -3.14159"},
                          {"3.1416", "3.1416 rad, 1e-05 beyond its limit 3.14159"},
                          {"-3.141590002", "-3.141590002 rad, 2e-09 beyond its limit -3.14159"}}) {
    const Outcome run = runSwept({"check", arm, one.value});
    EXPECT_EQ(run.exitCode, 0) << one.value;
    EXPECT_EQ(run.err, kWarning + "turn is " + one.remark + kTaken);
    const auto json = jsonOf(runSwept({"check", arm, one.value, "--json", "-q"}));
    EXPECT_EQ(std::abs(json["states"][0]["values"][0].get<double>()), 3.14159) << one.value;
    const Outcome quiet = runSwept({"check", arm, one.value, "-q"});
    EXPECT_EQ(quiet.err, "");
    EXPECT_EQ(quiet.out, run.out);
  }
  for (const auto& [value, text] :
       {std::pair{"3.141601", "3.141601, allowed is -3.14159 to 3.14159 rad (1.1e-05 beyond)"},
        {"-3.141601", "-3.141601, allowed is -3.14159 to 3.14159 rad (1.1e-05 beyond)"},
        {"3.14259", "3.14259, allowed is -3.14159 to 3.14159 rad"}}) {
    const Outcome run = runSwept({"check", arm, value});
    EXPECT_EQ(run.exitCode, 3) << value;
    EXPECT_THAT(run.err, testing::StartsWith(kError + "state 1: turn is " + text)) << value;
  }
  const Outcome inside = runSwept({"check", arm, "3.14159", "-3.14159", "3.141589999"});
  EXPECT_EQ(inside.exitCode, 0);
  EXPECT_EQ(inside.err, "");
  // Large limits: six digits would show all three alike.
  const std::string rail = folder.write(
      "rail.urdf",
      R"(<robot name="rail"><link name="a"/><link name="b"><collision><geometry><sphere radius="1"/></geometry></collision></link>
      <joint name="x" type="prismatic"><parent link="a"/><child link="b"/><axis xyz="1 0 0"/><limit lower="1000" upper="1000.0001"/></joint></robot>)");
  EXPECT_EQ(runSwept({"check", rail, "1000.00012"}).err,
            kError + "state 1: x is 1000.00012, allowed is 1000 to 1000.0001 m (2e-05 beyond)\n");
}

TEST(HairBeyond, EachIsSaidOnce) {
  const Gantry gantry;
  const Outcome run =
      gantry.run("motion", {"2.500009,1.000000002", "0,1", "2.500009,1", "2.500001,1.000000002"});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, kWarning + "slide is 2.500009 m, 9e-06 beyond its limit 2.5" + kTaken +
                         kWarning + "lift is 1.000000002 m, 2e-09 beyond its limit 1" + kTaken +
                         kWarning + "slide is 2.500001 m, 1e-06 beyond its limit 2.5" + kTaken);
}

/// The answers are those of the limit itself, in all that takes states.
TEST(HairBeyond, AnswersAreThoseOfTheLimit) {
  const Gantry gantry;
  const auto same = [&](const std::string& command, const std::vector<std::string>& hair,
                        const std::vector<std::string>& limit) {
    const Outcome run = gantry.run(command, hair), wanted = gantry.run(command, limit);
    EXPECT_EQ(run.exitCode, wanted.exitCode) << command;
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.out, wanted.out) << command;
    EXPECT_THAT(run.err, HasSubstr("beyond its limit")) << command;
    EXPECT_EQ(wanted.err, "");
  };
  for (const std::string value : {"-0.500000002", "-0.500001", "-0.500009", "-0.50001"}) {
    same("check", {value + ",0"}, {"-0.5,0"});
    same("motion", {value + ",-9e-6", "0.5,0"}, {"-0.5,0", "0.5,0"});
    const auto planned = jsonOf(gantry.run("plan", {value + ",0", "2.500009,1", "--json", "-q"}));
    EXPECT_EQ(planned["proven"], true);
    EXPECT_EQ(planned["states"].front(), (nlohmann::json{-0.5, 0.0}));
    EXPECT_EQ(planned["states"].back(), (nlohmann::json{2.5, 1.0}));
  }
  EXPECT_EQ(gantry.run("check", {"-0.500011,0"}).err,
            kError + "state 1: slide is -0.500011, allowed is -0.5 to 2.5 m (1.1e-05 beyond)\n");
  EXPECT_EQ(gantry.run("plan", {"0,0", "2.500011,0"}).err,
            kError + "goal: slide is 2.500011, allowed is -0.5 to 2.5 m (1.1e-05 beyond)\n");
}

std::string problemAt(const std::string& lift, const std::string& slide) {
  return R"({"set": [{"index": 1, "world": {"sphere": [{"name": "ball", "position": [0, 0, 9], "radius": 0.1}]}, "start": [)" +
         lift + ", " + slide + R"(], "goals": [[0, 2]], "joint_names": ["lift", "slide"]}]})";
}

TEST(HairBeyond, InProblems) {
  const Gantry gantry;
  const auto plan = [&](const std::string& lift, const std::string& slide,
                        std::vector<std::string> more) {
    const std::string file = gantry.folder().write("hair.json", problemAt(lift, slide));
    more.insert(more.begin(), {"--problems", file});
    return gantry.run("plan", more);
  };
  const std::string remark = kWarning + "slide is 2.500009 m, 9e-06 beyond its limit 2.5" + kTaken;
  for (const std::vector<std::string>& which :
       {std::vector<std::string>{}, {"--set", "set", "--index", "1"}}) {
    const Outcome run = plan("0", "2.500009", which);
    EXPECT_EQ(run.exitCode, 0) << run.out;
    EXPECT_EQ(run.err, remark);
    std::vector<std::string> quiet = which;
    quiet.emplace_back("-q");
    EXPECT_EQ(plan("0", "2.500009", quiet).err, "");
  }
  const Outcome refused = plan("-1.1e-5", "0", {});
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_THAT(refused.out, HasSubstr("set 1: problem set 1, start: lift is -1.1e-05, allowed is 0 "
                                     "to 1 m (1.1e-05 beyond)\n"));
  const std::string file = gantry.folder().write("hair.json", problemAt("0", "2.500009"));
  const std::string log = gantry.folder().path("log.jsonl");
  const Outcome batch = runSwept({"bench", "planners", gantry.urdf, "--group", "both", "--problems",
                                  file, "-o", log, "--time", "1"});
  EXPECT_EQ(batch.exitCode, 0) << batch.err;
  EXPECT_THAT(batch.err, HasSubstr(remark));
}

TEST(HairBeyond, InRequestsAndNamedStates) {
  const Gantry gantry;
  const auto request = [&](const std::string& lift, const std::string& goal) {
    return gantry.run(
        "plan",
        {"--request",
         gantry.folder().write(
             "request.yaml",
             "group_name: slider\nstart_state: {joint_state: {name: [lift, slide], position: [" +
                 lift +
                 ", 0]}}\ngoal_constraints:\n  - joint_constraints: [{joint_name: slide, "
                 "position: " +
                 goal + "}]\n"),
         "--group", "slider", "--json"});
  };
  // The lift is not in the group: where it is held, it is held at its limit.
  const Outcome run = request("1.000009", "2.500000002");
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_EQ(jsonOf(run)["states"].back(), (nlohmann::json{2.5}));
  EXPECT_EQ(run.err, kWarning + "lift is 1.000009 m, 9e-06 beyond its limit 1" + kTaken + kWarning +
                         "slide is 2.500000002 m, 2e-09 beyond its limit 2.5" + kTaken);
  EXPECT_EQ(request("1", "2.5").err, "");
  EXPECT_THAT(request("1", "2.500011").err,
              HasSubstr("slide is 2.500011, allowed is -0.5 to 2.5 m"));

  const std::string srdf = gantry.folder().write(
      "hair.srdf",
      R"(<robot name="gantry"><group name="both"><joint name="slide"/><joint name="lift"/></group>
<group_state name="end" group="both"><joint name="slide" value="2.500009"/><joint name="lift" value="1"/></group_state></robot>)");
  const Outcome named = gantry.run("check", {"end", "--srdf", srdf, "--json"});
  EXPECT_EQ(named.exitCode, 0);
  EXPECT_EQ(jsonOf(named)["states"][0]["values"], (nlohmann::json{2.5, 1.0}));
  EXPECT_EQ(named.err, srdf +
                           ":2: warning: state 'end': slide is 2.500009 m, 9e-06 beyond its "
                           "limit 2.5" +
                           kTaken);
}

TEST(HairBeyond, InCasesThatAreReplayed) {
  const Gantry gantry;
  const auto replay = [&](const std::string& value, std::vector<std::string> more) {
    const Json file = {
        {"version", 1},
        {"cases",
         {{{"id", "hair"},
           {"query", "motion"},
           {"inputs", {{"robot", gantry.urdf}, {"group", "both"}, {"scene", gantry.scene}}},
           {"joint_names", {"slide", "lift"}},
           {"from", {Json::parse(value), 0.0}},
           {"to", {0.5, 0.0}},
           {"expected", {{"verdict", "free"}}}}}}};
    more.insert(more.begin(), {"replay", gantry.folder().write("case.json", file.dump())});
    return runSwept(more);
  };
  const Outcome run = replay("-0.500009", {});
  EXPECT_EQ(run.exitCode, 0) << run.out;
  EXPECT_EQ(run.err, kWarning + "slide is -0.500009 m, 9e-06 beyond its limit -0.5" + kTaken);
  EXPECT_EQ(replay("-0.500009", {"-q"}).err, "");
  const Outcome refused = replay("-0.500011", {});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_THAT(refused.out, HasSubstr("slide is -0.500011, allowed is -0.5 to 2.5 m (1.1e-05 "));
}

/// Halves what the planes of a tree promise.
void promiseLess(Json& tree) {
  if (tree.is_array()) {
    tree[3] = 0.5 * tree[3].get<double>();
    return;
  }
  for (auto& [side, halves] : tree.items())
    for (Json& half : halves) promiseLess(half);
}

/// Recorded by a program that does not take values to limits: the proof is of them as they are.
TEST(HairBeyond, InAPathThatIsVerified) {
  const Gantry gantry;
  const std::string file = gantry.folder().path("path.json");
  ASSERT_EQ(gantry.run("plan", {"0,1", "2,1", "-o", file, "--embed"}).exitCode, 0);
  const Json path = Json::parse(gantry.folder().read("path.json"));
  const auto verified = [&](double lift, std::vector<std::string> more) {
    Json moved = path;
    moved["states"].back()[1] = lift;
    for (std::size_t i = 0; i + 1 < moved["states"].size(); ++i) {
      Json& segment = moved["proof"]["segments"][i];
      for (Json& pair : segment["pairs"]) {
        for (Json& interval : pair["intervals"]) promiseLess(interval[2]);
        pair["digest"] = verify::pairDigest(pair);
      }
      segment["states_digest"] = verify::stateDigest(moved["states"][i], moved["states"][i + 1]);
    }
    more.insert(more.begin(), {"verify", gantry.folder().write("moved.json", moved.dump())});
    return runSwept(more);
  };
  EXPECT_EQ(verified(1.0, {}).err, "");
  for (const auto& [value, text] :
       {std::pair{1.000000002, "1.000000002, 2e-09"}, {1.000009, "1.000009, 9e-06"}}) {
    const Outcome run = verified(value, {});
    EXPECT_EQ(run.exitCode, 0) << run.out;
    EXPECT_EQ(run.err, kWarning + "lift is " + text + " beyond its limit 1: proven as it is\n");
    EXPECT_EQ(verified(value, {"-q"}).err, "");
  }
  const Outcome refused = verified(1.000011, {});
  EXPECT_EQ(refused.exitCode, 1);
  EXPECT_THAT(refused.out, HasSubstr(", lift: beyond its limits\n"));
}

}  // namespace
}  // namespace swept::test
