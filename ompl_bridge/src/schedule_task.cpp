// SPDX-License-Identifier: BSD-3-Clause
#include "schedule_task.hpp"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "number_text.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept::detail {

namespace {

constexpr double kTurnRange = 0.8;   // rad, of a tree's longest step
constexpr double kSlideShare = 0.2;  // of the way of a joint that slides, likewise
/// Of the limit of acceleration, in the search: blends of the final curve then fit between its
/// straight motions.
constexpr double kPlannedShare = 0.998;
constexpr double kRatesShare = 1.0 - 1e-6;  // of the limits, for the rounding of times

Eigen::VectorXd vectorOf(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), std::ssize(values));
}

class TaskReader {
 public:
  TaskReader(const Checker& checker, const ScheduleTask& task, std::size_t index)
      : robot_(checker.robot()), task_(task), of_("task " + std::to_string(index + 1)) {}

  OwnTask read() {
    const Group* group = robot_.findGroup(task_.group);
    requirePlan(group != nullptr, of_ + ": there is no group '" + task_.group + "'");
    const auto size = static_cast<Eigen::Index>(group->variables.size());
    requireCount(task_.limits.velocity.size(), group->variables.size(), "limits of velocity");
    requireCount(task_.limits.acceleration.size(), group->variables.size(),
                 "limits of acceleration");
    requirePlan(!task_.goals.empty(), of_ + " has no goal");
    OwnTask own;
    OwnSpace& space = own.space;
    space.lower.resize(size);
    space.upper.resize(size);
    space.cyclic.resize(size);
    space.range.resize(size);
    space.bounds = {Eigen::ArrayXd(size), Eigen::ArrayXd(size)};
    for (Eigen::Index v = 0; v < size; ++v) {
      const Variable& variable =
          robot_
              .variables()[static_cast<std::size_t>(group->variables[static_cast<std::size_t>(v)])];
      own.names.push_back(variable.name);
      addVariable(variable, v, space);
    }
    space.planned = {kRatesShare * space.bounds.velocity,
                     kPlannedShare * space.bounds.acceleration};
    own.start = configuration(task_.start, *group, "start");
    for (const std::vector<double>& goal : task_.goals)
      own.goals.push_back(configuration(goal, *group, "goal"));
    return own;
  }

 private:
  void requireCount(std::size_t count, std::size_t expected, const std::string& what) const {
    requirePlan(count == expected, of_ + " has " + std::to_string(count) + " " + what +
                                       ", expected " + std::to_string(expected));
  }

  double rateOf(const std::string& name, double limit, const std::string& what) const {
    requirePlan(std::isfinite(limit) && limit > 0.0, of_ + ": the limit of " + what + " of '" +
                                                         name + "' is " + numberText(limit) +
                                                         "; allowed are finite numbers above 0");
    return limit;
  }

  void addVariable(const Variable& variable, Eigen::Index v, OwnSpace& space) const {
    const auto i = static_cast<std::size_t>(v);
    requirePlan(!isOrientation(robot_, variable), of_ + ": '" + variable.name +
                                                      "' is of an orientation, which is not "
                                                      "planned in time");
    const double way = variable.upper - variable.lower;
    requirePlan(variable.cyclic || std::isfinite(way),
                of_ + ": '" + variable.name + "' has no limits of position to plan between");
    space.cyclic[v] = variable.cyclic;
    space.lower[v] = variable.cyclic ? -std::numbers::pi : variable.lower;
    space.upper[v] = variable.cyclic ? std::numbers::pi : variable.upper;
    space.range[v] = unitOf(robot_, variable) == "rad" ? kTurnRange : kSlideShare * way;
    space.bounds.velocity[v] =
        kRatesShare * rateOf(variable.name, task_.limits.velocity[i], "velocity");
    space.bounds.acceleration[v] =
        kRatesShare * rateOf(variable.name, task_.limits.acceleration[i], "acceleration");
  }

  Eigen::VectorXd configuration(const std::vector<double>& values, const Group& group,
                                const std::string& which) const {
    requireCount(values.size(), group.variables.size(), "values of a " + which);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const Variable& variable = robot_.variables()[static_cast<std::size_t>(group.variables[i])];
      requirePlan(std::isfinite(values[i]),
                  of_ + ": the " + which + "'s value of '" + variable.name + "' is not finite");
      requirePlan(variable.cyclic || isWithin(values[i], variable.lower, variable.upper),
                  of_ + ": the " + which + "'s " +
                      outsideText(variable.name, values[i], variable.lower, variable.upper,
                                  unitOf(robot_, variable)));
    }
    return vectorOf(values);
  }

  const Robot& robot_;
  const ScheduleTask& task_;
  const std::string of_;
};

}  // namespace

void requirePlan(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument("planSchedule: " + message);
}

OwnTask readTask(const Checker& checker, const ScheduleTask& task, std::size_t index) {
  return TaskReader(checker, task, index).read();
}

}  // namespace swept::detail
