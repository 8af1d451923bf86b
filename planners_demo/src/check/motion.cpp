// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "check/many_states.hpp"
#include "check/segment_report.hpp"
#include "command_line/commands.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "replay/query_dump.hpp"

namespace swept {
namespace {

SegmentReport examine(const LabelledState& from, const LabelledState& to, const Checker& checker,
                      Workspace& workspace) {
  SegmentReport segment{.from = from.label,
                        .to = to.label,
                        .certificate = {},
                        .clearance = {},
                        .constraints = &checker.options().constraints,
                        .times = timesBetween(from, to)};
  segment.certificate = checker.certifyMotion(from.q, to.q, workspace);
  if (segment.certificate.verdict != Verdict::Collision)
    segment.clearance =
        checker.motionClearance(from.q, to.q, clearanceAccuracy(checker), workspace);
  return segment;
}

}  // namespace

ExitCode runMotion(const Arguments& args) {
  requirePageFile(args);
  QueryDump dump(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = loadTask(args, model, warnings);
  if (task.states.size() < 2) throw UsageError("motion: two states or more are needed");
  dump.setFirstState(task.states.front());
  if (areMany(task)) return moveThroughMany(args, model, task, dump, warnings);
  Workspace workspace(*task.checker);
  ExitCode code = ExitCode::Free;
  std::string text;
  Json segments = Json::array();
  {
    Progress progress("certifying", args.quiet);
    for (std::size_t i = 1; i < task.states.size(); ++i) {
      const LabelledState& from = task.beginOfMotionTo(i);
      const SegmentReport segment = examine(from, task.states[i], *task.checker, workspace);
      text += segmentText(segment);
      segments.push_back(segmentJson(segment));
      dump.motion(*task.checker, segment.from + " to " + segment.to, from.q, task.states[i].q,
                  segment.certificate);
      code = worse(code, exitCodeOf(segment.certificate.verdict));
    }
  }
  if (args.json) {
    Json json = {{"robot", model.robot->name()},
                 {"group", task.checker->group().name},
                 {"margin", args.margin},
                 {"margin_self", task.checker->options().marginOf(true)},
                 {"margin_world", task.checker->options().marginOf(false)},
                 {"tolerance", args.tolerance},
                 {"segments", std::move(segments)}};
    addUnchecked(json, *task.checker, warnings);
    std::cout << dumped(json) << '\n';
  } else {
    printText(text + uncheckedText(*task.checker));
  }
  dump.announce();
  writeMotionPage(args, model, task);
  return code;
}

}  // namespace swept
