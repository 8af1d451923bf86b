// SPDX-License-Identifier: BSD-3-Clause
#include "plan/plan_report.hpp"

#include <cstddef>
#include <vector>

#include "certificate/trajectory_json.hpp"
#include "input/clouds.hpp"
#include "input/unchecked.hpp"
#include "output/clearance_text.hpp"
#include "output/clouds_json.hpp"
#include "output/terminal_text.hpp"
#include "output/text_table.hpp"
#include "plan/path_text.hpp"
#include "planning/end_report.hpp"

namespace swept {
namespace {

std::string planTable(const PlanRequest& request, const PlanOutcome& outcome) {
  TextTable table({{"planner"},
                   {"planning time", true},
                   {"simplification", true},
                   {"path length", true},
                   {"segments", true},
                   {"motions certified", true},
                   {"refused", true}});
  const bool solved = outcome.solved();
  table.add({request.planner, secondsText(outcome.planningTime),
             request.simplify && solved ? secondsText(outcome.simplifyTime) : "-",
             solved ? shortNumber(outcome.length) : "-",
             solved ? std::to_string(outcome.segments.size()) : "-",
             std::to_string(outcome.certified), std::to_string(outcome.refused)});
  return table.text();
}

std::string resultLine(const PlanOutcome& outcome, const Checker& checker) {
  if (!outcome.solved())
    return painted(Hue::Bad, "not solved") + ": " + escapedLine(outcome.failure) + "\n";
  if (outcome.proven())
    return painted(Hue::Good, "solved") + ": " + countedText(outcome.segments.size(), "segment") +
           (checker.checksNothing()        ? ", nothing was checked\n"
            : outcome.segments.size() == 1 ? ", proven free\n"
                                           : ", all proven free\n");
  for (std::size_t i = 0; i < outcome.segments.size(); ++i)
    if (const Verdict verdict = outcome.segments[i].certificate.verdict; verdict != Verdict::Free)
      return painted(Hue::Bad, "not proven") + ": segment " + std::to_string(i + 1) + " of " +
             std::to_string(outcome.segments.size()) + " is " + painted(verdict) + "\n";
  return {};
}

/// What became of a path that is proven.
std::string resultText(const Arguments& args, const Checker& checker, const PlanReport& report) {
  const bool timed = report.timed != nullptr;
  const std::string what = timed ? "trajectory" : "path";
  if (report.written) return what + " written to " + escapedLine(args.output) + "\n";
  if (!args.output.empty())
    return "no " + what + " written: " + reasonNotToWrite(report.timed->report.certificate) + "\n";
  return (timed ? "" : pathText(checker.robot(), checker.group(), report.outcome.states)) +
         "not kept: -o FILE.json writes it with its proof, .csv or .yaml without\n";
}

}  // namespace

std::string planText(const Arguments& args, const Checker& checker, const PlanReport& report) {
  const PlanOutcome& outcome = report.outcome;
  std::string text = planTable(report.request, outcome) + cloudsText(checker.world()) +
                     resultLine(outcome, checker);
  if (outcome.proven()) text += clearanceText(outcome.leastClearances()) + "\n";
  if (report.timed != nullptr) text += trajectoryText(report.timed->report);
  text += uncheckedText(checker);
  return outcome.proven() ? text + resultText(args, checker, report) : text;
}

Json planJson(const Arguments& args, const Checker& checker, const PlanReport& report,
              const Warnings& warnings) {
  const auto& [request, outcome, timed, written] = report;
  Json json = {{"robot", checker.robot().name()},
               {"group", checker.group().name},
               {"planner", request.planner},
               {"seed", request.seed},
               {"tracking", trackingJson(checker)},
               {"solved", outcome.solved()},
               {"proven", outcome.proven() && !checker.checksNothing()}};
  json["failure"] = outcome.solved() ? Json(nullptr) : Json(outcome.failure);
  json["bad_ends"] = Json::array();
  for (const EndReport& end : outcome.badEnds) json["bad_ends"].push_back(endJson(end));
  json["planning_time"] = outcome.planningTime;
  json["simplification_time"] = outcome.simplifyTime;
  json["path_length"] = outcome.solved() ? Json(outcome.length) : Json(nullptr);
  json["motions_certified"] = outcome.certified;
  json["motions_refused"] = outcome.refused;
  json["minimum_certified_clearance"] =
      outcome.proven() ? finiteOrNull(outcome.leastClearance()) : Json(nullptr);
  addClearances(outcome.proven() ? outcome.leastClearances() : Clearances{}, json);
  if (!outcome.proven()) json["clearance_world"] = json["clearance_self"] = nullptr;
  json["clouds"] = cloudsJson(checker.world());
  json["states"] = Json::array();
  for (const std::vector<double>& q : outcome.states) json["states"].push_back(toJson(q));
  if (args.timing.timed)
    json["trajectory"] = timed == nullptr ? Json(nullptr) : trajectoryJson(timed->report);
  json["path_file"] = written ? Json(args.output) : Json(nullptr);
  addUnchecked(json, checker, warnings);
  return json;
}

}  // namespace swept
