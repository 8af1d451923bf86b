// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "page/pages.hpp"

namespace swept {
namespace {

void addVerifyOptions(CLI::App& app, Arguments& args) {
  app.add_option("path", args.verify.path,
                 "path file that 'swept plan -o' has written, a task of several, or a model of "
                 "'swept cover -o' with --robot")
      ->required()
      ->type_name("PATH.json");
  app.add_option("--robot", args.verify.robot, "URDF file, if it is elsewhere by now")
      ->type_name("ROBOT.urdf");
  app.add_option("--scene", args.verify.scene, "planning scene, if it is elsewhere by now")
      ->type_name("FILE");
  app.add_flag("--files", args.verify.files,
               "compare a robot and world that are in the path file with the files they came from, "
               "too");
  addHtmlOption(app, args);
  addJsonOption(app, args);
  addVerboseOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kVerifyCommand{
    .name = "verify",
    .summary = "Check the proof in a path file, by other means than it was found",
    .example =
        "swept plan models/robots/rook7/rook7.urdf home ready --group arm "
        "--scene models/scenes/narrow_slot.yaml -o path.json && swept verify path.json",
    .exitCodes =
        "Exit codes: 0 the proof holds, 1 it does not, or something was changed, 3 bad "
        "input or usage.",
    .addOptions = addVerifyOptions,
    .run = runVerify};

}  // namespace swept
