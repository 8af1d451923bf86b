// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "group_space.hpp"
#include "joint_space.hpp"
#include "limit_warning.hpp"
#include "number_text.hpp"
#include "preconditions.hpp"
#include "state_layout.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/limits.hpp"
#include "tip_projection.hpp"

namespace swept {
namespace ob = ompl::base;
using detail::GroupSpace;
using detail::JointRun;
using detail::JointSpace;
using detail::numberText;
using detail::SubspaceKind;
namespace {

constexpr double kUnboundedTranslation = 10.0;  // m

[[noreturn]] void refuse(const std::string& what) {
  throw std::invalid_argument("state space: " + what);
}

std::pair<double, double> limitsOf(const Variable& variable, const StateSpaceOptions& options) {
  double lower = variable.lower, upper = variable.upper;
  const auto narrower = options.limits.find(variable.name);
  if (narrower != options.limits.end()) {
    auto [low, high] = narrower->second;
    low = limitNear(variable, low).value_or(low);
    high = limitNear(variable, high).value_or(high);
    if (!(low < high) || !std::isfinite(low) || !std::isfinite(high)) {
      refuse("limits [" + numberText(low) + ", " + numberText(high) + "] of `" + variable.name +
             "` are not two finite numbers, the lower one first");
    }
    if (low < lower || high > upper) {
      const std::vector<std::string> texts = distinctNumbers(std::array{low, high, lower, upper});
      refuse("limits [" + texts[0] + ", " + texts[1] + "] of `" + variable.name +
             "` are not within the robot's [" + texts[2] + ", " + texts[3] + "]");
    }
    return {low, high};
  }
  if (!std::isfinite(lower)) {
    lower = std::isfinite(upper) ? upper - 2.0 * kUnboundedTranslation : -kUnboundedTranslation;
  }
  if (!std::isfinite(upper)) upper = lower + 2.0 * kUnboundedTranslation;
  return {lower, upper};
}

ob::RealVectorBounds boundsOf(const Robot& robot, std::span<const int> variables,
                              const StateSpaceOptions& options) {
  ob::RealVectorBounds bounds(static_cast<unsigned int>(variables.size()));
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const auto [lower, upper] = limitsOf(robot.variables()[variables[i]], options);
    bounds.low[i] = lower;
    bounds.high[i] = upper;
  }
  return bounds;
}

double weightOf(const Robot& robot, int joint, const StateSpaceOptions& options) {
  const auto given = options.weights.find(robot.joints()[joint].name);
  return given == options.weights.end() ? 1.0 : given->second;
}

void nameDimensions(const Robot& robot, std::span<const int> variables, ob::StateSpace& space) {
  auto* realVector = space.as<ob::RealVectorStateSpace>();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    realVector->setDimensionName(static_cast<unsigned int>(i),
                                 robot.variables()[variables[i]].name);
  }
}

std::vector<double> weightsOf(const Robot& robot, const JointRun& run,
                              const StateSpaceOptions& options) {
  std::vector<double> weights;
  for (const int joint : run.joints) weights.push_back(weightOf(robot, joint, options));
  return weights;
}

void limitJoints(const Robot& robot, const JointRun& run, const StateSpaceOptions& options,
                 JointSpace& space) {
  space.setBounds(boundsOf(robot, run.variables, options));
  nameDimensions(robot, run.variables, space);
}

ob::StateSpacePtr spaceOf(const Robot& robot, const JointRun& run,
                          const StateSpaceOptions& options) {
  const std::span<const int> variables(run.variables);
  switch (run.kind) {
    case SubspaceKind::SO2:
      return std::make_shared<ob::SO2StateSpace>();
    case SubspaceKind::SE2: {
      auto space = std::make_shared<ob::SE2StateSpace>();
      space->setBounds(boundsOf(robot, variables.first(2), options));
      nameDimensions(robot, variables.first(2), *space->getSubspace(0));
      return space;
    }
    case SubspaceKind::SE3: {
      auto space = std::make_shared<ob::SE3StateSpace>();
      space->setBounds(boundsOf(robot, variables.first(3), options));
      nameDimensions(robot, variables.first(3), *space->getSubspace(0));
      return space;
    }
    case SubspaceKind::RealVector:
      break;
  }
  auto space = std::make_shared<JointSpace>(weightsOf(robot, run, options));
  limitJoints(robot, run, options, *space);
  return space;
}

