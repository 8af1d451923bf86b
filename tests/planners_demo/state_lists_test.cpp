// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "gantry.hpp"

/// States of `check` and `motion` that are not typed one by one: files, standard input, paths,
/// degrees.
namespace swept::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

class StateLists : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) const {
    return gantry_.folder().write(name, text);
  }
  Json states(const std::vector<std::string>& more) const {
    std::vector<std::string> arguments = more;
    arguments.emplace_back("--json");
    Json list = jsonOf(gantry_.run("check", arguments))["states"];
    for (Json& state : list) state.erase("label");
    return list;
  }
  std::string refusal(const std::string& command, const std::vector<std::string>& more) const {
    const Outcome run = gantry_.run(command, more);
    EXPECT_EQ(run.exitCode, 3) << run.out;
    EXPECT_EQ(run.out, "");
    return run.err;
  }

  Gantry gantry_;
};

TEST_F(StateLists, AFileHasAStateOnEachLine) {
  const std::string text = "# slide, lift\n0,0.25\n\n1.5 0.5  # blanks\n\tleft\r\n 1, 0";
  const std::string file = write("states.txt", text);
  const Json typed = states({"0,0.25", "1.5,0.5", "left", "1,0"});
  EXPECT_EQ(states({"@" + file}), typed);
  EXPECT_EQ(states({"0,0.25", "@" + write("rest.txt", "1.5,0.5\nleft\n1,0\n")}), typed);
  EXPECT_EQ(states({"@" + write("mark.txt", "\xef\xbb\xbf" + text)}), typed);
  const Outcome run = gantry_.run("check", {"@" + file});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, StartsWith(file + ":2: free"));
  EXPECT_THAT(run.out, HasSubstr("\n" + file + ":6: collision"));
}

TEST_F(StateLists, StandardInputIsSuchAFile) {
  const Outcome run = runShell("printf '0,0.25\\n1 0\\n' | swept check " + gantry_.urdf +
                               " - --scene " + gantry_.scene + " --group both");
  EXPECT_EQ(run.exitCode, 1) << run.err;
  EXPECT_THAT(run.out, StartsWith("-:1: free"));
  EXPECT_THAT(run.out, HasSubstr("\n-:2: collision"));
}

TEST_F(StateLists, APathFileHasItsStates) {
  const std::string file = write("path.csv", "lift,slide\n0.5,0\n0.5,2\n0,2\n");
  const auto segments = [&](const std::vector<std::string>& given) {
    std::vector<std::string> arguments = given;
    arguments.emplace_back("--json");
    Json list = jsonOf(gantry_.run("motion", arguments))["segments"];
    for (Json& segment : list) {
      segment.erase("from");
      segment.erase("to");
    }
    return list;
  };
  EXPECT_EQ(segments({file}), segments({"0,0.5", "2,0.5", "2,0"}));
  EXPECT_EQ(segments({"@" + file, "left"}), segments({"0,0.5", "2,0.5", "2,0", "left"}));
  EXPECT_THAT(gantry_.run("motion", {file}).out,
              StartsWith(file + " state 1 to " + file + " state 2: free"));
}

TEST_F(StateLists, DegreesAreOfAnglesAlone) {
  const auto values = [](const std::string& state, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"check", "models/robots/rook7/rook7.urdf", state, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return jsonOf(runSwept(arguments))["states"][0]["values"].get<std::vector<double>>();
  };
  const std::vector<std::string> arm{"--joints", "joint1,joint2,finger_joint"};
  std::vector<std::string> inDegrees = arm;
  inDegrees.emplace_back("--degrees");
  const std::vector<double> q = values("90,-45,0.02", inDegrees);
  ASSERT_EQ(q.size(), 3u);
  EXPECT_DOUBLE_EQ(q[0], std::numbers::pi / 2.0);
  EXPECT_DOUBLE_EQ(q[1], -std::numbers::pi / 4.0);
  EXPECT_EQ(q[2], 0.02);
  const TemporaryFolder folder;
  const std::string file = folder.write("states.txt", "90 -45 0.02\n");
  EXPECT_EQ(values("@" + file, inDegrees), q);
  EXPECT_EQ(values("home", {"--group", "arm", "--degrees"}), values("home", {"--group", "arm"}));
}

