// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "batch.hpp"
#include "gantry.hpp"

/// The table, the CSV and the logs are the JSON lines once more.
namespace swept::test {
namespace {

using nlohmann::json;

/// A thin wall that ends nowhere, which no path passes; a discrete check steps over it. And a post,
/// which every planner goes around at once.
constexpr const char* kProblems = R"({"wall": [
  {"index": 1, "world": {"box": [{"name": "post", "position": [1, 0, 0],
    "orientation": [0, 0, 0, 1], "half_extents": [0.1, 0.1, 0.1]}]},
   "start": [0, 0], "goals": [[0, 2]], "joint_names": ["lift", "slide"]},
  {"index": 2, "world": {"box": [{"name": "wall", "position": [1, 0, 0],
    "orientation": [0, 0, 0, 1], "half_extents": [0.001, 0.1, 5]}]},
   "start": [0, 0], "goals": [[0, 2]], "joint_names": ["lift", "slide"]}]}
)";

/// A batch with all kinds of outcomes but crashes, whatever the machine's speed.
class BatchOutput : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    sharedFolder = new TemporaryFolder;
    sharedBatch = runSwept(
        gantryBatch(*sharedFolder,
                    {"--planners", "RRTConnect,RRT", "--time", "0.5", "--validators",
                     "certified,discrete:0.1", "--runs", "2", "-q", "-o", sharedFolder->path("r"),
                     "--csv", sharedFolder->path("csv"), "--log", sharedFolder->path("logs")}));
    for (json& run : jsonLines(sharedFolder->read("r")))
      if (!run.contains("format")) sharedRuns.push_back(std::move(run));
    std::ranges::sort(sharedRuns, {}, [](const json& run) { return keyOf(run); });
  }
  static void TearDownTestSuite() {
    delete sharedFolder;
    sharedRuns.clear();
  }
  static Words gantryBatch(const TemporaryFolder& folder, const Words& more) {
    const Gantry gantry;
    for (const std::string& file : {gantry.urdf, gantry.srdf})
      std::filesystem::copy(file, folder.path());
    Words all{"bench", "planners",   folder.path("gantry.urdf"),          "--group",
              "both",  "--problems", folder.write("wall.json", kProblems)};
    all.insert(all.end(), more.begin(), more.end());
    return all;
  }
  static std::string keyOf(const json& run) {
    return run["index"].dump() + run["planner"].dump() + run["validator"].dump() +
           run["run"].dump();
  }

  static inline TemporaryFolder* sharedFolder = nullptr;
  static inline Outcome sharedBatch;
  static inline std::vector<json> sharedRuns;  ///< in the order of the CSV's rows
};

TEST_F(BatchOutput, IsRepresentative) {
  ASSERT_EQ(sharedBatch.exitCode, 0) << sharedBatch.err;
  ASSERT_EQ(sharedRuns.size(), 2u * 2 * 2 * 2);
  int found = 0, impossible = 0, missed = 0;
  for (const json& run : sharedRuns) {
    const bool behindWall = run["index"] == 2;
    const bool solved = run["solved"] == true;
    EXPECT_EQ(solved, !behindWall || run["validator"] != "certified") << run;
    found += solved ? 1 : 0;
    impossible += solved ? 0 : 1;
    missed += solved && behindWall && run["missed_collisions"] > 0 ? 1 : 0;
  }
  EXPECT_EQ(found, 12);
  EXPECT_EQ(impossible, 4);
  EXPECT_EQ(missed, 4);
}

/// Cells of a CSV with quotes, by the rules of RFC 4180.
std::vector<std::vector<std::string>> quotedCsvRows(const std::string& text) {
  std::vector<std::vector<std::string>> rows{{""}};
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '"' && i + 1 < text.size() && text[i + 1] == '"') {
      rows.back().back() += text[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (!quoted && c == ',') {
      rows.back().emplace_back();
    } else if (!quoted && c == '\n') {
      rows.push_back({""});
    } else {
      rows.back().back() += c;
    }
  }
  rows.pop_back();
  return rows;
}

/// What a cell of the column should hold.
json cellValue(const json& run, std::string column) {
  if (const auto bracket = column.find(" ["); bracket != std::string::npos) column.erase(bracket);
  return run["time"].contains(column) ? run["time"][column] : run.at(column);
}

TEST_F(BatchOutput, TheCsvHasTheValuesOfTheLines) {
  const auto rows = quotedCsvRows(sharedFolder->read("csv"));
  ASSERT_EQ(rows.size(), sharedRuns.size() + 1);
  EXPECT_THAT(rows[0], testing::IsSupersetOf({"path_length [rad or m]", "certified_clearance [m]",
                                              "certified_clearance_world [m]",
                                              "certified_clearance_self [m]", "planning [s]",
                                              "certification [s]"}));
  for (std::size_t i = 0; i < sharedRuns.size(); ++i) {
    ASSERT_EQ(rows[i + 1].size(), rows[0].size());
    for (std::size_t c = 0; c < rows[0].size(); ++c) {
      const json value = cellValue(sharedRuns[i], rows[0][c]);
      const std::string& cell = rows[i + 1][c];
      if (value.is_number())
        EXPECT_EQ(std::stod(cell), value.get<double>()) << rows[0][c];
      else
        EXPECT_EQ(cell, value.is_null()     ? ""
                        : value.is_string() ? value.get<std::string>()
                                            : value.dump());
    }
  }
}

