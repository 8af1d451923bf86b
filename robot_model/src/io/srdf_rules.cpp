// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <set>
#include <utility>

#include "io/srdf.hpp"
#include "io/warning_kinds.hpp"

namespace swept::detail {

namespace {

using LinkPair = std::pair<int, int>;

/// The two links, smaller index first; equal when the entry names no pair.
LinkPair lookUp(const SrdfDocument::Pair& pair, const RobotParts& robot, WarningKinds& warnings) {
  const std::string element = pair.enable ? "<enable_collisions>" : "<disable_collisions>";
  for (const std::string& name : {pair.link1, pair.link2}) {
    if (indexOf(robot.links, name) >= 0) continue;
    const std::string what = "link '" + name + "'";
    warnings.add(pair.line, element + ": " + what + " does not exist",
                 element + ": # pairs name " + what + ", which does not exist");
    return {0, 0};
  }
  const int a = indexOf(robot.links, pair.link1);
  const int b = indexOf(robot.links, pair.link2);
  if (a == b)
    warnings.add(pair.line, element + " names link '" + pair.link1 + "' twice",
                 element + ": # pairs name one link twice");
  return std::minmax(a, b);
}

}  // namespace

/// MoveIt makes an allowed collision matrix of these. `<disable_default_collisions>` sets the
/// default of a link, which counts where no pair has an entry. `<enable_collisions>` sets pairs to
/// be checked, and `<disable_collisions>` sets pairs to be left out. A link of the first kind is
/// also left out against the world.
void addPairs(const SrdfDocument& srdf, const InputSource& source, RobotParts& robot) {
  WarningKinds warnings(source);
  std::set<LinkPair> enabled;
  for (const auto& pair : srdf.pairs) {
    if (!pair.enable) continue;
    const auto [a, b] = lookUp(pair, robot, warnings);
    if (a != b && enabled.insert({a, b}).second) robot.enabledPairs.push_back({a, b});
  }
  std::set<LinkPair> disabled;
  for (const auto& pair : srdf.pairs) {
    if (pair.enable) continue;
    const auto [a, b] = lookUp(pair, robot, warnings);
    if (a == b) continue;
    // An enabled pair wins wherever it stands, which differs from MoveIt: checking more pairs is
    // never unsound.
    if (enabled.contains({a, b}))
      warnings.add(pair.line,
                   "<disable_collisions>: the pair '" + pair.link1 + "' - '" + pair.link2 +
                       "' is enabled, too; it stays checked",
                   "<disable_collisions>: # pairs are enabled, too; they stay checked");
    else if (disabled.insert({a, b}).second)
      robot.disabledPairs.push_back({a, b, pair.reason});
  }
  const std::string reason = "disable_default_collisions";
  for (const auto& [name, line] : srdf.uncheckedByDefault) {
    const std::string element = "<" + reason + ">";
    const int link = indexOf(robot.links, name);
    if (link < 0) {
      warnings.add(line, element + ": link '" + name + "' does not exist",
                   element + ": # links do not exist");
      continue;
    }
    for (int other = 0; other < static_cast<int>(robot.links.size()); ++other) {
      const LinkPair pair = std::minmax(link, other);
      if (other != link && !enabled.contains(pair) && disabled.insert(pair).second)
        robot.disabledPairs.push_back({pair.first, pair.second, reason});
    }
    warnings.add(line,
                 element + " leaves link '" + name +
                     "' out against other links; against the world, and what is attached, this is "
                     "not supported: it stays checked",
                 element +
                     " leaves # links out against other links; against the world, and what is "
                     "attached, this is not supported: they stay checked");
  }
  warnings.flush();
}

}  // namespace swept::detail
