// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "page/pages.hpp"
#include "replay/query_dump.hpp"

namespace swept {
namespace {

void addCertifyOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  app.add_option("path", args.path,
                 "path of any planner: .csv (a line of joint names, then values), .yaml "
                 "(JointTrajectory, RobotTrajectory, DisplayTrajectory) or .json (of 'swept plan')")
      ->required()
      ->type_name("PATH");
  addCheckerOptions(app, args);
  addSceneOptions(app, args);
  addSelfFilterOption(app, args);
  addConstraintOptions(app, args);
  app.add_option("-o,--output", args.output,
                 "the path with a proof for 'swept verify', if every segment is free")
      ->type_name("FILE.json");
  addEmbedOption(app, args);
  addDumpOption(app, args);
  addHtmlOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

std::string notes() {
  return "What is proven is the straight motion from each point to the next one: of a trajectory "
         "with\nvelocities or accelerations, not the curve that a controller makes of it.\n";
}

}  // namespace

const Command kCertifyCommand{
    .name = "certify",
    .summary = "Is this path free, whoever has planned it, and the proof?",
    .example =
        "swept plan models/robots/rook7/rook7.urdf home ready --group arm "
        "--scene models/scenes/narrow_slot.yaml -o path.csv && swept certify "
        "models/robots/rook7/rook7.urdf path.csv --group arm "
        "--scene models/scenes/narrow_slot.yaml -o proof.json",
    .exitCodes =
        "Exit codes: 0 all segments are free, 1 one is in collision, 2 one is undecided, or "
        "the proof\nthat -o asks for was not found, 3 bad input or usage.",
    .addOptions = addCertifyOptions,
    .run = runCertify,
    .notes = notes};

}  // namespace swept
