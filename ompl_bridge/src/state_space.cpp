// SPDX-License-Identifier: BSD-3-Clause
#include <ompl/base/ProjectionEvaluator.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>

#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "state_layout.hpp"
#include "swept/ompl_bridge/ompl_bridge.hpp"

namespace swept {
namespace ob = ompl::base;
using detail::JointRun;
using detail::SubspaceKind;
namespace {

constexpr double kUnboundedTranslation = 10.0;  // m

ob::RealVectorBounds boundsOf(const Robot& robot, std::span<const int> variables) {
  ob::RealVectorBounds bounds(static_cast<unsigned int>(variables.size()));
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const Variable& variable = robot.variables()[variables[i]];
    double lower = variable.lower, upper = variable.upper;
    if (!std::isfinite(lower)) {
      lower = std::isfinite(upper) ? upper - 2.0 * kUnboundedTranslation : -kUnboundedTranslation;
    }
    if (!std::isfinite(upper)) upper = lower + 2.0 * kUnboundedTranslation;
    bounds.low[i] = lower;
    bounds.high[i] = upper;
  }
  return bounds;
}

void nameDimensions(const Robot& robot, std::span<const int> variables, ob::StateSpace& space) {
  auto* realVector = space.as<ob::RealVectorStateSpace>();
  for (std::size_t i = 0; i < variables.size(); ++i) {
    realVector->setDimensionName(static_cast<unsigned int>(i),
                                 robot.variables()[variables[i]].name);
  }
}

ob::StateSpacePtr spaceOf(const Robot& robot, const JointRun& run) {
  const std::span<const int> variables(run.variables);
  switch (run.kind) {
    case SubspaceKind::SO2:
      return std::make_shared<ob::SO2StateSpace>();
    case SubspaceKind::SE2: {
      auto space = std::make_shared<ob::SE2StateSpace>();
      space->setBounds(boundsOf(robot, variables.first(2)));
      nameDimensions(robot, variables.first(2), *space->getSubspace(0));
      return space;
    }
    case SubspaceKind::SE3: {
      auto space = std::make_shared<ob::SE3StateSpace>();
      space->setBounds(boundsOf(robot, variables.first(3)));
      nameDimensions(robot, variables.first(3), *space->getSubspace(0));
      return space;
    }
    case SubspaceKind::RealVector:
      break;
  }
  auto space =
      std::make_shared<ob::RealVectorStateSpace>(static_cast<unsigned int>(variables.size()));
  space->setBounds(boundsOf(robot, variables));
  nameDimensions(robot, variables, *space);
  return space;
}

std::string nameOf(const Robot& robot, const JointRun& run) {
  const std::string& first = robot.joints()[run.joints.front()].name;
  if (run.joints.size() == 1) return first;
  return first + ".." + robot.joints()[run.joints.back()].name;
}

// Planners of the KPIECE family need a default projection, which OMPL gives to no compound.
void registerProjection(ob::CompoundStateSpace& space) {
  unsigned int largest = 0;
  for (unsigned int i = 1; i < space.getSubspaceCount(); ++i) {
    const bool larger =
        space.getSubspace(i)->getDimension() > space.getSubspace(largest)->getDimension();
    if (larger) largest = i;
  }
  space.registerDefaultProjection(
      std::make_shared<ob::SubspaceProjectionEvaluator>(&space, largest));
}

}  // namespace

ob::StateSpacePtr makeStateSpace(const Robot& robot, const Group& group) {
  const std::vector<JointRun> runs = detail::jointRuns(robot, group);
  ob::StateSpacePtr space;
  if (detail::isSingleRealVector(runs)) {
    space = spaceOf(robot, runs.front());
  } else {
    auto compound = std::make_shared<ob::CompoundStateSpace>();
    for (const JointRun& run : runs) {
      ob::StateSpacePtr subspace = spaceOf(robot, run);
      subspace->setName(nameOf(robot, run));
      compound->addSubspace(subspace, 1.0);
    }
    compound->lock();
    registerProjection(*compound);
    space = compound;
  }
  space->setName(group.name);
  return space;
}

}  // namespace swept
