// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <chrono>
#include <iostream>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "certificate/certificate.hpp"
#include "certificate/lines_json.hpp"
#include "certificate/path_files.hpp"
#include "certificate/path_json.hpp"
#include "command_line/commands.hpp"
#include "input/inputs.hpp"
#include "input/poses.hpp"
#include "input/states.hpp"
#include "input/task.hpp"
#include "input/unchecked.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/path_certificate.hpp"
#include "swept/robot_model/tool_line.hpp"

namespace swept {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct LineTool {
  ConstraintFrame frame;
  ToolLineOptions options;
};

/// `MM` or `MM,DEG`.
ToolLineOptions deviationOf(const std::string& text) {
  ToolLineOptions options;
  if (text.empty()) return options;
  const bool both = text.find(',') != std::string::npos;
  const std::vector<std::string> names =
      both ? std::vector<std::string>{"mm", "degrees"} : std::vector<std::string>{"mm"};
  const std::vector<double> values = readValues(text, names, "--deviation");
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] > 0.0))
      throw UsageError("--deviation: " + names[i] + " is " + shortNumber(values[i]) +
                       ", which must be above 0");
  options.position = 1e-3 * values[0];
  if (both) options.angle = values[1] >= 180.0 ? std::numbers::pi : values[1] * kDegree;
  return options;
}

void requireLineOptions(const Arguments& args) {
  if (args.states.size() != 1) throw UsageError("line: one state is needed, where it starts");
  if (args.toolLine.to.empty() && args.toolLine.by.empty())
    throw UsageError("line: --to or --by is needed");
  if (args.toolLine.frame != "world" && args.toolLine.frame != "tool")
    throw UsageError("--frame is '" + args.toolLine.frame + "', allowed are world and tool");
  if (args.embed && args.output.empty()) throw UsageError("--embed needs -o FILE.json");
}

LineTool toolOf(const Arguments& args, const Checker& checker) {
  LineTool tool{.frame = {.body = args.goalLink}, .options = deviationOf(args.toolLine.deviation)};
  if (!args.toolLine.tool.empty())
    tool.frame.body_from_frame = readPlace(args.toolLine.tool, "--tool");
  if (!tool.frame.body.empty()) return tool;
  const Group& group = checker.group();
  if (group.tipLink < 0)
    throw UsageError("line: group '" + group.name + "' has no tip; choose a --link");
  tool.frame.body = checker.robot().links()[static_cast<std::size_t>(group.tipLink)].name;
  return tool;
}

std::size_t linesIn(const Arguments& args) {
  return args.toolLine.to.empty() ? args.toolLine.by.size() : args.toolLine.to.size();
}

/// Of the i-th line, which begins at `begin`.
Eigen::Isometry3d goalOf(const Arguments& args, std::size_t i, const Eigen::Isometry3d& begin) {
  if (!args.toolLine.to.empty()) {
    const std::string& text = args.toolLine.to[i];
    Eigen::Isometry3d goal = readPlace(text, "--to");
    if (std::ranges::count(text, ',') == 2) goal.linear() = begin.linear();
    return goal;
  }
  const std::array<std::string, 3> names{"x", "y", "z"};
  const std::vector<double> v = readValues(args.toolLine.by[i], names, "--by");
  const Eigen::Vector3d way(v[0], v[1], v[2]);
  Eigen::Isometry3d goal = begin;
  goal.translation() += args.toolLine.frame == "tool" ? Eigen::Vector3d(begin.linear() * way) : way;
  return goal;
}

struct LinesFound {
  std::vector<ToolLine> lines;
  std::vector<std::vector<double>> states;  ///< of all, one after the other
  double time = 0.0;                        ///< s

  bool complete(std::size_t asked) const {
    return lines.size() == asked && lines.back().complete();
  }
};

/// One line after the other, until one ends early.
LinesFound follow(const Arguments& args, const ToolLinePlanner& planner, const LineTool& tool,
                  const std::vector<double>& start) {
  LinesFound found;
  found.states.push_back(start);
  Workspace workspace(planner.checker());
  // Goals are read before the work, as far as the place where a line begins does not matter.
  for (std::size_t i = 0; i < linesIn(args); ++i) goalOf(args, i, Eigen::Isometry3d::Identity());
  const auto begin = std::chrono::steady_clock::now();
  Eigen::Isometry3d place = planner.pose(start);
  for (std::size_t i = 0; i < linesIn(args); ++i) {
    const Eigen::Isometry3d goal = goalOf(args, i, place);
    found.lines.push_back(planner.plan(found.states.back(), goal, workspace, tool.options));
    const ToolLine& line = found.lines.back();
    found.states.insert(found.states.end(), line.wayPoints.begin() + 1, line.wayPoints.end());
    if (!line.complete()) break;
    place = goal;
  }
  found.time = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return found;
}

ExitCode codeOf(const LinesFound& found, std::size_t asked) {
  if (found.complete(asked)) return ExitCode::Free;
  return found.lines.back().stop->reason == ToolLineStop::Reason::Undecided ? ExitCode::Undecided
                                                                            : ExitCode::Collision;
}

