// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "replay/query_dump.hpp"

namespace swept {
namespace {

void addEdgesOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addCheckerOptions(app, args);
  app.add_option("--problems", args.problems, "problem file: the worlds of the motions")
      ->required()
      ->type_name("FILE.json");
  app.add_option("--edges", args.edges,
                 "the motions: set,index,from0,..,to0,..,length; .gz too; planners_demo/README.md")
      ->required()
      ->type_name("FILE.csv");
  app.add_option("--set", args.set, "only motions of this set of problems")->type_name("NAME");
  app.add_option("--limit", args.limit, "only the first N motions")
      ->type_name("N")
      ->check(within(1, std::numeric_limits<int>::max(), "1 or more"));
  app.add_option("--passes", args.passes, "each motion's time is the least of N (default 5)")
      ->type_name("N")
      ->check(within(1, 10000, "between 1 and 10000"));
  addAgainstOption(app, args,
                   "'fcl': also FCL under OMPL's discrete validator, on the same motions");
  addDumpOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kBenchEdgesCommand{
    .name = "bench edges",
    .summary = "Time per motion, over a list of motions",
    .example =
        "swept bench edges models/robots/rook7/rook7.urdf --group arm "
        "--problems models/problems.json --edges models/edges.csv",
    .exitCodes = "Exit codes: 0 measured, whatever the verdicts; 3 bad input or usage.",
    .addOptions = addEdgesOptions,
    .run = runBenchEdges};

}  // namespace swept
