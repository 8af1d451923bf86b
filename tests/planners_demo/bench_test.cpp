// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "gantry.hpp"
#include "models_dir.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/problems.hpp"

namespace swept::test {
namespace {

using testing::HasSubstr;
using Words = std::vector<std::string>;

const std::string kRook7 = "models/robots/rook7/rook7.urdf";
const std::string kProblems = "models/problems.json";
const std::string kEdges = "models/edges.csv";

Words rook7(const Words& more) {
  Words all{"bench", "edges", kRook7, "--group", "arm", "--problems", kProblems, "--edges", kEdges};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Columns are in the order of the problem's joint names: lift, then slide.
const std::string kHeader = "set,index,from0,from1,to0,to1,length\n";
// By hand: through the post, over it, and closer to its top than rounding can tell.
const std::string kRows =
    "over,1,0,0,0,2,1.96\n"
    "over,1,1,0,1,2,2.04\n"
    "over,2,0.5,0,0.5,1,1\n"
    "over,1,0.20000000000001,0,0.20000000000001,2,2\n";

Outcome gantryBench(const Gantry& gantry, const std::string& edges, const Words& more = {}) {
  Words all{"bench",      "edges",         gantry.urdf, "--group", "both",
            "--problems", gantry.problems, "--edges",   edges};
  all.insert(all.end(), more.begin(), more.end());
  return runSwept(all);
}

std::string writeCompressed(const TemporaryFolder& folder, const std::string& text) {
  std::string file = folder.path("edges.csv.gz");
  gzFile stream = gzopen(file.c_str(), "wb");
  gzwrite(stream, text.data(), static_cast<unsigned>(text.size()));
  gzclose(stream);
  return file;
}

/// What the Checker itself says of the motions of models/edges.csv, by length and by verdict; both
/// also `all`.
struct Counts {
  int edges = 0, tier1 = 0, tier2 = 0, undecided = 0;
  double lanes = 0.0;  ///< sum
};
using CountTable = std::map<std::pair<std::string, std::string>, Counts>;

std::vector<std::string> cellsOf(const std::string& line, char separator) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  for (std::string cell; std::getline(stream, cell, separator);) cells.push_back(cell);
  return cells;
}

void countMotion(CountTable& table, const std::string& length,
                 const MotionCertificate& certificate) {
  const std::string verdict(toString(certificate.verdict));
  for (const std::string& row : {length, std::string("all")}) {
    for (const std::string& column : {verdict, std::string("all")}) {
      Counts& counts = table[{row, column}];
      ++counts.edges;
      const bool decided = certificate.verdict != Verdict::Undecided;
      ++(!decided                            ? counts.undecided
         : certificate.effort.intervals == 0 ? counts.tier1
                                             : counts.tier2);
      counts.lanes += static_cast<double>(certificate.effort.lanes);
    }
  }
}

CountTable countsOfTheChecker() {
  const std::string root = modelsDir() + "/";
  const auto robot =
      Robot::load(root + "robots/rook7/rook7.urdf", root + "robots/rook7/rook7.srdf");
  const ProblemFile problems = ProblemFile::load(root + "problems.json");
  std::ifstream stream(root + "edges.csv");
  std::string line;
  std::getline(stream, line);
  CountTable table;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cellsOf(line, ',');
    std::vector<double> values;
    for (std::size_t i = 2; i < cells.size(); ++i) values.push_back(std::stod(cells[i]));
    const auto world =
        std::make_shared<const World>(problems.problem(cells[0], std::stoi(cells[1])).world);
    const Checker checker(robot, "arm", world);
    Workspace workspace(checker);
    const std::span<const double> all(values);
    std::ostringstream length;
    length << values.back();
    countMotion(table, length.str(),
                checker.certifyMotion(all.subspan(0, 7), all.subspan(7, 7), workspace,
                                      MotionQuery::VerdictOnly));
  }
  return table;
}

TEST(BenchEdges, CountsAreThoseOfTheChecker) {
  const CountTable expected = countsOfTheChecker();
  const Counts& all = expected.at({"all", "all"});
  // Representative: every length, and plenty of both verdicts.
  ASSERT_EQ(all.edges, 130);
  ASSERT_GE(expected.at({"all", "free"}).edges, 30);
  ASSERT_GE(expected.at({"all", "collision"}).edges, 30);

  const auto json = jsonOf(runSwept(rook7({"--json", "--passes", "2"})));
  EXPECT_EQ(json["robot"], "rook7");
  EXPECT_EQ(json["passes"], 2);
  EXPECT_EQ(json["checkers"], 13);
  EXPECT_EQ(json["edges"], all.edges);
  EXPECT_EQ(json["free"], expected.at({"all", "free"}).edges);
  EXPECT_EQ(json["collision"], expected.at({"all", "collision"}).edges);
  EXPECT_EQ(json["undecided"], all.undecided);
  EXPECT_TRUE(json["fcl_mean_ns"].is_null());
  EXPECT_TRUE(json["fcl_missed"].is_null());
  EXPECT_GT(json["load_s"], 0.0);
  EXPECT_GT(json["build_s"], 0.0);
  ASSERT_EQ(json["by_length"].size(), expected.size());
  for (const auto& row : json["by_length"]) {
    const std::string length =
        row["length"].is_string() ? row["length"].get<std::string>() : row["length"].dump();
    const std::string key = length.ends_with(".0") ? length.substr(0, length.size() - 2) : length;
    const Counts& counts = expected.at({key, row["verdict"]});
    EXPECT_EQ(row["edges"], counts.edges) << row;
    EXPECT_EQ(row["tiers"]["tier_1"], counts.tier1) << row;
    EXPECT_EQ(row["tiers"]["tier_2"], counts.tier2) << row;
    EXPECT_EQ(row["tiers"]["undecided"], counts.undecided) << row;
    EXPECT_NEAR(row["lanes"], counts.lanes / counts.edges, 1e-9) << row;
  }
}

TEST(BenchEdges, TimesOfAllAreTheMeanOfTheParts) {
  const auto json = jsonOf(runSwept(rook7({"--json", "--passes", "2"})));
  double sum = 0.0;
  for (const std::string verdict : {"free", "collision", "undecided"})
    if (json[verdict] > 0)
      sum += json[verdict].get<double>() * json[verdict + "_mean_ns"].get<double>();
    else
      EXPECT_TRUE(json[verdict + "_mean_ns"].is_null());
  EXPECT_NEAR(sum / json["edges"].get<double>(), json["mean_ns"], 1e-6 * sum);
  for (const auto& row : json["by_length"]) {
    EXPECT_GT(row["median_ns"], 0.0);
    EXPECT_GE(row["p95_ns"], row["median_ns"]);
  }
}

TEST(BenchEdges, TheTextHasARowPerLengthAndVerdict) {
  const CountTable expected = countsOfTheChecker();
  const Outcome run = runSwept(rook7({"--passes", "1"}));
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, HasSubstr("rook7, group arm: 130 motions in the worlds of 13 problems\n"));
  EXPECT_THAT(run.out, HasSubstr("the least of 1 pass, less the clock's own "));
  std::size_t rows = 0;
  std::istringstream lines(run.out);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::string length, verdict;
    int motions = 0;
    cells >> length >> verdict >> motions;
    if (length.ends_with(".0")) length.resize(length.size() - 2);
    const auto found = expected.find({length, verdict});
    if (found == expected.end()) continue;
    ++rows;
    EXPECT_EQ(motions, found->second.edges) << line;
  }
  EXPECT_EQ(rows, expected.size());
}

