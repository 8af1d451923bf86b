// SPDX-License-Identifier: BSD-3-Clause
#include "report/report_output.hpp"

namespace swept {
namespace {

constexpr std::string_view kHeader =
    "part,method,setting,queries,free,collision,missed,missed_rate,false_alarms,false_alarm_rate,"
    "deepest_missed [m],mean_error [m],largest_error [m],mean_bound [m],largest_bound [m],"
    "mean [ns],median [ns],undecided,relative_time\n";

std::string cell(const std::optional<double>& value) {
  return value ? exactNumber(*value) : "";
}

std::vector<std::string> rateCells(const std::optional<RateErrors>& rates) {
  if (!rates) return std::vector<std::string>(7);
  return {std::to_string(rates->free),        std::to_string(rates->collisions),
          std::to_string(rates->missed),      cell(rates->missedRate()),
          std::to_string(rates->falseAlarms), cell(rates->falseAlarmRate()),
          cell(rates->deepestMissed)};
}

std::string csvRow(const ReportRow& row) {
  std::vector<std::string> cells{toString(row.part), row.method.family(),
                                 exactNumber(row.method.setting), std::to_string(row.queries)};
  for (std::string& text : rateCells(row.rates)) cells.push_back(std::move(text));
  if (row.error) {
    cells[6] = std::to_string(row.error->missed);
    for (const std::optional<double>& value :
         {std::optional(row.error->mean), std::optional(row.error->largest), row.error->meanBound,
          row.error->largestBound})
      cells.push_back(cell(value));
  } else {
    cells.resize(cells.size() + 4);
  }
  cells.push_back(exactNumber(row.mean));
  cells.push_back(exactNumber(row.median));
  cells.resize(cells.size() + 2);
  return joined(cells, ",") + "\n";
}

std::string executedCsvRow(const ExecutedRow& row) {
  const std::vector<std::string> cells{kExecutedPart,
                                       row.curve,
                                       cell(row.setting),
                                       std::to_string(row.paths()),
                                       std::to_string(row.free),
                                       std::to_string(row.collisions),
                                       row.missed ? std::to_string(*row.missed) : "",
                                       cell(row.missedRate()),
                                       ",,,,,,",  // errors of other parts
                                       exactNumber(row.mean),
                                       exactNumber(row.median),
                                       std::to_string(row.undecided),
                                       exactNumber(row.relativeTime)};
  return joined(cells, ",") + "\n";
}

/// `0.1 0.2`
std::string valuesText(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text.append(text.empty() ? "" : " ").append(exactNumber(value));
  return text;
}

std::string namesText(const std::vector<ReportMethod>& methods) {
  std::string text;
  for (const ReportMethod& method : methods)
    text.append(text.empty() ? "" : " ").append(method.name());
  return text;
}

}  // namespace

std::string reportCsv(const ErrorReport& report) {
  std::string text(kHeader);
  for (const ReportRow& row : report.rows) text += csvRow(row);
  for (const ExecutedRow& row : report.executed.rows) text += executedCsvRow(row);
  return text;
}

std::string motionsCsv(const ErrorReport& report) {
  std::string text = "world,truth,length,t,body_a,body_b,from,to,missed_by,refused_by\n";
  for (const JudgedMotion& judged : report.motions) {
    const ReportMotion& motion = judged.motion;
    const std::optional<Witness>& witness = motion.truth.witness;
    const std::vector<std::string> cells{csvCell(judged.world),
                                         std::string(toString(motion.truth.verdict)),
                                         exactNumber(motion.length),
                                         witness ? exactNumber(witness->t) : "",
                                         witness ? csvCell(witness->bodyA) : "",
                                         witness ? csvCell(witness->bodyB) : "",
                                         valuesText(motion.from),
                                         valuesText(motion.to),
                                         namesText(judged.missedBy),
                                         namesText(judged.refusedBy)};
    text += joined(cells, ",") + "\n";
  }
  return text;
}

}  // namespace swept
