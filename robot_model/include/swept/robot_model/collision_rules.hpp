// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace swept {

/// Rules about pairs of bodies: which are checked, how far apart they must keep, and how large they
/// are. They add to the SRDF and the robot's joints.
///
/// Names are those of links, attached bodies and bodies of the world. A `*` in a name stands for
/// any characters, or none. The two names of a pair may come in either order.
///
/// Several rules may answer the same question: whether the pair is checked (`allow`, `check`), its
/// margin, a body's padding, its scale. The first of these criteria decides:
/// 1. the rule in the stronger layer wins (see over());
/// 2. within a layer, the rule with more plain names wins: two names over a name and a pattern, and
/// that over two patterns;
/// 3. among equals, the rule that was added last wins.
class CollisionRules {
 public:
  /// The functions below, in their order.
  enum class Kind : std::uint8_t { Allow, Check, Margin, Padding, Scale };
  /// One call of these functions.
  struct Rule {
    Kind kind;           ///< the function
    std::string bodyA;   ///< a name, or a pattern with `*`
    std::string bodyB;   ///< empty for rules about one body
    double value = 0.0;  ///< m; for Scale a factor
    std::string reason;  ///< why, or who says so; may be empty
    int layer = 0;       ///< 0 is the strongest; see over()
  };

  // Each adds to the strongest layer. `reason` is for people: Checker::explain and skippedPairs
  // repeat it. Each throws std::invalid_argument for an empty name, a non-finite value, a negative
  // length, and a factor that is not above zero.

  /// The two may collide: they are not checked against each other.
  CollisionRules& allow(std::string bodyA, std::string bodyB, std::string reason = {});
  /// The two are checked, whatever the SRDF, joints and touch links say. Two that the group cannot
  /// move against each other are checked once: see Checker::staticContacts.
  CollisionRules& check(std::string bodyA, std::string bodyB, std::string reason = {});
  /// m. The two must keep more than this, instead of the checker's margin and paddings.
  CollisionRules& margin(std::string bodyA, std::string bodyB, double metres,
                         std::string reason = {});
  /// m. The body reaches this much farther in all directions. A pair must keep the checker's margin
  /// plus the padding of both bodies.
  CollisionRules& pad(std::string body, double metres, std::string reason = {});
  /// Each piece of the body's geometry is scaled by this factor about the centre of its box; see
  /// `scaled`.
  CollisionRules& scale(std::string body, double factor, std::string reason = {});

  /// These rules above `weaker` ones, whose layers all come below those of these. `weaker` answers
  /// a question about a pair or a body only if these have no answer. To put a scene's rules below a
  /// program's: `program.over(scene)`.
  CollisionRules over(const CollisionRules& weaker) const;

  /// The rules in the order in which they were added; `weaker` ones follow.
  const std::vector<Rule>& rules() const { return rules_; }
  /// Whether there are no rules: then only the SRDF and the margin count.
  bool empty() const { return rules_.empty(); }

  /// The rule of a kind that decides about the pair or, with `bodyB` empty, about the body; null:
  /// there is none.
  const Rule* find(Kind kind, std::string_view bodyA, std::string_view bodyB = {}) const;
  /// The rule that decides whether the pair is checked, of kind Allow or Check; null: there is
  /// none.
  const Rule* decisive(std::string_view bodyA, std::string_view bodyB) const;
  /// True: allowed, false: checked; empty: the rules do not say.
  std::optional<bool> allowed(std::string_view bodyA, std::string_view bodyB) const;
  double padding(std::string_view body) const;  ///< m
  double scale(std::string_view body) const;    ///< a factor

  /// These rules without those that name the body itself, not by a `*`.
  CollisionRules without(std::string_view body) const;

 private:
  CollisionRules& add(Rule rule);
  const Rule* findStrongest(std::string_view bodyA, std::string_view bodyB, auto&& wanted) const;
  std::vector<Rule> rules_;
  /// Rules about two names, by these names: a matrix of all links has thousands, and each pair of
  /// bodies is looked up.
  std::unordered_map<std::string, std::vector<std::size_t>> byNames_;
  std::vector<std::size_t> others_;  ///< rules about one body, or with a pattern
};

}  // namespace swept