TEST(BenchEdges, ColumnsAreInTheOrderOfTheProblemsJoints) {
  const Gantry gantry;
  const std::string file = gantry.folder().write("edges.csv", kHeader + kRows);
  const auto json = jsonOf(gantryBench(gantry, file, {"--json"}));
  EXPECT_EQ(json["edges"], 4);
  EXPECT_EQ(json["free"], 2);
  EXPECT_EQ(json["collision"], 1);
  EXPECT_EQ(json["undecided"], 1);
  EXPECT_EQ(json["checkers"], 2);
  // 1.96 and 2.04 are rows of 2.0.
  std::vector<std::pair<std::string, int>> totals;
  for (const auto& row : json["by_length"])
    if (row["verdict"] == "all") totals.emplace_back(row["length"].dump(), row["edges"]);
  EXPECT_THAT(totals, testing::ElementsAre(std::pair<std::string, int>("1.0", 1),
                                           std::pair<std::string, int>("2.0", 3),
                                           std::pair<std::string, int>("\"all\"", 4)));
}

TEST(BenchEdges, TheGroupIsTheOneOfTheProblems) {
  const Gantry gantry;
  const std::string file = gantry.folder().write("edges.csv", kHeader + kRows);
  const Outcome run = runSwept(
      {"bench", "edges", gantry.urdf, "--problems", gantry.problems, "--edges", file, "--json"});
  EXPECT_EQ(jsonOf(run)["group"], "both");
}

