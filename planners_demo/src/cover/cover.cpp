// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "command_line/commands.hpp"
#include "command_line/shell_word.hpp"
#include "input/task.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/text_table.hpp"
#include "output/whole_file.hpp"
#include "page/pages.hpp"
#include "swept/robot_model/shape_model.hpp"
#include "swept/robot_model/sphere_model.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

std::string endingOf(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool isMesh(const std::string& file) {
  constexpr std::array kMeshes{".stl", ".obj", ".ply", ".dae", ".off", ".gltf", ".glb"};
  return std::ranges::find(kMeshes, endingOf(file)) != kMeshes.end();
}

/// `urdf`, `vamp`, ...: as asked for, or by the ending of the file; empty: of no known one.
std::string formatOf(const Arguments& args) {
  if (!args.cover.format.empty()) return args.cover.format;
  const std::string ending = endingOf(args.output);
  if (ending == ".yaml" || ending == ".yml") return "curobo";
  for (const std::string known : {"urdf", "xrdf", "srdf", "json"})
    if (ending == "." + known) return known;
  return {};
}

EnclosingKind kindOf(const std::string& shape) {
  if (shape == "capsule") return EnclosingKind::Capsule;
  return shape == "box" ? EnclosingKind::Box : EnclosingKind::Convex;
}

/// What the command works on.
struct Covered {
  Model model;  ///< of --html; without a robot for a mesh
  std::shared_ptr<const Robot> robot;
  ExpandedText urdf;  ///< with its `<collision>` elements
  std::string srdf;   ///< file; empty: none
  LoadOptions options;
};

Covered load(const Arguments& args, Warnings& warnings) {
  if (!isMesh(args.robot)) {
    Model model = loadModel(args, warnings);
    if (!args.cover.visual)
      return {model, model.robot, *model.urdf, model.srdf.file, model.options};
    const std::string text = urdfWithVisualsAsCollision(model.urdf->text, model.urdf->name);
    return {model, Robot::parse(text, model.urdf->name, {}, {}, model.options), *model.urdf,
            model.srdf.file, model.options};
  }
  if (args.cover.visual)
    throw UsageError("--visual is for a robot; '" + args.robot + "' is a mesh");
  const std::filesystem::path file = std::filesystem::absolute(args.robot);
  readTextFile(file);  // for its message, with the name as given
  LoadOptions options;
  options.warn = [&](const std::string& line) { warnings(line); };
  const ExpandedText urdf{urdfOfMesh(file), args.robot};
  return {{}, Robot::parse(urdf.text, urdf.name, {}, {}, options), urdf, {}, options};
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

void writeModel(const Arguments& args, const Covered& covered, const ShapeModel& model,
                const std::vector<LinkSphereReport>& reports) {
  const std::string format = formatOf(args);
  const std::string& name = covered.robot->name();
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

std::string millimetres(double metres) {
  return std::isfinite(metres) ? shortNumber(std::round(metres * 1e5) / 1e2) : "-";
}

std::string percentOf(double share) {
  return std::isfinite(share) ? shortNumber(std::round(share * 1e3) / 10.0) : "-";
}

std::string ratioText(double ratio) {
  return std::isfinite(ratio) ? shortNumber(std::round(ratio * 100.0) / 100.0) : "-";
}

struct CoverTotals {
  std::size_t spheres = 0;
  double largest = 0.0;                                       ///< m
  double mean = 0.0;                                          ///< m, of the links
  double outside = -std::numeric_limits<double>::infinity();  ///< m
};

CoverTotals totalsOf(const std::vector<LinkSphereReport>& reports) {
  CoverTotals totals;
  for (const LinkSphereReport& report : reports) {
    totals.spheres += report.spheres;
    totals.largest = std::max(totals.largest, report.excess.largest);
    totals.mean += report.excess.mean / static_cast<double>(reports.size());
    totals.outside = std::max(totals.outside, report.outside.upper);
  }
  return totals;
}

std::string excessText(const CoverTotals& totals, const std::string& what) {
  return countedText(totals.spheres, what) + ", largest excess " + millimetres(totals.largest) +
         " mm, mean excess " + millimetres(totals.mean) + " mm\n";
}

/// `what`: `sphere` or `shape`.
std::string coverText(const std::vector<LinkSphereReport>& reports, const std::string& what) {
  TextTable table({{"link"},
                   {what + "s", true},
                   {"largest excess (mm)", true},
                   {"mean (mm)", true},
                   {"volume ratio", true}});
  for (const LinkSphereReport& report : reports)
    table.add({report.link, std::to_string(report.spheres), millimetres(report.excess.largest),
               millimetres(report.excess.mean), ratioText(report.excess.volumeRatio)});
  return table.text() + excessText(totalsOf(reports), what);
}

std::string checkText(const std::vector<LinkSphereReport>& reports, const std::string& what) {
  TextTable table({{"link"},
                   {what + "s", true},
                   {"outside (mm)", true},
                   {"surface outside (%)", true},
                   {"farthest point (m)"},
                   {"inflated: largest excess (mm)", true},
                   {"mean (mm)", true}});
  for (const LinkSphereReport& report : reports) {
    const bool none = report.spheres == 0;
    const bool isOut = report.outside.upper > 0.0;
    table.add({report.link, std::to_string(report.spheres),
               none ? "all of it"
               : isOut
                   ? millimetres(report.outside.lower) + " to " + millimetres(report.outside.upper)
                   : "0",
               percentOf(report.outside.surfaceShare),
               isOut && !none ? pointText(report.outside.point) : "",
               none ? "-" : millimetres(report.excess.largest),
               none ? "-" : millimetres(report.excess.mean)});
  }
  const CoverTotals totals = totalsOf(reports);
  std::string text = table.text();
  if (totals.outside <= 0.0) {
    text += "the " + what + "s contain all links: proven\n";
  } else if (std::isfinite(totals.outside)) {
    text += "the least inflation that encloses all links: " + millimetres(totals.outside) + " mm\n";
  } else {
    text += "no inflation encloses links without " + what + "s\n";
  }
  return text + "each link inflated as it needs: " + excessText(totals, what);
}

Json reportJson(const LinkSphereReport& report) {
  return {{"link", report.link},
          {"spheres", report.spheres},
          {"outside_lower", finiteOrNull(report.outside.lower)},
          {"outside_upper", finiteOrNull(report.outside.upper)},
          {"farthest_point", toJson(report.outside.point)},
          {"surface_share_outside", report.outside.surfaceShare},
          {"largest_excess", finiteOrNull(report.excess.largest)},
          {"largest_excess_seen", finiteOrNull(report.excess.largestSeen)},
          {"mean_excess", finiteOrNull(report.excess.mean)},
          {"volume_ratio", finiteOrNull(report.excess.volumeRatio)}};
}

/// What the texts call the shapes.
std::string nameOf(const ShapeModel& model) {
  return sphereModelOf(model) ? "sphere" : "shape";
}

void print(const Arguments& args, const Covered& covered, const ShapeModel& model,
           const std::vector<LinkSphereReport>& reports, double seconds) {
  if (!args.json) {
    std::string text = args.cover.check.empty() ? coverText(reports, nameOf(model))
                                                : checkText(reports, nameOf(model));
    text += secondsText(seconds) + "\n";
    if (!args.output.empty()) text += "written to " + escapedLine(args.output) + "\n";
    printText(text);
    return;
  }
  Json json = {{"robot", covered.robot->name()},
               {"checked", args.cover.check.empty() ? Json(nullptr) : Json(args.cover.check)},
               {"output", args.output.empty() ? Json(nullptr) : Json(args.output)},
               {"seconds", seconds},
               {"links", Json::array()}};
  for (const LinkSphereReport& report : reports) json["links"].push_back(reportJson(report));
  std::cout << dumped(json) << '\n';
}

ExitCode judgement(const std::vector<LinkSphereReport>& reports) {
  ExitCode code = ExitCode::Free;
  for (const LinkSphereReport& report : reports) {
    if (report.outside.lower > 0.0) code = worse(code, ExitCode::Collision);
    if (report.outside.upper > 0.0) code = worse(code, ExitCode::Undecided);
  }
  return code;
}

void requireUsable(const Arguments& args) {
  if (!args.cover.spheres && !args.cover.excess && args.cover.check.empty())
    throw UsageError("cover needs --spheres N, --excess M or --check FILE");
  requirePageFile(args);
  if (!args.page.file.empty() && isMesh(args.robot))
    throw UsageError("--html is for a robot; '" + args.robot + "' is a mesh");
  if (args.output.empty()) {
    if (!args.cover.format.empty()) throw UsageError("--format needs -o FILE");
    return;
  }
  const std::string format = formatOf(args);
  if (format.empty())
    throw UsageError("-o '" + args.output + "' ends in '" + endingOf(args.output) +
                     "'; allowed: .urdf, .yaml, .yml (cuRobo), .xrdf, .srdf, .json, or any with "
                     "--format");
  if (args.cover.shape != "sphere" && format != "urdf" && format != "json")
    throw UsageError("the format " + format + " has spheres alone; --shape " + args.cover.shape +
                     " goes to urdf or json");
  requireWritable(args.output);
  if (format == "vamp") requireWritable(besideOutput(args, "_spherized.urdf"));
}

ShapeModel searchedModel(const Arguments& args, const Robot& robot) {
  if (args.cover.shape == "sphere") {
    SphereModelOptions options;
    options.spheres = args.cover.spheres;
    options.excess = args.cover.excess;
    options.search.seed = args.seed;
    return shapeModelOf(enclosingSphereModel(robot, options));
  }
  return enclosingShapeModel(robot, {.kind = kindOf(args.cover.shape),
                                     .shapes = args.cover.spheres,
                                     .excess = args.cover.excess,
                                     .search = {}});
}

}  // namespace

ExitCode runCover(const Arguments& args) {
  requireUsable(args);
  Warnings warnings(args.quiet);
  const Covered covered = load(args, warnings);
  if (std::ranges::all_of(covered.robot->links(),
                          [](const Link& link) { return link.collision.empty(); }))
    throw UsageError("robot '" + covered.robot->name() + "' has no " +
                     (args.cover.visual ? "visual" : "collision") + " geometry");
  const bool searches = args.cover.check.empty();
  const auto start = std::chrono::steady_clock::now();
  ShapeModel model;
  std::vector<LinkSphereReport> reports;
  {
    const Progress progress(
        searches ? "searching for " + args.cover.shape + " models" : "judging the model",
        args.quiet);
    model = searches ? searchedModel(args, *covered.robot)
                     : readShapeModel(args.cover.check, *covered.robot, covered.options);
    reports = judgeShapeModel(*covered.robot, model);
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!args.output.empty()) writeModel(args, covered, model, reports);
  print(args, covered, model, reports, seconds);
  writeCoverPage(args, covered.model, *covered.robot, model, reports);
  return searches ? ExitCode::Free : judgement(reports);
}

}  // namespace swept
