// SPDX-License-Identifier: BSD-3-Clause
#include "preconditions.hpp"

#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>
#include <ompl/base/spaces/SO2StateSpace.h>
#include <ompl/geometric/planners/cforest/CForest.h>
#include <ompl/geometric/planners/cforest/CForestStateSpaceWrapper.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <typeinfo>
#include <vector>

#include "group_space.hpp"
#include "joint_space.hpp"
#include "state_layout.hpp"

namespace swept::detail {

namespace {

namespace ob = ompl::base;

/// Not derived spaces: they may interpolate differently, or hold other states than they declare.
template <typename... Spaces>
bool isOneOf(const ob::StateSpace& space) {
  return ((typeid(space) == typeid(Spaces)) || ...);
}

bool interpolatesAsCertified(const ob::StateSpace& space) {
  if (isOneOf<ob::CompoundStateSpace, GroupSpace<ob::CompoundStateSpace>>(space)) {
    const auto& parts = space.as<ob::CompoundStateSpace>()->getSubspaces();
    return std::ranges::all_of(parts,
                               [](const auto& part) { return interpolatesAsCertified(*part); });
  }
  return isOneOf<JointSpace, GroupSpace<JointSpace>, ob::RealVectorStateSpace, ob::SO2StateSpace,
                 ob::SE2StateSpace, ob::SE3StateSpace>(space);
}

/// The variables for which makeStateSpace built the space; null: somebody else built it.
const std::vector<std::string>* variablesOf(const ob::StateSpace& space) {
  if (const auto* joints = dynamic_cast<const GroupSpace<JointSpace>*>(&space))
    return &joints->variables();
  if (const auto* compound = dynamic_cast<const GroupSpace<ob::CompoundStateSpace>*>(&space))
    return &compound->variables();
  return nullptr;
}

}  // namespace

std::vector<std::string> variablesOf(const Robot& robot, const Group& group) {
  std::vector<std::string> names;
  for (const int index : group.variables) names.push_back(robot.variables()[index].name);
  return names;
}

const ob::StateSpace& unwrapped(const ob::StateSpace& space) {
  const auto* wrapper = dynamic_cast<const ob::CForestStateSpaceWrapper*>(&space);
  if (wrapper == nullptr) return space;
  return *wrapper->getCForestInstance()->getSpaceInformation()->getStateSpace();
}

void requireSpaceOf(const Checker& checker, const ompl::base::StateSpace& space) {
  const ob::StateSpace& inner = unwrapped(space);
  std::vector<int> wanted, given;
  const std::string refused = "state space `" + inner.getName() +
                              "` is not built as makeStateSpace does for group `" +
                              checker.group().name + "`";
  if (!interpolatesAsCertified(inner)) {
    throw std::invalid_argument(refused + ": its motions are not those that are certified");
  }
  unprojectedSpace(checker.robot(), checker.group())->computeSignature(wanted);
  inner.computeSignature(given);
  if (given != wanted) throw std::invalid_argument(refused);
  // A left and a right arm have the same layout. Whoever built a space by hand must know whose it
  // is.
  const std::vector<std::string>* variables = variablesOf(inner);
  if (variables != nullptr && *variables != variablesOf(checker.robot(), checker.group()))
    throw std::invalid_argument(refused + ": it is of another group's variables");
}

std::shared_ptr<const Checker> requireChecker(std::shared_ptr<const Checker> checker,
                                              const ompl::base::StateSpace& space) {
  if (!checker) throw std::invalid_argument("no checker given");
  if (!checker->world().obstacles().empty()) {
    throw std::invalid_argument("the checker's world has a moving obstacle, `" +
                                checker->world().obstacles().front().name +
                                "`, and states of the space have no time");
  }
  requireSpaceOf(*checker, space);
  return checker;
}

}  // namespace swept::detail
