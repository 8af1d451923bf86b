// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "gantry.hpp"
#include "report_files.hpp"

/// What `swept report` says of the curves that are executed of planned paths.
namespace swept::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kPart = "executed curves";

/// By curve and setting, such as `blends:0.1`.
std::map<std::string, json> executedRows(const json& report) {
  std::map<std::string, json> rows;
  for (const json& row : report["rows"])
    if (row["part"] == kPart)
      rows[row["method"].get<std::string>() +
           (row["setting"].is_null() ? "" : ":" + row["setting"].dump())] = row;
  return rows;
}

class ExecutedReport : public testing::Test {
 protected:
  static const json& report() {
    static const json once = jsonOf(runSwept(rook7Report(800, {"--json"})));
    return once;
  }
  std::map<std::string, json> rows_ = executedRows(report());
};

TEST_F(ExecutedReport, CountsAddUp) {
  EXPECT_EQ(report()["executed_curves"]["paths"], 40);
  EXPECT_GE(report()["executed_curves"]["corners"], 40);
  EXPECT_TRUE(report()["executed_curves"]["left_out"].is_null());
  std::vector<std::string> names;
  for (const auto& [name, row] : rows_) {
    names.push_back(name);
    EXPECT_EQ(row["queries"], 40) << row;
    EXPECT_EQ(row["free"].get<int>() + row["collision"].get<int>() + row["undecided"].get<int>(),
              40)
        << row;
    EXPECT_EQ(row["relative_time"],
              row["mean_ns"].get<double>() / rows_["polyline"]["mean_ns"].get<double>());
    EXPECT_GT(row["median_ns"], 0.0);
    const bool sampled = row["method"] == "blends" || row["method"] == "spline";
    EXPECT_EQ(row["missed"].is_null(), !sampled) << row;
    if (!sampled || row["collision"] == 0) {
      EXPECT_TRUE(row["missed_rate"].is_null()) << row;
      continue;
    }
    EXPECT_LE(row["missed"], row["collision"]) << row;
    EXPECT_EQ(row["missed_rate"], row["missed"].get<double>() / row["collision"].get<double>());
  }
  EXPECT_THAT(names,
              testing::ElementsAre("blends:0.01", "blends:0.05", "blends:0.1", "polyline",
                                   "proven blends:0.1", "spline", "tube:0.005", "tube:0.01"));
}

TEST_F(ExecutedReport, BlendsAndTubesCollideAndProvenPathsDoNot) {
  EXPECT_EQ(rows_["polyline"]["free"], 40);
  EXPECT_EQ(rows_["proven blends:0.1"]["free"], 40);
  // Representative.
  EXPECT_GE(rows_["blends:0.1"]["collision"], 5);
  EXPECT_GE(rows_["blends:0.1"]["free"], 5);
  EXPECT_GE(rows_["spline"]["collision"], 1);
  EXPECT_GT(rows_["blends:0.1"]["collision"], rows_["blends:0.01"]["collision"]);
  // A tube holds the smaller one.
  EXPECT_GE(rows_["tube:0.005"]["collision"], 5);
  EXPECT_GE(rows_["tube:0.01"]["collision"], rows_["tube:0.005"]["collision"]);
  EXPECT_LE(rows_["tube:0.01"]["free"], rows_["tube:0.005"]["free"]);
}

/// All but times.
json withoutTimes(std::map<std::string, json> rows) {
  for (auto& [name, row] : rows)
    for (const char* time : {"mean_ns", "median_ns", "relative_time"}) row.erase(time);
  return rows;
}

