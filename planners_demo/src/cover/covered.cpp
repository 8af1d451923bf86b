// SPDX-License-Identifier: BSD-3-Clause
#include "cover/covered.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <utility>

#include "command_line/exit_code.hpp"
#include "input/load_options.hpp"
#include "io/input_source.hpp"
#include "io/yaml.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

Covered coveredRobot(const Arguments& args, bool visual, Warnings& warnings) {
  Model model = loadModel(args, warnings);
  Covered covered{.model = model,
                  .robot = model.robot,
                  .world = nullptr,
                  .bodies = {},
                  .name = {},
                  .urdf = *model.urdf,
                  .srdf = model.srdf.file,
                  .options = model.options};
  if (visual) {
    const std::string text = urdfWithVisualsAsCollision(covered.urdf.text, covered.urdf.name);
    covered.robot = Robot::parse(text, covered.urdf.name, {}, {}, covered.options);
  }
  return covered;
}

Covered coveredMesh(const Arguments& args, const LoadOptions& options) {
  const std::filesystem::path file = std::filesystem::absolute(args.robot);
  readTextFile(file);  // for its message, with the name as given
  const ExpandedText urdf{urdfOfMesh(file), args.robot};
  return {.model = {},
          .robot = Robot::parse(urdf.text, urdf.name, {}, {}, options),
          .world = nullptr,
          .bodies = {},
          .name = {},
          .urdf = urdf,
          .srdf = {},
          .options = options};
}

Covered coveredScene(const Arguments& args, const LoadOptions& options) {
  const auto world = std::make_shared<const World>(World::load(args.robot, options));
  return {.model = {},
          .robot = nullptr,
          .world = world,
          .bodies = bodiesOf(*world),
          .name = std::filesystem::path(args.robot).stem().string(),
          .urdf = {},
          .srdf = {},
          .options = options};
}

}  // namespace

std::string endingInLowerCase(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool isMesh(const std::string& file) {
  constexpr std::array kMeshes{".stl", ".obj", ".ply", ".dae", ".off", ".gltf", ".glb"};
  return std::ranges::find(kMeshes, endingInLowerCase(file)) != kMeshes.end();
}

bool isScene(const std::string& file) {
  const std::string ending = std::filesystem::path(file).extension().string();
  if (ending == ".scene") return true;
  if (ending != ".yaml" && ending != ".yml") return false;
  const detail::InputSource source(file, {});
  const detail::YamlPlace root = detail::YamlPlace::parse(readTextFile(file), source);
  return root.isMap() && !root.at("robots").present() &&
         (root.at("world").present() || root.at("collision_objects").present());
}

Covered loadCovered(const Arguments& args, bool visual, Warnings& warnings) {
  const bool mesh = isMesh(args.robot);
  const bool scene = !mesh && isScene(args.robot);
  if (visual && (mesh || scene))
    throw UsageError("--visual is for a robot; '" + args.robot + "' is a " +
                     (mesh ? "mesh" : "scene"));
  if (scene) {
    if (!args.srdf.empty() || args.xacro)
      throw UsageError(std::string(args.xacro ? "--xacro" : "--srdf") + " is for a robot; '" +
                       args.robot + "' is a scene");
    return coveredScene(args, loadOptionsOf(args, warnings));
  }
  Covered covered = mesh ? coveredMesh(args, loadOptionsOf(args, warnings))
                         : coveredRobot(args, visual, warnings);
  covered.bodies = bodiesOf(*covered.robot);
  covered.name = covered.robot->name();
  return covered;
}

}  // namespace swept
