// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <optional>

#include "certificate/certificate.hpp"
#include "certificate/model_json.hpp"
#include "command_line/commands.hpp"
#include "input/clouds.hpp"
#include "input/inputs.hpp"
#include "input/poses.hpp"
#include "input/unchecked.hpp"
#include "output/clearance_text.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/text_table.hpp"
#include "page/pages.hpp"
#include "plan/path_files.hpp"
#include "plan/path_text.hpp"
#include "plan/plan_dump.hpp"
#include "plan/plan_options.hpp"
#include "plan/plan_sets.hpp"
#include "planning/planners.hpp"
#include "planning/planning.hpp"

namespace swept {
namespace {

// How near to a goal pose is enough.
constexpr double kPositionTolerance = 1e-3;     // m
constexpr double kOrientationTolerance = 1e-2;  // rad

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

std::string planText(const Arguments& args, const Checker& checker, const PlanRequest& request,
                     const PlanOutcome& outcome) {
  std::string text =
      planTable(request, outcome) + cloudsText(checker.world()) + resultLine(outcome, checker);
  if (outcome.proven()) text += clearanceText(outcome.leastClearances()) + "\n";
  text += uncheckedText(checker);
  if (!outcome.proven()) return text;
  if (!args.output.empty()) return text + "path written to " + escapedLine(args.output) + "\n";
  return text + pathText(checker.robot(), checker.group(), outcome.states) +
         "not kept: -o FILE.json writes it with its proof, .csv or .yaml without\n";
}

Json planJson(const Arguments& args, const Checker& checker, const PlanRequest& request,
              const PlanOutcome& outcome, const Warnings& warnings) {
  Json json = {
      {"robot", checker.robot().name()}, {"group", checker.group().name},
      {"planner", request.planner},      {"seed", request.seed},
      {"solved", outcome.solved()},      {"proven", outcome.proven() && !checker.checksNothing()}};
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
  json["path_file"] = outcome.proven() && !args.output.empty() ? Json(args.output) : Json(nullptr);
  addUnchecked(json, checker, warnings);
  return json;
}

/// A path file is JSON: names that cannot be in it are told before the work.
void requireNames(const Arguments& args, const Checker& checker) {
  const std::string where = "-o '" + args.output + "'";
  requireUtf8(inputsJson(args, args.output), where);
  requireModelNames(checker, where);
}

void writePath(const Arguments& args, const PathFile& file, const Checker& checker,
               const PlanRequest& request, const PlanOutcome& outcome, Warnings& warnings) {
  Certificate certificate;
  if (file.holdsProof()) {
    Progress progress("writing the proof", args.quiet);
    std::vector<double> clearances;
    for (const PathSegment& segment : outcome.segments) clearances.push_back(segment.clearance);
    certificate = certificateOf(checker, outcome.states, clearances);
  }
  if (!certificate.missing.empty())
    warnings("swept: warning: no proof in '" + args.output +
             "': no separating planes were found for " + certificate.missing);
  PathRecord record{.maker = {{"planner", request.planner}, {"seed", request.seed}},
                    .states = outcome.states,
                    .segments = {},
                    .inputs = inputsJson(args, args.output),
                    .warnings = warnings.unchecked()};
  for (const PathSegment& segment : outcome.segments)
    record.segments.push_back({segment.certificate.verdict, segment.clearance, segment.clearances});
  file.write(checker, record, certificate, args.embed);
}

std::optional<PoseTarget> goalPoseOf(const Arguments& args, const Task& task) {
  const Robot& robot = task.checker->robot();
  const Group& group = task.checker->group();
  if (task.poseGoal)
    return PoseTarget{.link = task.poseGoal->link,
                      .model_from_link = task.poseGoal->model_from_link,
                      .positionTolerance = task.poseGoal->positionTolerance,
                      .orientationTolerance = task.poseGoal->orientationTolerance};
  if (args.goalPose.empty()) return std::nullopt;
  PoseTarget target{
      .link = args.goalLink,
      .model_from_link = readPose(args.goalPose, "--goal-pose"),
      .positionTolerance = args.positionTolerance.value_or(kPositionTolerance),
      .orientationTolerance = args.orientationTolerance.value_or(kOrientationTolerance)};
  if (target.link.empty()) {
    if (group.tipLink < 0)
      throw UsageError("--goal-pose: group '" + group.name + "' has no tip; choose a --link");
    target.link = robot.links()[group.tipLink].name;
  }
  return target;
}

}  // namespace

ExitCode runPlan(const Arguments& args) {
  requirePlanOptions(args);
  routePlannerMessages(args.verbose);
  PlanRequest request{.planner = plannerName(args.planner),
                      .time = args.time,
                      .range = args.range,
                      .seed = args.seed,
                      .simplify = !args.noSimplify,
                      .simplifyTime = args.simplifyTime.value_or(args.time),
                      .threads = args.threads,
                      .goalPose = {},
                      .clearance = !plansSeveral(args)};
  if (plansSeveral(args)) return runPlanSets(args, request);

  requirePageFile(args);
  QueryDump dump(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = loadTask(args, model, warnings);
  request.goalPose = goalPoseOf(args, task);
  std::optional<PathFile> file;
  if (!args.output.empty()) file.emplace(args.output, *model.robot, task.checker->group());
  if (file && file->holdsProof()) requireNames(args, *task.checker);
  PlanOutcome outcome;
  {
    Progress progress(
        "planning with " + request.planner + ", at most " + shortNumber(request.time) + " s",
        args.quiet);
    outcome = plan(task.checker, task.states, request);
  }
  dumpFailures(dump, *task.checker, outcome);
  if (file && outcome.proven()) writePath(args, *file, *task.checker, request, outcome, warnings);
  if (args.json) {
    std::cout << dumped(planJson(args, *task.checker, request, outcome, warnings)) << '\n';
  } else {
    printText(planText(args, *task.checker, request, outcome));
  }
  dump.announce();
  writePlanPage(args, model, task, request, outcome);
  return outcome.code;
}

}  // namespace swept
