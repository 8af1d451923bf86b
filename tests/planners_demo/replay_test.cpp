// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>

#include "data_folder.hpp"
#include "models_dir.hpp"
#include "program.hpp"

namespace swept::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kFile = "models/cases.json";

json ourCases() {
  std::ifstream stream(modelsDir() + "/cases.json");
  return json::parse(stream);
}

json& caseOf(json& file, const std::string& id) {
  for (json& item : file["cases"])
    if (item["id"] == id) return item;
  throw std::runtime_error("no case " + id);
}

std::string lastLine(const std::string& text) {
  const auto end = text.find_last_not_of('\n');
  const auto start = text.rfind('\n', end);
  return text.substr(start + 1, end - start);
}

Outcome replay(const json& file) {
  const TemporaryFolder folder;
  return runSwept({"replay", folder.write("cases.json", file.dump())});
}

TEST(Replay, OurCasesPassAndTheUnknownShapeIsSkipped) {
  const Outcome run = runSwept({"replay", kFile});
  EXPECT_EQ(run.exitCode, 0) << run.out;
  EXPECT_EQ(run.err, "");
  EXPECT_EQ(lastLine(run.out), "19 passed, 0 failed, 1 skipped");
  EXPECT_THAT(run.out, testing::ContainsRegex("\ncubes-overlap +penetration +-0.3 +-0.3 .* ok\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex("\nball-in-mesh +distance +0 +0 +0 +ok\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex("\ncylinders-crossed +collide +yes +yes +- +ok\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex("\nballs-clear +collide +no +no +- +ok\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex("\ncubes-touching +collide .* either +- +ok\n"));
  EXPECT_THAT(run.out,
              testing::ContainsRegex("\nball-through-plate +ccd +0.46875 +0.46875 .* ok\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex("\nballs-that-pass +ccd +free +free +- +ok\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex(
                           "\ntorus +signed_distance +- +- +- +skipped \\(shape torus\\)\n"));
}

TEST(Replay, JsonHasIntervalsAroundTheDistancesByHand) {
  const Outcome run = runSwept({"replay", "--json", kFile});
  const json result = jsonOf(run);
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(result["passed"], 19);
  EXPECT_EQ(result["failed"], 0);
  EXPECT_EQ(result["skipped"], 1);
  const std::map<std::string, double> byHand = {
      {"spheres-apart", std::hypot(3.0, 4.0) - 0.75},
      {"cubes-overlap", 1.2 - 1.0 - 0.5},
      {"cube-edge-on", 1.5 - 0.5 - std::sqrt(0.5)},
      {"capsule-over-box", 0.65 - 0.5 - 0.1},
      {"ball-at-octahedron", (3.0 - 1.0) / std::sqrt(3.0) - 0.2},
      {"ball-in-triangle", 0.3 - 0.5},
      {"cone-and-ball", std::hypot(4.0, 0.5) - 1.0},
      {"ball-off-ellipsoid", 4.0 - 2.0 - 0.5},
      {"box-through-plane", -(0.5 - 0.25)},
      {"cylinder-in-ground", 0.75 - 1.0},
      {"ball-over-terrain", 2.0 - 1.0 - 0.25},
      {"box-among-voxels", 1.5 - 0.5},
      {"ball-through-plate", (8.0 - 0.25 - 0.25) / 16.0},
      {"bar-turns-into-ground", 1.0 / 3.0},
  };
  std::size_t found = 0;
  for (const json& item : result["cases"]) {
    if (!byHand.contains(item["id"])) continue;
    const double distance = byHand.at(item["id"]);
    ++found;
    EXPECT_LE(item["lower"], distance + 1e-12) << item;
    EXPECT_GE(item["upper"], distance - 1e-12) << item;
    EXPECT_NEAR(item["answer"], distance, 1e-9) << item;
    EXPECT_LE(item["error"], 1e-9) << item;
    EXPECT_GE(item["seconds"], 0.0) << item;
    EXPECT_EQ(item["result"], "ok") << item;
    EXPECT_EQ(item["reason"], "") << item;
  }
  EXPECT_EQ(found, byHand.size());
  EXPECT_EQ(result["cases"].back()["result"], "skipped");
  EXPECT_EQ(result["cases"].back()["reason"], "shape torus");
  EXPECT_EQ(result["cases"].back()["answer"], "-");
}

TEST(Replay, AWrongDistanceFailsAndARightOneWithinToleranceDoesNot) {
  for (const double off : {-2e-3, -0.5e-3, 0.5e-3, 2e-3}) {
    json file = ourCases();
    caseOf(file, "cubes-overlap")["expected"] = {{"signed_distance", -0.3 + off},
                                                 {"tolerance", 1e-3}};
    const Outcome run = replay(file);
    const bool wrong = std::abs(off) > 1e-3;
    EXPECT_EQ(run.exitCode, wrong ? 1 : 0);
    EXPECT_EQ(run.err, "");
    EXPECT_EQ(lastLine(run.out),
              wrong ? "18 passed, 1 failed, 1 skipped" : "19 passed, 0 failed, 1 skipped");
    if (wrong) {
      EXPECT_THAT(run.out, testing::ContainsRegex(
                               "\ncubes-overlap .* 0.002 +FAILED \\(off by more than 0.001\\)\n"));
    }
  }
}

TEST(Replay, AWrongYesOrNoFails) {
  json file = ourCases();
  caseOf(file, "cylinders-crossed")["expected"]["state"] = "separated";
  caseOf(file, "balls-clear")["expected"]["collides"] = true;
  const Outcome run = replay(file);
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(lastLine(run.out), "17 passed, 2 failed, 1 skipped");
  EXPECT_THAT(run.out, testing::ContainsRegex("\ncylinders-crossed .* FAILED \\(wrong\\)\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex("\nballs-clear .* FAILED \\(wrong\\)\n"));
}

TEST(Replay, AWrongFirstContactFails) {
  json file = ourCases();
  caseOf(file, "ball-through-plate")["expected"]["time_of_contact"] = 0.46875 + 2e-9;
  caseOf(file, "bar-turns-into-ground")["expected"] = {{"collides", false}, {"tolerance", 1e-9}};
  caseOf(file, "balls-that-pass")["expected"] = {
      {"collides", true}, {"time_of_contact", 0.5}, {"tolerance", 1e-9}};
  const Outcome run = replay(file);
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(lastLine(run.out), "16 passed, 3 failed, 1 skipped") << run.out;
  EXPECT_THAT(run.out, testing::ContainsRegex(
                           "\nball-through-plate .* FAILED \\(off by more than 1e-09\\)\n"));
  EXPECT_THAT(run.out,
              testing::ContainsRegex(
                  "\nbar-turns-into-ground +ccd +collision +free +- +FAILED \\(wrong\\)\n"));
}

TEST(Replay, AnUnknownInterpolationIsSkipped) {
  json file = ourCases();
  caseOf(file, "ball-through-plate")["motions"][0]["interpolation"] = "by hand";
  const Outcome run = replay(file);
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(lastLine(run.out), "18 passed, 0 failed, 2 skipped");
  EXPECT_THAT(run.out, HasSubstr("skipped (interpolation by hand)"));
}

TEST(Replay, OverflowIsAFailureAndNotAnAnswer) {
  json file = ourCases();
  for (const char* id : {"spheres-apart", "cubes-touching"})
    caseOf(file, id)["transforms"][1][0][3] = 1.7e308;
  caseOf(file, "cubes-touching")["transforms"][0][0][3] = -1.7e308;
  caseOf(file, "cubes-touching")["expected"] = {{"collides", false}};
  const Outcome run = replay(file);
  EXPECT_EQ(run.exitCode, 1);
  EXPECT_EQ(lastLine(run.out), "17 passed, 2 failed, 1 skipped") << run.out;
}

TEST(Replay, PosesFarFromTheOriginKeepTheirDigits) {
  json file = ourCases();
  json& item = caseOf(file, "cube-edge-on");
  for (json& transform : item["transforms"])
    for (int row = 0; row < 3; ++row)
      transform[row][3] = transform[row][3].get<double>() + 1048576.0;
  const TemporaryFolder folder;
  const json result = jsonOf(runSwept({"replay", "--json", folder.write("far.json", file.dump())}));
  EXPECT_NEAR(result["cases"][2]["answer"], 1.0 - std::sqrt(0.5), 1e-9);
}

TEST(Replay, ATerrainInWordsIsFlat) {
  json file = ourCases();
  json& shape = caseOf(file, "ball-over-terrain")["shapes"][0];
  shape.erase("base");
  shape["heights"] = "flat, all 1, 9x5 samples, base -1";
  EXPECT_EQ(lastLine(replay(file).out), "19 passed, 0 failed, 1 skipped");
  shape["heights"] = "flat, all 0.5, 9x5 samples, base -1";
  EXPECT_EQ(lastLine(replay(file).out), "18 passed, 1 failed, 1 skipped");
}

TEST(Replay, AHalfSpaceDoesNotMakeEveryAnswerRight) {
  json file = ourCases();
  caseOf(file, "cylinder-in-ground")["expected"]["signed_distance"] = -0.26;
  EXPECT_EQ(lastLine(replay(file).out), "18 passed, 1 failed, 1 skipped");
}

TEST(Replay, AnUnknownQueryIsSkippedWithoutReadingTheRest) {
  const Outcome run = replay({{"cases", {{{"id", "a"}, {"query", "sweep"}}}}});
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(lastLine(run.out), "0 passed, 0 failed, 1 skipped");
  EXPECT_THAT(run.out, HasSubstr("skipped (query sweep)"));
}

/// What is done to our cases, and what is said about it.
struct Broken {
  std::string name;
  std::string id;
  std::string pointer;  ///< JSON pointer into the case
  json value;
  std::string message;
};

/// GoogleTest would print its bytes.
void PrintTo(const Broken& test, std::ostream* out) {
  *out << test.name;
}

class BrokenCase : public testing::TestWithParam<Broken> {};

TEST_P(BrokenCase, ExitsWith3AndNamesCaseKeyAndValue) {
  json file = ourCases();
  caseOf(file, GetParam().id)[json::json_pointer(GetParam().pointer)] = GetParam().value;
  const TemporaryFolder folder;
  const std::string path = folder.write("cases.json", file.dump());
  const Outcome run = runSwept({"replay", path});
  EXPECT_EQ(run.exitCode, 3) << "signal " << run.signal;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, path + ": error: " + GetParam().message + "\n");
}

const json kMirrored = {{-1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};

const Broken kBroken[] = {
    {"NegativeRadius", "spheres-apart", "/shapes/0/radius", -1,
     "case 'spheres-apart': shapes[0].radius is -1; it must be 0 or more"},
    {"RadiusIsText", "spheres-apart", "/shapes/1/radius", "big",
     "case 'spheres-apart': shapes[1].radius is \"big\"; it must be a finite number"},
    {"SizeOfTwo",
     "cubes-overlap",
     "/shapes/1/size",
     {1, 1},
     "case 'cubes-overlap': shapes[1].size holds 2 values; it must hold 3"},
    {"FlatMesh",
     "ball-in-mesh",
     "/shapes/0/size",
     {1, 0, 1},
     "case 'ball-in-mesh': shapes[0].size is [1,0,1]; it must be greater than 0"},
    {"NoLength",
     "capsule-over-box",
     "/shapes/0",
     {{"type", "capsule"}, {"radius", 1}},
     "case 'capsule-over-box': shapes[0].length is missing"},
    {"NoPoints", "ball-at-octahedron", "/shapes/0/vertices", json::array(),
     "case 'ball-at-octahedron': shapes[0].vertices must hold at least one point"},
    {"NoTriangle",
     "ball-in-triangle",
     "/shapes/0/vertices",
     {{0, 0, 0}, {1, 0, 0}},
     "case 'ball-in-triangle': shapes[0].vertices holds 2 values; it must hold 3"},
    {"ZeroNormal",
     "box-through-plane",
     "/shapes/0/normal",
     {0, 0, 0},
     "case 'box-through-plane': shapes[0] is no shape: plane has normal (0, 0, 0) and offset 1; "
     "allowed: finite numbers, a normal that is not zero"},
    {"RaggedTerrain",
     "ball-over-terrain",
     "/shapes/0/heights/1",
     {0, 1},
     "case 'ball-over-terrain': shapes[0].heights[1] holds 2 values; it must hold 3"},
    {"TerrainBelowItsBase", "ball-over-terrain", "/shapes/0/base", 0.5,
     "case 'ball-over-terrain': shapes[0] is no shape: height field has height 0 in row 0, column "
     "0; allowed: finite and greater than the base, 0.5"},
    {"TerrainInWords", "ball-over-terrain", "/shapes/0/heights", "hilly",
     "case 'ball-over-terrain': shapes[0].heights is \"hilly\"; it must be rows of numbers, or "
     "'flat, all H, RxC samples, base B'"},
    {"NoVoxelSize", "box-among-voxels", "/shapes/1/resolution", 0,
     "case 'box-among-voxels': shapes[1].resolution is 0; it must be greater than 0"},
    {"OneShape",
     "balls-clear",
     "/shapes",
     {{{"type", "sphere"}, {"radius", 1}}},
     "case 'balls-clear': shapes holds 1 values; it must hold 2"},
    {"NoTransforms", "balls-clear", "/transforms", nullptr,
     "case 'balls-clear': transforms must be a list"},
    {"Scaled", "balls-clear", "/transforms/1/0/0", 2,
     "case 'balls-clear': transforms[1] does not turn and move only: its first three columns must "
     "be orthonormal to 1e-6, with determinant 1"},
    {"Mirrored", "balls-clear", "/transforms/0", kMirrored,
     "case 'balls-clear': transforms[0] does not turn and move only: its first three columns must "
     "be orthonormal to 1e-6, with determinant 1"},
    {"Projective", "balls-clear", "/transforms/0/3/0", 1,
     "case 'balls-clear': transforms[0][3] is [1,0,0,1]; it must be [0, 0, 0, 1]"},
    {"NoDistance",
     "spheres-apart",
     "/expected",
     {{"tolerance", 1}},
     "case 'spheres-apart': expected.signed_distance is missing"},
    {"NegativeTolerance", "spheres-apart", "/expected/tolerance", -1e-9,
     "case 'spheres-apart': expected.tolerance is -1e-09; it must be 0 or more"},
    {"UnknownState", "cubes-touching", "/expected/state", "near",
     "case 'cubes-touching': expected.state is \"near\"; it must be separated, touching or "
     "penetrating"},
    {"NoAnswer", "cubes-touching", "/expected", json::object(),
     "case 'cubes-touching': expected.collides is missing"},
    {"Contradiction", "cylinders-crossed", "/expected/collides", false,
     "case 'cylinders-crossed': expected.collides contradicts the state"},
    {"NoMotions", "balls-that-pass", "/motions", nullptr,
     "case 'balls-that-pass': motions must be a list"},
    {"NoTime",
     "ball-through-plate",
     "/expected",
     {{"collides", true}, {"tolerance", 1}},
     "case 'ball-through-plate': expected.time_of_contact is missing"},
    {"TurnsOnAStraightLine", "bar-turns-into-ground", "/motions/1/interpolation",
     "linear translation, constant rotation",
     "case 'bar-turns-into-ground': motions[1].end turns, which 'linear translation, constant "
     "rotation' does not"},
    {"RepeatedId", "cubes-overlap", "/id", "spheres-apart", "cases[1].id repeats 'spheres-apart'"},
    {"IdIsANumber", "cubes-overlap", "/id", 7, "cases[1].id is 7; it must be text"},
};

std::string nameOf(const testing::TestParamInfo<Broken>& info) {
  return info.param.name;
}

INSTANTIATE_TEST_SUITE_P(Replay, BrokenCase, testing::ValuesIn(kBroken), nameOf);

TEST(Replay, BrokenFilesAreNamedWithTheirLine) {
  const TemporaryFolder folder;
  const std::pair<std::string, std::string> files[] = {
      {"{\n\"cases\": [\n}", ":3: error: malformed JSON: syntax error"},
      {"{\"cases\": [1e999]}", ": error: malformed JSON: number overflow"},
      {"[]", ": error: the file must be an object with the key 'cases'\n"},
      {"{}", ": error: cases is missing\n"},
      {"{\"cases\": 1}", ": error: cases must be a list\n"},
      {"{\"version\": 2, \"cases\": []}", ": error: version is 2; it must be 1\n"},
      {"{\"cases\": [3]}", ": error: cases[0] must be an object\n"},
  };
  for (const auto& [text, message] : files) {
    const std::string path = folder.write("broken.json", text);
    const Outcome run = runSwept({"replay", path});
    EXPECT_EQ(run.exitCode, 3) << text;
    EXPECT_EQ(run.out, "") << text;
    EXPECT_THAT(run.err, testing::StartsWith(path + message)) << text;
  }
  // nlohmann-json 3.11.2 and 3.11.3.
  const std::string empty = folder.write("empty.json", "");
  const std::string malformed = empty + ":1: error: malformed JSON: ";
  const Outcome nothing = runSwept({"replay", empty});
  EXPECT_EQ(nothing.exitCode, 3);
  EXPECT_EQ(nothing.out, "");
  EXPECT_THAT(
      nothing.err,
      testing::AnyOf(testing::StartsWith(malformed + "syntax error"),
                     testing::StartsWith(malformed + "attempting to parse an empty input")));
  EXPECT_EQ(runSwept({"replay", folder.path("none")}).err,
            folder.path("none") + ": error: file not found\n");
  EXPECT_EQ(runSwept({"replay", folder.path()}).err,
            folder.path() + ": error: not a regular file\n");
  EXPECT_EQ(runSwept({"replay"}).err, "swept: error: cases is required (try --help)\n");
}

TEST(Replay, CasesFromOutsidePass) {
  const auto data = dataFolder();
  if (!data) GTEST_SKIP() << "skipped: SWEPT_DATA is not set";
  const Outcome run = runSwept({"replay", *data / "regressions/cases.json"});
  EXPECT_EQ(run.exitCode, 0) << run.out << run.err;
  EXPECT_THAT(lastLine(run.out), HasSubstr(" 0 failed, "));
  EXPECT_THAT(lastLine(run.out), testing::Not(testing::StartsWith("0 passed")));
}

}  // namespace
}  // namespace swept::test