/// Reads a log by the grammar of OMPL's documentation, and nothing beside it: each line has to be
/// the next one of it.
class LogReader {
 public:
  explicit LogReader(const std::string& text) : stream_(text) {}

  struct Planner {
    std::vector<std::pair<std::string, std::string>> properties;  ///< name and type
    std::vector<std::vector<std::string>> runs;
  };
  std::map<std::string, std::string> preamble;
  std::vector<std::string> statuses;
  std::map<std::string, Planner> planners;

  void read() {
    line("([^ ]+) version ([^ ]+)");
    preamble["experiment"] = line("Experiment ([^ ]+)")[1];
    line("Running on ([^ ]+)");
    line("Starting at (.+)");
    line("<<<\\|");
    while (next() != "|>>>") ASSERT_TRUE(stream_) << "the setup has no end";
    preamble["seed"] = line("([0-9]+) is the random seed")[1];
    preamble["limit"] = line(kFloat + " seconds per run")[1];
    line(kFloat + " MB per run");
    preamble["runs"] = line("([0-9]+) runs per planner")[1];
    preamble["total"] = line(kFloat + " seconds spent to collect the data")[1];
    line("1 enum type");
    std::istringstream names(line("status((\\|[^|]+)+)")[1]);
    for (std::string name; std::getline(names, name, '|');) statuses.push_back(name);
    statuses.erase(statuses.begin());  // before the first bar
    const int count = std::stoi(line("([0-9]+) planners")[1]);
    for (int i = 0; i < count; ++i) readPlanner();
    std::string rest;
    EXPECT_FALSE(std::getline(stream_, rest)) << "more than the grammar has: " << rest;
  }

 private:
  static inline const std::string kFloat = "([0-9.e+-]+)";

  std::string next() {
    std::string text;
    std::getline(stream_, text);
    return text;
  }
  std::smatch line(const std::string& pattern) {
    last_ = next();
    std::smatch match;
    EXPECT_TRUE(std::regex_match(last_, match, std::regex(pattern))) << pattern << "\n" << last_;
    if (match.empty()) throw std::runtime_error("not the grammar's line: " + last_);
    return match;
  }

  void readPlanner() {
    Planner& planner = planners[line("([^ ]+)")[1]];
    const int common = std::stoi(line("([0-9]+) common properties")[1]);
    for (int i = 0; i < common; ++i) line("([^=]+) = (.+)");
    const int properties = std::stoi(line("([0-9]+) properties for each run")[1]);
    for (int i = 0; i < properties; ++i) {
      const std::smatch match = line("([a-z ]+) (BOOLEAN|INTEGER|REAL|ENUM)");
      planner.properties.emplace_back(match[1], match[2]);
    }
    const int runs = std::stoi(line("([0-9]+) runs")[1]);
    for (int i = 0; i < runs; ++i) {
      std::string text = next();
      planner.runs.emplace_back();
      for (std::size_t end; (end = text.find("; ")) != std::string::npos; text.erase(0, end + 2))
        planner.runs.back().push_back(text.substr(0, end));
      EXPECT_EQ(text, "") << "a value without its `; `";
      EXPECT_EQ(planner.runs.back().size(), planner.properties.size());
    }
    EXPECT_EQ(next(), ".");
  }

  std::istringstream stream_;
  std::string last_;
};

std::string numberOrEmpty(const json& value) {
  return value.is_null() ? "" : value.is_boolean() ? (value.get<bool>() ? "1" : "0") : value.dump();
}

void expectRun(const LogReader& log, const LogReader::Planner& planner,
               const std::vector<std::string>& values, const json& run) {
  const std::map<std::string, json> expected{
      {"certified", run["certified"]},
      {"certified clearance", run["certified_clearance"]},
      {"certified clearance of itself", run["certified_clearance_self"]},
      {"certified clearance of the world", run["certified_clearance_world"]},
      {"missed collisions", run["missed_collisions"]},
      {"motions checked", run["motions_checked"]},
      {"random seed", run["seed"]},
      {"simplified solution length", run["path_length"]},
      {"simplified solution segments", run["segments"]},
      {"solved", run["solved"]},
      {"states checked", run["states_checked"]},
      {"time", run["time"]["planning"]},
      {"simplification time", run["time"]["simplification"]},
      {"undecided segments", run["undecided"]},
      {"approximate solution", run["status"] == "Approximate solution"},
      {"certification time", run["solved"] == true ? run["time"]["certification"] : json()}};
  ASSERT_EQ(planner.properties.size(), expected.size() + 1);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [name, type] = planner.properties[i];
    if (name == "status") {
      EXPECT_EQ(type, "ENUM");
      EXPECT_EQ(log.statuses.at(std::stoul(values[i])), run["status"].get<std::string>());
      continue;
    }
    ASSERT_TRUE(expected.contains(name)) << name;
    const json& value = expected.at(name);
    if (type == "REAL" && !value.is_null())
      EXPECT_EQ(std::stod(values[i]), value.get<double>()) << name;
    else
      EXPECT_EQ(values[i], numberOrEmpty(value)) << name;
    if (type == "BOOLEAN") {
      EXPECT_THAT(values[i], testing::AnyOf("0", "1", "")) << name;
    }
  }
}

