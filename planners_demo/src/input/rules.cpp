// SPDX-License-Identifier: BSD-3-Clause
#include "input/rules.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "command_line/exit_code.hpp"
#include "rules/name_pattern.hpp"

namespace swept {
namespace {

/// `NAME=NUMBER`; names of bodies may have a `=` in them.
std::pair<std::string, double> numberOf(const std::string& option, const std::string& text) {
  const std::size_t equals = text.rfind('=');
  const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
  char* end = nullptr;
  const double value = std::strtod(number.c_str(), &end);
  if (equals == 0 || number.empty() || *end != '\0')
    throw UsageError(option + " '" + text + "': expected NAME=NUMBER");
  return {text.substr(0, equals), value};
}

/// Whatever the world is.
bool isOfTheRobot(const std::string& name, const Robot& robot,
                  const std::vector<AttachedBody>& attached) {
  return name.empty() || name.find('*') != std::string::npos || robot.findLink(name) ||
         std::ranges::find(attached, name, &AttachedBody::name) != attached.end();
}

bool isIn(const World& world, const std::string& name) {
  return world.find(name) != nullptr || world.findObstacle(name) != nullptr;
}

}  // namespace

std::pair<std::string, std::string> namesOfPair(const std::string& option,
                                                const std::string& text) {
  const std::size_t comma = text.find(',');
  const bool two = comma != std::string::npos && comma > 0 && comma + 1 < text.size() &&
                   text.find(',', comma + 1) == std::string::npos;
  if (!two) throw UsageError(option + " '" + text + "': expected two names, A,B");
  return {text.substr(0, comma), text.substr(comma + 1)};
}

CollisionRules rulesOf(const Arguments& args) {
  CollisionRules rules;
  for (const std::string& text : args.pads) {
    const auto [name, metres] = numberOf("--pad", text);
    if (!(metres >= 0.0) || !std::isfinite(metres))
      throw UsageError("--pad '" + text + "': a padding must be 0 m or more, and finite");
    rules.pad(name, metres);
  }
  for (const std::string& text : args.scales) {
    const auto [name, factor] = numberOf("--scale", text);
    if (!(factor > 0.0) || !std::isfinite(factor))
      throw UsageError("--scale '" + text + "': a factor must be above 0, and finite");
    rules.scale(name, factor);
  }
  for (const std::string& text : args.allowed) {
    const auto [a, b] = namesOfPair("--allow", text);
    rules.allow(a, b, "--allow");
  }
  return rules;
}

CollisionRules rulesIn(const World& world, const CollisionRules& rules, const Robot& robot,
                       const std::vector<AttachedBody>& attached) {
  CollisionRules result = rules;
  for (const CollisionRules::Rule& rule : rules.rules())
    for (const std::string& name : {rule.bodyA, rule.bodyB})
      if (!isOfTheRobot(name, robot, attached) && !isIn(world, name)) result = result.without(name);
  return result;
}

std::vector<std::string> idlePatterns(const CollisionRules& rules, const Robot& robot,
                                      const std::vector<AttachedBody>& attached,
                                      const World& world) {
  std::vector<std::string> idle;
  for (const CollisionRules::Rule& rule : rules.rules())
    for (const std::string& name : {rule.bodyA, rule.bodyB}) {
      const auto fits = [&name](const auto& body) { return detail::matches(name, body.name); };
      if (detail::isPattern(name) && std::ranges::none_of(robot.links(), fits) &&
          std::ranges::none_of(attached, fits) && std::ranges::none_of(world.bodies(), fits) &&
          std::ranges::none_of(world.obstacles(), fits))
        idle.push_back(name);
    }
  return idle;
}

NamesOfBodies::NamesOfBodies(const CollisionRules& rules, const Robot& robot,
                             const std::vector<AttachedBody>& attached) {
  for (const CollisionRules::Rule& rule : rules.rules())
    for (const std::string& name : {rule.bodyA, rule.bodyB})
      if (!isOfTheRobot(name, robot, attached)) names_.push_back(name);
}

void NamesOfBodies::find(const World& world) {
  std::erase_if(names_, [&](const std::string& name) { return isIn(world, name); });
}

void NamesOfBodies::requireFound(const std::string& worlds) const {
  if (names_.empty()) return;
  throw UsageError("a rule names '" + names_.front() +
                   "', which is no link, attached body or body of " + worlds);
}

}  // namespace swept
