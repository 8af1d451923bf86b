// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "page/pages.hpp"

namespace swept {
namespace {

void addInfoOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addRuleOptions(app, args);
  addSceneOptions(app, args);
  app.add_option("--explain", args.explained,
                 "why two links, or a link and a body of the world, are checked or not "
                 "(repeatable)")
      ->type_name("A,B")
      ->allow_extra_args(false);
  addHtmlOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kInfoCommand{
    .name = "info",
    .summary = "What is in a robot, a scene and a group",
    .example =
        "swept info models/robots/rook7/rook7.urdf --scene models/scenes/shelf.yaml --group arm",
    .exitCodes = kVerdictExitCodes,
    .addOptions = addInfoOptions,
    .run = runInfo,
    .hasClock = true};

}  // namespace swept
