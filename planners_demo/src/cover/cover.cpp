// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "command_line/commands.hpp"
#include "cover/cover_output.hpp"
#include "cover/covered.hpp"
#include "output/progress.hpp"
#include "output/whole_file.hpp"
#include "page/pages.hpp"
#include "swept/robot_model/scene_model.hpp"
#include "swept/robot_model/shape_model.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

/// `urdf`, `vamp`, ...: as asked for, or by the ending of the file; empty: of no known one.
std::string formatOf(const Arguments& args, bool scene) {
  if (!args.cover.format.empty()) return args.cover.format;
  const std::string ending = endingInLowerCase(args.output);
  if (ending == ".yaml" || ending == ".yml") return scene ? "scene" : "curobo";
  if (ending == ".json") return "json";
  if (scene) return ending == ".scene" ? "scene" : "";
  for (const std::string known : {"urdf", "xrdf", "srdf"})
    if (ending == "." + known) return known;
  return {};
}

EnclosingKind kindOf(const std::string& shape) {
  if (shape == "capsule") return EnclosingKind::Capsule;
  return shape == "box" ? EnclosingKind::Box : EnclosingKind::Convex;
}

/// Beside the output, with its stem: `panda` for `panda.json`.
std::filesystem::path besideOutput(const Arguments& args, const std::string& end) {
  const std::filesystem::path output = args.output;
  return output.parent_path() / (output.stem().string() + end);
}

void writeUrdf(const Covered& covered, const ShapeModel& model, const std::filesystem::path& file) {
  const std::string folder = file.stem().string() + "_meshes";
  const ShapedUrdf shaped =
      urdfWithShapes(model, covered.urdf.text, covered.urdf.name, folder + "/");
  if (!shaped.meshes.empty()) {
    std::error_code error;
    std::filesystem::create_directories(file.parent_path() / folder, error);
    if (error)
      throw UsageError("cannot make the folder '" + (file.parent_path() / folder).string() +
                       "': " + error.message());
  }
  for (const auto& [name, text] : shaped.meshes) writeWholeFile(file.parent_path() / name, text);
  writeWholeFile(file, shaped.text);
}

void writeSceneModel(const Arguments& args, const Covered& covered, const ShapeModel& model,
                     const std::vector<LinkSphereReport>& reports) {
  const std::string& name = covered.name;
  if (formatOf(args, true) == "json")
    return writeWholeFile(args.output, sceneModelJson(model, name, reports));
  writeWholeFile(args.output, endingInLowerCase(args.output) == ".scene"
                                  ? sceneModelText(model, *covered.world, name)
                                  : sceneModelYaml(model, *covered.world, name));
}

void writeModel(const Arguments& args, const Covered& covered, const ShapeModel& model,
                const std::vector<LinkSphereReport>& reports) {
  if (covered.world) return writeSceneModel(args, covered, model, reports);
  const std::string format = formatOf(args, false);
  const std::string& name = covered.name;
  const std::string srdf = covered.srdf.empty() ? "" : readTextFile(covered.srdf);
  if (format == "urdf") return writeUrdf(covered, model, args.output);
  // All other formats but JSON have spheres alone.
  const std::optional<SphereModel> spheres = sphereModelOf(model);
  if (format == "json")
    return writeWholeFile(args.output, spheres ? sphereModelJson(*spheres, name, reports)
                                               : shapeModelJson(model, name, reports));
  if (format == "xrdf") return writeWholeFile(args.output, xrdfSpheres(*spheres));
  if (format == "curobo") return writeWholeFile(args.output, curoboSpheres(*spheres, name));
  if (format == "srdf")
    return writeWholeFile(args.output, sphereApproximationSrdf(*spheres, name, srdf, covered.srdf));
  const std::filesystem::path urdf = besideOutput(args, "_spherized.urdf");
  writeUrdf(covered, model, urdf);
  const std::string srdfPath =
      covered.srdf.empty() ? "" : std::filesystem::absolute(covered.srdf).string();
  writeWholeFile(args.output,
                 vampConfiguration(*covered.robot, urdf.filename().string(), srdfPath));
}

ExitCode judgement(const std::vector<LinkSphereReport>& reports) {
  ExitCode code = ExitCode::Free;
  for (const LinkSphereReport& report : reports) {
    if (report.outside.lower > 0.0) code = worse(code, ExitCode::Collision);
    if (report.outside.upper > 0.0) code = worse(code, ExitCode::Undecided);
  }
  return code;
}

