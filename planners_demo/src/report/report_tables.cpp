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

}  // namespace

std::vector<ReportTable> reportTables(const ErrorReport& report) {
  std::vector<ReportTable> tables{rateTable(report.rowsOf(ReportPart::Motions))};
  for (const ReportPart part : {ReportPart::FirstContact, ReportPart::Clearance,
                                ReportPart::Distance, ReportPart::Penetration})
    if (const auto rows = report.rowsOf(part); !rows.empty())
      tables.push_back(lengthTable(part, rows));
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
    text += "\n" + table.title + ". " + table.remark + "\n" + lines.text();
  }
  return text;
}

}  // namespace swept
