// SPDX-License-Identifier: BSD-3-Clause
#include "certify/moved_pairs.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "rules/name_pattern.hpp"

namespace swept::detail {

namespace {

/// Which of two sets of variables move a joint, or what is between two bodies.
struct MovedBy {
  bool first = false, second = false;

  MovedBy operator|(const MovedBy& more) const {
    return {first || more.first, second || more.second};
  }
  bool both() const { return first && second; }
  bool firstAlone() const { return first && !second; }
};

/// Bodies of the robot, and the joints from the model frame to each.
class MovedBodies {
 public:
  MovedBodies(const Checker& checker, std::span<const std::string> first,
              std::span<const std::string> second)
      : robot_(checker.robot()) {
    for (const Joint& joint : robot_.joints()) {
      const Joint& master =
          joint.mimic ? robot_.joints()[static_cast<std::size_t>(joint.mimic->master)] : joint;
      moved_.push_back({isAmong(first, master), isAmong(second, master)});
    }
    for (std::size_t link = 0; link < robot_.links().size(); ++link)
      bodies_.push_back({robot_.links()[link].name, pathTo(link)});
    for (const AttachedBody& body : checker.options().attached)
      bodies_.push_back({body.name, pathTo(static_cast<std::size_t>(*robot_.findLink(body.link)))});
  }

  std::size_t size() const { return bodies_.size(); }
  const std::string& name(std::size_t body) const { return bodies_[body].name; }
  MovedBy toWorld(std::size_t body) const { return along(bodies_[body].joints, 0); }
  MovedBy between(std::size_t a, std::size_t b) const {
    const std::vector<int>&first = bodies_[a].joints, &second = bodies_[b].joints;
    const auto [end, ignored] = std::ranges::mismatch(first, second);
    const auto shared = static_cast<std::size_t>(end - first.begin());
    return along(first, shared) | along(second, shared);
  }

 private:
  struct Body {
    std::string name;
    std::vector<int> joints;  ///< from the model frame
  };

  bool isAmong(std::span<const std::string> variables, const Joint& joint) const {
    return std::ranges::any_of(variables, [&](const std::string& name) {
      return &robot_.joints()[static_cast<std::size_t>(
                 robot_.variables()[static_cast<std::size_t>(*robot_.findVariable(name))].joint)] ==
             &joint;
    });
  }

  std::vector<int> pathTo(std::size_t link) const {
    std::vector<int> joints;
    for (int at = static_cast<int>(link); at >= 0;) {
      const int joint = robot_.links()[static_cast<std::size_t>(at)].parentJoint;
      if (joint < 0) break;
      joints.push_back(joint);
      at = robot_.joints()[static_cast<std::size_t>(joint)].parentLink;
    }
    std::ranges::reverse(joints);
    return joints;
  }

  MovedBy along(const std::vector<int>& joints, std::size_t from) const {
    MovedBy moved;
    for (std::size_t i = from; i < joints.size(); ++i)
      moved = moved | moved_[static_cast<std::size_t>(joints[i])];
    return moved;
  }

  const Robot& robot_;
  std::vector<MovedBy> moved_;  ///< per joint
  std::vector<Body> bodies_;
};

/// A pair with a name like a pattern stays: a rule would leave out others that fit it.
void allow(CollisionRules& rules, const std::string& a, const std::string& b, const char* reason) {
  if (!isPattern(a) && !isPattern(b)) rules.allow(a, b, reason);
}

}  // namespace

Checker delayedPairs(const Checker& checker, std::span<const std::string> delayed,
                     std::span<const std::string> others) {
  const MovedBodies bodies(checker, delayed, others);
  CollisionRules rules;
  bool worldMatters = false;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    worldMatters = worldMatters || bodies.toWorld(a).both();
    for (std::size_t b = a + 1; b < bodies.size(); ++b)
      if (!bodies.between(a, b).both())
        allow(rules, bodies.name(a), bodies.name(b),
              "a delay does not move them against each other");
  }
  Checker left = checker;
  if (!worldMatters)
    for (const WorldBody& body : checker.world().bodies()) left = left.withoutBody(body.name);
  return left.withRules(rules.over(left.options().rules));
}

Checker pairsMovedBy(const Checker& checker, std::span<const std::string> own,
                     std::span<const std::string> ignored) {
  constexpr const char* kReason = "the planned robot does not move them against each other";
  const MovedBodies bodies(checker, own, ignored);
  CollisionRules rules;
  for (std::size_t a = 0; a < bodies.size(); ++a) {
    for (std::size_t b = a + 1; b < bodies.size(); ++b)
      if (!bodies.between(a, b).firstAlone()) allow(rules, bodies.name(a), bodies.name(b), kReason);
    if (bodies.toWorld(a).firstAlone()) continue;
    for (const WorldBody& body : checker.world().bodies())
      allow(rules, bodies.name(a), body.name, kReason);
    for (const MovingObstacle& obstacle : checker.world().obstacles())
      allow(rules, bodies.name(a), obstacle.name, kReason);
  }
  return checker.withRules(rules.over(checker.options().rules));
}

}  // namespace swept::detail