std::string nameOf(const Robot& robot, const JointRun& run) {
  const std::string& first = robot.joints()[run.joints.front()].name;
  if (run.joints.size() == 1) return first;
  return first + ".." + robot.joints()[run.joints.back()].name;
}

/// Checks the names in the options: that they exist, and can have these settings.
void requireOptions(const Robot& robot, const Group& group, const StateSpaceOptions& options) {
  for (const auto& [name, limits] : options.limits) {
    const std::optional<int> index = robot.findVariable(name);
    if (!index || std::ranges::find(group.variables, *index) == group.variables.end()) {
      refuse("group `" + group.name + "` has no variable `" + name + "` to limit");
    }
    const Variable& variable = robot.variables()[*index];
    if (variable.cyclic || isOrientation(robot, variable))
      refuse("`" + name + "` is an angle without limits, or part of an orientation");
    for (const double value : {limits.first, limits.second}) {
      const std::optional<double> limit = limitNear(variable, value);
      if (limit) detail::warnOfLimit({name, value, *limit, unitOf(robot, variable)}, "limits");
    }
  }
  for (const auto& [name, weight] : options.weights) {
    const std::optional<int> index = robot.findJoint(name);
    if (!index || std::ranges::find(group.joints, *index) == group.joints.end()) {
      refuse("group `" + group.name + "` has no joint `" + name + "` to weigh");
    }
    if (!(weight > 0.0) || !std::isfinite(weight)) {
      refuse("weight " + numberText(weight) + " of `" + name +
             "` is not a finite number greater than zero");
    }
  }
}

template <typename Space>
ob::StateSpacePtr finished(const std::shared_ptr<Space>& space, const Robot& robot,
                           const Group& group, bool isProjected) {
  space->setName(group.name);
  space->setVariables(detail::variablesOf(robot, group));
  if (isProjected) space->setProjection(detail::makeProjection(*space, robot, group));
  return space;
}

ob::StateSpacePtr layOut(const Robot& robot, const Group& group, const StateSpaceOptions& options,
                         bool isProjected) {
  const std::vector<JointRun> runs = detail::jointRuns(robot, group);
  requireOptions(robot, group, options);
  if (detail::isSingleRealVector(runs)) {
    const auto space =
        std::make_shared<GroupSpace<JointSpace>>(weightsOf(robot, runs.front(), options));
    limitJoints(robot, runs.front(), options, *space);
    return finished(space, robot, group, isProjected);
  }
  const auto compound = std::make_shared<GroupSpace<ob::CompoundStateSpace>>();
  for (const JointRun& run : runs) {
    ob::StateSpacePtr subspace = spaceOf(robot, run, options);
    subspace->setName(nameOf(robot, run));
    // Joints with limits have theirs in their common space.
    const bool shared = run.kind == SubspaceKind::RealVector;
    compound->addSubspace(subspace, shared ? 1.0 : weightOf(robot, run.joints.front(), options));
  }
  compound->lock();
  return finished(compound, robot, group, isProjected);
}

}  // namespace

std::map<std::string, std::pair<double, double>> limitsAround(
    const Robot& robot, const Group& group, const ConfigurationList& configurations) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return limitsAround(robot, group, configurations); });
  }
  std::map<std::string, std::pair<double, double>> limits;
  for (const ConfigurationView& q : configurations) {
    if (q.size() != group.variables.size())
      throw std::invalid_argument("limitsAround: a configuration of " + std::to_string(q.size()) +
                                  " values; group `" + group.name + "` has " +
                                  std::to_string(group.variables.size()));
    for (std::size_t i = 0; i < q.size(); ++i) {
      const Variable& variable = robot.variables()[group.variables[i]];
      const auto [low, high] = limitsOf(variable, {.limits = limits});
      const bool below = q[i] < low && variable.lower < low && std::isfinite(q[i]);
      const bool above = q[i] > high && variable.upper > high && std::isfinite(q[i]);
      if (!below && !above) continue;
      limits[variable.name] = {
          below ? std::max(variable.lower, q[i] - kUnboundedTranslation) : low,
          above ? std::min(variable.upper, q[i] + kUnboundedTranslation) : high};
    }
  }
  return limits;
}

ob::StateSpacePtr makeStateSpace(const Robot& robot, const Group& group,
                                 const StateSpaceOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return makeStateSpace(robot, group, options); });
  }
  return layOut(robot, group, options, true);
}

ob::StateSpacePtr detail::unprojectedSpace(const Robot& robot, const Group& group) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return unprojectedSpace(robot, group); });
  }
  return layOut(robot, group, {}, false);
}

}  // namespace swept
