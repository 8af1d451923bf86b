// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "page/pages.hpp"

namespace swept {
namespace {

void addScheduleOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  app.add_option("part", args.schedule.parts,
                 "a group and its trajectory, a file of 'swept trajectory': left/arm=left.yaml. "
                 "Names of joints may lack that of the robot")
      ->type_name("GROUP=FILE");
  CLI::Option* plan =
      app.add_option("--plan", args.schedule.plans,
                     "plan a trajectory of this group beside all others, from one state to another "
                     "(each a named state or values): right/arm=tucked..ready. Repeatable: the "
                     "first has priority")
          ->type_name("GROUP=START..GOAL")
          ->allow_extra_args(false);
  app.add_option("--time", args.time, "s; limit of planning (default 5)")
      ->type_name("S")
      ->check(within(1e-3, 1e6, "between 0.001 and 1e6 s"))
      ->needs(plan);
  app.add_option("--at", args.schedule.starts,
                 "s; when the group's trajectory starts (default 0; repeatable)")
      ->type_name("GROUP=S")
      ->allow_extra_args(false);
  app.add_option("--late", args.schedule.late,
                 "s; prove, too, that nothing touches if the group starts up to so much later; "
                 "else the longest delay that is proven, and the first conflict after it "
                 "(repeatable, one group at a time)")
      ->type_name("GROUP=S")
      ->allow_extra_args(false);
  app.add_option("--slow", args.schedule.slow,
                 "percent; the same where the group takes up to so much longer, with each of the "
                 "delays of --late (repeatable)")
      ->type_name("GROUP=PERCENT")
      ->allow_extra_args(false);
  addCheckerOptions(app, args);
  addSceneOptions(app, args);
  addTrackingOptions(app, args);
  addConstraintOptions(app, args);
  addLimitsOption(app, args);
  addSpeedOptions(app, args, plan);
  addSeedOption(app, args);
  app.add_option("-o,--output", args.output,
                 "the trajectory of all groups, if it is free: .json (with a proof for 'swept "
                 "verify'), .csv, or .yaml (JointTrajectory)")
      ->type_name("FILE");
  addEmbedOption(app, args);
  addHtmlOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

std::string notes() {
  return "All groups share one clock. Before its trajectory begins, and after it ends, a group "
         "rests.\nOf several groups that are planned, each avoids those before it. The result has "
         "positions "
         "and velocities,\nwithin limits (--limits, --max-acceleration).\nA delay stands for the "
         "whole trajectory; --tracking is for errors on the way.\n";
}

}  // namespace

const Command kScheduleCommand{
    .name = "schedule",
    .summary =
        "Trajectories of several robots on one clock: are they free, how late may one be? And plan "
        "them.",
    .example =
        "swept schedule models/cells/two_rooks.yaml left/arm=models/trajectories/rook7_reach.csv "
        "right/arm=models/trajectories/rook7_reach.csv --at right/arm=4 --late left/arm=1",
    .exitCodes =
        "Exit codes: 0 free with all delays that were asked about, 1 there is a conflict, a "
        "limit is left or no plan\nwas found, 2 undecided, 3 bad input or usage.",
    .addOptions = addScheduleOptions,
    .run = runSchedule,
    .notes = notes,
    .hasClock = true};

}  // namespace swept
