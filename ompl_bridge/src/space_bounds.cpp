// SPDX-License-Identifier: BSD-3-Clause
#include "space_bounds.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/base/spaces/SE3StateSpace.h>

#include <numbers>
#include <vector>

#include "preconditions.hpp"
#include "state_layout.hpp"

namespace swept::detail {

namespace {

namespace ob = ompl::base;

constexpr double kPi = std::numbers::pi;

void add(const ob::RealVectorBounds& translation, SpaceBounds& bounds) {
  bounds.lower.insert(bounds.lower.end(), translation.low.begin(), translation.low.end());
  bounds.upper.insert(bounds.upper.end(), translation.high.begin(), translation.high.end());
}

void add(double most, int count, SpaceBounds& bounds) {
  bounds.lower.insert(bounds.lower.end(), count, -most);
  bounds.upper.insert(bounds.upper.end(), count, most);
}

void addBounds(const ob::StateSpace& space, SubspaceKind kind, SpaceBounds& bounds) {
  switch (kind) {
    case SubspaceKind::RealVector:
      add(space.as<ob::RealVectorStateSpace>()->getBounds(), bounds);
      break;
    case SubspaceKind::SO2:
      add(kPi, 1, bounds);
      break;
    case SubspaceKind::SE2:
      add(space.as<ob::SE2StateSpace>()->getBounds(), bounds);
      add(kPi, 1, bounds);
      break;
    case SubspaceKind::SE3:
      add(space.as<ob::SE3StateSpace>()->getBounds(), bounds);
      bounds.quaternions.push_back(static_cast<int>(bounds.lower.size()));
      add(1.0, 4, bounds);
      break;
  }
}

}  // namespace

SpaceBounds boundsOf(const ob::StateSpace& space, const Checker& checker) {
  const ob::StateSpace& inner = unwrapped(space);
  const std::vector<JointRun> runs = jointRuns(checker.robot(), checker.group());
  const bool single = isSingleRealVector(runs);
  SpaceBounds bounds;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const auto index = static_cast<unsigned int>(i);
    const ob::StateSpace* part =
        single ? &inner : inner.as<ob::CompoundStateSpace>()->getSubspace(index).get();
    addBounds(*part, runs[i].kind, bounds);
  }
  return bounds;
}

}  // namespace swept::detail
