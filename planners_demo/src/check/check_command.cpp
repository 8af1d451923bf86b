// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "input/clock.hpp"
#include "page/pages.hpp"
#include "replay/query_dump.hpp"

namespace swept {
namespace {

void addCheckOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addRuleOptions(app, args);
  addSceneOptions(app, args);
  addSelfFilterOption(app, args);
  addConstraintOptions(app, args);
  addStateListOption(app, args, "states to check");
  app.add_option("--time", args.clock.time,
                 "s; when the states are checked, on the clock of the objects of --scene that move")
      ->type_name("S")
      ->check(within(-kMostTime, kMostTime, "between -1e6 and 1e6 s"));
  addProblemOptions(app, args, "checks start and goals in its world");
  addDumpOption(app, args);
  addHtmlOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kCheckCommand{.name = "check",
                            .summary = "Are these states free?",
                            .example =
                                "swept check models/robots/rook7/rook7.urdf home ready --group arm "
                                "--scene models/scenes/narrow_slot.yaml",
                            .exitCodes = kVerdictExitCodes,
                            .addOptions = addCheckOptions,
                            .run = runCheck,
                            .notes = stateListNotes,
                            .takesLists = true,
                            .hasClock = true};

}  // namespace swept
