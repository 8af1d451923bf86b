// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cstdio>
#include <fstream>
#include <sstream>

#include "gantry.hpp"
#include "report_files.hpp"

/// The files of `swept report`: CSV, pictures and the page.
namespace swept::test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// One run with all of its files.
struct MadeFiles {
  MadeFiles() {
    const Outcome run =
        runSwept(rook7Report(150, {"--json", "--csv", folder.path("r.csv"), "--svg",
                                   folder.path("r"), "--html", folder.path("r.html")}));
    EXPECT_EQ(run.err, "");
    json = jsonOf(run);
    page = folder.read("r.html");
  }

  TemporaryFolder folder;
  nlohmann::json json;
  std::string page;
};

class ReportFiles : public testing::Test {
 protected:
  static const MadeFiles& made() {
    static const MadeFiles once;
    return once;
  }
  const TemporaryFolder& folder_ = made().folder;
  const nlohmann::json& json_ = made().json;
  const std::string& page_ = made().page;
};

/// What the numbers are of was not said.
TEST(ReportClouds, AreListed) {
  const TemporaryFolder folder;
  const std::string cloud = folder.write("far.xyz", "0.9 0 0.5\n8 8 8\n");
  const auto report = [&](const Words& more) {
    Words words{"--cloud",       cloud, "--point-radius", "0.01",
                "--motions",     "2",   "--html",         folder.path("r.html"),
                "--resolutions", "0.2", "--tolerances",   "0.01"};
    words.insert(words.end(), more.begin(), more.end());
    return runSwept(rook7In(words));
  };
  EXPECT_THAT(report({}).out,
              HasSubstr(" passes\nbody far is 2 balls of radius 0.01 m\n\nmotions."));
  EXPECT_THAT(folder.read("r.html"), HasSubstr("body far is 2 balls of radius 0.01 m"));
  const auto json = jsonOf(report({"--json"}));
  ASSERT_EQ(json["clouds"].size(), 1u);
  EXPECT_EQ(json["clouds"][0]["body"], "far");
  EXPECT_EQ(json["clouds"][0]["balls"], 2);
}

TEST_F(ReportFiles, CsvSaysWhatTheJsonSays) {
  const std::string text = folder_.read("r.csv");
  EXPECT_EQ(text.substr(0, text.find('\n')),
            "part,method,setting,queries,free,collision,missed,missed_rate,false_alarms,"
            "false_alarm_rate,deepest_missed [m],mean_error [m],largest_error [m],mean_bound [m],"
            "largest_bound [m],mean [ns],median [ns],undecided,relative_time");
  const std::vector<CsvRow> rows = csvRows(text);
  ASSERT_EQ(rows.size(), json_["rows"].size());
  const std::vector<std::pair<std::string, std::string>> columns{
      {"setting", "setting"},
      {"queries", "queries"},
      {"free", "free"},
      {"collision", "collision"},
      {"missed", "missed"},
      {"missed_rate", "missed_rate"},
      {"false_alarms", "false_alarms"},
      {"false_alarm_rate", "false_alarm_rate"},
      {"deepest_missed [m]", "deepest_missed"},
      {"mean_error [m]", "mean_error"},
      {"largest_error [m]", "largest_error"},
      {"mean_bound [m]", "mean_bound"},
      {"largest_bound [m]", "largest_bound"},
      {"mean [ns]", "mean_ns"},
      {"median [ns]", "median_ns"},
      {"undecided", "undecided"},
      {"relative_time", "relative_time"}};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const nlohmann::json& row = json_["rows"][i];
    EXPECT_EQ(rows[i].at("part"), row["part"].get<std::string>());
    EXPECT_EQ(rows[i].at("method"), row["method"].get<std::string>());
    for (const auto& [title, key] : columns) {
      const nlohmann::json value = row.value(key, nlohmann::json());
      const std::string& cell = rows[i].at(title);
      EXPECT_EQ(cell.empty(), value.is_null()) << title << " of " << row;
      if (cell.empty() || value.is_null()) continue;
      EXPECT_EQ(std::stod(cell), value.get<double>()) << title << " of " << row;
    }
  }
}

void countPoints(const tinyxml2::XMLElement* element, int& points, int& titles) {
  for (; element != nullptr; element = element->NextSiblingElement()) {
    const char* kind = element->Attribute("class");
    if (kind != nullptr && std::string(kind).starts_with("point ")) {
      ++points;
      titles += element->FirstChildElement("title") != nullptr ? 1 : 0;
    }
    countPoints(element->FirstChildElement(), points, titles);
  }
}

/// What is executed without a collision by construction has no marker.
bool isFreeForSure(const nlohmann::json& row) {
  return row["method"] == "polyline" || row["method"] == "proven blends";
}

TEST_F(ReportFiles, PicturesHaveAMarkerPerRow) {
  const std::vector<std::pair<std::string, std::string>> pictures{
      {"missed", "motions"},
      {"false-alarms", "motions"},
      {"first-contact", "first contact"},
      {"clearance", "clearance"},
      {"distance", "distance"},
      {"penetration", "penetration"},
      {"executed-curves", "executed curves"}};
  EXPECT_THAT(folder_.names(), testing::SizeIs(pictures.size() + 2));
  for (const auto& [name, part] : pictures) {
    const std::string svg = folder_.read("r-" + name + ".svg");
    tinyxml2::XMLDocument document;
    ASSERT_EQ(document.Parse(svg.c_str()), tinyxml2::XML_SUCCESS) << document.ErrorStr();
    ASSERT_STREQ(document.RootElement()->Name(), "svg");
    int rows = 0, points = 0, titles = 0;
    for (const auto& row : json_["rows"])
      rows += row["part"] == part && !isFreeForSure(row) ? 1 : 0;
    countPoints(document.RootElement(), points, titles);
    EXPECT_GE(rows, 3) << part;
    EXPECT_EQ(points, rows) << name;
    EXPECT_EQ(titles, points) << name;
    // The page has the same picture.
    EXPECT_THAT(page_, HasSubstr(svg)) << name;
  }
}

