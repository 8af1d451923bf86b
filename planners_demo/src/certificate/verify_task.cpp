// SPDX-License-Identifier: BSD-3-Clause
#include "certificate/verify_task.hpp"

#include <cmath>
#include <iostream>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "certificate/summary_output.hpp"
#include "input/task.hpp"
#include "output/progress.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "verify/task.hpp"

namespace swept {
namespace {

using Pairs = std::map<std::string, std::vector<std::string>>;  ///< by who says that they may touch

/// Pairs that are not checked: those of two links are nearly the same in all phases.
struct UncheckedPairs {
  Pairs ofLinks, others;
};

UncheckedPairs uncheckedOf(const Json& model) {
  std::set<std::string> links;
  for (const Json& link : model["links"]) links.insert(link.get<std::string>());
  UncheckedPairs unchecked;
  for (const Json& pair : model["allowed"]) {
    const std::string a = pair[0], b = pair[1];
    Pairs& own = links.contains(a) && links.contains(b) ? unchecked.ofLinks : unchecked.others;
    own[pair[2].get<std::string>()].push_back(a + " - " + b);
  }
  return unchecked;
}

std::string phaseText(std::size_t number, const verify::PhaseSummary& phase, const Pairs& others) {
  const verify::Summary& proof = phase.proof;
  std::string text = "phase " + std::to_string(number) + " (" + phase.name + "), " +
                     shortNumber(phase.begin) + " to " + shortNumber(phase.end) + " s, " +
                     phase.group + ": ";
  if (!phase.changes.empty()) text += joined(phase.changes) + "; ";
  text += countedText(proof.segments, "piece") + ", " +
          (proof.tube.empty() ? "" : tubeText(proof)) +
          countedText(proof.pairs, "pair of bodies", "pairs of bodies");
  text += std::isinf(proof.clearance)
              ? std::string(", no pair to check")
              : ", every pair keeps more than " + shortNumber(proof.clearance) + " m";
  if (!proof.moving.empty()) text += "; beside what moves: " + joined(proof.moving);
  for (const std::string& constraint : proof.constraints)
    text += "; at every instant: " + constraint;
  for (const auto& [reason, pairs] : others)
    text += "; not checked (" + reason + "): " + joined(pairs);
  return escapedLine(text) + "\n";
}

/// Of all phases together.
verify::Summary sumOf(const std::vector<verify::PhaseSummary>& phases) {
  verify::Summary sum;
  for (const verify::PhaseSummary& phase : phases) sum.add(phase.proof);
  sum.duration = phases.back().end - phases.front().begin;
  return sum;
}

std::string taskText(const Json& task, const std::vector<verify::PhaseSummary>& phases) {
  std::string text;
  std::map<std::string, std::set<std::string>> ofLinks;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const UncheckedPairs unchecked = uncheckedOf(task["phases"][i]["path"]["model"]);
    text += phaseText(i + 1, phases[i], unchecked.others);
    for (const auto& [reason, pairs] : unchecked.ofLinks)
      ofLinks[reason].insert(pairs.begin(), pairs.end());
  }
  const verify::Summary sum = sumOf(phases);
  text +=
      painted(Hue::Good, "verified") + ": task of " + countedText(phases.size(), "phase") + ", " +
      secondsText(*sum.duration) + ", " + countedText(sum.segments, "piece") + ", " +
      countedText(sum.intervals, "interval") + ", " + countedText(sum.planes, "plane") + "\n" +
      "each phase begins where the one before ends; what it says has changed, and nothing else, "
      "has\n" +
      keptText(sum) + "\n";
  for (const auto& [reason, pairs] : ofLinks)
    text += escapedLine("not checked (" + reason +
                        "): " + joined(std::vector<std::string>(pairs.begin(), pairs.end()))) +
            "\n";
  return text;
}

Json taskJson(const std::vector<verify::PhaseSummary>& phases, const std::string& refusal) {
  Json json = {{"verified", refusal.empty()}, {"refusal", nullptr}, {"phases", Json::array()}};
  if (!refusal.empty()) json["refusal"] = refusal;
  for (const verify::PhaseSummary& phase : phases) {
    Json entry = {{"phase", phase.name},
                  {"group", phase.group},
                  {"begin", phase.begin},
                  {"end", phase.end},
                  {"changes", phase.changes}};
    entry.update(outcomeJson({.refusal = {}, .summary = phase.proof}));
    json["phases"].push_back(std::move(entry));
  }
  return json;
}

void refuseOptionsOfPaths(const Arguments& args) {
  const std::pair<const char*, bool> given[] = {{"--robot", !args.verify.robot.empty()},
                                                {"--scene", !args.verify.scene.empty()},
                                                {"--files", args.verify.files},
                                                {"--html", !args.page.file.empty()}};
  for (const auto& [name, isGiven] : given)
    if (isGiven)
      throw UsageError(std::string(name) + ": '" + args.verify.path +
                       "' is a task, which has its robot and worlds in it");
}

}  // namespace

bool isTask(const Json& file) {
  return file.is_object() && file.contains("phases");
}

ExitCode runVerifyTask(const Arguments& args, const Json& task) {
  refuseOptionsOfPaths(args);
  Warnings warnings(args.quiet);
  std::vector<verify::PhaseSummary> phases;
  std::string refusal;
  try {
    Progress progress("verifying", args.quiet);
    phases = verify::checkTask(task);
  } catch (const verify::Refusal& error) {
    refusal = error.what();
  }
  std::set<std::string> said;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const Json& path = task["phases"][i]["path"];
    if (said.insert(path.value("warnings", Json()).dump()).second) repeatWarnings(path, warnings);
  }
  Json json = taskJson(phases, refusal);
  json["warnings"] = warnings.unchecked();
  if (args.json)
    std::cout << dumped(json) << '\n';
  else
    printText(refusal.empty() ? taskText(task, phases)
                              : painted(Hue::Bad, "refused") + ": " + escapedLine(refusal) + "\n");
  return refusal.empty() ? ExitCode::Free : ExitCode::Collision;
}

}  // namespace swept
