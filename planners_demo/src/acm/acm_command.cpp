// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"

namespace swept {
namespace {

void addAcmOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args, " to compare with, and to keep all but the disabled pairs of");
  app.add_option("-o,--output", args.output, "SRDF to write; may be the one that was read")
      ->type_name("FILE");
  app.add_option("--margin", args.margin, "m; contact means: at most this apart (default 0)")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
  app.add_option("--budget", args.budget,
                 "work per pair of links, in distances between balls; one on exact geometry counts "
                 "as 100 (default 20000000, a few seconds)")
      ->type_name("N")
      ->check(within(0, 1e15, "between 0 and 1e15"));
  app.add_option("--samples", args.samples,
                 "random configurations per pair of links (default 1000)")
      ->type_name("N")
      ->check(within(0, 1e9, "between 0 and 1e9"));
  app.add_option("--time", args.acmTime,
                 "s; pairs that are open then are unknown (default 20 below 40 links, else no "
                 "limit: how far it gets in the time depends on the machine)")
      ->type_name("S")
      ->check(within(1e-3, 1e6, "between 0.001 and 1e6 s"));
  addSeedOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kAcmCommand{
    .name = "acm",
    .summary = "Which pairs of links can never collide: the SRDF's disabled pairs",
    .example = "swept acm models/robots/rook7/rook7.urdf -o rook7.srdf",
    .exitCodes =
        "Exit codes: 0 the SRDF disables no pair that may collide, 1 it disables one, 2 it "
        "disables "
        "one\nfor which that is not known, 3 bad input or usage.",
    .addOptions = addAcmOptions,
    .run = runAcm};

}  // namespace swept
