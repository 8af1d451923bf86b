// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "command_line/commands.hpp"
#include "command_line/options.hpp"

namespace swept {
namespace {

const int kMost = std::numeric_limits<int>::max();

void addWorldOptions(CLI::App& app, Arguments& args) {
  addSceneOptions(app, args);
  auto* problems =
      app.add_option("--problems", args.problems, "problem file: its worlds, instead of --scene")
          ->type_name("FILE.json");
  app.add_option("--set", args.set, "only worlds of this set of problems")
      ->type_name("NAME")
      ->needs(problems);
  app.add_option("--every", args.report.every, "only each Nth of these problems, from the first on")
      ->type_name("N")
      ->needs(problems)
      ->check(within(1, kMost, "1 or more"));
  app.add_option("--limit", args.limit, "only the first N of what is left")
      ->type_name("N")
      ->needs(problems)
      ->check(within(1, kMost, "1 or more"));
}

void addMeasureOptions(CLI::App& app, Arguments& args) {
  app.add_option("--motions", args.report.motions,
                 "random motions between valid states, over all worlds, and a planned path for "
                 "each 20 of them "
                 "(default 1000)")
      ->type_name("N")
      ->check(within(1, 10'000'000, "between 1 and 1e7"));
  addSeedOption(app, args);
  app.add_option("--resolutions", args.report.resolutions,
                 "of discrete checks: steps of at most this share of the space's extent, of which "
                 "OMPL's default is 0.01 (default 0.2,0.1,0.05,0.02,0.01,0.005)")
      ->type_name("R,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(within(1e-6, 0.5, "between 1e-6 and 0.5"));
  app.add_option("--tolerances", args.report.tolerances,
                 "m; of certified checks (default 0.1,0.03,0.01,0.003,0.001,0.0001)")
      ->type_name("M,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(within(1e-6, 1.0, "between 1e-6 and 1 m"));
  addAgainstOption(app, args, "'fcl': also discrete checks of states by FCL");
  app.add_option("--passes", args.passes, "a time is the least of N (default 5)")
      ->type_name("N")
      ->check(within(1, 10000, "between 1 and 10000"));
}

void addReportOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addRuleOptions(app, args);
  addWorldOptions(app, args);
  addMeasureOptions(app, args);
  app.add_option("-o,--output", args.output,
                 "the motions, and which methods miss or refuse them: for 'swept motion'")
      ->type_name("FILE.csv");
  app.add_option("--csv", args.report.csv, "a row per part, method and setting")
      ->type_name("FILE.csv");
  app.add_option("--svg", args.report.svg, "pictures: PREFIX-missed.svg, ...")->type_name("PREFIX");
  app.add_option("--html", args.report.html,
                 "a page with pictures and tables, one file for any browser, without network")
      ->type_name("FILE.html");
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kReportCommand{
    .name = "report",
    .summary = "What checks of motions miss, and what they take: error against time",
    .example =
        "swept report models/robots/rook7/rook7.urdf --group arm --scene models/scenes/shelf.yaml "
        "--motions 200 --passes 1 --html report.html",
    .exitCodes =
        "Exit codes: 0 measured, whatever came of it; 3 bad input or usage; 130 stopped by SIGINT "
        "or SIGTERM,\nnothing written.",
    .addOptions = addReportOptions,
    .run = runReport};

}  // namespace swept
