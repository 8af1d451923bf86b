// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace swept {

/// Which pairs of bodies are checked, how far apart they have to keep, and how large they are taken
/// to be: what a program adds to what the SRDF and the robot's joints say.
///
/// Names are those of links, attached bodies and bodies of the world. A `*` in a name stands for
/// any characters, or none. The two names of a pair may come in either order. Where several rules
/// say something about the same pair or body, the one that was added last counts.
class CollisionRules {
 public:
  /// What a rule is about: the functions below, in their order.
  enum class Kind : std::uint8_t { Allow, Check, Margin, Padding, Scale };
  /// One call of these functions.
  struct Rule {
    Kind kind;           ///< which of them
    std::string bodyA;   ///< a name, or a pattern with `*`
    std::string bodyB;   ///< empty for rules about one body
    double value = 0.0;  ///< m; of Scale: a factor
    std::string reason;  ///< of Allow
  };

  /// The two may collide: they are not checked against each other.
  CollisionRules& allow(std::string bodyA, std::string bodyB, std::string reason = {});
  /// The two are checked, whatever the SRDF, joints and touch links say.
  CollisionRules& check(std::string bodyA, std::string bodyB);
  /// m. The two have to keep more than this; the checker's margin and paddings do not count.
  CollisionRules& margin(std::string bodyA, std::string bodyB, double metres);
  /// m. The body is taken to reach this much farther in all directions: what the pair has to keep
  /// is the checker's margin and the padding of either body.
  CollisionRules& pad(std::string body, double metres);
  /// Each piece of the body's geometry is taken to be this much larger in all directions, from the
  /// middle of its box; see `scaled`.
  CollisionRules& scale(std::string body, double factor);

  /// In the order in which they were added.
  const std::vector<Rule>& rules() const { return rules_; }
  /// No rules: the SRDF and the margin alone count.
  bool empty() const { return rules_.empty(); }

  /// Of the rules of a kind that are about the pair or, with `bodyB` empty, about the body, the one
  /// that counts; null: there is none.
  const Rule* find(Kind kind, std::string_view bodyA, std::string_view bodyB = {}) const;
  /// True: allowed, false: checked; empty: the rules do not say.
  std::optional<bool> allowed(std::string_view bodyA, std::string_view bodyB) const;
  double padding(std::string_view body) const;  ///< m
  double scale(std::string_view body) const;    ///< a factor

  /// Without the rules that name the body as it is, not by a `*`.
  CollisionRules without(std::string_view body) const;

 private:
  const Rule* findLast(std::string_view bodyA, std::string_view bodyB, auto&& wanted) const;
  std::vector<Rule> rules_;
};

}  // namespace swept