std::string threeDigits(double value) {
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.3g", value);
  return buffer;
}

TEST_F(ReportFiles, ThePageHasTheRates) {
  for (const auto& row : json_["rows"]) {
    if (row["part"] != "motions") continue;
    std::ostringstream name;
    name << "<tr><td>" << row["method"].get<std::string>() << ":" << row["setting"].get<double>()
         << "</td><td class=\"number\">" << row["missed"] << "</td><td class=\"number\">"
         << threeDigits(100.0 * row["missed_rate"].get<double>()) << " %</td>";
    EXPECT_THAT(page_, HasSubstr(name.str()));
  }
  EXPECT_THAT(page_, HasSubstr("150 random motions in 1 world: " + json_["motions"]["free"].dump() +
                               " free, " + json_["motions"]["collision"].dump() + " in collision"));
}

TEST_F(ReportFiles, ThePageHasTheExecutedCurves) {
  int rows = 0;
  for (const auto& row : json_["rows"]) {
    if (row["part"] != "executed curves") continue;
    ++rows;
    std::ostringstream name;
    name << "<tr><td>" << row["method"].get<std::string>();
    if (!row["setting"].is_null()) name << ":" << row["setting"].get<double>();
    name << "</td><td class=\"number\">" << row["collision"] << "</td><td class=\"number\">"
         << threeDigits(100.0 * row["collision"].get<double>() / row["queries"].get<double>())
         << " %</td><td class=\"number\">" << row["undecided"] << "</td><td class=\"number\">"
         << row["free"] << "</td>";
    EXPECT_THAT(page_, HasSubstr(name.str()));
  }
  EXPECT_EQ(rows, 8);
  EXPECT_THAT(page_, HasSubstr("<dt>paths</dt><dd>by RRTConnect, simplified, between "));
}

TEST_F(ReportFiles, ThePageNeedsNoNetworkAndSaysHowItWasMade) {
  std::string without = page_;
  const std::string space = "xmlns=\"http://www.w3.org/2000/svg\"";
  for (std::size_t at; (at = without.find(space)) != std::string::npos;)
    without.erase(at, space.size());
  EXPECT_THAT(without, Not(HasSubstr("http:")));
  EXPECT_THAT(without, Not(HasSubstr("https:")));
  EXPECT_THAT(without, Not(HasSubstr("//")));
  EXPECT_THAT(without, Not(HasSubstr("<script")));
  EXPECT_THAT(without, Not(HasSubstr("src=")));
  EXPECT_THAT(page_, HasSubstr("<code>swept report models/robots/rook7/rook7.urdf --group arm "));
  EXPECT_THAT(page_, HasSubstr("<dt>swept</dt><dd>" SWEPT_VERSION "</dd>"));
  EXPECT_THAT(page_, testing::ContainsRegex("<dt>OMPL</dt><dd>[0-9]+\\.[0-9]+\\.[0-9]+</dd>"));
  for (const char* fact : {"processor", "cores", "system", "compiler"})
    EXPECT_THAT(page_, testing::ContainsRegex("<dt>" + std::string(fact) + "</dt><dd>[^<]+</dd>"));
  EXPECT_EQ(json_["machine"]["swept"], SWEPT_VERSION);
  EXPECT_THAT(page_, HasSubstr("prefers-color-scheme:dark"));
}

TEST(ReportPage, NamesAreHarmless) {
  const Gantry gantry;
  std::string urdf = gantry.folder().read("gantry.urdf");
  urdf.replace(urdf.find("\"gantry\""), 8, "\"&lt;b&gt;&amp;&quot;\"");
  gantry.folder().write("gantry.urdf", urdf);
  const Outcome run = gantry.run(
      "report", {"--motions", "40", "--passes", "1", "--srdf", "none", "--group", "all", "--html",
                 gantry.folder().path("<i>.html"), "--svg", gantry.folder().path("p")});
  ASSERT_EQ(run.exitCode, 0) << run.err;
  const std::string page = gantry.folder().read("<i>.html");
  EXPECT_THAT(page, HasSubstr("&lt;b&gt;&amp;&quot;, group all</title>"));
  EXPECT_THAT(page, HasSubstr("&lt;i&gt;.html"));
  EXPECT_THAT(page, Not(HasSubstr("<b>")));
  EXPECT_THAT(page, Not(HasSubstr("<i>")));
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(gantry.folder().read("p-missed.svg").c_str()), tinyxml2::XML_SUCCESS);
}

TEST(ReportText, SaysWhatItFoundAndWrote) {
  const TemporaryFolder folder;
  const Outcome run = runSwept(rook7In(
      {"--scene", "models/scenes/shelf.yaml", "--motions", "40", "--csv", folder.path("r.csv")}));
  EXPECT_EQ(run.exitCode, 0);
  EXPECT_EQ(run.err, "");
  EXPECT_THAT(run.out, testing::StartsWith("rook7, group arm, 40 random motions in 1 world: "));
  EXPECT_THAT(run.out, testing::ContainsRegex("\ncertified:0.001 +0 +0 % +- +[0-9]+ "));
  EXPECT_THAT(run.out, testing::ContainsRegex("\ndiscrete:0.005 +[0-9]+ "));
  EXPECT_THAT(run.out, testing::EndsWith("written to " + folder.path("r.csv") + "\n"));
}

}  // namespace
}  // namespace swept::test