TEST_F(BatchOutput, EachLogIsOneExperimentOfTheGrammar) {
  for (const std::string index : {"1", "2"}) {
    LogReader log(sharedFolder->read("logs/wall_" + index + ".log"));
    ASSERT_NO_THROW(log.read());
    EXPECT_EQ(log.preamble["experiment"], "wall_" + index);
    EXPECT_EQ(log.preamble["seed"], "1");
    EXPECT_EQ(log.preamble["limit"], "0.5");
    EXPECT_EQ(log.preamble["runs"], "2");
    EXPECT_EQ(log.planners.size(), 4u);
    int seen = 0;
    double total = 0.0;
    for (const json& run : sharedRuns) {
      if (run["index"].dump() != index) continue;
      const LogReader::Planner& planner = log.planners.at(run["planner"].get<std::string>() + "/" +
                                                          run["validator"].get<std::string>());
      expectRun(log, planner, planner.runs.at(run["run"].get<std::size_t>() - 1), run);
      for (const json& seconds : run["time"]) total += seconds.get<double>();
      ++seen;
    }
    EXPECT_EQ(seen, 8);
    EXPECT_NEAR(std::stod(log.preamble["total"]), total, 1e-9);
  }
}

TEST_F(BatchOutput, TheTableIsOfTheLines) {
  const json table = jsonOf(runSwept({"bench", "summary", sharedFolder->path("r"), "--json"}));
  EXPECT_EQ(table["runs"], 16);
  ASSERT_EQ(table["rows"].size(), 4u) << "one set, so no total";
  for (const json& row : table["rows"]) {
    int runs = 0, solved = 0, certified = 0, withMissed = 0;
    double length = 0.0;
    std::vector<double> times;
    for (const json& run : sharedRuns) {
      if (run["planner"] != row["planner"] || run["validator"] != row["validator"]) continue;
      ++runs;
      if (run["solved"] == false) continue;
      ++solved;
      certified += run["certified"] == true ? 1 : 0;
      withMissed += run["missed_collisions"] > 0 ? 1 : 0;
      length += run["path_length"].get<double>();
      times.push_back(run["time"]["planning"]);
    }
    std::ranges::sort(times);
    EXPECT_EQ(row["runs"], runs);
    EXPECT_EQ(row["solved"], solved);
    EXPECT_EQ(row["certified"], certified);
    EXPECT_EQ(row["with_missed_collisions"], withMissed);
    if (solved == 0) {
      EXPECT_EQ(row["median"], nullptr);
      continue;
    }
    EXPECT_EQ(row["median"], times[(times.size() - 1) / 2]);
    EXPECT_EQ(row["p95"], times.back());
    EXPECT_NEAR(row["path_length"], length / solved, 1e-9);
  }
}

TEST_F(BatchOutput, ASummaryIsWhatTheBatchPrintedAndWrote) {
  const Outcome summary =
      runSwept({"bench", "summary", sharedFolder->path("r"), sharedFolder->path("r"), "--csv",
                sharedFolder->path("csv2"), "--log", sharedFolder->path("logs2")});
  EXPECT_EQ(summary.exitCode, 0) << summary.err;
  EXPECT_EQ(summary.out, sharedBatch.out);
  EXPECT_EQ(sharedFolder->read("csv2"), sharedFolder->read("csv"));
  EXPECT_EQ(sharedFolder->read("logs2/wall_2.log"), sharedFolder->read("logs/wall_2.log"));
}

TEST_F(BatchOutput, ProgressIsForTerminalsOnly) {
  // Long enough for a guess of what is left.
  const TemporaryFolder folder;
  const Words batch = gantryBatch(folder, {"--planners", "RRT", "--time", "0.4", "--runs", "2"});
  const Outcome shown = runSwept(batch, Stderr::Terminal);
  EXPECT_THAT(shown.err, testing::ContainsRegex("\\[[#.]+\\] [0-4] of 4 runs, [0-9]+ %"));
  EXPECT_THAT(shown.err, testing::ContainsRegex(" %, [0-9]+ s left"));
  EXPECT_THAT(shown.err, testing::EndsWith("\r\033[K"));
  Words quiet = batch;
  quiet.push_back("-q");
  EXPECT_EQ(runSwept(quiet, Stderr::Terminal).err, "");
  EXPECT_EQ(sharedBatch.err, "");
}

}  // namespace
}  // namespace swept::test
