// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "gantry.hpp"
#include "page_data.hpp"

/// `swept certify` judges a path that comes from elsewhere, and `swept verify` takes its proof.
namespace swept::test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::StartsWith;

/// Over the post, in columns of another order.
const std::string kOver = "lift,slide\n0,0\n0.5,0\n0.5,2\n0,2\n";
/// Through it.
const std::string kThrough = "slide,lift\n0,0\n0.5,0\n2,0\n";

class Certify : public testing::Test {
 protected:
  Outcome run(const std::string& file, std::vector<std::string> more = {}) const {
    more.insert(more.begin(), file);
    return gantry_.run("certify", more);
  }
  std::string path(const std::string& name) const { return gantry_.folder().path(name); }
  std::string write(const std::string& name, const std::string& text) const {
    return gantry_.folder().write(name, text);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }

  Gantry gantry_;
};

TEST_F(Certify, KeepsTheClearanceThatItClaims) {
  const Outcome run = this->run(write("over.csv", kOver), {"--json"});
  EXPECT_EQ(run.exitCode, 0) << run.err;
  const Json json = jsonOf(run);
  EXPECT_EQ(json["verdict"], "free");
  EXPECT_EQ(json["proven"], true);
  EXPECT_EQ(json["count"], 3);
  EXPECT_EQ(json["free"], 3);
  EXPECT_TRUE(json["segments"].empty());
  EXPECT_TRUE(json["proof_file"].is_null());
  const std::vector<std::vector<double>> states{{0, 0}, {0, 0.5}, {2, 0.5}, {2, 0}};
  double least = INFINITY;
  for (std::size_t i = 1; i < states.size(); ++i)
    least = std::min(least, Gantry::leastDistance(states[i - 1], states[i]));
  EXPECT_LE(json["clearance_world"].get<double>(), least);
  EXPECT_GE(json["clearance_world"].get<double>(), least - 2e-4);
  EXPECT_EQ(json["nearest_world"], (Json{"cube", "post"}));
}

TEST_F(Certify, WhatPlanWritesCertifiesInEachFormat) {
  for (const std::string ending : {".csv", ".yaml", ".json"}) {
    SCOPED_TRACE(ending);
    const std::string planned = path("planned" + ending), proof = path("proof.json");
    ASSERT_EQ(gantry_.plan({"left", "right", "-o", planned}).exitCode, 0);
    const Outcome run = this->run(planned, {"-o", proof});
    EXPECT_EQ(run.exitCode, 0) << run.err;
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(run.out, HasSubstr("proof written to " + proof + "\n"));
    const Outcome checked = runSwept({"verify", proof});
    EXPECT_EQ(checked.exitCode, 0) << checked.out << checked.err;
    EXPECT_THAT(checked.out, StartsWith("verified: "));
    // And it is a path again.
    EXPECT_EQ(this->run(proof).exitCode, 0);
  }
}

TEST_F(Certify, AProofThatWasChangedIsRefused) {
  const std::string proof = path("proof.json");
  ASSERT_EQ(run(write("over.csv", kOver), {"-o", proof, "--embed"}).exitCode, 0);
  auto json = nlohmann::ordered_json::parse(gantry_.folder().read("proof.json"));
  ASSERT_EQ(json["states"].size(), 4u);
  json["states"][1][1] = 0.4;
  const Outcome changed = runSwept({"verify", write("changed.json", json.dump())});
  EXPECT_EQ(changed.exitCode, 1);
  EXPECT_EQ(changed.out, "refused: state 2: is not as it was when the path was certified\n");
}

TEST_F(Certify, AnEmbeddedProofNeedsNoOtherFile) {
  ASSERT_EQ(run(write("over.csv", kOver), {"-o", path("proof.json"), "--embed"}).exitCode, 0);
  const TemporaryFolder elsewhere;
  const std::string alone = elsewhere.write("proof.json", gantry_.folder().read("proof.json"));
  EXPECT_EQ(runSwept({"verify", alone}).exitCode, 0);
}

TEST_F(Certify, TellsWhichSegmentsAreNotFreeAndWritesNoProof) {
  const Outcome run = this->run(write("through.csv", kThrough), {"-o", path("proof.json")});
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, StartsWith("2 segments: 1 free, 1 in collision\n"
                                  "state 2 to state 3: collision\n"
                                  "  free until  t = 0.19"));
  EXPECT_THAT(run.out, HasSubstr("cube - post"));
  EXPECT_THAT(run.out,
              HasSubstr("no proof written to " + path("proof.json") + ": the path is not free\n"));
  EXPECT_FALSE(exists("proof.json"));
  const Json json = jsonOf(this->run(path("through.csv"), {"-o", path("proof.json"), "--json"}));
  EXPECT_EQ(json["verdict"], "collision");
  EXPECT_EQ(json["proven"], false);
  ASSERT_EQ(json["segments"].size(), 1u);
  EXPECT_EQ(json["segments"][0]["from"], "state 2");
  EXPECT_TRUE(json["clearance_world"].is_null());
  EXPECT_EQ(json["no_proof"], "the path is not free");
}

