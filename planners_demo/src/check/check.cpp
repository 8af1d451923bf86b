// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "check/many_states.hpp"
#include "check/state_report.hpp"
#include "command_line/commands.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "replay/query_dump.hpp"

namespace swept {

ExitCode runCheck(const Arguments& args) {
  requirePageFile(args);
  QueryDump dump(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = loadTask(args, model, warnings);
  dump.setFirstState(task.states.front());
  if (areMany(task)) return checkMany(args, model, task, dump, warnings);
  Workspace workspace(*task.checker);
  ExitCode code = ExitCode::Free;
  std::string text;
  Json states = Json::array();
  {
    Progress progress("checking states", args.quiet);
    for (const LabelledState& state : task.states) {
      const StateReport report = task.checker->reportState(state.q, workspace);
      text += reportText(state.label, report, task.checker->options().constraints);
      states.push_back(reportJson(state, report, task.checker->options().constraints));
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
