// SPDX-License-Identifier: BSD-3-Clause
#include "schedule/schedule_parts.hpp"

#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "input/states.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/usage_error.hpp"
#include "text/numbers.hpp"
#include "trajectory/timing.hpp"

namespace swept {

namespace {

constexpr const char* kBetween = "..";

/// `left/arm` and `left.yaml` of `left/arm=left.yaml`.
std::pair<std::string, std::string> splitAtEqual(const std::string& option, const std::string& text,
                                                 const std::string& form) {
  const auto at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw UsageError(option + " '" + text + "': must be " + form);
  return {text.substr(0, at), text.substr(at + 1)};
}

void requireNew(const std::vector<SchedulePart>& parts, const std::string& option,
                const std::string& text, const std::string& group) {
  const auto same = std::ranges::find(parts, group, &SchedulePart::group);
  if (same == parts.end()) return;
  throw UsageError(option + " '" + text + "': group '" + group + "' " +
                   (same->isPlanned() ? "is planned already" : "has a trajectory already"));
}

}  // namespace

std::vector<SchedulePart> partsOf(const Arguments& args) {
  std::vector<SchedulePart> parts;
  for (const std::string& text : args.schedule.parts) {
    auto [group, file] = splitAtEqual("part", text, "GROUP=FILE");
    requireNew(parts, "part", text, group);
    parts.push_back({.group = std::move(group), .file = std::move(file), .start = {}, .goal = {}});
  }
  for (const std::string& text : args.schedule.plans) {
    constexpr const char* kForm = "GROUP=START..GOAL";
    auto [group, way] = splitAtEqual("--plan", text, kForm);
    const auto at = way.find(kBetween);
    if (at == std::string::npos || at == 0 || at + 2 == way.size())
      throw UsageError("--plan '" + text + "': must be " + kForm);
    requireNew(parts, "--plan", text, group);
    parts.push_back({.group = std::move(group),
                     .file = {},
                     .start = way.substr(0, at),
                     .goal = way.substr(at + 2)});
  }
  if (parts.empty())
    throw UsageError(
        "there is no trajectory: GROUP=FILE names one, --plan GROUP=START..GOAL plans "
        "one");
  return parts;
}

std::map<std::size_t, double> numbersOf(const std::string& option,
                                        const std::vector<std::string>& texts,
                                        const std::vector<SchedulePart>& parts,
                                        const std::string& unit) {
  std::map<std::size_t, double> numbers;
  for (const std::string& text : texts) {
    const auto [group, value] = splitAtEqual(option, text, "GROUP=" + unit);
    const auto part = std::ranges::find(parts, group, &SchedulePart::group);
    std::vector<std::string> known;
    for (const SchedulePart& one : parts) known.push_back(one.group);
    if (part == parts.end())
      throw UsageError(option + " '" + text + "': no part is of group '" + group + "'; there are " +
                       joined(known));
    const std::optional<double> number = detail::parseNumber(value);
    if (!number || !(*number >= 0.0) || *number > 1e6)
      throw UsageError(option + " '" + text + "': '" + value +
                       "' is no number from 0 to 1000000 (" + unit + ")");
    if (!numbers.emplace(part - parts.begin(), *number).second)
      throw UsageError(option + " '" + text + "': group '" + group + "' has one already");
  }
  return numbers;
}

std::map<std::size_t, double> startsOf(const Arguments& args,
                                       const std::vector<SchedulePart>& parts) {
  std::map<std::size_t, double> starts = numbersOf("--at", args.schedule.starts, parts, "S");
  for (const auto& [part, start] : starts)
    if (parts[part].isPlanned())
      throw UsageError("--at: group '" + parts[part].group +
                       "' is planned, and may move from 0 s on");
  return starts;
}

ScheduleTask taskOf(const Arguments& args, const Model& model, const Group& group,
                    const SchedulePart& part, Warnings& warnings) {
  const std::string label = "--plan " + part.group + ": ";
  const auto state = [&](const std::string& text, const char* which) {
    return readState(*model.robot, group, text, label + which, std::ref(warnings));
  };
  std::vector<double> start = state(part.start, "start");
  std::vector<double> goal = state(part.goal, "goal");
  return {.group = part.group,
          .start = std::move(start),
          .goals = {std::move(goal)},
          .limits = timingLimits(args, model, group, "--plan")};
}

}  // namespace swept
