// SPDX-License-Identifier: BSD-3-Clause
#include "page/pages.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>
#include <limits>

#include "command_line/commands.hpp"
#include "command_line/options.hpp"
#include "io/json_value.hpp"
#include "output/clearance_text.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/whole_file.hpp"
#include "page/live_part.hpp"
#include "page/page_content.hpp"
#include "page/path_page.hpp"
#include "page/program_page.hpp"
#include "page/view.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {
namespace {

/// The group's values in the robot's default state.
PageContent::State defaultState(const Robot& robot, const Group& group) {
  const Eigen::VectorXd all = robot.defaultState();
  PageContent::State state{.label = "default state", .q = {}};
  for (const int variable : group.variables) state.q.push_back(all[variable]);
  return state;
}

/// s, at which the first of what moves begins to.
double firstTime(const World& world) {
  double begin = std::numeric_limits<double>::infinity();
  for (const MovingObstacle& body : world.obstacles())
    begin = std::min(begin, body.waypoints.front().time);
  return begin;
}

/// Beside objects that move: at the time that is asked for, or when they begin to.
PageContent::State onClock(const Arguments& args, const World& world, PageContent::State state) {
  if (world.obstacles().empty()) return state;
  const double time = args.clock.time ? *args.clock.time : firstTime(world);
  state.q.push_back(time);
  state.label += " at " + shortNumber(time) + " s";
  return state;
}

VisualModel visualsOf(const Model& model) {
  if (!model.urdf) return {};
  return VisualModel::parse(model.urdf->text, model.urdf->name, model.options);
}

/// The configuration that the page begins with.
std::vector<double> firstOf(const PageContent& content) {
  if (!content.motions.empty()) return content.motions.front().from;
  if (!content.states.empty()) return content.states.front().q;
  const PiecewisePolynomial& curve = content.trajectories.front().curve;
  const Eigen::VectorXd begin = curve.position(curve.begin());
  return {begin.begin(), begin.end()};
}

}  // namespace

void addHtmlOption(CLI::App& app, Arguments& args) {
  app.add_option("--html", args.page.file,
                 "also writes a page that shows it, one file for any browser, without network")
      ->type_name("FILE.html");
}

std::span<const Command* const> pageCommands() {
  static constexpr const Command* kView = &kViewCommand;
  return {&kView, 1};
}

void requirePageFile(const Arguments& args) {
  requireLive(args);
  if (args.page.file.empty()) return;
  const std::filesystem::path file = args.page.file;
  if (file.extension() != ".html" && file.extension() != ".htm")
    throw UsageError("'" + args.page.file + "': a page ends in .html or .htm");
  requireWritable(file);
}

std::vector<PageContent::State> pageStates(const std::vector<LabelledState>& states) {
  std::vector<PageContent::State> shown;
  for (const LabelledState& state : states) shown.push_back({.label = state.label, .q = state.q});
  return shown;
}

void writePage(const Arguments& args, const Model& model, const Checker* checker,
               PageContent content) {
  content.title = "swept " + std::string(args.command->name);
  content.command = args.page.commandLine;
  {
    Progress progress("making the page", args.quiet);
    const World& world = checker == nullptr ? *model.world : checker->world();
    const VisualModel visuals = visualsOf(model);
    Json json = pageJson(*model.robot, world, checker, content, visuals);
    // Only the program has a clock.
    if (isLive(args) && world.obstacles().empty())
      json["live"] = liveJson(args, *checker, firstOf(content));
    writeWholeFile(args.page.file, htmlOf(json));
  }
  if (!args.json) printText("page written to " + escapedLine(args.page.file) + "\n");
}

void writeCheckPage(const Arguments& args, const Model& model, const Task& task) {
  if (args.page.file.empty()) return;
  writePage(args, model, task.checker.get(), statesContent(*task.checker, pageStates(task.states)));
}

void writeMotionPage(const Arguments& args, const Model& model, const Task& task) {
  if (args.page.file.empty()) return;
  const Checker& checker = *task.checker;
  Workspace workspace(checker);
  PageContent content;
  std::vector<Finding> findings;
  for (std::size_t i = 1; i < task.states.size(); ++i) {
    const LabelledState& from = task.beginOfMotionTo(i);
    const LabelledState& to = task.states[i];
    content.motions.push_back({.label = from.label + " to " + to.label,
                               .from = from.q,
                               .to = to.q,
                               .certificate = checker.certifyMotion(from.q, to.q, workspace)});
    findings.push_back(findingOf(content.motions.back().certificate));
  }
  content.tone = toneOf(worst(findings).verdict);
  content.headline = countsText("motion", findings);
  sayIfNothingIsChecked(content, checker);
  writePage(args, model, &checker, content);
}

void writeVerifyPage(const Arguments& args, const Model& model, const Task& task, const Json& file,
                     const VerifyOutcome& outcome) {
  if (args.page.file.empty()) return;
  std::vector<std::vector<double>> states{task.states.front().q};
  try {
    states = pathStates(file, *task.checker, args.verify.path);
  } catch (const InputError&) {
    if (outcome.holds()) throw;  // what is wrong with them is why the path is refused
  }
  PageContent content;
  Workspace workspace(*task.checker);
  for (std::size_t i = 0; i + 1 < states.size(); ++i)
    content.motions.push_back(
        {.label = "segment " + std::to_string(i + 1),
         .from = states[i],
         .to = states[i + 1],
         .certificate = task.checker->certifyMotion(states[i], states[i + 1], workspace)});
  if (content.motions.empty()) content.states = {{.label = "start", .q = states.front()}};
  content.tone = outcome.holds() ? PageContent::Tone::Good : PageContent::Tone::Bad;
  content.headline = outcome.holds() ? "verified" : "refused: " + outcome.refusal;
  if (outcome.holds()) {
    const verify::Summary& summary = outcome.summary;
    content.facts = {{"every pair keeps more than", clearanceText(summary.clearance)},
                     {"pairs with the world", clearanceText(summary.clearanceWorld)},
                     {"pairs of the robot's bodies", clearanceText(summary.clearanceSelf)},
                     {"pairs of bodies", std::to_string(summary.pairs)},
                     {"intervals", std::to_string(summary.intervals)},
                     {"separating planes", std::to_string(summary.planes)}};
    for (const auto& [reason, pairs] : summary.allowed)
      content.facts.emplace_back("not checked (" + reason + ")", joined(pairs));
  }
  writePage(args, model, task.checker.get(), content);
}

void writeInfoPage(const Arguments& args, const Model& model, const Checker* checker) {
  if (args.page.file.empty()) return;
  const Robot& robot = *model.robot;
  const Group& group = checker == nullptr ? robot.groups().front() : checker->group();
  const World& world = checker == nullptr ? *model.world : checker->world();
  const PageContent::State state = onClock(args, world, defaultState(robot, group));
  PageContent content;
  if (checker != nullptr) content = statesContent(*checker, {state});
  content.tone = PageContent::Tone::Plain;
  content.headline = std::to_string(robot.links().size()) + " links, " +
                     std::to_string(robot.joints().size()) + " joints";
  content.states = {state};
  writePage(args, model, checker, content);
}

}  // namespace swept
