// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/options.hpp"

#include <limits>

namespace swept {

CLI::Validator within(double low, double high, const std::string& what) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
        return "must be " + what + ", not " + CLI::detail::trim_copy(text);
      },
      "");
}

namespace {

void addXacroOptions(CLI::App& app, Arguments& args) {
  auto* xacro =
      app.add_flag("--xacro", args.xacro, "the robot is what the program xacro makes of the file");
  app.add_option("--xacro-arg", args.xacroArguments, "argument of xacro (repeatable)")
      ->type_name("NAME:=VALUE")
      ->check(CLI::Validator(
          [](std::string& text) -> std::string {
            const auto at = text.find(":=");
            const bool isOne = at != std::string::npos && at > 0 && text.front() != '-';
            return isOne ? "" : "must be NAME:=VALUE, not " + text;
          },
          ""))
      ->needs(xacro)
      ->allow_extra_args(false);
}

}  // namespace

void addRobotOptions(CLI::App& app, Arguments& args, const std::string& use) {
  app.add_option("robot", args.robot, "URDF file, or a .yaml of several robots")
      ->required()
      ->type_name("ROBOT.urdf");
  app.add_option("--srdf", args.srdf,
                 "SRDF file" + use +
                     "; without: a .srdf beside the URDF with the same stem, if there is one; "
                     "'none': no SRDF")
      ->type_name("FILE");
  app.add_option("--package", args.packages, "folder of package://NAME/... (repeatable)")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false);
  addVerboseOption(app, args);
  addXacroOptions(app, args);
}

void addVerboseOption(CLI::App& app, Arguments& args) {
  app.add_flag(
      "-v,--verbose", args.verbose,
      "each warning, where many are of one kind, and messages of planners, on stderr; with info "
      "each pair of links");
}

void addRuleOptions(CLI::App& app, Arguments& args) {
  auto* group = app.add_option("--group", args.group,
                               "planning group; not needed when only one has joints, or the named "
                               "states given");
  auto* joints =
      app.add_option("--joints", args.joints, "instead of a group: these joints")->excludes(group);
  auto* chain = app.add_option("--chain", args.chain,
                               "instead of a group: the joints between these two links");
  group->type_name("NAME");
  joints->type_name("A,B,...");
  chain->type_name("BASE,TIP")->excludes(group)->excludes(joints);
  app.add_option("--margin", args.margin, "m; free means: more than this apart (default 0)")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
  app.add_option("--margin-self", args.selfMargin,
                 "m; of pairs of two links or attached bodies, instead of --margin")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
  app.add_option("--margin-world", args.worldMargin,
                 "m; of pairs with the world, instead of --margin")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
  app.add_option("--pad", args.pads,
                 "a link or body of the world reaches so many m farther; in names * stands for any "
                 "characters (repeatable)")
      ->type_name("NAME=M")
      ->allow_extra_args(false);
  app.add_option("--scale", args.scales,
                 "a link or body of the world is so many times as large (repeatable)")
      ->type_name("NAME=FACTOR")
      ->allow_extra_args(false);
  app.add_option("--allow", args.allowed,
                 "two links, or a link and a body of the world, may collide (repeatable)")
      ->type_name("A,B")
      ->allow_extra_args(false);
  app.add_flag("--keep-default-contacts", args.keepDefaultContacts,
               "without an SRDF: check pairs of links, too, that are in contact at the default "
               "state and at all others that were looked at");
  app.add_option(
         "--attach", args.attached,
         "a link carries box:X,Y,Z or sphere:R or cylinder:R,L (m) or a mesh file, which is "
         "checked as the link is, but not against it; behind a colon its pose in the link's "
         "frame, X,Y,Z[,QX,QY,QZ,QW] (repeatable)")
      ->type_name("SHAPE@LINK")
      ->allow_extra_args(false);
  app.add_option("--stand", args.standing,
                 "the joints of another group stand at this state, instead of at their default "
                 "(repeatable)")
      ->type_name("GROUP=STATE")
      ->allow_extra_args(false);
}

void addCheckerOptions(CLI::App& app, Arguments& args) {
  addRuleOptions(app, args);
  app.add_option("--tolerance", args.tolerance,
                 "m; motions that keep more than margin + tolerance are decided (default 0.001)")
      ->type_name("M")
      ->check(within(1e-6, 1.0, "between 1e-6 and 1 m"));
}

void addSceneOptions(CLI::App& app, Arguments& args) {
  app.add_option("--scene", args.scene,
                 "planning scene: .yaml, .yml, .scene, or a .urdf of what stands around")
      ->type_name("FILE");
  app.add_option(
         "--cloud", args.clouds,
         "sensed points (.pcd, .ply, .xyz) or an OctoMap (.bt, .ot), a body named after its "
         "file (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--point-radius", args.pointRadius,
                 "m; each point of a cloud stands for a ball of this radius")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
  app.add_option("--cloud-pose", args.cloudPose, "of the clouds' frame in the model frame")
      ->type_name("X,Y,Z,QX,QY,QZ,QW");
  app.add_option("--occluded", args.occluded,
                 "m; what points hide from their sensor is occupied, too, up to so far from it: it "
                 "is where the file says (VIEWPOINT, camera), else at the origin of their frame; "
                 "needs a radius above zero")
      ->type_name("RANGE")
      ->check(within(1e-3, 1e3, "between 0.001 and 1000 m"));
}

