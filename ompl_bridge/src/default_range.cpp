// SPDX-License-Identifier: BSD-3-Clause
#include "default_range.hpp"

#include <ompl/base/ScopedState.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "swept/ompl_bridge/state_space.hpp"
#include "swept/robot_model/limits.hpp"
#include "used_checker.hpp"

namespace swept::detail {

namespace {

namespace ob = ompl::base;

constexpr double kTurnStep = 0.4;    // rad
constexpr double kShareOfWay = 0.2;  // of the way of a joint that slides, or of a space's extent
constexpr double kSlide = 4.0;       // m, of a joint without limits

double stepOf(const Robot& robot, const Variable& variable) {
  const double way = variable.upper - variable.lower;
  if (unitOf(robot, variable) == "rad")
    return std::isfinite(way) ? std::min(kTurnStep, way) : kTurnStep;
  return std::isfinite(way) ? kShareOfWay * way : kSlide;
}

}  // namespace

double defaultRange(const ob::SpaceInformation& si) {
  const ob::StateSpacePtr& space = si.getStateSpace();
  const std::shared_ptr<const Checker> checker = checkerOf(si);
  if (checker == nullptr) return kShareOfWay * space->getMaximumExtent();
  const Robot& robot = checker->robot();
  std::vector<double> from, to;
  for (const int index : checker->group().variables) {
    const Variable& variable = robot.variables()[static_cast<std::size_t>(index)];
    // Components of a quaternion have no unit: here it turns about its first axis.
    if (unitOf(robot, variable).empty()) {
      const bool isReal = variable.name.ends_with("rot_w");
      const bool isFirst = variable.name.ends_with("rot_x");
      from.push_back(isReal ? 1.0 : 0.0);
      to.push_back(isReal ? std::cos(0.5 * kTurnStep) : isFirst ? std::sin(0.5 * kTurnStep) : 0.0);
      continue;
    }
    const double begin = std::isfinite(variable.lower) ? variable.lower : 0.0;
    from.push_back(begin);
    to.push_back(begin + stepOf(robot, variable));
  }
  const StateConversion conversion(robot, checker->group());
  ob::ScopedState<> a(space), b(space);
  conversion.toState(from, a.get());
  conversion.toState(to, b.get());
  return space->distance(a.get(), b.get());
}

}  // namespace swept::detail
