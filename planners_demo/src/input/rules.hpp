// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "command_line/arguments.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// The rules of --allow, --pad and --scale. Throws UsageError.
CollisionRules rulesOf(const Arguments& args);

/// Those of the rules that apply to a checker in this world. They name links, bodies that `robot`
/// carries, bodies of the world or, by a `*`, any body.
CollisionRules rulesIn(const World& world, const CollisionRules& rules, const Robot& robot,
                       const std::vector<AttachedBody>& attached);

/// The names with a `*` in the rules that are the name of no link, no attached body and no body of
/// the world: such a rule does nothing.
std::vector<std::string> idlePatterns(const CollisionRules& rules, const Robot& robot,
                                      const std::vector<AttachedBody>& attached,
                                      const World& world);

/// Names in rules that are neither a link's nor an attached body's, and that no world so far has as
/// the name of a body.
class NamesOfBodies {
 public:
  NamesOfBodies(const CollisionRules& rules, const Robot& robot,
                const std::vector<AttachedBody>& attached);
  void find(const World& world);
  bool empty() const { return names_.empty(); }
  /// Throws UsageError for a name that no world had; `worlds` describes the worlds.
  void requireFound(const std::string& worlds) const;

 private:
  std::vector<std::string> names_;
};

/// The two names of `A,B`. Throws UsageError.
std::pair<std::string, std::string> namesOfPair(const std::string& option, const std::string& text);

}  // namespace swept
