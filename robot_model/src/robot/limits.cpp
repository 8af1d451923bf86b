// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <stdexcept>

#include "robot/joint_types.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

namespace {

std::string withDigits(double value, int digits) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.*g", digits, value);
  return buffer.data();
}

/// Whether the texts differ as much as the values do, to a twentieth, so that different values
/// never look alike.
bool showDifferences(std::span<const double> values, std::span<const std::string> texts) {
  constexpr double kShare = 0.05;
  for (std::size_t i = 0; i < values.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      const double difference = values[i] - values[k];
      const double shown =
          std::strtod(texts[i].c_str(), nullptr) - std::strtod(texts[k].c_str(), nullptr);
      if (std::abs(shown - difference) > kShare * std::abs(difference)) return false;
    }
  }
  return true;  // for infinity and NaN, six digits are as good as more
}

/// Of the variable among its joint's.
int placeOf(const Robot& robot, const Variable& variable) {
  const auto index = &variable - robot.variables().data();
  return static_cast<int>(index) - robot.joints()[variable.joint].firstVariable;
}

bool isOrientation(JointType type, int place) {
  const std::optional<int> first = detail::quaternionPlace(type);
  return first && place >= *first && place < *first + 4;
}

/// `2e-05 beyond`
std::string excessText(double excess) {
  return withDigits(excess, 3) + " beyond";
}

}  // namespace

std::optional<double> limitNear(const Variable& variable, double value) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return limitNear(variable, value); });
  }
  if (variable.cyclic || !isWithin(value, variable.lower, variable.upper)) return std::nullopt;
  if (value < variable.lower) return variable.lower;
  if (value > variable.upper) return variable.upper;
  return std::nullopt;
}

bool isOrientation(const Robot& robot, const Variable& variable) {
  return isOrientation(robot.joints()[variable.joint].type, placeOf(robot, variable));
}

std::vector<TakenToLimit> takeToLimits(const Robot& robot, const Group& group,
                                       ConfigurationSpan q) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return takeToLimits(robot, group, q); });
  }
  if (q.size() != group.variables.size())
    throw std::invalid_argument("a configuration of the group has " +
                                std::to_string(group.variables.size()) + " values, not " +
                                std::to_string(q.size()));
  std::vector<TakenToLimit> taken;
  for (std::size_t i = 0; i < q.size(); ++i) {
    const Variable& variable = robot.variables()[group.variables[i]];
    const std::optional<double> limit = limitNear(variable, q[i]);
    if (!limit || isOrientation(robot, variable)) continue;
    taken.push_back({variable.name, q[i], *limit, unitOf(robot, variable)});
    q[i] = *limit;
  }
  return taken;
}

std::string limitRemark(const TakenToLimit& taken, const std::string& done) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return limitRemark(taken, done); });
  }
  const std::array numbers{taken.value, taken.limit};
  const std::vector<std::string> texts = distinctNumbers(numbers);
  return taken.variable + " is " + texts[0] + (taken.unit.empty() ? "" : " " + taken.unit) + ", " +
         excessText(std::abs(taken.value - taken.limit)) + " its limit " + texts[1] + ": " + done;
}

std::string outsideText(const std::string& name, double value, double lower, double upper,
                        const std::string& unit) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return outsideText(name, value, lower, upper, unit); });
  }
  constexpr double kSmall = 1e-3;  // rad or m
  const std::array numbers{value, lower, upper};
  const std::vector<std::string> texts = distinctNumbers(numbers);
  const double excess = std::max(lower - value, value - upper);
  return name + " is " + texts[0] + ", allowed is " + texts[1] + " to " + texts[2] +
         (unit.empty() ? "" : " " + unit) +
         (excess < kSmall ? " (" + excessText(excess) + ")" : "");
}

std::vector<std::string> distinctNumbers(std::span<const double> values) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return distinctNumbers(values); });
  }
  constexpr int kFewest = 6;
  constexpr int kMost = 17;  // distinguishes all doubles
  std::vector<std::string> texts(values.size());
  for (int digits = kFewest; digits <= kMost; ++digits) {
    std::ranges::transform(values, texts.begin(),
                           [&](double value) { return withDigits(value, digits); });
    if (showDifferences(values, texts)) break;
  }
  return texts;
}

std::string unitOf(const Joint& joint, int place) {
  if (detail::isLength(joint.type, place)) return "m";
  return isOrientation(joint.type, place) ? "" : "rad";
}

std::string unitOf(const Robot& robot, const Variable& variable) {
  return unitOf(robot.joints()[variable.joint], placeOf(robot, variable));
}

}  // namespace swept
