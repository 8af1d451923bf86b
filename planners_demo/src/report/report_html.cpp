// SPDX-License-Identifier: BSD-3-Clause
#include "input/clouds.hpp"
#include "output/markup_text.hpp"
#include "report/machine.hpp"
#include "report/report_output.hpp"
#include "report/report_worlds.hpp"

namespace swept {
namespace {

constexpr const char* kStyle = R"(<style>
:root { --back: #f4f5f7; --card: #ffffff; --ink: #1d2430; --soft: #667085; --line: #dfe3e8; color-scheme: light dark; }
@media (prefers-color-scheme: dark) {
  :root { --back: #14181f; --card: #1c222b; --ink: #e6eaf0; --soft: #94a0b2; --line: #2d3643; }
}
body { margin: 0 auto; max-width: 860px; padding: 24px; background: var(--back); color: var(--ink); font: 15px/1.5 system-ui, "DejaVu Sans", sans-serif; }
section { background: var(--card); border: 1px solid var(--line); border-radius: 8px; padding: 14px 18px; margin: 18px 0; overflow-x: auto; }
h1 { font-size: 22px; } h2 { font-size: 17px; margin: 4px 0 8px; }
svg { display: block; width: 100%; height: auto; margin: 8px 0; }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums; }
th, td { padding: 3px 10px; border-bottom: 1px solid var(--line); text-align: left; white-space: nowrap; }
.number { text-align: right; }
th { color: var(--soft); font-weight: 600; }
dl { display: grid; grid-template-columns: auto 1fr; gap: 3px 14px; } dt { color: var(--soft); } dd { margin: 0; overflow-wrap: anywhere; }
code { font: 13px/1.5 ui-monospace, "DejaVu Sans Mono", monospace; overflow-wrap: anywhere; }
</style>
)";

constexpr const char* kReading =
    "Each point is a method at one setting: to the left is faster, down is better, and the lowest "
    "line is no error at all. A certified check proves a motion free for every instant of it. It "
    "misses nothing; the price of a coarse tolerance (m) is that free motions which pass closer "
    "than that may be refused. A discrete check looks at states, in steps of at most a share of "
    "the space's extent. It hardly ever refuses a free motion; what happens between two states it "
    "does not "
    "see, and finer steps take more time. Of two methods the one that is below the other and not "
    "to its right is better. In the picture of executed curves a point is what is executed of "
    "paths that are proven free, and what certifying it takes.";

std::string element(const std::string& tag, const std::string& text, const std::string& kind = {}) {
  const std::string open = kind.empty() ? tag : tag + " class=\"" + kind + "\"";
  return "<" + open + ">" + markupText(text) + "</" + tag + ">";
}

std::string tableHtml(const ReportTable& table) {
  const auto line = [&](const std::string& tag, const auto& cellOf) {
    std::string cells;
    for (std::size_t c = 0; c < table.columns.size(); ++c)
      cells += element(tag, cellOf(c), table.columns[c].number ? "number" : "");
    return "<tr>" + cells + "</tr>\n";
  };
  std::string html = element("h2", table.title) + element("p", table.remark) + "\n";
  if (table.rows.empty()) return "<section>\n" + html + "</section>\n";
  html += "<table>\n" + line("th", [&](std::size_t c) { return table.columns[c].title; });
  for (const std::vector<std::string>& row : table.rows)
    html += line("td", [&](std::size_t c) { return row[c]; });
  return "<section>\n" + html + "</table>\n</section>\n";
}

std::string factsHtml(const ErrorReport& report, const std::string& commandLine) {
  std::string html = "<section>\n" + element("h2", "how it was made") + "\n<dl>\n";
  const auto add = [&](const std::string& name, const std::string& value) {
    html += element("dt", name) + element("dd", value) + "\n";
  };
  html += element("dt", "command") + "<dd>" + element("code", commandLine) + "</dd>\n";
  for (const auto& [name, value] : machineFacts()) add(name, value);
  add("worlds", joined(report.worlds));
  if (const std::string clouds = cloudsText(*report.world); !clouds.empty()) add("clouds", clouds);
  add("margin", exactNumber(report.margin) + " m");
  if (report.selfMargin != report.margin)
    add("margin to itself", exactNumber(report.selfMargin) + " m");
  if (report.worldMargin != report.margin)
    add("margin to the world", exactNumber(report.worldMargin) + " m");
  add("seed", std::to_string(report.seed));
  add("times", "on one thread, the least of " + std::to_string(report.passes) +
                   " passes; the methods take turns");
  add("motions",
      "from a uniformly random free state towards another, for a length whose logarithm is "
      "uniformly random from 2 % to all of the space's extent; lengths " +
          shortNumber(report.counts.shortest) + " to " + shortNumber(report.counts.longest) +
          ", median " + shortNumber(report.counts.median));
  add("truth", "certified at a tolerance of " + exactNumber(kTruthTolerance) +
                   " m; motions that are undecided then are counted, and left out");
  if (report.executed.paths > 0)
    add("paths",
        "by RRTConnect, simplified, between random free states whose straight motion is not free; "
        "proven blends keep the velocities of the URDF, and 1 (rad, m, s) where there is no limit");
  return html + "</dl>\n</section>\n";
}

}  // namespace

std::string reportHtml(const ErrorReport& report, const std::string& commandLine) {
  const std::string title = "Error against time: " + report.robot + ", group " + report.group;
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n" +
      element("title", title) + "\n" + kStyle + "</head>\n<body>\n" + element("h1", title) + "\n" +
      element("p", countsText(report) + ".") + "\n" + element("p", kReading) + "\n";
  for (const ReportPicture& picture : reportPictures(report))
    html += "<section id=\"" + picture.name + "\">\n" + svgText(picture.plot) + "</section>\n";
  for (const ReportTable& table : reportTables(report)) html += tableHtml(table);
  return html + factsHtml(report, commandLine) + "</body>\n</html>\n";
}

}  // namespace swept
