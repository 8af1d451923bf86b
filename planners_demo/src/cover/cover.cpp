// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <limits>
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
#include "swept/robot_model/sphere_model.hpp"
#include "swept/robot_model/text_file.hpp"

namespace swept {
namespace {

constexpr std::array kFormats{".urdf", ".yaml", ".yml", ".srdf", ".json"};

std::string endingOf(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

bool isMesh(const std::string& file) {
  constexpr std::array kMeshes{".stl", ".obj", ".ply", ".dae", ".off", ".gltf", ".glb"};
  return std::ranges::find(kMeshes, endingOf(file)) != kMeshes.end();
}

/// What the command works on.
struct Covered {
  std::shared_ptr<const Robot> robot;
  ExpandedText urdf;  ///< with its `<collision>` elements
  std::string srdf;   ///< file; empty: none
  LoadOptions options;
};

Covered load(const Arguments& args, Warnings& warnings) {
  if (!isMesh(args.robot)) {
    const Model model = loadModel(args, warnings);
    if (!args.cover.visual) return {model.robot, *model.urdf, model.srdf.file, model.options};
    const std::string text = urdfWithVisualsAsCollision(model.urdf->text, model.urdf->name);
    return {Robot::parse(text, model.urdf->name, {}, {}, model.options), *model.urdf,
            model.srdf.file, model.options};
  }
  if (args.cover.visual)
    throw UsageError("--visual is for a robot; '" + args.robot + "' is a mesh");
  const std::filesystem::path file = std::filesystem::absolute(args.robot);
  readTextFile(file);  // for its message, with the name as given
  LoadOptions options;
  options.warn = [&](const std::string& line) { warnings(line); };
  const ExpandedText urdf{urdfOfMesh(file), args.robot};
  return {Robot::parse(urdf.text, urdf.name, {}, {}, options), urdf, {}, options};
}

std::string fileText(const Covered& covered, const SphereModel& model,
                     const std::vector<LinkSphereReport>& reports, const std::string& output) {
  const std::string& name = covered.robot->name();
  const std::string ending = endingOf(output);
  if (ending == ".urdf") return spherizedUrdf(model, covered.urdf.text, covered.urdf.name);
  if (ending == ".json") return sphereModelJson(model, name, reports);
  if (ending != ".srdf") return curoboSpheres(model, name);
  const std::string srdf = covered.srdf.empty() ? "" : readTextFile(covered.srdf);
  return sphereApproximationSrdf(model, name, srdf, covered.srdf);
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

std::string excessText(const CoverTotals& totals) {
  return countedText(totals.spheres, "sphere") + ", largest excess " + millimetres(totals.largest) +
         " mm, mean excess " + millimetres(totals.mean) + " mm\n";
}

std::string coverText(const std::vector<LinkSphereReport>& reports) {
  TextTable table({{"link"},
                   {"spheres", true},
                   {"largest excess (mm)", true},
                   {"mean (mm)", true},
                   {"volume ratio", true}});
  for (const LinkSphereReport& report : reports)
    table.add({report.link, std::to_string(report.spheres), millimetres(report.excess.largest),
               millimetres(report.excess.mean), ratioText(report.excess.volumeRatio)});
  return table.text() + excessText(totalsOf(reports));
}

std::string checkText(const std::vector<LinkSphereReport>& reports) {
  TextTable table({{"link"},
                   {"spheres", true},
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
    text += "the spheres contain all links: proven\n";
  } else if (std::isfinite(totals.outside)) {
    text += "the least inflation that encloses all links: " + millimetres(totals.outside) + " mm\n";
  } else {
    text += "no inflation encloses links without spheres\n";
  }
  return text + "each link inflated as it needs: " + excessText(totals);
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

void print(const Arguments& args, const Covered& covered,
           const std::vector<LinkSphereReport>& reports, double seconds) {
  if (!args.json) {
    std::string text = args.cover.check.empty() ? coverText(reports) : checkText(reports);
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
  const auto& [spheres, excess, check, visual] = args.cover;
  if (!spheres && !excess && check.empty())
    throw UsageError("cover needs --spheres N, --excess M or --check FILE");
  if (args.output.empty()) return;
  if (const std::string ending = endingOf(args.output);
      std::ranges::find(kFormats, ending) == kFormats.end())
    throw UsageError("-o '" + args.output + "' ends in '" + ending +
                     "'; allowed: .urdf, .yaml, .yml (cuRobo), .srdf, .json");
  requireWritable(args.output);
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
  const auto start = std::chrono::steady_clock::now();
  SphereModel model;
  std::vector<LinkSphereReport> reports;
  {
    const Progress progress(args.cover.check.empty() ? "searching for spheres" : "judging spheres",
                            args.quiet);
    if (args.cover.check.empty()) {
      SphereModelOptions options;
      options.spheres = args.cover.spheres;
      options.excess = args.cover.excess;
      options.search.seed = args.seed;
      model = enclosingSphereModel(*covered.robot, options);
    } else {
      model = readSphereModel(args.cover.check, *covered.robot, covered.options);
    }
    reports = judgeSphereModel(*covered.robot, model);
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!args.output.empty())
    writeWholeFile(args.output, fileText(covered, model, reports, args.output));
  print(args, covered, reports, seconds);
  return args.cover.check.empty() ? ExitCode::Free : judgement(reports);
}

}  // namespace swept
