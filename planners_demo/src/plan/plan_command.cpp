// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "plan/planners.hpp"

namespace swept {
namespace {

void addOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addCheckerOptions(app, args);
  addSceneOptions(app, args);
  app.add_option("states", args.states, "start and goal")->type_name("START GOAL")->expected(0, 2);
  addProblemOptions(app, args, "plans from start to goals; without --set or --index all of them");
  app.add_option("--planner", args.planner, "OMPL planner (default RRTConnect); names below")
      ->type_name("NAME");
  app.add_option("--time", args.time, "s; limit of the planner, per problem (default 5)")
      ->type_name("S")
      ->check(within(1e-3, 1e6, "between 0.001 and 1e6 s"));
  addSeedOption(app, args);
  app.add_option("-o,--output", args.output,
                 "path file, by its ending: .json (with certificates), .csv, or .yaml "
                 "(RobotTrajectory without time stamps)")
      ->type_name("FILE");
  app.add_flag("--embed", args.embed,
               "the .json has the robot and the world in it, so that 'swept verify' needs no other "
               "file");
  app.add_flag("--no-simplify", args.noSimplify, "keep the path as the planner returned it");
  app.add_option("--jobs", args.jobs,
                 "problems planned at the same time, one thread each (default 1; with more, random "
                 "numbers depend on timing)")
      ->type_name("N")
      ->check(within(1, 1024, "between 1 and 1024"));
  app.add_flag("-v,--verbose", args.verbose, "OMPL's messages on stderr");
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
                           .addOptions = addOptions,
                           .run = runPlan,
                           .notes = notes};

}  // namespace swept
