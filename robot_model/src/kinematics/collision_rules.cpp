// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/collision_rules.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "io/numbers.hpp"
#include "kinematics/name_pattern.hpp"

namespace swept {

namespace {

using detail::matches;
using Rule = CollisionRules::Rule;

void requireNamed(const std::string& name) {
  if (name.empty()) throw std::invalid_argument("CollisionRules: a body's name must not be empty");
}

void requireLength(const std::string& what, double metres) {
  if (metres >= 0.0 && std::isfinite(metres)) return;
  throw std::invalid_argument("CollisionRules: the " + what + ", " + detail::formatNumber(metres) +
                              " m, must be a finite number that is not negative");
}

bool isAbout(const Rule& rule, std::string_view a, std::string_view b) {
  if (rule.bodyB.empty() || b.empty())
    return rule.bodyB.empty() && b.empty() && matches(rule.bodyA, a);
  return (matches(rule.bodyA, a) && matches(rule.bodyB, b)) ||
         (matches(rule.bodyA, b) && matches(rule.bodyB, a));
}

}  // namespace

CollisionRules& CollisionRules::allow(std::string bodyA, std::string bodyB, std::string reason) {
  requireNamed(bodyA);
  requireNamed(bodyB);
  rules_.push_back({Kind::Allow, std::move(bodyA), std::move(bodyB), 0.0, std::move(reason)});
  return *this;
}

CollisionRules& CollisionRules::check(std::string bodyA, std::string bodyB) {
  requireNamed(bodyA);
  requireNamed(bodyB);
  rules_.push_back({Kind::Check, std::move(bodyA), std::move(bodyB), 0.0, {}});
  return *this;
}

CollisionRules& CollisionRules::margin(std::string bodyA, std::string bodyB, double metres) {
  requireNamed(bodyA);
  requireNamed(bodyB);
  requireLength("margin of '" + bodyA + "' and '" + bodyB + "'", metres);
  rules_.push_back({Kind::Margin, std::move(bodyA), std::move(bodyB), metres, {}});
  return *this;
}

CollisionRules& CollisionRules::pad(std::string body, double metres) {
  requireNamed(body);
  requireLength("padding of '" + body + "'", metres);
  rules_.push_back({Kind::Padding, std::move(body), {}, metres, {}});
  return *this;
}

CollisionRules& CollisionRules::scale(std::string body, double factor) {
  requireNamed(body);
  if (!(factor > 0.0) || !std::isfinite(factor)) {
    throw std::invalid_argument("CollisionRules: the scale of '" + body + "', " +
                                detail::formatNumber(factor) +
                                ", must be a finite number above zero");
  }
  rules_.push_back({Kind::Scale, std::move(body), {}, factor, {}});
  return *this;
}

const Rule* CollisionRules::findLast(std::string_view bodyA, std::string_view bodyB,
                                     auto&& wanted) const {
  for (auto rule = rules_.rbegin(); rule != rules_.rend(); ++rule)
    if (wanted(*rule) && isAbout(*rule, bodyA, bodyB)) return &*rule;
  return nullptr;
}

const Rule* CollisionRules::find(Kind kind, std::string_view bodyA, std::string_view bodyB) const {
  return findLast(bodyA, bodyB, [kind](const Rule& rule) { return rule.kind == kind; });
}

std::optional<bool> CollisionRules::allowed(std::string_view bodyA, std::string_view bodyB) const {
  const Rule* last = findLast(bodyA, bodyB, [](const Rule& rule) {
    return rule.kind == Kind::Allow || rule.kind == Kind::Check;
  });
  if (last == nullptr) return std::nullopt;
  return last->kind == Kind::Allow;
}

double CollisionRules::padding(std::string_view body) const {
  const Rule* rule = find(Kind::Padding, body);
  return rule == nullptr ? 0.0 : rule->value;
}

double CollisionRules::scale(std::string_view body) const {
  const Rule* rule = find(Kind::Scale, body);
  return rule == nullptr ? 1.0 : rule->value;
}

CollisionRules CollisionRules::without(std::string_view body) const {
  // A body may be called `*`: what is said of all is not gone with it.
  if (detail::isPattern(body)) return *this;
  CollisionRules result;
  std::ranges::copy_if(rules_, std::back_inserter(result.rules_), [body](const Rule& rule) {
    return rule.bodyA != body && rule.bodyB != body;
  });
  return result;
}

}  // namespace swept
