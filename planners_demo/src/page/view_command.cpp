// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/options.hpp"
#include "input/clock.hpp"
#include "page/view.hpp"

namespace swept {
namespace {

void addViewOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args);
  app.get_option("robot")->description(
      "URDF file, a .yaml of several robots, or a .json that holds robot, world and a proof: a "
      "task, a trajectory, or a path of --embed");
  addRuleOptions(app, args);
  addSceneOptions(app, args);
  addSelfFilterOption(app, args);
  app.add_option("states", args.states,
                 "states to show, or paths (.json of swept plan -o) of one robot in one world; "
                 "without: the default state")
      ->type_name("STATE|PATH.json");
  app.add_option("--time", args.clock.time,
                 "s; when the states are shown, on the clock of the objects of --scene that move "
                 "(without states: by default when the first of them begins to)")
      ->type_name("S")
      ->check(within(-kMostTime, kMostTime, "between -1e6 and 1e6 s"));
  addProblemOptions(app, args, "shows start and goals in its world");
  app.add_option("-o,--output", args.page.file,
                 "where the page goes; without: a temporary file, opened with xdg-open")
      ->type_name("FILE.html");
  addQuietOption(app, args);
}

}  // namespace

const Command kViewCommand{
    .name = "view",
    .summary = "Look at a robot, a scene, states, paths and tasks in a browser",
    .example =
        "swept view models/robots/rook7/rook7.urdf ready --group arm "
        "--scene models/scenes/shelf.yaml -o page.html",
    .exitCodes = kVerdictExitCodes,
    .addOptions = addViewOptions,
    .run = runView,
    .notes = stateNotes,
    .hasClock = true};

}  // namespace swept
