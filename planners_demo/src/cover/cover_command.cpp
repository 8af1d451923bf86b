// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "page/pages.hpp"

namespace swept {
namespace {

void addCoverOptions(CLI::App& app, Arguments& args) {
  addRobotOptions(app, args, " whose groups and pairs a written SRDF keeps");
  CLI::Option* spheres =
      app.add_option(
             "--spheres", args.cover.spheres,
             "of all links together, divided so that the largest excess is small; with --shape "
             "of any of them")
          ->type_name("N")
          ->check(within(1, 100000, "between 1 and 100000"));
  CLI::Option* shape = app.add_option("--shape", args.cover.shape, "what the model consists of")
                           ->check(CLI::IsMember({"sphere", "capsule", "box", "convex"}))
                           ->capture_default_str();
  CLI::Option* excess =
      app.add_option("--excess", args.cover.excess,
                     "m; as many shapes as are needed so that none reaches farther beyond its link")
          ->type_name("M")
          ->check(within(1e-4, 10.0, "between 0.0001 and 10 m"))
          ->excludes(spheres);
  CLI::Option* check =
      app.add_option(
             "--check", args.cover.check,
             "judges the model in this file instead: .json of this command or for VAMP, "
             ".yaml of cuRobo, .xrdf, .srdf of MoveIt, or a .urdf; of a scene: .json or a scene")
          ->type_name("FILE")
          ->excludes(spheres)
          ->excludes(excess)
          ->excludes(shape);
  app.add_option("-o,--output", args.output,
                 "file to write: .urdf with the shapes for <collision> (VAMP takes spheres), .yaml "
                 "of cuRobo, .xrdf, .srdf of MoveIt, or .json with the figures; of a scene: .yaml, "
                 ".scene or .json")
      ->type_name("FILE")
      ->excludes(check);
  app.add_option(
         "--format", args.cover.format,
         "of FILE, whatever it ends in; vamp: the .json for VAMP's generator, with its URDF "
         "beside it; of a scene: scene or json")
      ->check(CLI::IsMember({"urdf", "vamp", "curobo", "xrdf", "srdf", "json", "scene"}))
      ->excludes(check);
  app.add_flag("--visual", args.cover.visual, "around the <visual> geometry, not <collision>");
  addHtmlOption(app, args);
  addSeedOption(app, args);
  addJsonOption(app, args);
  addQuietOption(app, args);
}

}  // namespace

const Command kCoverCommand{
    .name = "cover",
    .summary = "Spheres that contain a robot's links, with proof, or what others leave outside",
    .example = "swept cover models/robots/rook7/rook7.urdf --spheres 40 -o rook7_spheres.urdf",
    .exitCodes =
        "Exit codes: 0 the shapes contain all links, 1 with --check: some link is partly "
        "outside,\n2 with --check: that is not known, 3 bad input or usage.",
    .addOptions = addCoverOptions,
    .run = runCover,
    .notes = [] {
      return std::string(
          "ROBOT may also be a mesh (.stl, .obj, .ply, .dae, .off, .gltf, .glb), in "
          "metres: the only link of a robot.\nOr a planning scene (.yaml, .scene): its bodies "
          "take the place of links.\n");
    }};

}  // namespace swept