void addSelfFilterOption(CLI::App& app, Arguments& args) {
  app.add_option("--self-filter", args.selfFilter,
                 "m; points this near to the robot in the first state are the robot itself")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
}

void addStateListOption(CLI::App& app, Arguments& args, const std::string& what) {
  app.add_option("states", args.states, what)->type_name("STATE");
  app.add_flag("--degrees", args.degrees,
               "values of states are in degrees where they are angles; in m otherwise, as always");
}

void addProblemOptions(CLI::App& app, Arguments& args, const std::string& what) {
  auto* problems =
      app.add_option("--problems", args.problems, "problem file: " + what)->type_name("FILE.json");
  app.add_option("--set", args.set, "set of problems in it")->type_name("NAME")->needs(problems);
  app.add_option("--index", args.index, "number of the problem in the set")
      ->type_name("N")
      ->needs(problems);
}

void addAgainstOption(CLI::App& app, Arguments& args, const std::string& what) {
  app.add_option("--against", args.against, what)
      ->type_name("PEER")
      ->check(CLI::Validator(
          [](std::string& peer) -> std::string {
            return peer == "fcl" ? "" : "must be fcl, not " + CLI::detail::trim_copy(peer);
          },
          ""));
}

void addTrackingOptions(CLI::App& app, Arguments& args) {
  app.add_option("--tracking", args.tracking,
                 "rad or m; each joint may be off by so much at every instant, or these joints "
                 "(default 0)")
      ->type_name("E|JOINT=E,...");
  app.add_option("--controllers", args.controllers,
                 "parameters of ros2_control: tolerances are those at which its "
                 "joint_trajectory_controllers abort")
      ->type_name("FILE.yaml");
}

void addConstraintOptions(CLI::App& app, Arguments& args, bool hasFirstState) {
  app.add_option("--keep-upright", args.keepUpright,
                 "an axis of the link (x, y, z, -x, -y or -z; default z) points up, within so many "
                 "degrees (default 5), at every instant (repeatable)")
      ->type_name("LINK[:DEG[:AXIS]]")
      ->allow_extra_args(false);
  if (hasFirstState)
    app.add_option("--keep-level", args.keepLevel,
                   "what points up in the link at the first state keeps pointing up, likewise "
                   "(repeatable)")
        ->type_name("LINK[:DEG]")
        ->allow_extra_args(false);
  app.add_option("--stay-in", args.stayIn,
                 "the link's origin stays in box:X,Y,Z (full sides), sphere:R or cylinder:R,L at "
                 "this place in the model frame (repeatable)")
      ->type_name("LINK:SHAPE[@X,Y,Z[,QX,QY,QZ,QW]]")
      ->allow_extra_args(false);
  app.add_option("--stay-on", args.stayOn,
                 "the link's origin stays within M m (default 0.005) of the line through a point "
                 "in a direction, or of the plane with this normal (repeatable)")
      ->type_name("LINK:line|plane:X,Y,Z,DX,DY,DZ[:M]")
      ->allow_extra_args(false);
}

CLI::Option* addLimitsOption(CLI::App& app, Arguments& args) {
  return app
      .add_option("--limits", args.limits,
                  "MoveIt's joint_limits.yaml: limits of velocities, accelerations and jerks; "
                  "without it, velocities of the URDF")
      ->type_name("FILE.yaml");
}

void addSpeedOptions(CLI::App& app, Arguments& args, CLI::Option* user) {
  app.add_option("--max-acceleration", args.timing.maxAcceleration,
                 "rad/s^2 or m/s^2; of joints without a limit of their own")
      ->type_name("A")
      ->check(within(1e-6, 1e6, "between 1e-6 and 1e6"))
      ->needs(user);
  app.add_option("--speed", args.timing.speed,
                 "share of the full speed: limits of velocities are multiplied by S, those of "
                 "accelerations by S^2 and those of jerks by S^3, so that it is the same curve "
                 "(default 1)")
      ->type_name("S")
      ->check(within(1e-3, 1.0, "between 0.001 and 1"))
      ->needs(user);
}

void addTimingOptions(CLI::App& app, Arguments& args, CLI::Option* user) {
  addSpeedOptions(app, args, user);
  app.add_flag("--jerk-limited", args.timing.jerkLimited,
               "accelerations are continuous and keep limits of jerk, which --limits has to give")
      ->needs(user);
}

void addEmbedOption(CLI::App& app, Arguments& args) {
  app.add_flag("--embed", args.embed,
               "the .json has the robot and the world in it, so that 'swept verify' needs no other "
               "file");
}

void addSeedOption(CLI::App& app, Arguments& args) {
  app.add_option("--seed", args.seed, "of the random numbers, 1 or more (default 1)")
      ->type_name("N")
      ->check(within(1, std::numeric_limits<std::uint32_t>::max(), "between 1 and 4294967295"));
}

void addJsonOption(CLI::App& app, Arguments& args) {
  app.add_flag("--json", args.json, "one JSON object on stdout instead of text");
}

void addQuietOption(CLI::App& app, Arguments& args) {
  app.add_flag("-q,--quiet", args.quiet, "no warnings and no progress on stderr");
}

}  // namespace swept
