// SPDX-License-Identifier: BSD-3-Clause
#include "batch/results_options.hpp"
#include "command_line/commands.hpp"
#include "command_line/options.hpp"

namespace swept {
namespace {

void addSummaryOptions(CLI::App& app, Arguments& args) {
  app.add_option("results", args.batch.files, "files of `bench planners`, with the same header")
      ->required()
      ->type_name("RESULTS.jsonl...");
  addResultFileOptions(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kBenchSummaryCommand{
    .name = "bench summary",
    .summary = "The table, log and CSV of results that `bench planners` wrote",
    .example =
        "swept bench planners models/robots/rook7/rook7.urdf --group arm --set shelf "
        "--problems models/problems.json -o results.jsonl && swept bench summary results.jsonl",
    .exitCodes = "Exit codes: 0 read, whatever the results; 3 bad input or usage.",
    .addOptions = addSummaryOptions,
    .run = runBenchSummary};

}  // namespace swept
