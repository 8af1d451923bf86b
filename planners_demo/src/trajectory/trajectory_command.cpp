// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "input/clock.hpp"
#include "page/pages.hpp"

namespace swept {
namespace {

void addTrajectoryOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  app.add_option("file", args.trajectory.file,
                 "trajectory of any planner: .yaml (JointTrajectory, RobotTrajectory, "
                 "DisplayTrajectory; several with --- between), .csv (time, joints, "
                 "JOINT_velocity, JOINT_acceleration) or .json (of swept, with or without a proof)")
      ->required()
      ->type_name("FILE");
  addCheckerOptions(app, args);
  addSceneOptions(app, args);
  addTrackingOptions(app, args);
  addConstraintOptions(app, args);
  app.add_option("--start", args.trajectory.start,
                 "state that the robot starts from at time 0, at rest: a name or values between "
                 "commas")
      ->type_name("STATE");
  app.add_option("--clock", args.clock.begin,
                 "s; what the clock of the objects of --scene that move shows at the trajectory's "
                 "time 0 (default 0)")
      ->type_name("S")
      ->check(within(-kMostTime, kMostTime, "between -1e6 and 1e6 s"));
  addLimitsOption(app, args);
  app.add_option("-o,--output", args.output,
                 "the trajectory, if it is free: .json (with a proof for 'swept verify'), .csv, "
                 "or .yaml (JointTrajectory)")
      ->type_name("FILE");
  addEmbedOption(app, args);
  CLI::Option* repair =
      app.add_flag("--repair", args.trajectory.repair,
                   "where a trajectory is not free, or leaves limits of rates: the nearest one "
                   "that is proven, into the file of -o");
  addTimingOptions(app, args, repair);
  addHtmlOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

std::string notes() {
  return "What is proven is the curve that ros2_control's joint_trajectory_controller makes of the "
         "points:\nlines, cubics or quintics, by whether they have velocities and accelerations.\n";
}

}  // namespace

const Command kTrajectoryCommand{
    .name = "trajectory",
    .summary = "Is the curve that a controller makes of this trajectory free?",
    .example =
        "swept trajectory models/robots/rook7/rook7.urdf models/trajectories/rook7_shelf.yaml "
        "--group arm --scene models/scenes/shelf.yaml --tracking 0.005",
    .exitCodes =
        "Exit codes: 0 all are free and keep the limits, 1 one is in collision or leaves a limit, "
        "2 "
        "one is\nundecided, 3 bad input or usage. With --repair: of what was written.",
    .addOptions = addTrajectoryOptions,
    .run = runTrajectory,
    .notes = notes,
    .hasClock = true};

}  // namespace swept
