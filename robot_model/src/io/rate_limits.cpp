// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/rate_limits.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "io/yaml.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"
#include "swept/robot_model/did_you_mean.hpp"
#include "swept/robot_model/foreign_text.hpp"
#include "swept/robot_model/limits.hpp"
#include "swept/robot_model/text_file.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// Reads a `joint_limits.yaml` into the limits of a group.
class JointLimitsReader {
 public:
  JointLimitsReader(const Robot& robot, const Group& group, RateLimits& limits)
      : robot_(robot), group_(group), limits_(limits) {}

  void read(const detail::YamlPlace& root) {
    if (!root.isMap()) root.fail("limits of joints must be a mapping with 'joint_limits'");
    root.allowOnly(
        {"joint_limits", "default_velocity_scaling_factor", "default_acceleration_scaling_factor"});
    const detail::YamlPlace joints = root.at("joint_limits");
    if (!joints.present()) joints.fail("is missing");
    for (const auto& [name, joint] : joints.entries()) readJoint(name, joint);
    scale(root.at("default_velocity_scaling_factor"), limits_.velocity);
    scale(root.at("default_acceleration_scaling_factor"), limits_.acceleration);
  }

 private:
  void readJoint(const detail::YamlPlace& name, const detail::YamlPlace& joint) {
    joint.allowOnly({"has_position_limits", "min_position", "max_position", "has_velocity_limits",
                     "max_velocity", "has_acceleration_limits", "max_acceleration",
                     "has_deceleration_limits", "max_deceleration", "has_jerk_limits", "max_jerk",
                     "has_effort_limits", "max_effort", "angle_wraparound"});
    const std::optional<int> variable = variableOf(name);
    const std::optional<double> velocity = limitOf(joint, "velocity", false);
    const std::optional<double> acceleration = limitOf(joint, "acceleration", false);
    const std::optional<double> deceleration = limitOf(joint, "deceleration", true);
    const std::optional<double> jerk = limitOf(joint, "jerk", false);
    if (!variable) return;
    notePositions(joint, robot_.variables()[*variable]);
    const auto place = std::ranges::find(group_.variables, *variable);
    if (place == group_.variables.end()) return;
    const auto i = static_cast<std::size_t>(place - group_.variables.begin());
    if (velocity) limits_.velocity[i] = *velocity;
    limits_.acceleration[i] =
        std::min(acceleration.value_or(kUnlimited), deceleration.value_or(kUnlimited));
    limits_.jerk[i] = jerk.value_or(kUnlimited);
  }

  /// None for a joint without values of its own.
  std::optional<int> variableOf(const detail::YamlPlace& name) const {
    const std::string given = name.text();
    if (const auto variable = robot_.findVariable(given)) {
      if (isOrientation(robot_, robot_.variables()[*variable]))
        name.fail("has '" + given + "', a component of an orientation, which has no limits");
      return variable;
    }
    const auto joint = robot_.findJoint(given);
    if (!joint) {
      std::vector<std::string> known;
      for (const Variable& variable : robot_.variables()) known.push_back(variable.name);
      name.fail("has '" + given + "', which is no joint of robot '" + robot_.name() + "'" +
                didYouMean(given, known));
    }
    if (const int first = robot_.joints()[*joint].firstVariable; first >= 0)
      name.fail("has '" + given + "', a joint of several values, which are called " +
                robot_.variables()[first].name + " and so on");
    return std::nullopt;
  }

  /// Of `has_RATE_limits` and `max_RATE`; no value if the file does not say. `negative`: the limit
  /// is written so, and returned without its sign.
  static std::optional<double> limitOf(const detail::YamlPlace& joint, const std::string& rate,
                                       bool negative) {
    const detail::YamlPlace has = joint.at("has_" + rate + "_limits");
    const detail::YamlPlace most = joint.at("max_" + rate);
    if (!has.present()) {
      if (most.present()) most.fail("has no effect without has_" + rate + "_limits");
      return std::nullopt;
    }
    if (!has.boolean()) return kUnlimited;
    const double value = negative ? -most.number() : most.number();
    if (!(value > 0.0))
      most.fail("is '" + most.text() + "'; it must be " + (negative ? "negative" : "positive"));
    return value;
  }

  static void notePositions(const detail::YamlPlace& joint, const Variable& variable) {
    const detail::YamlPlace has = joint.at("has_position_limits");
    if (has.present() && !has.boolean()) return;
    const auto differs = [](const detail::YamlPlace& place, double limit) {
      return place.present() && !(std::abs(place.number() - limit) <= tolerance::kLimit);
    };
    for (const auto& [key, limit] :
         {std::pair{"min_position", variable.lower}, std::pair{"max_position", variable.upper}})
      if (const detail::YamlPlace place = joint.at(key); differs(place, limit))
        place.warn("is not used: " +
                   (variable.cyclic || std::isinf(limit)
                        ? std::string("the joint has no limits")
                        : "the limit of the URDF counts, " + detail::formatNumber(limit)));
  }

  static void scale(const detail::YamlPlace& place, std::vector<double>& limits) {
    if (!place.present()) return;
    const double factor = place.number();
    if (!(factor > 0.0 && factor <= 1.0))
      place.fail("is '" + place.text() + "'; it must be above 0 and at most 1");
    for (double& limit : limits) limit *= factor;
  }

  const Robot& robot_;
  const Group& group_;
  RateLimits& limits_;
};

}  // namespace

RateLimits RateLimits::of(const Robot& robot, const Group& group) {
  RateLimits limits;
  for (const int variable : group.variables)
    limits.velocity.push_back(robot.variables()[variable].velocity);
  limits.acceleration.assign(group.variables.size(), kUnlimited);
  limits.jerk.assign(group.variables.size(), kUnlimited);
  return limits;
}

RateLimits RateLimits::read(const std::filesystem::path& file, const Robot& robot,
                            const Group& group, const LoadOptions& options) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return read(file, robot, group, options); });
  }
  RateLimits limits = of(robot, group);
  const detail::InputSource source(file.string(), options);
  const detail::YamlPlace root = detail::YamlPlace::parse(readTextFile(file), source);
  try {
    JointLimitsReader(robot, group, limits).read(root);
  } catch (const YAML::Exception& error) {
    source.fail(error.mark.line + 1, "malformed YAML: " + foreignText(error.msg));
  }
  return limits;
}

}  // namespace swept
