// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "batch/results_options.hpp"
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "replay/query_dump.hpp"

namespace swept {
namespace {

void addRunOptions(CLI::App& app, Arguments& args) {
  const int most = std::numeric_limits<int>::max();
  app.add_option("--problems", args.problems, "problem file")->required()->type_name("FILE.json");
  app.add_option("--set", args.set, "only problems of this set")->type_name("NAME");
  app.add_option("--limit", args.limit, "only the first N problems")
      ->type_name("N")
      ->check(within(1, most, "1 or more"));
  app.add_option("--planners", args.batch.planners, "OMPL planners (default RRTConnect)")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--validators", args.batch.validators,
                 "what says during planning which motions are valid: certified, discrete:R, fcl:R; "
                 "R is the step, as a share of the space's extent (default certified)")
      ->type_name("NAME,...")
      ->delimiter(',')
      ->allow_extra_args(false);
  app.add_option("--runs", args.batch.runs,
                 "of each planner and validator on each problem (default 1)")
      ->type_name("N")
      ->check(within(1, 1'000'000, "between 1 and 1000000"));
  app.add_option("--seed", args.seed, "of the first run, the next ones count up (default 1)")
      ->type_name("N")
      ->check(within(1, std::numeric_limits<std::uint32_t>::max(), "between 1 and 4294967295"));
  app.add_option("--time", args.time, "s; limit of the planner, per run (default 5)")
      ->type_name("S")
      ->check(within(1e-3, 1e6, "between 0.001 and 1e6 s"));
  app.add_option("--hard-limit", args.batch.hardLimit,
                 "s; a run that takes longer in all is stopped (default 30 + 5 x --time)")
      ->type_name("S")
      ->check(within(1e-3, 1e7, "between 0.001 and 1e7 s"));
  app.add_flag("--no-simplify", args.noSimplify, "keep paths as planners returned them");
  app.add_option("--jobs", args.jobs, "runs at the same time, each in its process (default 1)")
      ->type_name("N")
      ->check(within(1, 1024, "between 1 and 1024"));
}

void addOutputOptions(CLI::App& app, Arguments& args) {
  app.add_option("-o,--output", args.output,
                 "results, a JSON line per run; runs that are there are not repeated")
      ->type_name("FILE.jsonl");
  app.add_flag("--no-times", args.batch.noTimes,
               "no times in results, so that they can be compared");
  app.add_flag("--no-clearance", args.batch.noClearance,
               "do not bound the clearance of certified paths, which takes most of their time");
  app.add_flag("--states", args.batch.states, "the states of paths in results");
  app.add_flag("--list", args.batch.list, "print the runs as JSON lines, run nothing");
  app.add_flag("--stdin", args.batch.fromStdin,
               "the runs are such lines on stdin; results go to stdout as they come");
  addDumpOption(app, args);
  addResultFileOptions(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

void addPlannersOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addCheckerOptions(app, args);
  addRunOptions(app, args);
  addOutputOptions(app, args);
}

}  // namespace

const Command kBenchPlannersCommand{
    .name = "bench planners",
    .summary = "Many problems, planners, validators and seeds; every path certified",
    .example =
        "swept bench planners models/robots/rook7/rook7.urdf --group arm --set shelf "
        "--problems models/problems.json --validators certified,discrete:0.05 -o results.jsonl",
    .exitCodes =
        "Exit codes: 0 all runs done, whatever came of them; 3 bad input or usage; 130 stopped by "
        "SIGINT or SIGTERM.",
    .addOptions = addPlannersOptions,
    .run = runBenchPlanners};

}  // namespace swept