TEST(ReportExecuted, PathsDependOnTheSeedAndNotOnTheMethods) {
  const auto run = [](const Words& more) {
    Words words{"--problems", "models/problems.json", "--every", "5", "--motions", "200", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return jsonOf(runSwept(rook7In(words)));
  };
  const json first = run({"--tolerances", "0.1", "--resolutions", "0.1"});
  const json other = run({"--tolerances", "0.02,0.01", "--resolutions", "0.3,0.03"});
  const json seeded = run({"--tolerances", "0.1", "--resolutions", "0.1", "--seed", "77"});
  // Each of three worlds has a third of ten, but in an empty one motions hardly ever collide.
  EXPECT_EQ(first["worlds"], json({"bin 1", "empty 2", "shelf 3"}));
  EXPECT_GE(first["executed_curves"]["paths"], 6);
  EXPECT_LE(first["executed_curves"]["paths"], 9);
  EXPECT_EQ(first["executed_curves"], other["executed_curves"]);
  EXPECT_EQ(withoutTimes(executedRows(first)), withoutTimes(executedRows(other)));
  EXPECT_NE(first["executed_curves"], seeded["executed_curves"]);
}

/// The outputs of a run without this part.
void expectLeftOut(const Gantry& gantry, Words words, const std::string& reason) {
  for (const std::string more : {"--motions", "60", "--passes", "1"}) words.push_back(more);
  const TemporaryFolder& folder = gantry.folder();
  for (const auto& [option, name] :
       std::map<std::string, std::string>{{"--csv", "r.csv"}, {"--svg", "r"}, {"--html", "r.html"}})
    words.insert(words.end(), {option, folder.path(name)});
  const Outcome text = runSwept(words);
  EXPECT_THAT(text.out, HasSubstr("\nexecuted curves. " + reason + "\nwritten to "));
  std::string html = reason;
  for (std::size_t at; (at = html.find('\'')) != std::string::npos;) html.replace(at, 1, "&#39;");
  EXPECT_THAT(folder.read("r.html"),
              testing::AnyOf(HasSubstr("<h2>executed curves</h2><p>" + reason + "</p>"),
                             HasSubstr("<h2>executed curves</h2><p>" + html + "</p>")));
  EXPECT_THAT(folder.read("r.csv"), Not(HasSubstr(kPart)));
  EXPECT_THAT(folder.names(), Not(testing::Contains("r-executed-curves.svg")));
  words.push_back("--json");
  const json report = jsonOf(runSwept(words));
  EXPECT_TRUE(executedRows(report).empty());
  EXPECT_EQ(report["executed_curves"], json({{"paths", 0}, {"corners", 0}, {"left_out", reason}}));
}

TEST(ReportExecuted, OneVariableHasNoCorner) {
  const Gantry gantry;
  expectLeftOut(gantry, gantry.arguments("report", {"--group", "slider", "--margin", "0.1"}),
                "Left out: group 'slider' has one variable, so no path has a corner.");
}

TEST(ReportExecuted, AFloatingJointIsNamed) {
  const Gantry gantry;
  expectLeftOut(
      gantry, {"report", "models/robots/drifter/drifter.urdf"},
      "Left out: the orientation of joint 'flight' turns by a slerp, which no polynomial follows.");
}

TEST(ReportExecuted, WhereAllMotionsAreFreeThereIsNoCorner) {
  const Gantry gantry;
  std::string scene = gantry.folder().read("post.yaml");
  scene.replace(scene.find("[1, 0, 0]"), 9, "[1, 0, 2]");
  gantry.folder().write("post.yaml", scene);
  expectLeftOut(gantry, gantry.arguments("report", {}),
                "Left out: between pairs of random free states, no path with a corner was found.");
}

/// The paths of the gantry go over the post, with corners in a plane.
TEST(ReportExecuted, TheGantryGoesOverItsPost) {
  const Gantry gantry;
  const json report =
      jsonOf(gantry.run("report", {"--motions", "400", "--passes", "1", "--json", "--margin", "0.2",
                                   "--tolerances", "0.1", "--resolutions", "0.1"}));
  std::map<std::string, json> rows = executedRows(report);
  EXPECT_EQ(report["executed_curves"]["paths"], 20);
  EXPECT_EQ(rows["polyline"]["free"], 20);
  EXPECT_EQ(rows["proven blends:0.1"]["free"], 20);
  EXPECT_GE(rows["blends:0.1"]["collision"], 3);
  EXPECT_GE(rows["tube:0.01"]["collision"], 3);
}

TEST(ReportExecuted, TheTableHasARowPerCurve) {
  const Outcome run = runSwept(rook7In({"--scene", "models/scenes/tunnel_trap.yaml", "--motions",
                                        "100", "--tolerances", "0.1", "--resolutions", "0.1"}));
  EXPECT_EQ(run.exitCode, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("\nexecuted curves. Of 5 planned paths with "));
  EXPECT_THAT(run.out, testing::ContainsRegex("\ncurve +collide  of paths  undecided  proven  "
                                              "missed +mean +median  relative\n"));
  EXPECT_THAT(run.out,
              testing::ContainsRegex("\npolyline +0 +0 % +0 +5 +- +[0-9.]+ us +[0-9.]+ us +1\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex("\nblends:0.1 +[0-5] +[0-9]+ % +[0-5] +[0-5] +[0-5] "
                                              "+[0-9.]+ [mu]s +[0-9.]+ [mu]s +[0-9.]+\n"));
  EXPECT_THAT(run.out, testing::ContainsRegex("\nproven blends:0.1 +0 +0 % +0 +5 +- "));
}

}  // namespace
}  // namespace swept::test
