// SPDX-License-Identifier: BSD-3-Clause
#include "input/unchecked.hpp"

#include "output/terminal_text.hpp"
#include "output/unchecked_json.hpp"

namespace swept {

void warnOfNothing(const Checker& checker, Warnings& warnings) {
  if (!checker.checksNothing()) return;
  const std::size_t skipped = checker.skippedPairs().size();
  warnings.ofUnchecked("swept: warning: nothing is checked: group '" + checker.group().name +
                       "' moves nothing that could meet a link or a body of the world" +
                       (skipped == 0 ? "" : ", or rules, SRDF and joints leave out its pairs"));
}

std::string uncheckedText(const Checker& checker) {
  const std::vector<std::string> links = checker.linksWithoutGeometry();
  if (links.empty()) return {};
  return escapedLine("not checked, no collision geometry: " + joined(links)) + "\n";
}

void addUnchecked(Json& json, const Checker& checker, const Warnings& warnings) {
  addUnchecked(json, checker, warnings.unchecked());
}

}  // namespace swept
