// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "command_line/commands.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/clearance_text.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "replay/query_dump.hpp"

namespace swept {
namespace {

std::string stateText(const std::string& label, const StateReport& report) {
  std::string text = escapedLine(label) + ": " + painted(report.verdict);
  if (keepApart(report.contacts)) text += " (closer than the margin)";
  if (report.verdict != Verdict::Collision)
    text.append(", ").append(clearanceText(clearancesOf(report)));
  text += "\n";
  for (const Witness& contact : report.contacts) text += "  " + witnessText(contact) + "\n";
  return text;
}

Json stateJson(const LabelledState& state, const StateReport& report) {
  Json contacts = Json::array();
  for (const Witness& contact : report.contacts) {
    contacts.push_back(toJson(contact));
    contacts.back().erase("t");
  }
  Json json = {{"label", state.label},
               {"values", toJson(state.q)},
               {"verdict", toString(report.verdict)},
               {"clearance", finiteOrNull(report.clearance)}};
  json["nearest"] = nearestJson(report.nearestA, report.nearestB);
  addClearances(clearancesOf(report), json);
  json["contacts"] = std::move(contacts);
  return json;
}

}  // namespace

ExitCode runCheck(const Arguments& args) {
  requirePageFile(args);
  QueryDump dump(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = loadTask(args, model, warnings);
  Workspace workspace(*task.checker);
  ExitCode code = ExitCode::Free;
  std::string text;
  Json states = Json::array();
  {
    Progress progress("checking states", args.quiet);
    for (const LabelledState& state : task.states) {
      const StateReport report = task.checker->reportState(state.q, workspace);
      text += stateText(state.label, report);
      states.push_back(stateJson(state, report));
      dump.state(*task.checker, state.label, state.q, report.verdict);
      code = worse(code, exitCodeOf(report.verdict));
    }
  }
  if (args.json) {
    Json json = {{"robot", model.robot->name()},
                 {"group", task.checker->group().name},
                 {"margin", args.margin},
                 {"margin_self", task.checker->options().marginOf(true)},
                 {"margin_world", task.checker->options().marginOf(false)},
                 {"states", std::move(states)}};
    addUnchecked(json, *task.checker, warnings);
    std::cout << dumped(json) << '\n';
  } else {
    printText(text + uncheckedText(*task.checker));
  }
  dump.announce();
  writeCheckPage(args, model, task);
  return code;
}

}  // namespace swept
