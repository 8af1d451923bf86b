// SPDX-License-Identifier: BSD-3-Clause
#include "page/pages.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <iostream>

#include "command_line/options.hpp"
#include "input/json_value.hpp"
#include "output/clearance_text.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/whole_file.hpp"
#include "page/page_content.hpp"
#include "page/view.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {
namespace {

/// `3 motions: 1 free, 2 in collision`.
std::string countsText(const std::string& what, const std::vector<Verdict>& verdicts) {
  static constexpr std::array<std::pair<Verdict, const char*>, 3> kWords{
      {{Verdict::Free, "free"},
       {Verdict::Collision, "in collision"},
       {Verdict::Undecided, "undecided"}}};
  std::vector<std::string> counts;
  for (const auto& [verdict, word] : kWords) {
    const auto count = static_cast<std::size_t>(std::ranges::count(verdicts, verdict));
    if (count == 0) continue;
    const std::string number = count == verdicts.size() ? "all" : std::to_string(count);
    counts.push_back(verdicts.size() == 1 ? word : number + " " + word);
  }
  if (verdicts.size() == 1) return what + ": " + counts.front();
  return std::to_string(verdicts.size()) + " " + what + "s: " + joined(counts);
}

Verdict worst(const std::vector<Verdict>& verdicts) {
  Verdict result = Verdict::Free;
  for (const Verdict verdict : verdicts)
    if (result != Verdict::Collision && verdict != Verdict::Free) result = verdict;
  return result;
}

/// Green would say too much.
void sayIfNothingIsChecked(PageContent& content, const Checker& checker) {
  if (!checker.checksNothing() || content.tone != PageContent::Tone::Good) return;
  content.tone = PageContent::Tone::Unsure;
  content.headline += ", nothing was checked";
}

PageContent statesContent(const Checker& checker, std::vector<LabelledState> states) {
  PageContent content;
  Workspace workspace(checker);
  std::vector<Verdict> verdicts;
  for (const LabelledState& state : states)
    verdicts.push_back(checker.checkState(state.q, workspace));
  content.tone = toneOf(worst(verdicts));
  content.headline = countsText("state", verdicts);
  sayIfNothingIsChecked(content, checker);
  content.states = std::move(states);
  return content;
}

/// The group's values in the robot's default state.
LabelledState defaultState(const Robot& robot, const Group& group) {
  const Eigen::VectorXd all = robot.defaultState();
  LabelledState state{.label = "default state", .q = {}};
  for (const int variable : group.variables) state.q.push_back(all[variable]);
  return state;
}

std::string pathHeadline(const PlanOutcome& outcome, const Checker& checker) {
  if (!outcome.solved()) return "not solved: " + outcome.failure;
  const std::string segments = std::to_string(outcome.segments.size()) + " segment" +
                               (outcome.segments.size() == 1 ? "" : "s");
  if (!outcome.proven()) return "not proven: " + segments;
  return "solved: " + segments + (checker.checksNothing() ? "" : ", all proven free");
}

void addPlanFacts(PageContent& content, const PlanRequest& request, const PlanOutcome& outcome) {
  const auto add = [&](const char* name, std::string value) {
    content.facts.emplace_back(name, std::move(value));
  };
  if (outcome.proven()) add("least certified clearance", clearanceText(outcome.leastClearance()));
  add("planner", request.planner);
  add("seed", std::to_string(request.seed));
  add("planning time", secondsText(outcome.planningTime));
  if (request.simplify && outcome.solved())
    add("simplification", secondsText(outcome.simplifyTime));
  add("motions certified",
      std::to_string(outcome.certified) + ", refused " + std::to_string(outcome.refused));
  if (outcome.solved()) add("path length", shortNumber(outcome.length));
}

/// The states of a path file, each within the limits. Throws InputError or UsageError.
std::vector<std::vector<double>> pathStates(const Json& path, const Checker& checker,
                                            const std::string& file) {
  const nlohmann::json plain(path.contains("states") ? path["states"] : Json());
  std::vector<std::vector<double>> states;
  for (const JsonValue& place : JsonValue(plain, "states", file).elements()) {
    std::vector<double> q;
    for (const JsonValue& value : place.elements(checker.group().variables.size()))
      q.push_back(value.number());
    states.push_back(std::move(q));
  }
  if (states.empty()) throw InputError(file, 0, "states must hold one or more");
  return states;
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
  if (args.page.file.empty()) return;
  const std::filesystem::path file = args.page.file;
  if (file.extension() != ".html" && file.extension() != ".htm")
    throw UsageError("'" + args.page.file + "': a page ends in .html or .htm");
  requireWritable(file);
}

void writePage(const Arguments& args, const Robot& robot, const World& world,
               const Checker* checker, const PageContent& content) {
  {
    Progress progress("making the page", args.quiet);
    writeWholeFile(args.page.file, htmlOf(pageJson(args, robot, world, checker, content)));
  }
  if (!args.json) std::cout << "page written to " << escapedLine(args.page.file) << '\n';
}

void writeCheckPage(const Arguments& args, const Model& model, const Task& task) {
  if (args.page.file.empty()) return;
  writePage(args, *model.robot, task.checker->world(), task.checker.get(),
            statesContent(*task.checker, task.states));
}

void writeMotionPage(const Arguments& args, const Model& model, const Task& task) {
  if (args.page.file.empty()) return;
  const Checker& checker = *task.checker;
  Workspace workspace(checker);
  PageContent content;
  std::vector<Verdict> verdicts;
  for (std::size_t i = 1; i < task.states.size(); ++i) {
    const LabelledState& from = task.beginOfMotionTo(i);
    const LabelledState& to = task.states[i];
    content.motions.push_back({.label = from.label + " to " + to.label,
                               .from = from.q,
                               .to = to.q,
                               .certificate = checker.certifyMotion(from.q, to.q, workspace)});
    verdicts.push_back(content.motions.back().certificate.verdict);
  }
  content.tone = toneOf(worst(verdicts));
  content.headline = countsText("motion", verdicts);
  sayIfNothingIsChecked(content, checker);
  writePage(args, *model.robot, checker.world(), &checker, content);
}

void writePlanPage(const Arguments& args, const Model& model, const Task& task,
                   const PlanRequest& request, const PlanOutcome& outcome) {
  if (args.page.file.empty()) return;
  PageContent content;
  if (outcome.solved()) {
    std::vector<Verdict> verdicts;
    for (std::size_t i = 0; i < outcome.segments.size(); ++i) {
      content.motions.push_back({.label = "segment " + std::to_string(i + 1),
                                 .from = outcome.states[i],
                                 .to = outcome.states[i + 1],
                                 .certificate = outcome.segments[i].certificate});
      verdicts.push_back(outcome.segments[i].certificate.verdict);
    }
    content.tone = toneOf(worst(verdicts));
  } else {
    content = statesContent(*task.checker, task.states);
    content.tone = PageContent::Tone::Bad;
  }
  content.headline = pathHeadline(outcome, *task.checker);
  sayIfNothingIsChecked(content, *task.checker);
  addPlanFacts(content, request, outcome);
  // A path may consist of its start alone.
  if (content.motions.empty() && content.states.empty()) content.states = {task.states.front()};
  writePage(args, *model.robot, task.checker->world(), task.checker.get(), content);
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
                     {"pairs of bodies", std::to_string(summary.pairs)},
                     {"intervals", std::to_string(summary.intervals)},
                     {"separating planes", std::to_string(summary.planes)}};
    for (const auto& [reason, pairs] : summary.allowed)
      content.facts.emplace_back("not checked (" + reason + ")", joined(pairs));
  }
  writePage(args, *model.robot, task.checker->world(), task.checker.get(), content);
}

void writeInfoPage(const Arguments& args, const Model& model, const Checker* checker) {
  if (args.page.file.empty()) return;
  const Robot& robot = *model.robot;
  const Group& group = checker == nullptr ? robot.groups().front() : checker->group();
  PageContent content;
  if (checker != nullptr) content = statesContent(*checker, {defaultState(robot, group)});
  content.tone = PageContent::Tone::Plain;
  content.headline = std::to_string(robot.links().size()) + " links, " +
                     std::to_string(robot.joints().size()) + " joints";
  content.states = {defaultState(robot, group)};
  writePage(args, robot, *model.world, checker, content);
}

}  // namespace swept
