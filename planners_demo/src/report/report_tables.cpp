// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <cstdio>

#include "input/clouds.hpp"
#include "output/terminal_text.hpp"
#include "report/report_output.hpp"
#include "report/report_worlds.hpp"

namespace swept {
namespace {

/// Three significant digits.
std::string threeDigits(double value) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.3g", value);
  return buffer.data();
}

std::string percentText(const std::optional<double>& rate) {
  return rate ? threeDigits(100.0 * *rate) + " %" : "-";
}

std::string metresText(const std::optional<double>& length) {
  return length ? threeDigits(*length) + " m" : "-";
}

/// ns as `12.3 us`.
std::string durationText(double ns) {
  if (ns < 1e3) return threeDigits(ns) + " ns";
  if (ns < 1e6) return threeDigits(1e-3 * ns) + " us";
  if (ns < 1e9) return threeDigits(1e-6 * ns) + " ms";
  return threeDigits(1e-9 * ns) + " s";
}

ReportTable rateTable(const std::vector<ReportRow>& rows) {
  ReportTable table{.title = toString(ReportPart::Motions),
                    .remark =
                        "missed: called free, and a contact is proven. false alarms: not called "
                        "free, and proven free. Times per motion.",
                    .columns = {{"method"},
                                {"missed", true},
                                {"of collisions", true},
                                {"deepest", true},
                                {"false alarms", true},
                                {"of free", true},
                                {"mean", true},
                                {"median", true}},
                    .rows = {}};
  for (const ReportRow& row : rows) {
    const RateErrors& rates = *row.rates;
    table.rows.push_back({row.method.name(), std::to_string(rates.missed),
                          percentText(rates.missedRate()), metresText(rates.deepestMissed),
                          std::to_string(rates.falseAlarms), percentText(rates.falseAlarmRate()),
                          durationText(row.mean), durationText(row.median)});
  }
  return table;
}

std::string remarkOf(ReportPart part) {
  switch (part) {
    case ReportPart::FirstContact:
      return "When a motion that collides first does: error and bound in time, times the most that "
             "any point of the robot moves. missed: no contact found.";
    case ReportPart::Clearance:
      return "Least distance over a motion that is free.";
    case ReportPart::Distance:
      return "Of the nearest two shapes in a random state.";
    case ReportPart::Motions:
    case ReportPart::Penetration:
      break;
  }
  return "Depth of two shapes in each other, in a random state that collides.";
}

ReportTable lengthTable(ReportPart part, const std::vector<ReportRow>& rows) {
  ReportTable table{.title = toString(part),
                    .remark = remarkOf(part),
                    .columns = {{"method"},
                                {"queries", true},
                                {"missed", true},
                                {"mean error", true},
                                {"largest", true},
                                {"mean bound", true},
                                {"largest bound", true},
                                {"mean", true},
                                {"median", true}},
                    .rows = {}};
  for (const ReportRow& row : rows) {
    const LengthErrors& error = *row.error;
    table.rows.push_back(
        {row.method.name(), std::to_string(row.queries), std::to_string(error.missed),
         metresText(error.mean), metresText(error.largest), metresText(error.meanBound),
         metresText(error.largestBound), durationText(row.mean), durationText(row.median)});
  }
  return table;
}

ReportTable executedTable(const ExecutedPaths& executed) {
  if (!executed.leftOut.empty())
    return {.title = kExecutedPart, .remark = executed.leftOut, .columns = {}, .rows = {}};
  ReportTable table{
      .title = kExecutedPart,
      .remark =
          "Of " + countedText(executed.paths, "planned path") + " with " +
          countedText(executed.corners, "corner") +
          ", whose straight motions are all proven free. blends: a circular arc at "
          "each corner, as MoveIt makes it, up to so far off the path (rad, m). "
          "spline: the cubic spline through the way points. tube: the path, each "
          "joint up to so much off it (rad, m). proven blends: what provenTrajectory "
          "makes of the path, and the time of making it. missed: collisions that "
          "states every " +
          exactNumber(kStateStep) +
          " (rad, m) of the curve do not show. Times per path; relative: to the polyline's mean.",
      .columns = {{"curve"},
                  {"collide", true},
                  {"of paths", true},
                  {"undecided", true},
                  {"proven", true},
                  {"missed", true},
                  {"mean", true},
                  {"median", true},
                  {"relative", true}},
      .rows = {}};
  for (const ExecutedRow& row : executed.rows)
    table.rows.push_back({row.name(), std::to_string(row.collisions),
                          percentText(row.collisionRate()), std::to_string(row.undecided),
                          std::to_string(row.free), row.missed ? std::to_string(*row.missed) : "-",
                          durationText(row.mean), durationText(row.median),
                          threeDigits(row.relativeTime)});
  return table;
}

}  // namespace

std::vector<ReportTable> reportTables(const ErrorReport& report) {
  std::vector<ReportTable> tables{rateTable(report.rowsOf(ReportPart::Motions))};
  for (const ReportPart part : {ReportPart::FirstContact, ReportPart::Clearance,
                                ReportPart::Distance, ReportPart::Penetration})
    if (const auto rows = report.rowsOf(part); !rows.empty())
      tables.push_back(lengthTable(part, rows));
  tables.push_back(executedTable(report.executed));
  return tables;
}

std::string countsText(const ErrorReport& report) {
  const MotionCounts& counts = report.counts;
  const std::size_t worlds = report.worlds.size();
  std::string text = countedText(static_cast<std::size_t>(counts.motions), "random motion") +
                     " in " + countedText(worlds, "world") + ": " + std::to_string(counts.free) +
                     " free, " + std::to_string(counts.collision) + " in collision";
  if (counts.undecided > 0)
    text += ", " + std::to_string(counts.undecided) + " undecided at " +
            exactNumber(kTruthTolerance) + " m and left out";
  return text;
}

std::string reportText(const ErrorReport& report) {
  std::string text = escapedLine(report.robot + ", group " + report.group) + ", " +
                     countsText(report) + "\nlengths " + shortNumber(report.counts.shortest) +
                     " to " + shortNumber(report.counts.longest) + ", median " +
                     shortNumber(report.counts.median) + " (rad, m); times: the least of " +
                     std::to_string(report.passes) + " passes\n" + cloudsText(*report.world);
  for (const ReportTable& table : reportTables(report)) {
    TextTable lines(table.columns);
    for (const std::vector<std::string>& row : table.rows) lines.add(row);
    text += "\n" + table.title + ". " + escapedLine(table.remark) + "\n";
    if (!table.rows.empty()) text += lines.text();
  }
  return text;
}

}  // namespace swept