TEST_F(StateLists, TwoHundredThousandStatesAreJudgedEachByItself) {
  constexpr std::size_t kCount = 200'000;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> slide(-0.5, 2.5), lift(0.0, 1.0);
  std::string text;
  std::vector<bool> isFree;
  std::size_t free = 0;
  while (isFree.size() < kCount) {
    const double x = slide(random), z = lift(random);
    const double distance = Gantry::distance(x, z);
    if (distance < 1e-6 && distance > 0.0) continue;  // too near to say
    text += std::to_string(x) + " " + std::to_string(z) + "\n";
    const double readX = std::stod(std::to_string(x)), readZ = std::stod(std::to_string(z));
    isFree.push_back(Gantry::distance(readX, readZ) > 0.0);
    free += isFree.back();
  }
  ASSERT_GT(free, kCount / 2);
  ASSERT_LT(free, kCount);
  const std::string file = write("states.txt", text);
  const Json json = jsonOf(gantry_.run("check", {"@" + file, "--json"}));
  EXPECT_EQ(json["count"], kCount);
  ASSERT_EQ(json["verdicts"].size(), kCount);
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < kCount; ++i)
    wrong += json["verdicts"][i] != (isFree[i] ? "free" : "collision");
  EXPECT_EQ(wrong, json["undecided"].get<std::size_t>()) << "what is not decided is not wrong";
  EXPECT_LT(wrong, 20u);
  EXPECT_EQ(json["states"].size(), 20u);
  const Outcome run = gantry_.run("check", {"@" + file});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out,
              StartsWith("200000 states: " + std::to_string(json["free"].get<int>()) + " free, "));
  EXPECT_THAT(run.out, HasSubstr("further states that are not free\n"));
}

TEST_F(StateLists, ManyMotionsAreCounted) {
  // Up and over the post, and every tenth time through it.
  std::string text;
  for (int i = 0; i < 500; ++i) {
    const std::string height = i % 10 == 9 ? "0.1" : "0.5";
    text += (i % 2 == 0 ? "0," + height + "\n2," : "2," + height + "\n0,") + height + "\n";
  }
  text += "0,0.5\n";
  const Outcome run = gantry_.run("motion", {"@" + write("states.txt", text)});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, StartsWith("1000 motions: 950 free, 50 in collision\n"));
  EXPECT_THAT(run.out, HasSubstr("and 30 further motions that are not free\n"));
}

TEST_F(StateLists, AreRefusedWithFileAndLine) {
  EXPECT_EQ(refusal("check", {"@" + write("bad.txt", "0,0\n0,zero\n")}),
            gantry_.folder().path("bad.txt") +
                ":2: error: state: lift is 'zero', which is not a number\n");
  EXPECT_EQ(
      refusal("check", {"@" + write("short.txt", "0,0,0\n")}),
      gantry_.folder().path("short.txt") + ":1: error: state: 3 values, expected 2: slide,lift\n");
  EXPECT_EQ(
      refusal("check", {"@" + write("far.txt", "\n0 7\n")}),
      gantry_.folder().path("far.txt") + ":2: error: state: lift is 7, allowed is 0 to 1 m\n");
  EXPECT_EQ(refusal("check", {"@" + write("old.txt", "0,0\r# right\r1,0\r")}),
            gantry_.folder().path("old.txt") +
                ":1: error: a carriage return is within the line; a line ends with a line feed\n");
  EXPECT_EQ(refusal("check", {"@" + write("empty.txt", "# nothing\n")}),
            gantry_.folder().path("empty.txt") + ": error: there is no state in it\n");
  EXPECT_EQ(refusal("check", {"@" + gantry_.folder().path("absent.txt")}),
            gantry_.folder().path("absent.txt") + ": error: file not found\n");
  EXPECT_EQ(refusal("check", {"@"}), "swept: error: @: expected @FILE\n");
  EXPECT_EQ(refusal("motion", {"-", "-"}), "swept: error: -: standard input is read once\n");
  EXPECT_EQ(refusal("motion", {"--degrees", "path.csv"}),
            "swept: error: --degrees and 'path.csv' cannot be combined: the angles of a path file "
            "are in rad\n");
  EXPECT_THAT(refusal("plan", {"@" + write("ends.txt", "0,0\n2,0\n"), "right"}),
              HasSubstr("no named state '@"));
  std::string many;
  for (int i = 0; i < 1001; ++i) many += "0,0\n";
  EXPECT_EQ(
      refusal("check", {"@" + write("many.txt", many), "--html", gantry_.folder().path("p.html")}),
      "swept: error: --html shows 1000 states at most; these are 1001\n");
}

TEST_F(StateLists, DumpsAreOfStatesAsTheyAre) {
  const std::string file = write("states.txt", "1,0\n");
  const std::string folder = gantry_.folder().path("dumps");
  EXPECT_EQ(gantry_.run("check", {"@" + file, "--dump", folder}).exitCode, 1);
  EXPECT_EQ(runShell("swept replay " + folder + "/*.json").exitCode, 0);
}

}  // namespace
}  // namespace swept::test
