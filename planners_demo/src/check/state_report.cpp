// SPDX-License-Identifier: BSD-3-Clause
#include "check/state_report.hpp"

#include <span>
#include <utility>

#include "output/clearance_text.hpp"
#include "output/terminal_text.hpp"
#include "output/violation_json.hpp"

namespace swept {

std::string reportText(const std::string& label, const StateReport& report,
                       const TaskConstraint& constraints) {
  std::string text = escapedLine(label) + ": " + painted(report.verdict);
  if (keepApart(report.contacts)) text += " (closer than the margin)";
  if (report.verdict != Verdict::Collision)
    text.append(", ").append(clearanceText(clearancesOf(report)));
  text += "\n";
  for (const Witness& contact : report.contacts) text += "  " + witnessText(contact) + "\n";
  for (const ConstraintViolation& violation : report.violations)
    text += "  " + escapedLine(describe(violation, constraints)) + "\n";
  return text;
}

Json reportJson(const LabelledState& state, const StateReport& report,
                const TaskConstraint& constraints) {
  Json contacts = Json::array();
  for (const Witness& contact : report.contacts) {
    contacts.push_back(toJson(contact));
    contacts.back().erase("t");
  }
  const std::span<const double> values(state.q);
  Json json = {{"label", state.label},
               {"values", toJson(state.time ? values.first(values.size() - 1) : values)},
               {"verdict", toString(report.verdict)},
               {"clearance", finiteOrNull(report.clearance)}};
  if (state.time) json["time"] = *state.time;
  json["nearest"] = nearestJson(report.nearestA, report.nearestB);
  addClearances(clearancesOf(report), json);
  json["contacts"] = std::move(contacts);
  for (const ConstraintViolation& violation : report.violations) {
    json["violations"].push_back(violationJson(violation, constraints));
    json["violations"].back().erase("t");
  }
  return json;
}

}  // namespace swept
