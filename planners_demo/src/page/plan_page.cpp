// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "output/clearance_text.hpp"
#include "page/pages.hpp"
#include "page/program_page.hpp"

namespace swept {
namespace {

/// Longer reasons wait below the headline.
constexpr std::size_t kMostHeadline = 72;

/// `start and goal are in collision`, `7 ends are in collision`; empty: no end is that.
std::string endsText(const std::vector<EndReport>& ends, const std::string& what) {
  std::vector<std::string> labels;
  for (const EndReport& end : ends)
    if (whatIs(end) == what) labels.push_back(end.label);
  if (labels.empty()) return {};
  if (labels.size() == 1) return labels.front() + " is " + what;
  if (labels.size() == 2) return joined(labels, " and ") + " are " + what;
  return std::to_string(labels.size()) + " ends are " + what;
}

/// Why there is no path, without the contacts: those are on the page.
std::string shortReason(const PlanOutcome& outcome) {
  std::vector<std::string> ends;
  for (const char* what : {"in collision", "closer than the margin", "undecided"})
    if (const std::string text = endsText(outcome.badEnds, what); !text.empty())
      ends.push_back(text);
  if (!ends.empty()) return joined(ends);
  if (outcome.failure.size() <= kMostHeadline) return outcome.failure;
  return outcome.failure.substr(0, outcome.failure.find_first_of(":;("));
}

/// The first end that cannot be used.
std::optional<std::size_t> badEnd(const std::vector<PageContent::State>& states,
                                  const PlanOutcome& outcome) {
  if (outcome.badEnds.empty()) return std::nullopt;
  const auto found =
      std::ranges::find(states, outcome.badEnds.front().label, &PageContent::State::label);
  if (found == states.end()) return std::nullopt;
  return static_cast<std::size_t>(found - states.begin());
}

std::string pathHeadline(const PlanOutcome& outcome, const Checker& checker) {
  if (!outcome.solved()) return "not solved: " + shortReason(outcome);
  const std::string segments = countedText(outcome.segments.size(), "segment");
  if (!outcome.proven()) return "not proven: " + segments;
  if (checker.checksNothing()) return "solved: " + segments;
  return "solved: " + segments +
         (outcome.segments.size() == 1 ? ", proven free" : ", all proven free");
}

void addKinds(PageContent& content, const Clearances& clearances) {
  const auto add = [&](const char* name, const NearestPair& pair) {
    std::string text = clearanceText(pair.clearance);
    if (!pair.bodyA.empty()) text += ", nearest " + pair.bodyA + " - " + pair.bodyB;
    content.facts.emplace_back(name, std::move(text));
  };
  add("clearance from the world", clearances.world);
  add("clearance from itself", clearances.self);
}

void addPlanFacts(PageContent& content, const PlanRequest& request, const PlanOutcome& outcome) {
  const auto add = [&](const char* name, std::string value) {
    content.facts.emplace_back(name, std::move(value));
  };
  if (outcome.proven()) {
    add("least certified clearance", clearanceText(outcome.leastClearance()));
    addKinds(content, outcome.leastClearances());
  }
  add("planner", request.planner);
  add("seed", std::to_string(request.seed));
  add("planning time", secondsText(outcome.planningTime));
  if (request.simplify && outcome.solved())
    add("simplification", secondsText(outcome.simplifyTime));
  add("motions certified",
      std::to_string(outcome.certified) + ", refused " + std::to_string(outcome.refused));
  if (outcome.solved()) add("path length", shortNumber(outcome.length));
}

}  // namespace

void writePlanPage(const Arguments& args, const Model& model, const Task& task,
                   const PlanRequest& request, const PlanOutcome& outcome,
                   const ShownTrajectory* trajectory) {
  if (args.page.file.empty()) return;
  PageContent content;
  if (trajectory != nullptr) {
    showTrajectories(content, {*trajectory});
  } else if (outcome.solved()) {
    std::vector<Finding> findings;
    for (std::size_t i = 0; i < outcome.segments.size(); ++i) {
      content.motions.push_back({.label = "segment " + std::to_string(i + 1),
                                 .from = outcome.states[i],
                                 .to = outcome.states[i + 1],
                                 .certificate = outcome.segments[i].certificate});
      findings.push_back(findingOf(outcome.segments[i].certificate));
    }
    content.tone = toneOf(worst(findings).verdict);
  } else {
    content = statesContent(*task.checker, pageStates(task.states));
    content.tone = PageContent::Tone::Bad;
    content.reason = outcome.failure;
    content.opensAt = badEnd(content.states, outcome);
  }
  if (trajectory == nullptr) content.headline = pathHeadline(outcome, *task.checker);
  sayIfNothingIsChecked(content, *task.checker);
  addPlanFacts(content, request, outcome);
  // A path may consist of its start alone.
  if (content.motions.empty() && content.states.empty() && content.trajectories.empty())
    content.states = pageStates({task.states.front()});
  writePage(args, model, task.checker.get(), content);
}

}  // namespace swept
