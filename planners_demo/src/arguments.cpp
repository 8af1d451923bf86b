// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <cctype>
#include <cmath>
#include <iostream>
#include <limits>

#include "exit_code.hpp"
#include "planners.hpp"

namespace swept {
namespace {

constexpr std::string_view kExitCodes =
    "Exit codes: 0 free or solved, 1 collision or not solved, 2 undecided, 3 bad input or usage.";

constexpr std::string_view kReplayExitCodes =
    "Exit codes: 0 all passed or skipped, 1 a case failed, 3 bad input or usage.";

constexpr std::string_view kBenchExitCodes =
    "Exit codes: 0 measured, whatever the verdicts; 3 bad input or usage.";

constexpr std::string_view kAcmExitCodes =
    "Exit codes: 0 the SRDF disables no pair that may collide, 1 it disables one, 2 it disables "
    "one\n"
    "for which that is not known, 3 bad input or usage.";

constexpr std::string_view kStates =
    "States are names from the SRDF or comma-separated values (rad, m) in the order of the "
    "group's\n"
    "variables, such as 0.1,-0.5,0,-1.2,0,1.5,0.7.";

/// `-0.1,0.2` and `-inf` are values, not options.
bool isNegativeValue(const std::string& text) {
  if (text.size() < 2 || text[0] != '-') return false;
  return std::isdigit(static_cast<unsigned char>(text[1])) || text[1] == '.' ||
         text.starts_with("-inf") || text.starts_with("-nan");
}

/// The arguments, last first, as the parser wants them. A leading blank keeps it from taking a
/// negative value for an option, and everything that reads a value skips blanks. That leaves
/// nothing for a `--` to do, which the parser would turn against options that are limited in
/// number.
std::vector<std::string> reversedArguments(int argc, const char* const* argv) {
  std::vector<std::string> reversed;
  for (int i = argc - 1; i > 0; --i) {
    const std::string text = argv[i];
    if (text == "--") continue;
    reversed.push_back(isNegativeValue(text) ? " " + text : text);
  }
  return reversed;
}

CLI::Validator within(double low, double high, const std::string& what) {
  return CLI::Validator(
      [=](std::string& text) -> std::string {
        double value = 0.0;
        if (CLI::detail::lexical_cast(text, value) && value >= low && value <= high) return {};
        return "must be " + what + ", not " + CLI::detail::trim_copy(text);
      },
      "");
}

void addModelOptions(CLI::App& app, Arguments& args) {
  app.add_option("robot", args.robot, "URDF file")->required()->type_name("ROBOT.urdf");
  app.add_option("--srdf", args.srdf,
                 "SRDF file; without: a .srdf beside the URDF with the same stem, if there is one; "
                 "'none': no SRDF")
      ->type_name("FILE");
  app.add_option("--group", args.group, "planning group; not needed when there is only one")
      ->type_name("NAME");
  app.add_option("--package", args.packages, "folder of package://NAME/... (repeatable)")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false);
  app.add_option("--margin", args.margin, "m; free means: more than this apart (default 0)")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
  app.add_option("--pad", args.pads,
                 "a link or body of the world reaches so many m farther; in names * stands for any "
                 "characters (repeatable)")
      ->type_name("NAME=M")
      ->allow_extra_args(false);
  app.add_option("--scale", args.scales,
                 "a link or body of the world is so many times as large (repeatable)")
      ->type_name("NAME=FACTOR")
      ->allow_extra_args(false);
  app.add_option("--allow", args.allowed,
                 "two links, or a link and a body of the world, may collide (repeatable)")
      ->type_name("A,B")
      ->allow_extra_args(false);
  app.add_option("--tolerance", args.tolerance,
                 "m; motions that keep more than margin + tolerance are decided (default 0.001)")
      ->type_name("M")
      ->check(within(1e-6, 1.0, "between 1e-6 and 1 m"));
  app.add_flag("--json", args.json, "one JSON object on stdout instead of text");
  app.add_flag("-q,--quiet", args.quiet, "no warnings and no progress on stderr");
}

void addSceneOption(CLI::App& app, Arguments& args) {
  app.add_option("--scene", args.scene, "planning scene: .yaml, .yml or .scene")->type_name("FILE");
  app.add_option(
         "--cloud", args.clouds,
         "sensed points (.pcd, .ply, .xyz) or an OctoMap (.bt, .ot), a body named after its "
         "file (repeatable)")
      ->type_name("FILE")
      ->allow_extra_args(false);
  app.add_option("--point-radius", args.pointRadius,
                 "m; each point of a cloud stands for a ball of this radius")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
  app.add_option("--cloud-pose", args.cloudPose, "of the clouds' frame in the model frame")
      ->type_name("X,Y,Z,QX,QY,QZ,QW");
  app.add_option("--occluded", args.occluded,
                 "m; what points hide from a sensor at the origin of their frame is occupied, too, "
                 "up to so far from it; needs a radius above zero")
      ->type_name("RANGE")
      ->check(within(1e-3, 1e3, "between 0.001 and 1000 m"));
  app.add_option("--self-filter", args.selfFilter,
                 "m; points this near to the robot in the first state are the robot itself")
      ->type_name("M")
      ->check(within(0.0, 10.0, "between 0 and 10 m"));
}

void addProblemOptions(CLI::App& app, Arguments& args, const std::string& what) {
  auto* problems =
      app.add_option("--problems", args.problems, "problem file: " + what)->type_name("FILE.json");
  app.add_option("--set", args.set, "set of problems in it")->type_name("NAME")->needs(problems);
  app.add_option("--index", args.index, "number of the problem in the set")
      ->type_name("N")
      ->needs(problems);
}

void addPlanOptions(CLI::App& app, Arguments& args) {
  app.add_option("--planner", args.planner, "OMPL planner (default RRTConnect); names below")
      ->type_name("NAME");
  app.add_option("--time", args.time, "s; limit of the planner, per problem (default 5)")
      ->type_name("S")
      ->check(within(1e-3, 1e6, "between 0.001 and 1e6 s"));
  app.add_option("--seed", args.seed, "of the random numbers, 1 or more (default 1)")
      ->type_name("N")
      ->check(within(1, std::numeric_limits<std::uint32_t>::max(), "between 1 and 4294967295"));
  app.add_option("-o,--output", args.output,
                 "path file, by its ending: .json (with certificates), .csv, or .yaml "
                 "(RobotTrajectory without time stamps)")
      ->type_name("FILE");
  app.add_flag("--no-simplify", args.noSimplify, "keep the path as the planner returned it");
  app.add_option("--jobs", args.jobs,
                 "problems planned at the same time, one thread each (default 1; with more, random "
                 "numbers depend on timing)")
      ->type_name("N")
      ->check(within(1, 1024, "between 1 and 1024"));
  app.add_flag("-v,--verbose", args.verbose, "OMPL's messages on stderr");
}

void addBenchOptions(CLI::App& app, Arguments& args) {
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
  app.add_option("--against", args.against,
                 "'fcl': also FCL under OMPL's discrete validator, on the same motions")
      ->type_name("PEER")
      ->check(CLI::Validator(
          [](std::string& peer) -> std::string {
            return peer == "fcl" ? "" : "must be fcl, not " + CLI::detail::trim_copy(peer);
          },
          ""));
}

void addAcmOptions(CLI::App& app, Arguments& args) {
  app.add_option("robot", args.robot, "URDF file")->required()->type_name("ROBOT.urdf");
  app.add_option("--srdf", args.srdf,
                 "SRDF file to compare with, and to keep all but the disabled pairs of; without: a "
                 ".srdf beside the URDF with the same stem, if there is one; 'none': no SRDF")
      ->type_name("FILE");
  app.add_option("-o,--output", args.output, "SRDF to write; may be the one that was read")
      ->type_name("FILE");
  app.add_option("--package", args.packages, "folder of package://NAME/... (repeatable)")
      ->type_name("NAME=DIR")
      ->allow_extra_args(false);
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
  app.add_option("--seed", args.seed, "of the random numbers, 1 or more (default 1)")
      ->type_name("N")
      ->check(within(1, std::numeric_limits<std::uint32_t>::max(), "between 1 and 4294967295"));
  app.add_flag("--json", args.json, "one JSON object on stdout instead of text");
  app.add_flag("-q,--quiet", args.quiet, "no warnings and no progress on stderr");
}

/// Each runs from the folder that holds `models`.
std::string_view exampleOf(std::string_view command) {
  if (command == "info")
    return "swept info models/robots/rook7/rook7.urdf --scene models/scenes/shelf.yaml --group arm";
  if (command == "check")
    return "swept check models/robots/rook7/rook7.urdf home ready --group arm "
           "--scene models/scenes/narrow_slot.yaml";
  if (command == "motion")
    return "swept motion models/robots/rook7/rook7.urdf home ready --group arm "
           "--scene models/scenes/narrow_slot.yaml";
  if (command == "acm") return "swept acm models/robots/rook7/rook7.urdf -o rook7.srdf";
  if (command == "replay") return "swept replay models/cases.json";
  if (command == "edges")
    return "swept bench edges models/robots/rook7/rook7.urdf --group arm "
           "--problems models/problems.json --edges models/edges.csv";
  return "swept plan models/robots/rook7/rook7.urdf home ready --group arm "
         "--scene models/scenes/narrow_slot.yaml -o path.json";
}

std::string footer(std::string_view command) {
  std::string text = "\nExample:\n  " + std::string(exampleOf(command)) + "\n";
  if (command == "acm") return text + "\n" + std::string(kAcmExitCodes);
  if (command == "replay") return text + "\n" + std::string(kReplayExitCodes);
  if (command == "edges") return text + "\n" + std::string(kBenchExitCodes);
  if (command != "info") text = "\n" + std::string(kStates) + "\n" + text;
  if (command == "plan") {
    text += "\nPlanners:";
    std::size_t column = 80;
    for (const std::string& name : plannerNames()) {
      if (column + name.size() + 1 > 80) {
        text += "\n ";
        column = 1;
      }
      text += " " + name;
      column += name.size() + 1;
    }
    text += "\n";
  }
  return text + "\n" + std::string(kExitCodes);
}

/// The parser misses a subcommand before it says that it does not know the one given.
std::string messageOf(const CLI::ParseError& error, int argc, const char* const* argv) {
  const bool noSubcommand = argc > 1 && std::string_view(error.what()).starts_with("A subcommand");
  if (!noSubcommand) return error.what();
  if (std::string_view(argv[1]) == "bench")
    return argc > 2 ? std::string("bench has no subcommand '") + argv[2] + "'; there is edges"
                    : "bench: a subcommand is required; there is edges";
  return std::string("no subcommand '") + argv[1] +
         "'; there are info, check, motion, plan, acm, replay, bench";
}

}  // namespace

