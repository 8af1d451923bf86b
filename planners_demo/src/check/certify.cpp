// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <optional>

#include "certificate/certificate.hpp"
#include "certificate/path_files.hpp"
#include "certificate/path_json.hpp"
#include "check/many_states.hpp"
#include "check/segment_report.hpp"
#include "command_line/commands.hpp"
#include "input/constraints.hpp"
#include "input/groups.hpp"
#include "input/inputs.hpp"
#include "input/state_lists.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/clearance_text.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "replay/query_dump.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/path_file.hpp"

namespace swept {
namespace {

/// A page holds each segment's course.
constexpr std::size_t kMostShown = 5000;

void requirePageOf(const Arguments& args, std::size_t segments) {
  if (!args.page.file.empty() && segments > kMostShown)
    throw UsageError("--html shows " + std::to_string(kMostShown) +
                     " segments at most; these are " + std::to_string(segments));
}

Task pathTask(const Arguments& args, const Model& model, Warnings& warnings) {
  const Group& group = chooseGroup(*model.robot, args);
  Task task;
  for (std::vector<double>& q :
       readPath(args.path, *model.robot, group, model.reference, model.options))
    task.states.push_back(
        {.label = "state " + std::to_string(task.states.size() + 1), .q = std::move(q)});
  // What is proven of a single state is the motion that stays there.
  if (task.states.size() == 1) task.states.push_back(task.states.front());
  task.checker = withConstraintsOf(args, makeChecker(args, model, group, model.world, warnings),
                                   task.states.front().q);
  warnOfNothing(*task.checker, warnings);
  return task;
}

Json inputsOfProof(const Arguments& args, const Task& task) {
  return inputsOfPath(args, args.output, task.states.front().q, task.states.back().q);
}

/// Where the proof goes, refused before the work where it cannot.
std::optional<PathFile> proofFile(const Arguments& args, const Task& task) {
  if (args.output.empty()) {
    if (args.embed) throw UsageError("--embed needs -o FILE.json");
    return std::nullopt;
  }
  PathFile file(args.output, task.checker->robot(), task.checker->group());
  if (!file.holdsProof())
    throw UsageError("'" + args.output + "': a file with a proof ends in .json");
  file.requireNames(inputsOfProof(args, task), *task.checker);
  return file;
}

/// Empty, or why there is no proof in the file.
std::string writeProofOf(const Arguments& args, const PathFile& file, const Task& task,
                         const PathCertificate& path, const Warnings& warnings) {
  if (path.verdict() != Verdict::Free) return "the path is not free";
  Progress progress("writing the proof", args.quiet);
  std::vector<std::vector<double>> states;
  for (const LabelledState& state : task.states) states.push_back(state.q);
  const ProvenPath proven = provenPath(states, path);
  const Certificate certificate = certificateOf(*task.checker, proven.states, proven.clearances());
  if (!certificate.missing.empty()) return "none was found for " + certificate.missing;
  const PathRecord record{.maker = Json::object(),
                          .states = proven.states,
                          .segments = proven.segments,
                          .inputs = inputsOfProof(args, task),
                          .warnings = warnings.unchecked()};
  file.write(*task.checker, record, certificate, args.embed);
  return {};
}

/// Of all segments; of those in collision there are none.
std::optional<Clearances> leastClearances(const PathCertificate& path) {
  std::optional<Clearances> least;
  for (const CertifiedSegment& segment : path.segments) {
    if (!segment.clearance) return std::nullopt;
    const Clearances own = clearancesOf(*segment.clearance);
    if (least)
      takeLeast(own, *least);
    else
      least = own;
  }
  return least;
}

struct Report {
  VerdictCounts counts;
  std::string text;           ///< of the first segments that are not free
  Json told = Json::array();  ///< likewise
};

Report reportOf(const Task& task, const PathCertificate& path, QueryDump& dump) {
  Report report;
  for (std::size_t i = 0; i < path.segments.size(); ++i) {
    const CertifiedSegment& segment = path.segments[i];
    report.counts.add(segment.certificate.verdict);
    if (segment.certificate.verdict == Verdict::Free) continue;
    const LabelledState &from = task.states[i], &to = task.states[i + 1];
    dump.motion(*task.checker, from.label + " to " + to.label, from.q, to.q, segment.certificate);
    if (report.told.size() == kMostTold) continue;
    const SegmentReport own{.from = from.label,
                            .to = to.label,
                            .certificate = segment.certificate,
                            .clearance = segment.clearance,
                            .constraints = &task.checker->options().constraints};
    report.text += segmentText(own);
    report.told.push_back(segmentJson(own));
  }
  return report;
}

Json certifyJson(const Arguments& args, const Task& task, const PathCertificate& path,
                 Report& report, const std::string& noProof, const Warnings& warnings) {
  const Checker& checker = *task.checker;
  const bool proven = path.verdict() == Verdict::Free && !checker.checksNothing();
  Json json = {{"robot", checker.robot().name()},
               {"group", checker.group().name},
               {"margin", args.margin},
               {"margin_self", checker.options().marginOf(true)},
               {"margin_world", checker.options().marginOf(false)},
               {"tolerance", args.tolerance},
               {"verdict", toString(path.verdict())},
               {"proven", proven}};
  report.counts.addTo(json);
  const std::optional<Clearances> least = leastClearances(path);
  addClearances(least.value_or(Clearances{}), json);
  if (!least) json["clearance_world"] = json["clearance_self"] = nullptr;
  json["segments"] = std::move(report.told);
  json["proof_file"] = !args.output.empty() && noProof.empty() ? Json(args.output) : Json(nullptr);
  json["no_proof"] = noProof.empty() ? Json(nullptr) : Json(noProof);
  addUnchecked(json, checker, warnings);
  return json;
}

std::string certifyText(const Arguments& args, const Task& task, const PathCertificate& path,
                        const Report& report, const std::string& noProof) {
  std::string text = report.counts.text("segment");
  text += task.checker->checksNothing() ? ", nothing was checked\n" : "\n";
  text += report.text + report.counts.furtherText("segment", report.told.size());
  if (const auto least = leastClearances(path)) text += clearanceText(*least) + "\n";
  text += uncheckedText(*task.checker);
  if (args.output.empty()) return text;
  return text +
         escapedLine(noProof.empty() ? "proof written to " + args.output
                                     : "no proof written to " + args.output + ": " + noProof) +
         "\n";
}

}  // namespace

ExitCode runCertify(const Arguments& args) {
  requirePageFile(args);
  QueryDump dump(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = pathTask(args, model, warnings);
  requirePageOf(args, task.states.size() - 1);
  dump.setFirstState(task.states.front());
  const std::optional<PathFile> file = proofFile(args, task);
  PathCertificate path;
  {
    std::vector<std::vector<double>> states;
    for (const LabelledState& state : task.states) states.push_back(state.q);
    ProgressBar progress("segments", 0, states.size() - 1, args.quiet);
    path = certifyPath(*task.checker, states,
                       {.progress = [&](std::size_t done) { progress.draw(done); }});
  }
  Report report = reportOf(task, path, dump);
  const std::string noProof =
      file ? writeProofOf(args, *file, task, path, warnings) : std::string();
  if (args.json)
    std::cout << dumped(certifyJson(args, task, path, report, noProof, warnings)) << '\n';
  else
    printText(certifyText(args, task, path, report, noProof));
  dump.announce();
  writeCertifyPage(args, model, task, path);
  // A proof that was asked for and not found is a question that stays open.
  return worse(report.counts.code(), noProof.empty() ? ExitCode::Free : ExitCode::Undecided);
}

}  // namespace swept
