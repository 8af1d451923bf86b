// SPDX-License-Identifier: BSD-3-Clause
#include "io/group_columns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>

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

/// Why a joint without a value of its own does not have this rate; empty: it has.
std::string whyAnotherRate(const Robot& robot, const Joint& joint, double rate,
                           const std::function<double(int variable)>& rateOf) {
  constexpr double kPlay = 1e-3;  // of 1 and of the rate: a rounded multiplier
  if (!joint.mimic) return std::abs(rate) <= kPlay ? "" : "does not move";
  const Joint& master = robot.joints()[joint.mimic->master];
  const double wanted = joint.mimic->multiplier * rateOf(master.firstVariable);
  if (std::abs(rate - wanted) <= kPlay * std::max(1.0, std::abs(wanted))) return {};
  return "follows '" + master.name + "' at " + exactNumber(wanted);
}

/// What names of the cell's robot begin with whose joints a group has.
std::string ownerOf(const Robot& robot, const Group& group) {
  std::string owner;
  for (const int joint : group.joints) {
    const std::string& name = robot.joints()[static_cast<std::size_t>(joint)].name;
    const std::string own = name.substr(0, name.find('/') + 1);
    if (own.empty() || (!owner.empty() && own != owner)) return {};
    owner = own;
  }
  return owner;
}

}  // namespace

GroupColumns::GroupColumns(const Robot& robot, const Group& group, const Eigen::VectorXd& reference)
    : robot_(robot), group_(group), reference_(reference), owner_(ownerOf(robot, group)) {}

std::optional<std::size_t> GroupColumns::placeOf(int variable) const {
  const auto place = std::ranges::find(group_.variables, variable);
  if (place == group_.variables.end()) return std::nullopt;
  return static_cast<std::size_t>(place - group_.variables.begin());
}

bool GroupColumns::knows(const std::string& name) const {
  const auto has = [this](const std::string& own) {
    return robot_.findVariable(own) || robot_.findJoint(own);
  };
  return has(name) || (!owner_.empty() && has(owner_ + name));
}

GroupColumns::Column GroupColumns::columnOf(const std::string& name, const FailAt& fail) const {
  Column column;
  if (const auto variable = robot_.findVariable(name)) {
    column.variable = *variable;
    column.joint = robot_.variables()[*variable].joint;
    if (const auto place = placeOf(*variable)) column.place = static_cast<int>(*place);
    return column;
  }
  const auto joint = robot_.findJoint(name);
  if (!joint && knows(name)) return columnOf(owner_ + name, fail);
  if (!joint)
    fail("is '" + name + "', which is no joint of robot '" + robot_.name() + "'; group '" +
         group_.name + "' has " + joined(variableNames(robot_, group_)));
  column.joint = *joint;
  const int first = robot_.joints()[*joint].firstVariable;
  if (first >= 0)
    fail("is '" + name + "', a joint of several values, which are called " +
         robot_.variables()[first].name + " and so on");
  return column;
}

void GroupColumns::set(std::span<const std::string> names, const FailAtColumn& failAt) {
  columns_.clear();
  std::set<std::string> known;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const FailAt fail = [&](const std::string& message) { failAt(i, message); };
    if (!known.insert(names[i]).second) fail("is '" + names[i] + "' a second time");
    const Column column = columnOf(names[i], fail);
    // With and without its robot's name it is the same one.
    const auto same = [&](const Column& other) {
      return other.variable == column.variable && other.joint == column.joint;
    };
    if (std::ranges::any_of(columns_, same)) fail("is '" + names[i] + "' a second time");
    columns_.push_back(column);
  }
}

std::vector<std::string> GroupColumns::missing() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < group_.variables.size(); ++i)
    if (std::ranges::find(columns_, static_cast<int>(i), &Column::place) == columns_.end())
      names.push_back(robot_.variables()[group_.variables[i]].name);
  return names;
}

void GroupColumns::requireWholeGroup(const FailAt& fail) const {
  const std::vector<std::string> names = missing();
  if (!names.empty())
    fail("there are no values of " + joined(names) + ", which group '" + group_.name + "' moves");
}

