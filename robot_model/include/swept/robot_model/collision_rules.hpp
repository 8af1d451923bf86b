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

/// Which pairs of bodies are checked, how far apart they have to keep, and how large they are taken
/// to be: what a program adds to what the SRDF and the robot's joints say.
///
/// Names are those of links, attached bodies and bodies of the world. A `*` in a name stands for
/// any characters, or none. The two names of a pair may come in either order.
///
/// Several rules may answer the same question: whether the pair is checked (`allow`, `check`), its
/// margin, a body's padding, its scale. One of them counts:
/// 1. that of the stronger layer (see over());
/// 2. within a layer that which names more bodies as they are: a pattern beside a name is less than
///    two names, two patterns are less still;
/// 3. of equals the one that was added last.
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
    std::string reason;  ///< why, or who says so; may be empty
    int layer = 0;       ///< 0 is the strongest; see over()
  };

  // Each adds to the strongest layer. `reason` is for people: Checker::explain and skippedPairs
  // repeat it. Each throws std::invalid_argument for an empty name, and for a value that is not
  // finite, a negative length, and a factor that is not above zero.

  /// The two may collide: they are not checked against each other.
  CollisionRules& allow(std::string bodyA, std::string bodyB, std::string reason = {});
  /// The two are checked, whatever the SRDF, joints and touch links say. Two that the group cannot
  /// move against each other are looked at once: see Checker::staticContacts.
  CollisionRules& check(std::string bodyA, std::string bodyB, std::string reason = {});
  /// m. The two have to keep more than this; the checker's margin and paddings do not count.
  CollisionRules& margin(std::string bodyA, std::string bodyB, double metres,
                         std::string reason = {});
  /// m. The body is taken to reach this much farther in all directions: what the pair has to keep
  /// is the checker's margin and the padding of either body.
  CollisionRules& pad(std::string body, double metres, std::string reason = {});
  /// Each piece of the body's geometry is taken to be this much larger in all directions, from the
  /// middle of its box; see `scaled`.
  CollisionRules& scale(std::string body, double factor, std::string reason = {});

  /// These rules above `weaker` ones, whose layers all come below those of these: to each question
  /// about a pair or a body `weaker` is the answer only where these have none. A scene's rules
  /// below a program's: `program.over(scene)`.
  CollisionRules over(const CollisionRules& weaker) const;

  /// In the order in which they were added; `weaker` ones follow.
  const std::vector<Rule>& rules() const { return rules_; }
  /// No rules: the SRDF and the margin alone count.
  bool empty() const { return rules_.empty(); }

  /// Of the rules of a kind that are about the pair or, with `bodyB` empty, about the body, the one
  /// that counts; null: there is none.
  const Rule* find(Kind kind, std::string_view bodyA, std::string_view bodyB = {}) const;
  /// The rule that says whether the pair is checked, of kind Allow or Check; null: there is none.
  const Rule* decisive(std::string_view bodyA, std::string_view bodyB) const;
  /// True: allowed, false: checked; empty: the rules do not say.
  std::optional<bool> allowed(std::string_view bodyA, std::string_view bodyB) const;
  double padding(std::string_view body) const;  ///< m
  double scale(std::string_view body) const;    ///< a factor

  /// Without the rules that name the body as it is, not by a `*`.
  CollisionRules without(std::string_view body) const;

 private:
  CollisionRules& add(Rule rule);
  const Rule* findStrongest(std::string_view bodyA, std::string_view bodyB, auto&& wanted) const;
  std::vector<Rule> rules_;
  /// Rules about two names, by these: a matrix of all links has thousands, and each pair of bodies
  /// is looked up.
  std::unordered_map<std::string, std::vector<std::size_t>> byNames_;
  std::vector<std::size_t> others_;  ///< rules about one body, or with a pattern
};

}  // namespace swept