TEST(BenchEdges, MarginAndToleranceReachTheChecker) {
  const Gantry gantry;
  const std::string file = gantry.folder().write("edges.csv", kHeader + "over,1,0.25,0,0.25,2,2\n");
  EXPECT_EQ(jsonOf(gantryBench(gantry, file, {"--json", "--margin", "0.04"}))["free"], 1);
  EXPECT_EQ(jsonOf(gantryBench(gantry, file, {"--json", "--margin", "0.06"}))["collision"], 1);
  EXPECT_EQ(jsonOf(gantryBench(gantry, file, {"--json", "--tolerance", "0.01"}))["tolerance"],
            0.01);
}

TEST(BenchEdges, SetAndLimitChooseMotions) {
  const Gantry gantry;
  const std::string file =
      gantry.folder().write("edges.csv", kHeader + "blocked,7,0,0,0,2,2\n" + kRows);
  EXPECT_EQ(jsonOf(gantryBench(gantry, file, {"--json"}))["collision"], 2);
  EXPECT_EQ(jsonOf(gantryBench(gantry, file, {"--json", "--set", "over"}))["collision"], 1);
  const auto first = jsonOf(gantryBench(gantry, file, {"--json", "--limit", "3"}));
  EXPECT_EQ(first["edges"], 3);
  EXPECT_EQ(first["collision"], 2);
  EXPECT_EQ(jsonOf(gantryBench(gantry, file, {"--json", "--limit", "99"}))["edges"], 5);
}

TEST(BenchEdges, CompressedAndPlainReadTheSame) {
  const Gantry gantry;
  const std::string compressed = writeCompressed(gantry.folder(), kHeader + kRows);
  ASSERT_NE(gantry.folder().read("edges.csv.gz"), kHeader + kRows);
  for (const std::string& file :
       {compressed, gantry.folder().write("edges.csv", kHeader + kRows),
        gantry.folder().write("windows.csv",
                              "set,index,from0,from1,to0,to1,length\r\n"
                              "over,1,0,0,0,2,2\r\nover,1,1,0,1,2,2\r\n"
                              "over,2,0.5,0,0.5,1,1\r\n\r\n"
                              "over,1,0.20000000000001,0,0.20000000000001,2,2")}) {
    const auto json = jsonOf(gantryBench(gantry, file, {"--json"}));
    EXPECT_EQ(json["free"], 2) << file;
    EXPECT_EQ(json["collision"], 1) << file;
    EXPECT_EQ(json["undecided"], 1) << file;
  }
}

TEST(BenchEdges, ACompressedFileThatEndsEarlyIsRefused) {
  const Gantry gantry;
  std::string rows;
  for (int i = 0; i < 2000; ++i) rows += "over,1,0," + std::to_string(i) + ",0,1,1\n";
  const std::string whole = writeCompressed(gantry.folder(), kHeader + rows);
  const std::string bytes = gantry.folder().read("edges.csv.gz");
  const std::string file = gantry.folder().write("cut.gz", bytes.substr(0, bytes.size() / 2));
  const Outcome run = gantryBench(gantry, file);
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, file + ": error: the compressed data ends too early\n");
}