bool GroupColumns::haveOfGroup(std::size_t begin, std::size_t end) const {
  return std::any_of(columns_.begin() + static_cast<std::ptrdiff_t>(begin),
                     columns_.begin() + static_cast<std::ptrdiff_t>(end),
                     [](const Column& column) { return column.place >= 0; });
}

std::vector<double> GroupColumns::ofGroup(std::span<const double> row) const {
  std::vector<double> q(group_.variables.size());
  for (std::size_t i = 0; i < columns_.size(); ++i)
    if (columns_[i].place >= 0) q[static_cast<std::size_t>(columns_[i].place)] = row[i];
  return q;
}

void GroupColumns::requireStill(std::span<const double> row, std::span<const double> q,
                                const FailAt& fail) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    if (column.place >= 0) continue;
    if (column.variable >= 0) {
      const Variable& variable = robot_.variables()[column.variable];
      const double stays = reference_[column.variable];
      if (!(off(row[i], stays, variable.cyclic) <= tolerance::kLimit))
        fail(variable.name + " is " + exactNumber(row[i]) + ", but group '" + group_.name +
             "' does not move it: it has to stay at " + exactNumber(stays));
      continue;
    }
    const Joint& joint = robot_.joints()[column.joint];
    const std::string why = whyElsewhere(robot_, joint, row[i], [&](int variable) {
      const auto place = placeOf(variable);
      return place ? q[*place] : reference_[variable];
    });
    if (!why.empty()) fail(joint.name + " is " + exactNumber(row[i]) + ", but the joint " + why);
  }
}

void GroupColumns::requireStillRates(const std::string& rate, std::span<const double> row,
                                     std::span<const double> rates, const FailAt& fail) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const Column& column = columns_[i];
    if (column.place >= 0) continue;
    const auto refuse = [&](const std::string& name, const std::string& why) {
      fail("the " + rate + " of " + name + " is " + exactNumber(row[i]) + ", but " + why);
    };
    if (column.variable >= 0) {
      if (!(std::abs(row[i]) <= tolerance::kLimit))
        refuse(robot_.variables()[column.variable].name,
               "group '" + group_.name + "' does not move it: it has to be 0");
      continue;
    }
    const Joint& joint = robot_.joints()[column.joint];
    const std::string why = whyAnotherRate(robot_, joint, row[i], [&](int variable) {
      const auto place = placeOf(variable);
      return place ? rates[*place] : 0.0;
    });
    if (!why.empty()) refuse(joint.name, "the joint " + why);
  }
}

void GroupColumns::requireLike(std::span<const double> row, std::span<const double> q,
                               const std::string& where, const FailAt& fail) const {
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (columns_[i].place < 0) continue;
    const Variable& variable = robot_.variables()[columns_[i].variable];
    const double there = q[static_cast<std::size_t>(columns_[i].place)];
    if (!(off(row[i], there, variable.cyclic) <= tolerance::kLimit))
      fail(variable.name + " is " + exactNumber(row[i]) + ", and " + where + " at " +
           exactNumber(there));
  }
  requireStill(row, q, fail);
}

bool GroupColumns::areAlike(std::span<const double> a, std::span<const double> b) const {
  for (std::size_t i = 0; i < group_.variables.size(); ++i) {
    const bool turns = robot_.variables()[group_.variables[i]].cyclic;
    if (!(off(a[i], b[i], turns) <= tolerance::kLimit)) return false;
  }
  return true;
}

Eigen::VectorXd referenceOf(const Robot& robot, const std::optional<Eigen::VectorXd>& reference) {
  Eigen::VectorXd still = reference.value_or(robot.defaultState());
  if (still.size() != std::ssize(robot.variables()))
    throw std::invalid_argument("a reference has " + std::to_string(robot.variables().size()) +
                                " values, not " + std::to_string(still.size()));
  return still;
}

std::vector<std::string> variableNames(const Robot& robot, const Group& group) {
  std::vector<std::string> names;
  for (const int variable : group.variables) names.push_back(robot.variables()[variable].name);
  return names;
}

}  // namespace swept::detail
