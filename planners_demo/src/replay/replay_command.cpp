// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"

namespace swept {
namespace {

void addReplayOptions(CLI::App& app, Arguments& args) {
  app.add_option("cases", args.cases,
                 "cases: pairs of shapes, states and motions of robots; planners_demo/README.md")
      ->required()
      ->type_name("FILE.json");
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kReplayCommand{
    .name = "replay",
    .summary = "Queries from files, asked again, against known answers",
    .example = "swept replay models/cases.json",
    .exitCodes = "Exit codes: 0 all passed or skipped, 1 a case failed, 3 bad input or usage.",
    .addOptions = addReplayOptions,
    .run = runReplay,
    .hasClock = true};

}  // namespace swept