struct BadFile {
  std::string name;
  std::string text;
  std::string message;  ///< after the file's name; `%` is the folder and a slash
};

void PrintTo(const BadFile& test, std::ostream* out) {
  *out << test.name;
}

class BadEdges : public testing::TestWithParam<BadFile> {};

TEST_P(BadEdges, IsRefusedWithItsLine) {
  const Gantry gantry;
  const std::string file = gantry.folder().write("edges.csv", GetParam().text);
  std::string message = GetParam().message;
  if (const auto at = message.find('%'); at != std::string::npos)
    message.replace(at, 1, gantry.folder().path());
  const Outcome run = gantryBench(gantry, file);
  EXPECT_EQ(run.exitCode, 3);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, file + message + "\n");
}

const BadFile kBadFiles[] = {
    {"Empty", "", ": error: the file is empty"},
    {"HeaderAlone", kHeader, ": error: there are no edges in the file"},
    {"OtherDimension", "set,index,from0,to0,length\nover,1,0,1,1\n",
     ":1: error: the header is 'set,index,from0,to0,length'; for a group of 2 variables it must be "
     "'set,index,from0,from1,to0,to1,length'"},
    {"NoHeader", "over,1,0,0,0,2,2\n",
     ":1: error: the header is 'over,1,0,0,0,2,2'; for a group of 2 variables it must be "
     "'set,index,from0,from1,to0,to1,length'"},
    {"TooFewColumns", kHeader + "over,1,0,0,0,2,2\nover,1,0,0,0,2\n",
     ":3: error: 6 columns; it must be 7, as in the header"},
    {"TooManyColumns", kHeader + "over,1,0,0,0,2,2,\n",
     ":2: error: 8 columns; it must be 7, as in the header"},
    {"NotANumber", kHeader + "\nover,1,0,0,zero,2,2\n",
     ":3: error: to0 is 'zero'; it must be a finite number"},
    {"NumberWithATail", kHeader + "over,1,0,0.5m,0,2,2\n",
     ":2: error: from1 is '0.5m'; it must be a finite number"},
    {"Nan", kHeader + "over,1,nan,0,0,2,2\n",
     ":2: error: from0 is 'nan'; it must be a finite number"},
    {"Overflow", kHeader + "over,1,0,0,0,1e999,2\n",
     ":2: error: to1 is '1e999'; it must be a finite number"},
    {"EmptyLength", kHeader + "over,1,0,0,0,2,\n",
     ":2: error: length is ''; it must be a finite number"},
    {"NegativeLength", kHeader + "over,1,0,0,0,2,-2\n",
     ":2: error: length is '-2'; it must be 0 or more"},
    {"IndexNotWhole", kHeader + "over,1.5,0,0,0,2,2\n",
     ":2: error: index is '1.5'; it must be a whole number"},
    {"UnknownSet", kHeader + "over,1,0,0,0,2,2\nunder,1,0,0,0,2,2\n",
     ":3: error: there is no set 'under'; there are blocked, foreign, over (%problems.json)"},
    {"UnknownIndex", kHeader + "over,3,0,0,0,2,2\n",
     ":2: error: set 'over' has no problem 3; it has 1, 2 (%problems.json)"},
};

INSTANTIATE_TEST_SUITE_P(Files, BadEdges, testing::ValuesIn(kBadFiles),
                         [](const auto& test) { return test.param.name; });

