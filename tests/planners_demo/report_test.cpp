// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "report_files.hpp"

/// `swept report`: what it counts, against the truth and against other subcommands.
namespace swept::test {
namespace {

using nlohmann::json;

const json& report() {
  static const json once = jsonOf(runSwept(rook7Report(400, {"--json"})));
  return once;
}

std::vector<json> rowsOf(const json& from, const std::string& part, const std::string& method) {
  std::vector<json> rows;
  for (const json& row : from["rows"])
    if (row["part"] == part && row["method"] == method) rows.push_back(row);
  return rows;
}

TEST(Report, CountsAddUp) {
  const json& motions = report()["motions"];
  EXPECT_EQ(motions["count"], 400);
  EXPECT_EQ(motions["free"].get<int>() + motions["collision"].get<int>() +
                motions["undecided"].get<int>(),
            400);
  // Representative.
  EXPECT_GE(motions["free"], 80);
  EXPECT_GE(motions["collision"], 80);
  EXPECT_LT(motions["shortest"].get<double>(), 0.1 * motions["longest"].get<double>());
  for (const json& row : report()["rows"]) {
    if (row["part"] != "motions") continue;
    EXPECT_EQ(row["free"], motions["free"]);
    EXPECT_EQ(row["collision"], motions["collision"]);
    EXPECT_EQ(row["queries"], motions["free"].get<int>() + motions["collision"].get<int>());
    EXPECT_EQ(row["missed_rate"], row["missed"].get<double>() / motions["collision"].get<double>());
    EXPECT_EQ(row["false_alarm_rate"],
              row["false_alarms"].get<double>() / motions["free"].get<double>());
    EXPECT_EQ(row["deepest_missed"].is_null(), row["missed"] == 0) << row;
    EXPECT_GT(row["median_ns"], 0.0);
  }
}

TEST(Report, CertifiedMissesNothingAndStatesDo) {
  const auto certified = rowsOf(report(), "motions", "certified");
  ASSERT_EQ(certified.size(), 3u);
  for (const json& row : certified) EXPECT_EQ(row["missed"], 0) << row;
  // Coarse first, and what a tolerance decides, a finer one does.
  EXPECT_EQ(certified[0]["setting"], 0.1);
  EXPECT_GE(certified[0]["false_alarms"], certified[1]["false_alarms"]);
  EXPECT_GE(certified[1]["false_alarms"], certified[2]["false_alarms"]);

  const auto discrete = rowsOf(report(), "motions", "discrete");
  ASSERT_EQ(discrete.size(), 4u);
  EXPECT_GE(discrete.front()["missed"], 20);
  EXPECT_GT(discrete.front()["deepest_missed"], 0.0);
  for (std::size_t i = 1; i < discrete.size(); ++i) {
    EXPECT_LT(discrete[i]["setting"], discrete[i - 1]["setting"]);
    EXPECT_LE(discrete[i]["missed"], discrete[i - 1]["missed"]);
  }
  // Plates of 1 mm: a hundredth of the extent goes through them.
  EXPECT_GE(discrete.back()["missed"], 1);
  for (const json& row : discrete) EXPECT_EQ(row["false_alarms"], 0) << row;
}

TEST(Report, ErrorsKeepTheirBounds) {
  std::map<std::string, int> queries;
  for (const json& row : report()["rows"]) {
    if (row["part"] == "motions" || row["part"] == "executed curves") continue;
    const std::string part = row["part"];
    queries[part] = row["queries"];
    if (row["method"] != "certified") continue;
    EXPECT_EQ(row["missed"], 0) << row;
    EXPECT_LE(row["largest_error"].get<double>(), row["largest_bound"].get<double>() + 1e-9) << row;
    EXPECT_LE(row["mean_error"].get<double>(), row["mean_bound"].get<double>() + 1e-9) << row;
  }
  EXPECT_EQ(queries.size(), 4u);
  EXPECT_GE(queries["first contact"], 50);
  EXPECT_GE(queries["clearance"], 5);
  EXPECT_GE(queries["distance"], 100);
  EXPECT_GE(queries["penetration"], 30);
}

TEST(Report, FinerSettingsAreNearerToTheTruth) {
  for (const std::string part : {"first contact", "clearance", "distance", "penetration"}) {
    const auto rows = rowsOf(report(), part, "certified");
    ASSERT_EQ(rows.size(), 3u) << part;
    EXPECT_LT(rows[2]["mean_error"].get<double>(), rows[0]["mean_error"].get<double>()) << part;
    // But for depths of meshes, whose bounds are their hulls', and grazing motions.
    if (part == "clearance" || part == "distance") {
      EXPECT_LE(rows[2]["largest_bound"].get<double>(), 0.001 * (1 + 1e-9)) << part;
    }
  }
  const auto discrete = rowsOf(report(), "first contact", "discrete");
  ASSERT_EQ(discrete.size(), 4u);
  EXPECT_LT(discrete[3]["mean_error"].get<double>(), discrete[0]["mean_error"].get<double>());
  EXPECT_GE(discrete[0]["missed"], 5);
  EXPECT_TRUE(discrete[0]["largest_bound"].is_null());
}

/// All but times.
json withoutTimes(json from) {
  for (json& row : from["rows"]) {
    row.erase("mean_ns");
    row.erase("median_ns");
    row.erase("relative_time");
  }
  from.erase("command");
  return from;
}

TEST(Report, TheSeedDecides) {
  const auto with = [](const std::string& seed) {
    return withoutTimes(jsonOf(
        runSwept(rook7In({"--scene", "models/scenes/shelf.yaml", "--json", "--motions", "30",
                          "--tolerances", "0.01", "--resolutions", "0.1", "--seed", seed}))));
  };
  const json first = with("5");
  EXPECT_EQ(with("5"), first);
  EXPECT_NE(with("6")["motions"], first["motions"]);
}

TEST(Report, MotionsDoNotDependOnTheMethods) {
  const Words few{"--json",    "--problems", "models/problems.json", "--every", "4",
                  "--motions", "30"};
  Words other = few;
  other.insert(other.end(), {"--tolerances", "0.02", "--resolutions", "0.3,0.03"});
  const auto run = [](const Words& more) { return jsonOf(runSwept(rook7In(more))); };
  const json a = run(few), b = run(other);
  EXPECT_EQ(a["worlds"], json({"bin 1", "empty 1", "shelf 1", "tunnel_trap 2"}));
  EXPECT_EQ(a["motions"], b["motions"]);
}

}  // namespace
}  // namespace swept::test
