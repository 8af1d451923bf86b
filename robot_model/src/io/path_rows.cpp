// SPDX-License-Identifier: BSD-3-Clause
#include "io/path_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "io/judged_state.hpp"
#include "output/text_output.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {

namespace {

/// The distance between two values. Angles may be whole turns apart.
double off(double value, double other, bool turns) {
  const double apart = value - other;
  return std::abs(turns ? std::remainder(apart, 2.0 * std::numbers::pi) : apart);
}

std::vector<std::string> namesOf(const Robot& robot, std::span<const int> variables) {
  std::vector<std::string> names;
  for (const int variable : variables) names.push_back(robot.variables()[variable].name);
  return names;
}

}  // namespace

PathRows::Column PathRows::columnOf(const std::string& name, const FailAt& fail) const {
  Column column;
  if (const auto variable = robot_.findVariable(name)) {
    column.variable = *variable;
    column.joint = robot_.variables()[*variable].joint;
    const auto place = std::ranges::find(group_.variables, *variable);
    if (place != group_.variables.end())
      column.place = static_cast<int>(place - group_.variables.begin());
    return column;
  }
  const auto joint = robot_.findJoint(name);
  if (!joint)
    fail("is '" + name + "', which is no joint of robot '" + robot_.name() + "'; group '" +
         group_.name + "' has " + joined(namesOf(robot_, group_.variables)));
  column.joint = *joint;
  const int first = robot_.joints()[*joint].firstVariable;
  if (first >= 0)
    fail("is '" + name + "', a joint of several values, which are called " +
         robot_.variables()[first].name + " and so on");
  return column;
}

void PathRows::setSomeColumns(std::span<const std::string> names,
                              const std::function<void(std::size_t, const std::string&)>& failAt) {
  columns_.clear();
  std::set<std::string> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const FailAt fail = [&](const std::string& message) { failAt(i, message); };
    if (!known.insert(names[i]).second) fail("is '" + names[i] + "' a second time");
    columns_.push_back(columnOf(names[i], fail));
  }
}

void PathRows::setColumns(std::span<const std::string> names,
                          const std::function<void(std::size_t, const std::string&)>& failAt,
                          const FailAt& fail) {
  setSomeColumns(names, failAt);
  std::vector<std::string> missing;
  for (std::size_t i = 0; i < group_.variables.size(); ++i)
    if (std::ranges::find(columns_, static_cast<int>(i), &Column::place) == columns_.end())
      missing.push_back(robot_.variables()[group_.variables[i]].name);
  if (!missing.empty())
    fail("there are no values of " + joined(missing) + ", which group '" + group_.name + "' moves");
}

void PathRows::add(std::span<const double> values, int line, const FailAt& fail, bool mayJump) {
  std::vector<double> q(group_.variables.size());
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].place >= 0) q[static_cast<std::size_t>(columns_[i].place)] = values[i];
  if (!mayJump) noteTurns(q, line);
  before_ = q;
  const JudgedState judged = judgeState(robot_, group_, q);
  if (!judged.problem.empty()) fail(judged.problem);
  for (const TakenToLimit& taken : judged.taken)
    note(taken_, taken.variable, limitRemark(taken), line);
  requireStill(values, q, fail);
  states_.push_back(std::move(q));
}

void PathRows::requireStill(std::span<const double> values, std::span<const double> q,
                            const FailAt& fail) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    if (column.place >= 0) continue;
    if (column.variable >= 0) {
      const Variable& variable = robot_.variables()[column.variable];
      const double stays = reference_[column.variable];
      if (!(off(values[i], stays, variable.cyclic) <= tolerance::kLimit))
        fail(variable.name + " is " + exactNumber(values[i]) + ", but group '" + group_.name +
             "' does not move it: it has to stay at " + exactNumber(stays));
      continue;
    }
    const Joint& joint = robot_.joints()[column.joint];
    const std::string why = whyElsewhere(robot_, joint, values[i], [&](int variable) {
      const auto place = std::ranges::find(group_.variables, variable);
      return place == group_.variables.end()
                 ? reference_[variable]
                 : q[static_cast<std::size_t>(place - group_.variables.begin())];
    });
    if (!why.empty()) fail(joint.name + " is " + exactNumber(values[i]) + ", but the joint " + why);
  }
}

void PathRows::requireLike(std::span<const double> values, const std::vector<double>& state,
                           const std::string& where, const FailAt& fail) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].place < 0) continue;
    const Variable& variable = robot_.variables()[columns_[i].variable];
    const double there = state[static_cast<std::size_t>(columns_[i].place)];
    if (!(off(values[i], there, variable.cyclic) <= tolerance::kLimit))
      fail(variable.name + " is " + exactNumber(values[i]) + ", and " + where + " at " +
           exactNumber(there));
  }
  requireStill(values, state, fail);
}

bool PathRows::areAlike(std::size_t a, std::size_t b) const {
  for (std::size_t i = 0; i < group_.variables.size(); ++i) {
    const bool turns = robot_.variables()[group_.variables[i]].cyclic;
    if (!(off(states_[a][i], states_[b][i], turns) <= tolerance::kLimit)) return false;
  }
  return true;
}

void PathRows::noteTurns(std::span<const double> q, int line) {
  if (before_.empty()) return;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Variable& variable = robot_.variables()[group_.variables[i]];
    const double turn = std::abs(q[i] - before_[i]);
    if (variable.cyclic && turn > std::numbers::pi)
      note(turns_, variable.name,
           variable.name + " turns by " + shortNumber(turn) +
               " rad, more than half a turn, from the point before: what is looked at is the "
               "shorter way",
           line);
  }
}

void PathRows::note(std::map<std::string, Remark>& remarks, const std::string& key,
                    const std::string& text, int line) {
  const auto [remark, isFirst] = remarks.try_emplace(key, Remark{text, line, 0});
  if (!isFirst) ++remark->second.further;
}

void PathRows::tellRemarks() const {
  const auto textOf = [](const Remark& remark) {
    if (remark.further == 0) return remark.text;
    return remark.text + "; likewise at " + countedText(remark.further, "further point");
  };
  for (const auto& [name, remark] : taken_) source_.warn(remark.line, textOf(remark));
  for (const auto& [name, remark] : turns_) source_.warnOfUnchecked(remark.line, textOf(remark));
}

}  // namespace swept::detail