TEST_F(Certify, OfManyBadSegmentsTheFirstAreTold) {
  std::string zigzag = "slide,lift\n0,0\n";
  for (int i = 0; i < 25; ++i) zigzag += "2,0\n0,0\n";
  const Outcome run = this->run(write("zigzag.csv", zigzag));
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_THAT(run.out, StartsWith("50 segments: 50 in collision\n"));
  EXPECT_THAT(run.out, HasSubstr("state 20 to state 21: collision\n"));
  EXPECT_THAT(run.out, testing::Not(HasSubstr("state 21 to state 22")));
  EXPECT_THAT(run.out, HasSubstr("and 30 further segments that are not free\n"));
}

TEST_F(Certify, TheMarginIsTheLimit) {
  // Half a metre up, the cube passes the post 0.3 m above it.
  const std::string file = write("over.csv", kOver);
  EXPECT_EQ(run(file, {"--margin", "0.29"}).exitCode, 0);
  const Outcome nearer = run(file, {"--margin", "0.31", "-o", path("proof.json")});
  EXPECT_EQ(nearer.exitCode, 1);
  EXPECT_THAT(nearer.out, HasSubstr("collision (closer than the margin)"));
  EXPECT_FALSE(exists("proof.json"));
}

TEST_F(Certify, AgreesWithMotion) {
  for (const std::string& text : {kOver, kThrough}) {
    const std::string file = write("path.csv", text);
    const Json motion = jsonOf(gantry_.run("motion", {file, "--json"}));
    const Json certified = jsonOf(run(file, {"--json"}));
    std::size_t free = 0;
    for (const Json& segment : motion["segments"]) free += segment["verdict"] == "free";
    EXPECT_EQ(certified["free"], free);
    EXPECT_EQ(certified["count"], motion["segments"].size());
  }
}

TEST_F(Certify, ACurveIsWarnedOfAndTheProofSaysSo) {
  const std::string file =
      write("curve.yaml",
            "joint_names: [slide, lift]\npoints:\n- {positions: [0, 0.5], velocities: [0, 0]}\n"
            "- {positions: [2, 0.5], velocities: [0, 0]}\n");
  const Outcome run = this->run(file, {"-o", path("proof.json"), "-q"});
  EXPECT_EQ(run.exitCode, 0);
  const std::string line = file +
                           ":3: warning: points have velocities or accelerations: what is looked "
                           "at is the straight motion between the points, not the curve of a "
                           "controller";
  EXPECT_EQ(run.err, line + "\n");
  EXPECT_EQ(Json::parse(gantry_.folder().read("proof.json"))["warnings"], Json{line});
}

TEST_F(Certify, OneStateStaysWhereItIs) {
  EXPECT_EQ(run(write("one.csv", "slide,lift\n0,0\n"), {"-o", path("proof.json")}).exitCode, 0);
  EXPECT_EQ(runSwept({"verify", path("proof.json")}).exitCode, 0);
  EXPECT_EQ(run(write("one.csv", "slide,lift\n1,0\n")).exitCode, 1);
}

TEST_F(Certify, WhatIsUndecidedHasNoProof) {
  // As near to the post as rounding can say.
  const std::string file = write("near.csv", "slide,lift\n0.79999999999999,0\n");
  const Outcome run = this->run(file, {"-o", path("proof.json")});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_THAT(run.out, StartsWith("1 segment: 1 undecided\nstate 1 to state 1: undecided\n"));
  EXPECT_FALSE(exists("proof.json"));
}

TEST_F(Certify, WritesAPage) {
  if (!programHasPages()) GTEST_SKIP() << "swept was built without three.js";
  const Outcome run = this->run(write("over.csv", kOver), {"--html", path("page.html")});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_THAT(run.out, HasSubstr("page written to " + path("page.html")));
  EXPECT_THAT(gantry_.folder().read("page.html"), HasSubstr("3 segments: all free"));
}

TEST_F(Certify, RefusesWhatItCannotDo) {
  const std::string file = write("over.csv", kOver);
  const auto refusal = [&](const std::vector<std::string>& more, const std::string& of) {
    const Outcome run = this->run(of, more);
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "");
    return run.err;
  };
  EXPECT_EQ(refusal({"-o", path("proof.csv")}, file),
            "swept: error: '" + path("proof.csv") + "': a file with a proof ends in .json\n");
  EXPECT_EQ(refusal({"--embed"}, file), "swept: error: --embed needs -o FILE.json\n");
  EXPECT_EQ(refusal({}, path("absent.csv")), path("absent.csv") + ": error: file not found\n");
  EXPECT_EQ(refusal({}, write("late.csv", "slide,lift\n0,0\n3,0\n")),
            path("late.csv") + ":3: error: slide is 3, allowed is -0.5 to 2.5 m\n");
  if (programHasPages()) {
    std::string longPath = "slide,lift\n";
    for (int i = 0; i < 5002; ++i) longPath += "0,0\n";
    EXPECT_EQ(refusal({"--html", path("page.html")}, write("long.csv", longPath)),
              "swept: error: --html shows 5000 segments at most; these are 5001\n");
  }
  const std::string itself =
      write("self.json", R"({"joint_names": ["slide", "lift"], "states": [[0, 0]]})");
  EXPECT_EQ(refusal({"-o", itself}, itself),
            "swept: error: -o '" + itself + "' would replace the file of path '" + itself + "'\n");
}

}  // namespace
}  // namespace swept::test