constexpr const char* kRobotEndings = ".urdf, .yaml, .yml (cuRobo), .xrdf, .srdf, .json";
constexpr const char* kSceneEndings = ".yaml, .yml, .scene, .json";

void requireOutput(const Arguments& args, bool scene) {
  if (args.output.empty()) {
    if (!args.cover.format.empty()) throw UsageError("--format needs -o FILE");
    return;
  }
  const std::string format = formatOf(args, scene);
  if (format.empty())
    throw UsageError("-o '" + args.output + "' ends in '" + endingInLowerCase(args.output) +
                     "'; allowed" + (scene ? " for a scene: " : ": ") +
                     (scene ? kSceneEndings : kRobotEndings) + ", or any with --format");
  if (scene && format != "scene" && format != "json")
    throw UsageError("the format " + format + " is for a robot; '" + args.robot +
                     "' is a scene, which goes to scene or json");
  if (!scene && format == "scene")
    throw UsageError("the format scene is for the bodies of a scene; '" + args.robot + "' is none");
  if (args.cover.shape != "sphere" && format != "urdf" && format != "json" && format != "scene")
    throw UsageError("the format " + format + " has spheres alone; --shape " + args.cover.shape +
                     " goes to urdf or json");
  requireWritable(args.output);
  if (format == "vamp") requireWritable(besideOutput(args, "_spherized.urdf"));
}

/// Whether it is a scene.
bool requireUsable(const Arguments& args) {
  if (!args.cover.spheres && !args.cover.excess && args.cover.check.empty())
    throw UsageError("cover needs --spheres N, --excess M or --check FILE");
  requirePageFile(args);
  const bool mesh = isMesh(args.robot);
  const bool scene = !mesh && isScene(args.robot);
  if (!args.page.file.empty() && (mesh || scene))
    throw UsageError("--html is for a robot; '" + args.robot + "' is a " +
                     (mesh ? "mesh" : "scene"));
  requireOutput(args, scene);
  return scene;
}

ShapeModel searchedModel(const Arguments& args, const Covered& covered) {
  if (args.cover.shape == "sphere") {
    SphereModelOptions options;
    options.spheres = args.cover.spheres;
    options.excess = args.cover.excess;
    options.search.seed = args.seed;
    return shapeModelOf(covered.robot ? enclosingSphereModel(*covered.robot, options)
                                      : enclosingSphereModel(covered.bodies, options));
  }
  const ShapeModelOptions options{.kind = kindOf(args.cover.shape),
                                  .shapes = args.cover.spheres,
                                  .excess = args.cover.excess,
                                  .search = {}};
  return covered.robot ? enclosingShapeModel(*covered.robot, options)
                       : enclosingShapeModel(covered.bodies, options);
}

ShapeModel checkedModel(const Arguments& args, const Covered& covered) {
  return covered.robot ? readShapeModel(args.cover.check, *covered.robot, covered.options)
                       : readSceneModel(args.cover.check, *covered.world, covered.options);
}

}  // namespace

ExitCode runCover(const Arguments& args) {
  const bool scene = requireUsable(args);
  Warnings warnings(args.quiet);
  const Covered covered = loadCovered(args, args.cover.visual, warnings);
  if (covered.bodies.empty() && scene)
    throw UsageError("no body of scene '" + args.robot + "' has geometry");
  if (covered.bodies.empty())
    throw UsageError("robot '" + covered.name + "' has no " +
                     (args.cover.visual ? "visual" : "collision") + " geometry");
  const bool searches = args.cover.check.empty();
  const auto start = std::chrono::steady_clock::now();
  ShapeModel model;
  std::vector<LinkSphereReport> reports;
  {
    const Progress progress(
        searches ? "searching for " + args.cover.shape + " models" : "judging the model",
        args.quiet);
    model = searches ? searchedModel(args, covered) : checkedModel(args, covered);
    reports = judgeShapeModel(covered.bodies, model);
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!args.output.empty()) writeModel(args, covered, model, reports);
  printCover(args, covered, model, reports, seconds);
  if (covered.robot) writeCoverPage(args, covered.model, *covered.robot, model, reports);
  return searches ? ExitCode::Free : judgement(reports);
}

}  // namespace swept
