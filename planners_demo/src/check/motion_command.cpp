// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "page/pages.hpp"
#include "replay/query_dump.hpp"

namespace swept {
namespace {

void addMotionOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addCheckerOptions(app, args);
  addSceneOptions(app, args);
  addSelfFilterOption(app, args);
  addConstraintOptions(app, args);
  addStateListOption(app, args, "two states or more");
  app.add_option("--times", args.clock.times,
                 "s; when the robot is at each of the states, on the clock of the objects of "
                 "--scene that move")
      ->type_name("T,T,...");
  addProblemOptions(app, args, "the motion from start to goal in its world");
  addDumpOption(app, args);
  addHtmlOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kMotionCommand{
    .name = "motion",
    .summary = "Are the straight motions between these states free?",
    .example =
        "swept motion models/robots/rook7/rook7.urdf home ready --group arm "
        "--scene models/scenes/narrow_slot.yaml",
    .exitCodes = kVerdictExitCodes,
    .addOptions = addMotionOptions,
    .run = runMotion,
    .notes = stateListNotes,
    .takesLists = true,
    .hasClock = true};

}  // namespace swept
