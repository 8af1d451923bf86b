// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificate/certificate.hpp"
#include "certificate/path_files.hpp"
#include "certificate/path_json.hpp"
#include "command_line/commands.hpp"
#include "input/constraints.hpp"
#include "input/inputs.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/seconds_since.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/whole_file.hpp"
#include "plan/path_text.hpp"
#include "swept/ompl_bridge/certified_roadmap.hpp"
#include "swept/robot_model/path_certificate.hpp"

namespace swept {
namespace {

using Clock = std::chrono::steady_clock;

/// Of the group, the world and the constraints on the command line. Throws UsageError.
std::shared_ptr<const Checker> roadmapChecker(const Arguments& args, const Model& model,
                                              Warnings& warnings) {
  const auto checker = withConstraintsOf(
      args, makeChecker(args, model, chooseGroup(*model.robot, args), model.world, warnings), {});
  warnOfNothing(*checker, warnings);
  return checker;
}

/// What a library refuses of a user's is the user's fault.
template <typename Action>
auto refusing(const Action& action) {
  try {
    return action();
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
}

Json roadmapJson(const CertifiedRoadmap& roadmap, const Arguments& args, double seconds) {
  const ProvenGraph& graph = roadmap.graph();
  const Checker& checker = *graph.checker();
  return {{"robot", checker.robot().name()},
          {"group", checker.group().name},
          {"states", graph.states()},
          {"motions", graph.motions()},
          {"free", roadmap.freeMotions()},
          {"components", roadmap.components()},
          {"time", seconds},
          {"roadmap_file", args.output}};
}

std::string roadmapText(const CertifiedRoadmap& roadmap, const Arguments& args) {
  const ProvenGraph& graph = roadmap.graph();
  return countedText(graph.states(), "state") + ", " + countedText(graph.motions(), "motion") +
         ": " + std::to_string(roadmap.freeMotions()) + " proven free, " +
         std::to_string(graph.motions() - roadmap.freeMotions()) +
         " blocked by bodies of the world\n" + countedText(roadmap.components(), "component") +
         " of states that free motions join\n" + "roadmap written to " + escapedLine(args.output) +
         "\n";
}

void printRoadmap(const CertifiedRoadmap& roadmap, const Arguments& args, Json json,
                  const std::string& text, const Warnings& warnings) {
  const Checker& checker = *roadmap.graph().checker();
  if (args.json) {
    addUnchecked(json, checker, warnings);
    std::cout << dumped(json) << '\n';
  } else {
    printText(text + roadmapText(roadmap, args) + uncheckedText(checker));
  }
}

struct Found {
  std::vector<std::vector<double>> states;
  PathCertificate certificate;
  double time = 0.0;  ///< s, of the query alone
};

/// Empty: there is no path.
std::optional<Found> findPath(const CertifiedRoadmap& roadmap, const Task& task) {
  Workspace workspace(*task.checker);
  const Clock::time_point begin = Clock::now();
  const auto path = roadmap.path(task.states[0].q, task.states[1].q, workspace);
  const double time = secondsSince(begin);
  if (!path) return std::nullopt;
  return Found{*path, certifyPath(*task.checker, *path), time};
}

/// Empty, or why the file has no proof.
std::string writePath(const Arguments& args, const PathFile& file, const Checker& checker,
                      const Found& found, const Warnings& warnings) {
  Progress progress("writing " + args.output, args.quiet);
  const ProvenPath path = provenPath(found.states, found.certificate);
  Certificate certificate;
  if (file.holdsProof()) certificate = certificateOf(checker, path.states, path.clearances());
  file.write(checker,
             {.maker = {{"planner", "roadmap"}},
              .states = path.states,
              .segments = path.segments,
              .inputs = inputsOfPath(args, args.output, path.states.front(), path.states.back()),
              .warnings = warnings.unchecked()},
             certificate, args.embed);
  return certificate.missing;
}

/// Why there may be no path, as far as one end says.
std::string withoutPathText(const CertifiedRoadmap& roadmap, const Task& task) {
  Workspace workspace(*task.checker);
  std::string text = "no path found: ";
  for (const LabelledState& state : {task.states[0], task.states[1]})
    if (task.checker->checkState(state.q, workspace) != Verdict::Free)
      return text + "the " + escapedLine(state.label) + " is not free\n";
  return text + "the roadmap has " + countedText(roadmap.components(), "component") +
         "; more states (roadmap build --states) may join them\n";
}

}  // namespace

ExitCode runRoadmapBuild(const Arguments& args) {
  Warnings warnings(args.quiet);
  requireWritable(args.output);
  const Model model = loadModel(args, warnings);
  const auto checker = roadmapChecker(args, model, warnings);
  const Clock::time_point begin = Clock::now();
  std::optional<CertifiedRoadmap> roadmap;
  {
    Progress progress("proving motions", args.quiet);
    roadmap = refusing([&] {
      return CertifiedRoadmap(checker,
                              {.states = static_cast<std::size_t>(args.roadmap.states),
                               .neighbours = static_cast<std::size_t>(args.roadmap.neighbours),
                               .seed = args.seed,
                               .threads = static_cast<unsigned>(args.threads)});
    });
  }
  const double seconds = secondsSince(begin);
  roadmap->graph().save(args.output);
  printRoadmap(*roadmap, args, roadmapJson(*roadmap, args, seconds),
               "built in " + secondsText(seconds) + "\n", warnings);
  return ExitCode::Free;
}

ExitCode runRoadmapUpdate(const Arguments& args) {
  Warnings warnings(args.quiet);
  requireWritable(args.output);
  const Model model = loadModel(args, warnings);
  const auto checker = roadmapChecker(args, model, warnings);
  const Clock::time_point begin = Clock::now();
  ProvenGraph::Updated updated = refusing([&] {
    return ProvenGraph::loadChanged(args.roadmap.file, checker,
                                    static_cast<unsigned>(args.threads));
  });
  const double seconds = secondsSince(begin);
  const ProvenGraph::Change& change = updated.change;
  const CertifiedRoadmap roadmap(std::move(updated.graph));
  roadmap.graph().save(args.output);
  Json json = roadmapJson(roadmap, args, seconds);
  json["bodies_gone"] = change.bodiesGone;
  json["bodies_new"] = change.bodiesNew;
  json["motions_asked"] = change.motionsAsked;
  json["pairs_asked"] = change.asked;
  json["pairs_by_arithmetic"] = change.byArithmetic;
  json["freed"] = change.freed;
  json["blocked"] = change.blocked;
  const std::size_t motions = roadmap.graph().motions();
  printRoadmap(roadmap, args, std::move(json),
               "bodies: " + std::to_string(change.bodiesGone) + " gone or changed, " +
                   std::to_string(change.bodiesNew) + " new or changed\n" +
                   countedText(change.motionsAsked, "motion") + " looked at again, " +
                   std::to_string(motions - change.motionsAsked) + " known by arithmetic\n" +
                   std::to_string(change.freed) + " are free and were not, " +
                   std::to_string(change.blocked) + " were and are not\n" + "read and updated in " +
                   secondsText(seconds) + "\n",
               warnings);
  return ExitCode::Free;
}

ExitCode runRoadmapQuery(const Arguments& args) {
  if (args.states.size() != 2)
    throw UsageError("roadmap query: two states are needed, start and goal");
  if (args.embed && args.output.empty()) throw UsageError("--embed needs -o FILE.json");
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = loadTask(args, model, warnings);
  const Checker& checker = *task.checker;
  std::optional<PathFile> file;
  if (!args.output.empty()) {
    file.emplace(args.output, checker.robot(), checker.group());
    if (args.embed && !file->holdsProof()) throw UsageError("--embed needs -o FILE.json");
    file->requireNames(inputsJson(args, args.output), checker);
  }
  const CertifiedRoadmap roadmap(refusing([&] {
    return ProvenGraph::load(args.roadmap.file, task.checker, static_cast<unsigned>(args.threads));
  }));
  const std::optional<Found> found = findPath(roadmap, task);
  const bool isProven = found && found->certificate.verdict() == Verdict::Free;
  std::string unproven;
  if (file && isProven) unproven = writePath(args, *file, checker, *found, warnings);
  if (!unproven.empty())
    warnings("swept: warning: no proof in '" + args.output + "': none was found for " + unproven);
  if (args.json) {
    Json json = {{"robot", checker.robot().name()},
                 {"group", checker.group().name},
                 {"found", found.has_value()},
                 {"proven", isProven},
                 {"time", found ? Json(found->time) : Json(nullptr)}};
    json["states"] = Json::array();
    if (found)
      for (const std::vector<double>& q : found->states) json["states"].push_back(toJson(q));
    json["path_file"] = file && isProven ? Json(args.output) : Json(nullptr);
    addUnchecked(json, checker, warnings);
    std::cout << dumped(json) << '\n';
  } else if (!found) {
    printText(painted(Hue::Bad, withoutPathText(roadmap, task)) + uncheckedText(checker));
  } else {
    printText(
        countedText(found->states.size() - 1, "motion") + ", " +
        (isProven ? painted(Hue::Good, "proven free") : painted(Hue::Bad, "not proven anew")) +
        ", found in " + secondsText(found->time) + "\n" +
        pathText(checker.robot(), checker.group(), found->states) + uncheckedText(checker) +
        (file && isProven ? "path written to " + escapedLine(args.output) + "\n" : ""));
  }
  if (!found) return ExitCode::Collision;
  return isProven ? ExitCode::Free : ExitCode::Undecided;
}

}  // namespace swept
