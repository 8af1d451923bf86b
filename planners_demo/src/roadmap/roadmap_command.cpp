// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"

namespace swept {
namespace {

/// What says of which robot, in which world and by which rules a roadmap is.
void addCommonOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  addCheckerOptions(app, args);
  addSceneOptions(app, args);
  addConstraintOptions(app, args, false);
}

void addLastOptions(CLI::App& app, Arguments& args) {
  app.add_option("--threads", args.threads, "threads that ask about motions (default 1)")
      ->type_name("N")
      ->check(within(1, 256, "between 1 and 256"));
  addTrackingOptions(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

void addRoadmapOption(CLI::App& app, Arguments& args) {
  app.add_option("--roadmap", args.roadmap.file, "roadmap of `roadmap build` or `roadmap update`")
      ->required()
      ->type_name("FILE.json");
}

void addBuildOptions(CLI::App& app, Arguments& args) {
  addCommonOptions(app, args);
  app.add_option("--states", args.roadmap.states, "free states to sample (default 2000)")
      ->type_name("N")
      ->check(within(1, 1'000'000, "between 1 and 1000000"));
  app.add_option("--neighbours", args.roadmap.neighbours,
                 "nearest states that each is joined with (default 10)")
      ->type_name("N")
      ->check(within(1, 1000, "between 1 and 1000"));
  addSeedOption(app, args);
  app.add_option("-o,--output", args.output, "roadmap to write")
      ->required()
      ->type_name("FILE.json");
  addLastOptions(app, args);
}

void addUpdateOptions(CLI::App& app, Arguments& args) {
  addCommonOptions(app, args);
  addRoadmapOption(app, args);
  app.add_option("-o,--output", args.output, "roadmap to write, for the new world")
      ->required()
      ->type_name("FILE.json");
  addLastOptions(app, args);
}

void addQueryOptions(CLI::App& app, Arguments& args) {
  addCommonOptions(app, args);
  addSelfFilterOption(app, args);
  app.add_option("states", args.states, "start and goal")->type_name("START GOAL");
  addRoadmapOption(app, args);
  app.add_option(
         "-o,--output", args.output,
         "path file, by its ending: .json (with a proof for 'swept verify'), .csv, or .yaml")
      ->type_name("FILE");
  addEmbedOption(app, args);
  addLastOptions(app, args);
}

constexpr std::string_view kDoneExitCodes =
    "Exit codes: 0 the roadmap is written, 3 bad input or usage.";

}  // namespace

const Command kRoadmapBuildCommand{
    .name = "roadmap build",
    .summary = "A roadmap of proven motions, for many queries",
    .example =
        "swept roadmap build models/robots/rook7/rook7.urdf --group arm "
        "--scene models/scenes/narrow_slot.yaml --states 500 -o roadmap.json",
    .exitCodes = kDoneExitCodes,
    .addOptions = addBuildOptions,
    .run = runRoadmapBuild};

const Command kRoadmapUpdateCommand{
    .name = "roadmap update",
    .summary = "The roadmap in another world: only what the change can reach is proven anew",
    .example =
        "swept roadmap build models/robots/rook7/rook7.urdf --group arm --states 500 "
        "-o roadmap.json && swept roadmap update models/robots/rook7/rook7.urdf --group arm "
        "--roadmap roadmap.json --scene models/scenes/narrow_slot.yaml -o updated.json",
    .exitCodes = kDoneExitCodes,
    .addOptions = addUpdateOptions,
    .run = runRoadmapUpdate};

const Command kRoadmapQueryCommand{
    .name = "roadmap query",
    .summary = "A path on a roadmap, with its proof",
    .example =
        "swept roadmap build models/robots/rook7/rook7.urdf --group arm "
        "--scene models/scenes/narrow_slot.yaml --states 500 -o roadmap.json && swept roadmap "
        "query models/robots/rook7/rook7.urdf home ready --group arm --roadmap roadmap.json "
        "--scene models/scenes/narrow_slot.yaml -o path.json",
    .exitCodes =
        "Exit codes: 0 a path is found, 1 none is, 2 one is not proven anew, 3 bad input or "
        "usage.",
    .addOptions = addQueryOptions,
    .run = runRoadmapQuery,
    .notes = stateNotes};

}  // namespace swept
