// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"

namespace swept {
namespace {

void addLineOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addCheckerOptions(app, args);
  addSceneOptions(app, args);
  addSelfFilterOption(app, args);
  app.add_option("start", args.states, "state where the line begins")->type_name("START");
  CLI::Option* to =
      app.add_option("--to", args.toolLine.to,
                     "the tool's pose at the end, in the model frame; x, y, z alone: with the same "
                     "orientation (repeatable: one line after the other)")
          ->type_name("X,Y,Z[,QX,QY,QZ,QW]")
          ->allow_extra_args(false);
  CLI::Option* by = app.add_option("--by", args.toolLine.by,
                                   "m; how far the tool goes, without turning (repeatable)")
                        ->type_name("X,Y,Z")
                        ->allow_extra_args(false)
                        ->excludes(to);
  app.add_option("--frame", args.toolLine.frame,
                 "axes of --by: world (the model frame) or tool, at the begin of its line (default "
                 "world)")
      ->type_name("FRAME")
      ->needs(by);
  app.add_option("--link", args.goalLink,
                 "link or attached body that carries the tool (default: the group's tip)")
      ->type_name("LINK");
  app.add_option("--tool", args.toolLine.tool,
                 "the tool's frame in that link (default: the link's)")
      ->type_name("X,Y,Z[,QX,QY,QZ,QW]");
  app.add_option("--deviation", args.toolLine.deviation,
                 "mm and degrees that the tool may be off its line, at every instant (default "
                 "1,0.5; 180 and more degrees: any orientation)")
      ->type_name("MM[,DEG]");
  app.add_option(
         "-o,--output", args.output,
         "path file, by its ending: .json (with a proof for 'swept verify'), .csv, or .yaml")
      ->type_name("FILE");
  addEmbedOption(app, args);
  addTrackingOptions(app, args);
  addConstraintOptions(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kLineCommand{
    .name = "line",
    .summary = "Move a tool along straight lines, proven at every instant",
    .example =
        "swept line models/robots/rook7/rook7.urdf ready --group arm --by 0,0,-0.1 -o line.json",
    .exitCodes =
        "Exit codes: 0 all lines are proven, 1 one ends early, 2 one ends early and undecided, 3 "
        "bad input\nor usage.",
    .addOptions = addLineOptions,
    .run = runLine,
    .notes = stateNotes};

}  // namespace swept
