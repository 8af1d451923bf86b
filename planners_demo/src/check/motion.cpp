// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <iostream>
#include <optional>

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

struct Segment {
  std::string from, to;
  MotionCertificate certificate;
  std::optional<MotionClearance> clearance;  ///< not asked for where there is a collision
};

Segment examine(const LabelledState& from, const LabelledState& to, const Checker& checker,
                Workspace& workspace) {
  Segment segment{.from = from.label, .to = to.label, .certificate = {}, .clearance = {}};
  segment.certificate = checker.certifyMotion(from.q, to.q, workspace);
  if (segment.certificate.verdict != Verdict::Collision)
    segment.clearance =
        checker.motionClearance(from.q, to.q, clearanceAccuracy(checker), workspace);
  return segment;
}

/// The lesser one first.
std::string clearanceLines(const MotionClearance& clearance) {
  if (std::isinf(clearance.lower)) return "  clearance   no pair to check\n";
  const auto line = [](const std::string& kind, const ClearanceInterval& of) {
    return "  " + kind + std::string(12 - kind.size(), ' ') + boundsText(of);
  };
  return line("clearance", clearance) +
         (clearance.selfPair ? " (self)\n" + line("world", clearance.world)
                             : " (world)\n" + line("self", clearance.self)) +
         "\n";
}

std::string segmentText(const Segment& segment) {
  const MotionCertificate& certificate = segment.certificate;
  std::string text =
      escapedLine(segment.from + " to " + segment.to) + ": " + painted(certificate.verdict) +
      (certificate.witness && keepsApart(*certificate.witness) ? " (closer than the margin)\n"
                                                               : "\n");
  if (certificate.verdict != Verdict::Free)
    text += "  free until  t = " + shortNumber(certificate.freeUntil) + "\n";
  if (certificate.witness)
    text += "  contact     t = " + shortNumber(certificate.witness->t) + ", " +
            witnessText(*certificate.witness) + "\n";
  if (certificate.verdict == Verdict::Undecided)
    text += "  undecided   t = " + shortNumber(certificate.undecidedAt) + "\n";
  if (segment.clearance) text += clearanceLines(*segment.clearance);
  const Effort& effort = certificate.effort;
  return text + "  effort      intervals in lanes " + std::to_string(effort.lanes) + ", exactly " +
         std::to_string(effort.intervals) + "; distances " + std::to_string(effort.distances) +
         ", settled by bounding volumes " + std::to_string(effort.culled) + "\n";
}

Json segmentJson(const Segment& segment) {
  const MotionCertificate& certificate = segment.certificate;
  Json json = {{"from", segment.from},
               {"to", segment.to},
               {"verdict", toString(certificate.verdict)},
               {"free_until", certificate.freeUntil}};
  json["witness"] = certificate.witness ? toJson(*certificate.witness) : Json(nullptr);
  json["undecided_at"] =
      certificate.verdict == Verdict::Undecided ? Json(certificate.undecidedAt) : Json(nullptr);
  const std::optional<MotionClearance>& clearance = segment.clearance;
  json["clearance"] = clearance ? boundsJson(*clearance) : Json(nullptr);
  json["clearance_world"] = clearance ? boundsJson(clearance->world) : Json(nullptr);
  json["clearance_self"] = clearance ? boundsJson(clearance->self) : Json(nullptr);
  json["effort"] = {{"intervals", certificate.effort.intervals},
                    {"lanes", certificate.effort.lanes},
                    {"distances", certificate.effort.distances},
                    {"culled", certificate.effort.culled}};
  return json;
}

}  // namespace

ExitCode runMotion(const Arguments& args) {
  requirePageFile(args);
  QueryDump dump(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = loadTask(args, model, warnings);
  if (task.states.size() < 2) throw UsageError("motion: two states or more are needed");
  Workspace workspace(*task.checker);
  ExitCode code = ExitCode::Free;
  std::string text;
  Json segments = Json::array();
  {
    Progress progress("certifying", args.quiet);
    for (std::size_t i = 1; i < task.states.size(); ++i) {
      const LabelledState& from = task.beginOfMotionTo(i);
      const Segment segment = examine(from, task.states[i], *task.checker, workspace);
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