ParsedArguments parseArguments(int argc, const char* const* argv) {
  Arguments args;
  CLI::App app{"Validity of robot states and of whole motions, proven on the exact geometry.",
               "swept"};
  app.require_subcommand(1);
  app.set_version_flag("--version", "swept " SWEPT_VERSION);
  app.footer(std::string("\n").append(kExitCodes));

  auto* info = app.add_subcommand("info", "What is in a robot, a scene and a group");
  auto* check = app.add_subcommand("check", "Are these states free?");
  auto* motion =
      app.add_subcommand("motion", "Are the straight motions between these states free?");
  auto* plan = app.add_subcommand("plan", "Find a path whose every motion is proven free");
  auto* bench = app.add_subcommand("bench", "How long checks take on this machine");
  bench->require_subcommand(1);
  auto* edges = bench->add_subcommand("edges", "Time per motion, over a list of motions");
  for (CLI::App* sub : {info, check, motion, plan, edges}) addModelOptions(*sub, args);
  for (CLI::App* sub : {info, check, motion, plan}) addSceneOption(*sub, args);
  info->add_option("--explain", args.explained,
                   "why two links, or a link and a body of the world, are checked or not "
                   "(repeatable; needs --group)")
      ->type_name("A,B")
      ->allow_extra_args(false);
  check->add_option("states", args.states, "states to check")->type_name("STATE");
  motion->add_option("states", args.states, "two states or more")->type_name("STATE");
  plan->add_option("states", args.states, "start and goal")
      ->type_name("START GOAL")
      ->expected(0, 2);
  addProblemOptions(*check, args, "checks start and goals in its world");
  addProblemOptions(*motion, args, "the motion from start to goal in its world");
  addProblemOptions(*plan, args, "plans from start to goals; without --set or --index all of them");
  addPlanOptions(*plan, args);
  addBenchOptions(*edges, args);
  auto* acm = app.add_subcommand(
      "acm", "Which pairs of links can never collide: the SRDF's disabled pairs");
  addAcmOptions(*acm, args);
  auto* replay = app.add_subcommand("replay", "Distances of shape pairs against known answers");
  replay->add_option("cases", args.cases, "cases of two shapes each; planners_demo/README.md")
      ->required()
      ->type_name("FILE.json");
  replay->add_flag("--json", args.json, "one JSON object on stdout instead of text");
  for (CLI::App* sub : {info, check, motion, plan, acm, replay, edges})
    sub->footer(footer(sub->get_name()));

  try {
    app.parse(reversedArguments(argc, argv));
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return {.run = {}, .exitCode = app.exit(error)};
    std::cerr << "swept: error: " << messageOf(error, argc, argv) << " (try --help)\n";
    return {.run = {}, .exitCode = static_cast<int>(ExitCode::BadInput)};
  }
  args.command = app.get_subcommands().front()->get_name();
  if (args.command == "bench") args.command += " " + bench->get_subcommands().front()->get_name();
  return {.run = std::move(args), .exitCode = 0};
}

}  // namespace swept
