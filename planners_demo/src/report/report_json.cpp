// SPDX-License-Identifier: BSD-3-Clause
#include "input/clouds.hpp"
#include "report/machine.hpp"
#include "report/report_output.hpp"
#include "report/report_worlds.hpp"

namespace swept {
namespace {

Json orNull(const std::optional<double>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json rowJson(const ReportRow& row) {
  Json json = {{"part", toString(row.part)},
               {"method", row.method.family()},
               {"setting", row.method.setting},
               {"queries", row.queries}};
  if (row.rates) {
    json["free"] = row.rates->free;
    json["collision"] = row.rates->collisions;
    json["missed"] = row.rates->missed;
    json["missed_rate"] = orNull(row.rates->missedRate());
    json["false_alarms"] = row.rates->falseAlarms;
    json["false_alarm_rate"] = orNull(row.rates->falseAlarmRate());
    json["deepest_missed"] = orNull(row.rates->deepestMissed);
  }
  if (row.error) {
    json["missed"] = row.error->missed;
    json["mean_error"] = row.error->mean;
    json["largest_error"] = row.error->largest;
    json["mean_bound"] = orNull(row.error->meanBound);
    json["largest_bound"] = orNull(row.error->largestBound);
  }
  json["mean_ns"] = row.mean;
  json["median_ns"] = row.median;
  return json;
}

Json executedRowJson(const ExecutedRow& row) {
  return {{"part", kExecutedPart},
          {"method", row.curve},
          {"setting", orNull(row.setting)},
          {"queries", row.paths()},
          {"free", row.free},
          {"collision", row.collisions},
          {"undecided", row.undecided},
          {"missed", row.missed ? Json(*row.missed) : Json(nullptr)},
          {"missed_rate", orNull(row.missedRate())},
          {"mean_ns", row.mean},
          {"median_ns", row.median},
          {"relative_time", row.relativeTime}};
}

Json executedJson(const ExecutedPaths& executed) {
  return {{"paths", executed.paths},
          {"corners", executed.corners},
          {"left_out", executed.leftOut.empty() ? Json(nullptr) : Json(executed.leftOut)}};
}

}  // namespace

Json reportJson(const ErrorReport& report, const std::string& commandLine) {
  const MotionCounts& counts = report.counts;
  Json json = {{"robot", report.robot},
               {"group", report.group},
               {"worlds", report.worlds},
               {"margin", report.margin},
               {"margin_self", report.selfMargin},
               {"margin_world", report.worldMargin},
               {"seed", report.seed},
               {"passes", report.passes},
               {"command", commandLine}};
  json["clouds"] = cloudsJson(*report.world);
  json["motions"] = {{"count", counts.motions},
                     {"free", counts.free},
                     {"collision", counts.collision},
                     {"undecided", counts.undecided},
                     {"truth_tolerance", kTruthTolerance},
                     {"shortest", counts.shortest},
                     {"median_length", counts.median},
                     {"longest", counts.longest}};
  json["executed_curves"] = executedJson(report.executed);
  for (const auto& [name, value] : machineFacts()) json["machine"][name] = value;
  json["rows"] = Json::array();
  for (const ReportRow& row : report.rows) json["rows"].push_back(rowJson(row));
  for (const ExecutedRow& row : report.executed.rows) json["rows"].push_back(executedRowJson(row));
  return json;
}

}  // namespace swept
