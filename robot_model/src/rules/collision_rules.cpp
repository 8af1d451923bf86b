// SPDX-License-Identifier: BSD-3-Clause
#include "swept/robot_model/collision_rules.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "rules/name_pattern.hpp"
#include "text/numbers.hpp"

namespace swept {

namespace {

using detail::isPattern;
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

bool hasPattern(const Rule& rule) {
  return isPattern(rule.bodyA) || isPattern(rule.bodyB);
}

/// Rank of a rule: the number of patterns among its names. Smaller is stronger.
int patternsOf(const Rule& rule) {
  return static_cast<int>(isPattern(rule.bodyA)) + static_cast<int>(isPattern(rule.bodyB));
}

/// A key that is the same in both orders; names contain no zero byte.
std::string keyOf(std::string_view a, std::string_view b) {
  const auto& [first, second] = std::minmax(a, b);
  return std::string(first).append(1, '\0').append(second);
}

}  // namespace

CollisionRules& CollisionRules::add(Rule rule) {
  if (rule.bodyB.empty() || hasPattern(rule))
    others_.push_back(rules_.size());
  else
    byNames_[keyOf(rule.bodyA, rule.bodyB)].push_back(rules_.size());
  rules_.push_back(std::move(rule));
  return *this;
}

CollisionRules& CollisionRules::allow(std::string bodyA, std::string bodyB, std::string reason) {
  requireNamed(bodyA);
  requireNamed(bodyB);
  return add({Kind::Allow, std::move(bodyA), std::move(bodyB), 0.0, std::move(reason)});
}

CollisionRules& CollisionRules::check(std::string bodyA, std::string bodyB, std::string reason) {
  requireNamed(bodyA);
  requireNamed(bodyB);
  return add({Kind::Check, std::move(bodyA), std::move(bodyB), 0.0, std::move(reason)});
}

CollisionRules& CollisionRules::margin(std::string bodyA, std::string bodyB, double metres,
                                       std::string reason) {
  requireNamed(bodyA);
  requireNamed(bodyB);
  requireLength("margin of '" + bodyA + "' and '" + bodyB + "'", metres);
  return add({Kind::Margin, std::move(bodyA), std::move(bodyB), metres, std::move(reason)});
}

CollisionRules& CollisionRules::pad(std::string body, double metres, std::string reason) {
  requireNamed(body);
  requireLength("padding of '" + body + "'", metres);
  return add({Kind::Padding, std::move(body), {}, metres, std::move(reason)});
}

CollisionRules& CollisionRules::scale(std::string body, double factor, std::string reason) {
  requireNamed(body);
  if (!(factor > 0.0) || !std::isfinite(factor)) {
    throw std::invalid_argument("CollisionRules: the scale of '" + body + "', " +
                                detail::formatNumber(factor) +
                                ", must be a finite number above zero");
  }
  return add({Kind::Scale, std::move(body), {}, factor, std::move(reason)});
}

CollisionRules CollisionRules::over(const CollisionRules& weaker) const {
  int below = 0;
  for (const Rule& rule : rules_) below = std::max(below, rule.layer + 1);
  CollisionRules result = *this;
  for (Rule rule : weaker.rules_) {
    rule.layer += below;
    result.add(std::move(rule));
  }
  return result;
}

const Rule* CollisionRules::findStrongest(std::string_view bodyA, std::string_view bodyB,
                                          auto&& wanted) const {
  const Rule* best = nullptr;
  const auto consider = [&](const Rule& rule) {
    if (!wanted(rule)) return;
    const auto rank = [](const Rule& one) { return std::pair(one.layer, patternsOf(one)); };
    // The later one of equal rank: addresses are in the order in which they were added.
    if (best == nullptr || rank(rule) < rank(*best) || (rank(rule) == rank(*best) && best < &rule))
      best = &rule;
  };
  if (!bodyB.empty() && !byNames_.empty()) {
    const auto named = byNames_.find(keyOf(bodyA, bodyB));
    if (named != byNames_.end())
      for (const std::size_t index : named->second) consider(rules_[index]);
  }
  for (const std::size_t index : others_)
    if (isAbout(rules_[index], bodyA, bodyB)) consider(rules_[index]);
  return best;
}

const Rule* CollisionRules::find(Kind kind, std::string_view bodyA, std::string_view bodyB) const {
  return findStrongest(bodyA, bodyB, [kind](const Rule& rule) { return rule.kind == kind; });
}

const Rule* CollisionRules::decisive(std::string_view bodyA, std::string_view bodyB) const {
  return findStrongest(bodyA, bodyB, [](const Rule& rule) {
    return rule.kind == Kind::Allow || rule.kind == Kind::Check;
  });
}

std::optional<bool> CollisionRules::allowed(std::string_view bodyA, std::string_view bodyB) const {
  const Rule* rule = decisive(bodyA, bodyB);
  if (rule == nullptr) return std::nullopt;
  return rule->kind == Kind::Allow;
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
  // A body may be called `*`: rules about all bodies are not removed with it.
  if (detail::isPattern(body)) return *this;
  CollisionRules result;
  for (const Rule& rule : rules_)
    if (rule.bodyA != body && rule.bodyB != body) result.add(rule);
  return result;
}

}  // namespace swept
