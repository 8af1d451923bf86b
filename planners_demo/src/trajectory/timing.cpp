// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/timing.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/usage_error.hpp"

namespace swept {
namespace {

/// An orientation needs none: no timed path turns it.
void requireAll(const std::vector<double>& limits, const std::string& rate,
                const std::string& options, const Robot& robot, const Group& group,
                const char* user) {
  for (std::size_t i = 0; i < limits.size(); ++i) {
    const Variable& variable = robot.variables()[static_cast<std::size_t>(group.variables[i])];
    if (std::isinf(limits[i]) && !isOrientation(robot, variable))
      throw UsageError(std::string(user) + ": joint " + variable.name + " has no limit of " + rate +
                       ", which its times depend on; " + options);
  }
}

void scale(std::vector<double>& limits, double factor) {
  for (double& limit : limits) limit *= factor;
}

}  // namespace

RateLimits limitsOf(const Arguments& args, const Model& model, const Group& group) {
  if (args.limits.empty()) return RateLimits::of(*model.robot, group);
  return RateLimits::read(args.limits, *model.robot, group, model.options);
}

RateLimits timingLimits(const Arguments& args, const Model& model, const Group& group,
                        const char* user) {
  RateLimits limits = limitsOf(args, model, group);
  if (args.timing.maxAcceleration)
    for (double& limit : limits.acceleration)
      if (std::isinf(limit)) limit = *args.timing.maxAcceleration;
  const Robot& robot = *model.robot;
  requireAll(limits.velocity, "velocity", "--limits gives one", robot, group, user);
  requireAll(limits.acceleration, "acceleration", "--limits or --max-acceleration gives one", robot,
             group, user);
  if (args.timing.jerkLimited)
    requireAll(limits.jerk, "jerk", "--limits gives one", robot, group, user);
  const double speed = args.timing.speed;
  scale(limits.velocity, speed);
  scale(limits.acceleration, speed * speed);
  scale(limits.jerk, speed * speed * speed);
  return limits;
}

TimingOptions timingOptions(const Arguments& args) {
  TimingOptions options;
  options.jerkLimited = args.timing.jerkLimited;
  return options;
}

}  // namespace swept
