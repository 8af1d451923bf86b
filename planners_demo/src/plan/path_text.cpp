// SPDX-License-Identifier: BSD-3-Clause
#include "plan/path_text.hpp"

#include <algorithm>

#include "input/states.hpp"
#include "output/line_breaks.hpp"
#include "output/terminal_text.hpp"
#include "output/text_output.hpp"
#include "output/text_table.hpp"
#include "swept/robot_model/limits.hpp"

namespace swept {
namespace {

constexpr std::size_t kMostRows = 20;

/// `-` for a part of a quaternion.
std::string unitText(const Robot& robot, int variable) {
  const std::string unit = unitOf(robot, robot.variables()[variable]);
  return unit.empty() ? "-" : unit;
}

/// That of all variables, or none.
std::string commonUnit(const Robot& robot, const Group& group) {
  const std::string unit = unitText(robot, group.variables.front());
  const bool same = std::ranges::all_of(
      group.variables, [&](const int variable) { return unitText(robot, variable) == unit; });
  return same ? unit : "";
}

/// Names, with units where they differ.
std::vector<std::string> titlesOf(const Robot& robot, const Group& group) {
  std::vector<std::string> titles = variableNames(robot, group);
  if (!commonUnit(robot, group).empty()) return titles;
  for (std::size_t i = 0; i < titles.size(); ++i)
    titles[i] += " [" + unitText(robot, group.variables[i]) + "]";
  return titles;
}

/// Number and values of each state that is shown; of one that stands for those left out, `...`.
std::vector<std::vector<std::string>> rowsOf(const std::vector<std::vector<double>>& states) {
  std::vector<std::vector<std::string>> rows;
  const bool all = states.size() <= kMostRows;
  const std::size_t first = all ? states.size() : kMostRows / 2;
  const std::size_t last = all ? states.size() : states.size() - kMostRows / 2;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (i == first) rows.push_back({"..."});
    if (i >= first && i < last) continue;
    rows.push_back({std::to_string(i + 1)});
    for (const double value : states[i]) rows.back().push_back(shortNumber(value));
  }
  return rows;
}

}  // namespace

std::string pathText(const Robot& robot, const Group& group,
                     const std::vector<std::vector<double>>& states,
                     std::optional<std::size_t> columns) {
  const std::vector<std::string> titles = titlesOf(robot, group);
  const std::string unit = commonUnit(robot, group);
  std::string heading = "path of " + countedText(states.size(), "state");
  if (states.size() > kMostRows) heading += ", " + std::to_string(kMostRows) + " of them shown";
  if (!unit.empty() && unit != "-") heading += ", " + unit;

  std::vector<TextTable::Column> shown{{"state", true}};
  for (const std::string& title : titles) shown.push_back({title, true});
  TextTable table(shown);
  std::string list;
  for (std::vector<std::string>& row : rowsOf(states)) {
    const std::vector<std::string> values(row.begin() + 1, row.end());
    list += "  " + std::string(3 - std::min<std::size_t>(3, row.front().size()), ' ') +
            row.front() + (values.empty() ? "" : "  " + joined(values)) + "\n";
    row.resize(shown.size());
    table.add(std::move(row));
  }
  const std::string wide = table.text({});
  if (!columns || widthOf(wide.substr(0, wide.find('\n'))) <= *columns)
    return heading + "\n" + wide;
  return heading + ": " + escapedLine(joined(titles)) + "\n" + list;
}

}  // namespace swept
