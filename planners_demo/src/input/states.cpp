// SPDX-License-Identifier: BSD-3-Clause
#include "input/states.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swept/robot_model/did_you_mean.hpp"
#include "command_line/exit_code.hpp"
#include "io/judged_state.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/named_states.hpp"
#include "text/double_from.hpp"

namespace swept {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

struct Number {
  double value = 0.0;
  bool readable = false;  ///< the whole text is a number, perhaps an infinite one
};

Number readNumber(const std::string& text) {
  Number number;
  const char* end = text.data() + text.size();
  const auto [stop, error] = detail::doubleFrom(text.data(), end, number.value);
  if (error == std::errc::result_out_of_range) number.value = HUGE_VAL;
  number.readable = stop == end && error != std::errc::invalid_argument;
  return number;
}

/// See detail::judgeState(). Refuses values outside the limits; of those that it takes to one
/// `warn` is told.
void keepLimits(const Robot& robot, const Group& group, std::vector<double>& q,
                const std::string& label, const Warn& warn) {
  const detail::JudgedState judged = detail::judgeState(robot, group, q);
  if (!judged.problem.empty()) throw UsageError(label + ": " + judged.problem);
  for (const TakenToLimit& taken : judged.taken) warn("swept: warning: " + limitRemark(taken));
}

void toRadians(const Robot& robot, const Group& group, std::vector<double>& q) {
  for (std::size_t i = 0; i < q.size(); ++i)
    if (unitOf(robot, robot.variables()[group.variables[i]]) == "rad")
      q[i] *= std::numbers::pi / 180.0;
}

std::vector<double> namedState(const Robot& robot, const Group& group, const NamedState& state,
                               const std::string& label) {
  std::vector<double> q(group.variables.size());
  for (std::size_t i = 0; i < group.variables.size(); ++i) {
    const auto found =
        std::ranges::find(state.values, group.variables[i], &std::pair<int, double>::first);
    if (found == state.values.end())
      throw UsageError(label + ": named state '" + state.name + "' has no value for " +
                       robot.variables()[group.variables[i]].name);
    q[i] = found->second;
  }
  return q;
}

[[noreturn]] void refuseName(const Robot& robot, const Group& group, const std::string& text,
                             const std::string& label) {
  for (const LeftOut& out : robot.leftOut())
    if (out.group == group.name && out.state == text)
      throw UsageError(label + ": named state '" + text + "' of group '" + group.name +
                       "' is left out: " + out.reason);
  std::vector<std::string> known;
  for (const NamedState& state : robot.namedStates())
    if (state.group == group.name) known.push_back(state.name);
  if (std::ranges::find(known, kDefaultState) == known.end()) known.emplace_back(kDefaultState);
  throw UsageError(label + ": no named state '" + text + "' in group '" + group.name + "' (" +
                   "it has " + joined(known) + ") and not a list of values: " +
                   joined(variableNames(robot, group), ",") + didYouMean(text, known));
}

std::vector<double> reordered(const Robot& robot, const Group& group,
                              const std::vector<std::size_t>& order,
                              const std::vector<double>& values, const std::string& label,
                              const Warn& warn) {
  std::vector<double> q;
  for (const std::size_t place : order) q.push_back(values.at(place));
  keepLimits(robot, group, q, label, warn);
  return q;
}

std::string labelOf(const PlanningProblem& problem) {
  return "problem " + problem.set + " " + std::to_string(problem.index);
}

/// Of many the first, and how many more.
std::string someOf(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 3;
  if (names.size() <= kMost) return joined(names);
  const std::vector<std::string> first(names.begin(), names.begin() + kMost);
  return joined(first) + " and " + std::to_string(names.size() - kMost) + " more";
}

}  // namespace

std::vector<std::string> splitAtCommas(const std::string& text) {
  std::vector<std::string> pieces;
  std::size_t begin = 0;
  for (std::size_t comma; (comma = text.find(',', begin)) != std::string::npos; begin = comma + 1)
    pieces.push_back(trimmed(text.substr(begin, comma - begin)));
  pieces.push_back(trimmed(text.substr(begin)));
  return pieces;
}

std::vector<std::string> variableNames(const Robot& robot, const Group& group) {
  std::vector<std::string> names;
  for (const int v : group.variables) names.push_back(robot.variables()[v].name);
  return names;
}

std::vector<double> readValues(const std::string& text, std::span<const std::string> names,
                               const std::string& label) {
  const std::vector<std::string> pieces = splitAtCommas(text);
  if (pieces.size() != names.size())
    throw UsageError(label + ": " + std::to_string(pieces.size()) + " values, expected " +
                     std::to_string(names.size()) + ": " + joined(names, ","));
  std::vector<double> values(names.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const Number number = readNumber(pieces[i]);
    const std::string seen = label + ": " + names[i] + " is '" + pieces[i] + "', ";
    if (!number.readable) throw UsageError(seen + "which is not a number");
    if (!std::isfinite(number.value)) throw UsageError(seen + "which is not a finite number");
    values[i] = number.value;
  }
  return values;
}

std::vector<double> readState(const Robot& robot, const Group& group, const std::string& text,
                              const std::string& label, const Warn& warn, AngleUnit unit) {
  const std::string wanted = trimmed(text);
  std::vector<double> q;
  if (const NamedState* state = robot.findNamedState(wanted, group.name)) {
    q = namedState(robot, group, *state, label);
  } else if (wanted == kDefaultState) {
    q = namedConfiguration(robot, group, wanted);
  } else if (wanted.find(',') != std::string::npos || readNumber(wanted).readable) {
    q = readValues(wanted, variableNames(robot, group), label);
    if (unit == AngleUnit::Degree) toRadians(robot, group, q);
  } else {
    refuseName(robot, group, wanted, label);
  }
  keepLimits(robot, group, q, label, warn);
  return q;
}

std::vector<std::size_t> problemOrder(const Robot& robot, const Group& group,
                                      const PlanningProblem& problem) {
  const std::vector<std::string> wanted = variableNames(robot, group);
  if (!std::ranges::is_permutation(wanted, problem.jointNames))
    throw UsageError(labelOf(problem) + ": its joints are " + joined(problem.jointNames, ",") +
                     ", those of group '" + group.name + "' are " + joined(wanted, ","));
  std::vector<std::size_t> order;
  for (const std::string& name : wanted)
    order.push_back(static_cast<std::size_t>(std::ranges::find(problem.jointNames, name) -
                                             problem.jointNames.begin()));
  return order;
}

ProblemStates problemStates(const Robot& robot, const Group& group, const PlanningProblem& problem,
                            const Warn& warn) {
  const std::string label = labelOf(problem);
  const std::vector<std::size_t> order = problemOrder(robot, group, problem);
  ProblemStates states;
  states.start = reordered(robot, group, order, problem.start, label + ", start", warn);
  for (const std::vector<double>& goal : problem.goals)
    states.goals.push_back(reordered(robot, group, order, goal, label + ", goal", warn));
  if (states.goals.empty()) throw UsageError(label + ": it has no goal");
  if (!problem.withZeroSize.empty())
    warn("swept: warning: " + label + ": " + someOf(problem.withZeroSize) +
         ": a shape with a size of 0 is checked as the point, segment or surface that it is");
  return states;
}

}  // namespace swept
