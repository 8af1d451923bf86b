// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <optional>

#include "certificate/certificate.hpp"
#include "certificate/path_files.hpp"
#include "command_line/commands.hpp"
#include "input/inputs.hpp"
#include "input/poses.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "page/pages.hpp"
#include "plan/plan_dump.hpp"
#include "plan/plan_options.hpp"
#include "plan/plan_report.hpp"
#include "plan/plan_sets.hpp"
#include "planning/planning.hpp"
#include "swept/ompl_bridge/planners.hpp"
#include "trajectory/timed_trajectory.hpp"
#include "trajectory/timing.hpp"

namespace swept {
namespace {

// How near to a goal pose is enough.
constexpr double kPositionTolerance = 1e-3;     // m
constexpr double kOrientationTolerance = 1e-2;  // rad

ProvenPath provenPathOf(const PlanOutcome& outcome) {
  ProvenPath path{.states = outcome.states, .segments = {}};
  for (const PathSegment& segment : outcome.segments)
    path.segments.push_back({segment.certificate.verdict, segment.clearance, segment.clearances});
  return path;
}

/// With planes if the file holds them.
PathProof proofOf(const PathFile& file, const Checker& checker, const PlanReport& report) {
  PathProof proof{.path = provenPathOf(report.outcome), .certificate = {}};
  if (!file.holdsProof()) return proof;
  if (report.timed != nullptr)
    return proofOf(checker, report.timed->trajectory, report.timed->report.certificate);
  proof.certificate = certificateOf(checker, proof.path.states, proof.path.clearances());
  return proof;
}

/// The path, or the trajectory that was made of it.
void writePath(const Arguments& args, const PathFile& file, const Checker& checker,
               const PlanReport& report, Warnings& warnings) {
  Progress progress("writing " + args.output, args.quiet);
  const PathProof proof = proofOf(file, checker, report);
  if (!proof.certificate.missing.empty())
    warnings("swept: warning: no proof in '" + args.output + "': none was found for " +
             proof.certificate.missing);
  file.write(checker,
             {.maker = {{"planner", report.request.planner}, {"seed", report.request.seed}},
              .states = proof.path.states,
              .segments = proof.path.segments,
              .inputs = inputsJson(args, args.output),
              .warnings = warnings.unchecked(),
              .trajectory = report.timed == nullptr ? nullptr : &report.timed->trajectory},
             proof.certificate, args.embed);
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

PlanRequest requestOf(const Arguments& args) {
  return {.planner = plannerName(args.planner),
          .time = args.time,
          .range = args.range,
          .seed = args.seed,
          .simplify = !args.noSimplify,
          .simplifyTime = args.simplifyTime,
          .threads = args.threads,
          .goalPose = {},
          .clearance = !plansSeveral(args)};
}

/// Without --timed none.
std::optional<RateLimits> timingLimitsOf(const Arguments& args, const Model& model,
                                         const Group& group) {
  if (!args.timing.timed) return std::nullopt;
  return timingLimits(args, model, group, "--timed");
}

/// Without -o none.
std::optional<PathFile> pathFileOf(const Arguments& args, const Checker& checker) {
  if (args.output.empty()) return std::nullopt;
  PathFile file(args.output, checker.robot(), checker.group(),
                args.timing.timed ? PathFile::Content::Trajectory : PathFile::Content::Path);
  file.requireNames(inputsJson(args, args.output), checker);
  return file;
}

PlanOutcome planned(const Arguments& args, const Task& task, const PlanRequest& request) {
  Progress progress(
      "planning with " + request.planner + ", at most " + shortNumber(request.time) + " s",
      args.quiet);
  return plan(task.checker, task.states, request);
}

bool isWritable(const PlanReport& report) {
  if (report.timed == nullptr) return report.outcome.proven();
  return reasonNotToWrite(report.timed->report.certificate).empty();
}

}  // namespace

ExitCode runPlan(const Arguments& args) {
  requirePlanOptions(args);
  routePlannerMessages(args.verbose);
  PlanRequest request = requestOf(args);
  if (plansSeveral(args)) return runPlanSets(args, request);

  requirePageFile(args);
  QueryDump dump(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = loadTask(args, model, warnings);
  const Checker& checker = *task.checker;
  request.goalPose = goalPoseOf(args, task);
  const std::optional<RateLimits> limits = timingLimitsOf(args, model, checker.group());
  const std::optional<PathFile> file = pathFileOf(args, checker);
  const PlanOutcome outcome = planned(args, task, request);
  dumpFailures(dump, checker, outcome);
  std::optional<TimedTrajectory> timed;
  if (limits && outcome.proven()) timed = timePath(args, checker, outcome.states, *limits);
  PlanReport report{.request = request, .outcome = outcome, .timed = timed ? &*timed : nullptr};
  report.written = file && isWritable(report);
  if (report.written) writePath(args, *file, checker, report, warnings);
  if (args.json)
    std::cout << dumped(planJson(args, checker, report, warnings)) << '\n';
  else
    printText(planText(args, checker, report));
  dump.announce();
  writePlanPage(args, model, task, request, outcome, timed ? &timed->shown : nullptr);
  return timed ? worse(outcome.code, codeOf(timed->report.certificate)) : outcome.code;
}

}  // namespace swept