TEST(BenchEdges, BadUseIsToldInOneLine) {
  const Gantry gantry;
  const std::string file = gantry.folder().write("edges.csv", kHeader + kRows);
  const std::string error = "swept: error: ";
  for (const auto& [more, message] : {
           std::pair{Words{"--passes", "0"},
                     error + "--passes: must be between 1 and 10000, not 0 (try --help)"},
           std::pair{Words{"--limit", "0"},
                     error + "--limit: must be 1 or more, not 0 (try --help)"},
           std::pair{Words{"--against", "bullet"},
                     error + "--against: must be fcl, not bullet (try --help)"},
           std::pair{Words{"--set", "under"},
                     gantry.problems +
                         ": error: there is no set 'under'; there are blocked, foreign, over"},
           std::pair{Words{"--set", "foreign"},
                     error + "'" + file + "' has no edge of set 'foreign'"},
       }) {
    const Outcome run = gantryBench(gantry, file, more);
    EXPECT_EQ(run.exitCode, 3);
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(run.err, message + "\n");
  }
  const std::string foreign =
      gantry.folder().write("foreign.csv", kHeader + "foreign,1,0,0,0,2,2\n");
  EXPECT_EQ(gantryBench(gantry, foreign).err,
            error +
                "problem foreign 1: its joints are lift,swing, those of group 'both' are "
                "slide,lift\n");
  EXPECT_EQ(gantryBench(gantry, gantry.folder().path("none.csv")).err,
            gantry.folder().path("none.csv") + ": error: file not found\n");
  EXPECT_EQ(gantryBench(gantry, gantry.folder().path()).err,
            gantry.folder().path() + ": error: not a regular file\n");
  EXPECT_EQ(
      runSwept({"bench"}).err,
      error + "bench: a subcommand is required; there are edges, planners, summary (try --help)\n");
  EXPECT_EQ(
      runSwept({"bench", "nodes"}).err,
      error + "bench has no subcommand 'nodes'; there are edges, planners, summary (try --help)\n");
}

/// Empty where this build cannot.
std::string whyWithoutFcl(const Outcome& run) {
  return run.err.find("this build has no FCL") == std::string::npos ? "" : run.err;
}

/// OMPL steps by 0.0316 m here: a hundredth of the diagonal of 3 m and 1 m.
TEST(BenchAgainstFcl, AContactBetweenTwoSamplesIsMissed) {
  const Gantry gantry;
  const std::string file = gantry.folder().write(
      "edges.csv",
      kHeader +
          // Clips the post's edge for 7 mm of the motion, 4.6 to 4.8 steps from its start.
          "over,1,0.095,0.7,0.795,1.4,1\n"
          // Starts in the post: OMPL takes a valid start for granted, so not its fault.
          "over,1,0,1.19,0,1.25,0.1\n" +
          kRows);
  const Outcome run = gantryBench(gantry, file, {"--against", "fcl", "--json"});
  if (!whyWithoutFcl(run).empty()) GTEST_SKIP() << run.err;
  const auto json = jsonOf(run);
  EXPECT_EQ(json["collision"], 3);
  EXPECT_EQ(json["fcl_missed"], 1);
  EXPECT_EQ(json["fcl_only"], 0);
  EXPECT_GT(json["fcl_mean_ns"], 0.0);
  EXPECT_THAT(gantryBench(gantry, file, {"--against", "fcl"}).out,
              HasSubstr("\nFCL (BVHModel<OBBRSS>) under OMPL's DiscreteMotionValidator"));
  EXPECT_EQ(gantryBench(gantry, file, {"--against", "fcl", "--margin", "0.01"}).err,
            "swept: error: --against fcl needs a margin of 0: whether FCL finds a collision is not "
            "a matter of distance\n");
}

/// A peer that saw only part of the geometry would miss more; one that saw too much, of another
/// place, would find what is not there.
TEST(BenchAgainstFcl, BothSeeTheSameArm) {
  const Outcome run = runSwept(rook7({"--against", "fcl", "--json", "--passes", "1"}));
  if (!whyWithoutFcl(run).empty()) GTEST_SKIP() << run.err;
  const auto json = jsonOf(run);
  ASSERT_GE(json["collision"], 30);
  EXPECT_LE(json["fcl_missed"], 3);
  EXPECT_EQ(json["fcl_only"], 0);
}

}  // namespace
}  // namespace swept::test