std::string lineText(const ToolLine& line, std::size_t number, const Checker& checker,
                     const ToolLineOptions& options) {
  std::string text = "line " + std::to_string(number) + ": ";
  text += line.complete() ? painted(Hue::Good, "proven")
                          : painted(Hue::Bad, "ends early") + ", proven to " +
                                shortNumber(line.share) + " of it";
  text += ", " + lengthText(line.share * line.length) + " m of " + lengthText(line.length) +
          " m, never more than " + shortNumber(1e3 * line.position) + " mm";
  if (options.angle < std::numbers::pi)
    text += " and " + shortNumber(line.angle / kDegree) + " degrees";
  text += " off, " + countedText(line.wayPoints.size(), "way point") + "\n";
  if (line.stop)
    text += "  " + escapedLine(describe(*line.stop, checker.options().constraints)) + "\n";
  return text;
}

Json lineJson(const ToolLine& line, const Checker& checker) {
  Json json = {{"complete", line.complete()}, {"length", line.length},
               {"turn", line.turn},           {"proven_share", line.share},
               {"deviation", line.position},  {"deviation_angle", line.angle}};
  json["way_points"] = line.wayPoints.size();
  json["shares"] = toJson(line.shares);
  json["stop"] = nullptr;
  if (!line.stop) return json;
  const ToolLineStop& stop = *line.stop;
  json["stop"] = {{"reason", toString(stop.reason)},
                  {"share", stop.share},
                  {"text", describe(stop, checker.options().constraints)},
                  {"variable", stop.variable.empty() ? Json(nullptr) : Json(stop.variable)},
                  {"least_singular_value", stop.leastSingularValue},
                  {"joint_step", stop.jointStep}};
  json["stop"]["contact"] = stop.contact ? toJson(*stop.contact) : Json(nullptr);
  return json;
}

/// Empty, or why the file has no proof.
std::string writeLines(const Arguments& args, const PathFile& file, const Checker& checker,
                       const LineTool& tool, const LinesFound& found, const Warnings& warnings) {
  Progress progress("writing " + args.output, args.quiet);
  const ProvenPath path = provenPath(found.states, certifyPath(checker, found.states));
  const Json lines = linesJson(checker, tool.frame, found.lines, tool.options);
  Certificate certificate;
  if (file.holdsProof())
    certificate = certificateOf(checker, path.states, path.clearances(), lines);
  file.write(checker,
             {.maker = {{"planner", "line"},
                        {"tool", tool.frame.body},
                        {"deviation", tool.options.position},
                        {"deviation_angle", tool.options.angle}},
              .states = path.states,
              .segments = path.segments,
              .inputs = inputsOfPath(args, args.output, path.states.front(), path.states.back()),
              .warnings = warnings.unchecked(),
              .lines = lines},
             certificate, args.embed);
  return certificate.missing;
}

}  // namespace

ExitCode runLine(const Arguments& args) {
  requireLineOptions(args);
  Warnings warnings(args.quiet);
  const Model model = loadModel(args, warnings);
  const Task task = loadTask(args, model, warnings);
  const Checker& checker = *task.checker;
  const LineTool tool = toolOf(args, checker);
  std::optional<PathFile> file;
  if (!args.output.empty()) {
    file.emplace(args.output, checker.robot(), checker.group());
    if (args.embed && !file->holdsProof()) throw UsageError("--embed needs -o FILE.json");
    file->requireNames(inputsJson(args, args.output), checker);
  }
  std::optional<ToolLinePlanner> planner;
  try {
    planner.emplace(task.checker, tool.frame);
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  const LinesFound found = follow(args, *planner, tool, task.states.front().q);
  const bool complete = found.complete(linesIn(args));
  std::string unproven;
  if (file && complete) unproven = writeLines(args, *file, checker, tool, found, warnings);
  if (!unproven.empty())
    warnings("swept: warning: no proof in '" + args.output + "': none was found for " + unproven);
  if (args.json) {
    Json json = {{"robot", checker.robot().name()},
                 {"group", checker.group().name},
                 {"tool", tool.frame.body},
                 {"allowed_deviation", tool.options.position},
                 {"allowed_deviation_angle", tool.options.angle},
                 {"complete", complete},
                 {"time", found.time}};
    json["lines"] = Json::array();
    for (const ToolLine& line : found.lines) json["lines"].push_back(lineJson(line, checker));
    json["states"] = Json::array();
    for (const std::vector<double>& q : found.states) json["states"].push_back(toJson(q));
    json["path_file"] = file && complete ? Json(args.output) : Json(nullptr);
    addUnchecked(json, checker, warnings);
    std::cout << dumped(json) << '\n';
    return codeOf(found, linesIn(args));
  }
  std::string text;
  for (std::size_t i = 0; i < found.lines.size(); ++i)
    text += lineText(found.lines[i], i + 1, checker, tool.options);
  text += "found in " + secondsText(found.time) + "\n" + uncheckedText(checker);
  if (file)
    text += complete ? "path written to " + escapedLine(args.output) + "\n"
                     : "no path written: a line ends early\n";
  printText(text);
  return codeOf(found, linesIn(args));
}

}  // namespace swept
