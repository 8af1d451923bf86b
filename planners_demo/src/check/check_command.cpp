// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
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
                            .takesLists = true};

}  // namespace swept
