// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "page/pages.hpp"
#include "replay/query_dump.hpp"
#include "swept/ompl_bridge/planners.hpp"

namespace swept {
namespace {

void addPlanOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addCheckerOptions(app, args);
  addSceneOptions(app, args);
  addSelfFilterOption(app, args);
  app.add_option("states", args.states,
                 "start and goal, or several goals, one of which is to be reached")
      ->type_name("START GOAL...");
  addProblemOptions(app, args, "plans from start to goals; without --set or --index all of them");
  app.add_option("--planner", args.planner,
                 "planner (default CertifiedConnect; the others are OMPL's); names below")
      ->type_name("NAME");
  app.add_option("--time", args.time, "s; limit of the planner, per problem (default 5)")
      ->type_name("S")
      ->check(within(1e-3, 1e6, "between 0.001 and 1e6 s"));
  app.add_option("--range", args.range,
                 "longest motion that the planner tries, in the metric of the state space (rad, m; "
                 "default: of CertifiedConnect 0.4 rad of each joint; of others a fifth of the "
                 "extent of the space, with more than 7 joints of one of them)")
      ->type_name("R")
      ->check(within(1e-6, 1e6, "between 1e-6 and 1e6"));
  addSeedOption(app, args);
  app.add_option("-o,--output", args.output,
                 "path file, by its ending: .json (with certificates), .csv, or .yaml "
                 "(RobotTrajectory without time stamps); with --timed a trajectory: .json, .csv, "
                 "or .yaml (JointTrajectory)")
      ->type_name("FILE");
  addEmbedOption(app, args);
  app.add_option("--request", args.request,
                 "planning request (moveit_msgs/MotionPlanRequest as YAML): start and goals")
      ->type_name("FILE.yaml");
  app.add_option("--goal-pose", args.goalPose, "goal: where a link is to be, in the model frame")
      ->type_name("X,Y,Z,QX,QY,QZ,QW");
  app.add_option("--link", args.goalLink, "link of --goal-pose (default: the group's tip)")
      ->type_name("LINK");
  app.add_option("--position-tolerance", args.positionTolerance,
                 "m; of --goal-pose (default 0.001)")
      ->type_name("M")
      ->check(within(1e-6, 10.0, "between 1e-6 and 10 m"));
  app.add_option("--orientation-tolerance", args.orientationTolerance,
                 "rad; of --goal-pose (default 0.01)")
      ->type_name("RAD")
      ->check(within(1e-6, 3.2, "between 1e-6 and 3.2 rad"));
  app.add_option("--threads", args.threads,
                 "threads of the planner; copies of it, side by side, where it has none (default "
                 "1; with more, the path depends on timing)")
      ->type_name("N")
      ->check(within(1, 256, "between 1 and 256"));
  app.add_option("--simplify", args.simplifyTime,
                 "s; let OMPL's simplifier shorten the path for so long (default: shortenPath() of "
                 "swept, which takes milliseconds)")
      ->type_name("S")
      ->check(within(1e-3, 1e6, "between 0.001 and 1e6 s"));
  app.add_flag("--no-simplify", args.noSimplify, "keep the path as the planner returned it");
  app.add_option("--jobs", args.jobs,
                 "problems planned at the same time, one thread each (default 1; with more, random "
                 "numbers depend on timing)")
      ->type_name("N")
      ->check(within(1, 1024, "between 1 and 1024"));
  addTrackingOptions(app, args);
  addConstraintOptions(app, args);
  CLI::Option* timed =
      app.add_flag("--timed", args.timing.timed,
                   "times the path, with blended corners, and proves the curve that ros2_control "
                   "makes of this trajectory");
  addLimitsOption(app, args)->needs(timed);
  addTimingOptions(app, args, timed);
  addDumpOption(app, args);
  addHtmlOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

std::string notes() {
  std::string text = stateNotes() + "\nPlanners:";
  std::size_t column = 80;
  for (const std::string& name : plannerNames()) {
    if (column + name.size() + 1 > 80) {
      text += "\n ";
      column = 1;
    }
    text += " " + name;
    column += name.size() + 1;
  }
  return text + "\n";
}

}  // namespace

const Command kPlanCommand{.name = "plan",
                           .summary = "Find a path whose every motion is proven free",
                           .example =
                               "swept plan models/robots/rook7/rook7.urdf home ready --group arm "
                               "--scene models/scenes/narrow_slot.yaml -o path.json",
                           .exitCodes = kVerdictExitCodes,
                           .addOptions = addPlanOptions,
                           .run = runPlan,
                           .notes = notes};

}  // namespace swept
