// SPDX-License-Identifier: BSD-3-Clause
#include "graph/lone_checker.hpp"

#include <algorithm>
#include <utility>

#include "rules/name_pattern.hpp"

namespace swept::detail {

namespace {

std::vector<std::string> carriersOf(const Checker& checker) {
  std::vector<std::string> names;
  for (const Link& link : checker.robot().links())
    if (!link.collision.empty()) names.push_back(link.name);
  for (const AttachedBody& body : checker.options().attached) names.push_back(body.name);
  return names;
}

}  // namespace

LoneChecker::LoneChecker(const Checker& checker)
    : checker_(checker), carriers_(carriersOf(checker)) {}

/// Rules that name the body, or no body, under rules that allow each pair of two carriers to meet.
/// A pair that is named like the body stays, since rules cannot tell the two apart.
CollisionRules LoneChecker::rulesFor(const std::string& body) const {
  CollisionRules rules = checker_.options().rules;
  if (!rules.empty())
    for (const WorldBody& other : checker_.world().bodies())
      if (other.name != body && !checker_.robot().findLink(other.name))
        rules = rules.without(other.name);
  CollisionRules own;
  for (std::size_t i = 0; i < carriers_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const std::string &a = carriers_[i], &b = carriers_[j];
      if (a != body && b != body && !isPattern(a) && !isPattern(b)) own.allow(a, b);
    }
  return own.over(rules);
}

/// A version of the whole checker, which shares what it has made for this body.
Checker LoneChecker::with(const WorldBody& body) const {
  auto world = std::make_shared<World>();
  world->add(body);
  const Checker alone = checker_.withWorld(std::move(world)).withRules(rulesFor(body.name));
  return checker_.options().constraints.empty() ? alone : alone.withConstraints({});
}

double LoneChecker::margin(const WorldBody& body) const {
  const CollisionRules& rules = checker_.options().rules;
  const double margin = checker_.options().marginOf(false);
  if (rules.empty()) return margin;
  double most = 0.0;
  for (const std::string& carrier : carriers_) {
    const auto* rule = rules.find(CollisionRules::Kind::Margin, carrier, body.name);
    most = std::max(most, rule != nullptr
                              ? rule->value
                              : margin + rules.padding(carrier) + rules.padding(body.name));
  }
  return most;
}

}  // namespace swept::detail
