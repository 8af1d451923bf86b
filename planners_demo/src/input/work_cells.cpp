// SPDX-License-Identifier: BSD-3-Clause
#include "input/work_cells.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "command_line/exit_code.hpp"
#include "input/groups.hpp"
#include "input/states.hpp"

namespace swept {

bool isWorkCell(const Arguments& args) {
  const std::filesystem::path ending = std::filesystem::path(args.robot).extension();
  return ending == ".yaml" || ending == ".yml";
}

ComposedRobot composedCell(const Arguments& args, const LoadOptions& options) {
  const std::string place = "'" + args.robot + "' is a work cell: ";
  if (args.xacro) throw UsageError("--xacro: " + place + "it names URDFs, which xacro has made");
  if (!args.srdf.empty() && args.srdf != "none")
    throw UsageError("--srdf: " + place + "it names the SRDF of each of its robots");
  return compose(WorkCell::read(args.robot, options), options);
}

std::optional<Eigen::VectorXd> withStanding(const Arguments& args, const Robot& robot,
                                            std::optional<Eigen::VectorXd> before,
                                            const LoadOptions& options) {
  if (args.standing.empty()) return before;
  Eigen::VectorXd all = before.value_or(robot.defaultState());
  for (const std::string& text : args.standing) {
    const auto at = text.find('=');
    if (at == std::string::npos || at == 0)
      throw UsageError("--stand '" + text + "': must be GROUP=STATE");
    const std::string name = text.substr(0, at);
    const Group& group = chooseGroup(robot, name);
    const std::string state = text.substr(at + 1);
    // Files that keep the command line have no unit.
    if (args.degrees && state != "default" && robot.findNamedState(state, group.name) == nullptr)
      throw UsageError("--stand '" + text +
                       "': values are in rad and m; name a state, or leave out --degrees");
    const std::vector<double> q =
        readState(robot, group, state, "--stand '" + text + "'", options.warn);
    for (std::size_t i = 0; i < q.size(); ++i) all[group.variables[i]] = q[i];
  }
  return all;
}

std::vector<std::string> idleStanding(const Arguments& args, const Robot& robot,
                                      const Group& moving) {
  const auto moves = [&moving](int variable) {
    return std::ranges::find(moving.variables, variable) != moving.variables.end();
  };
  std::vector<std::string> idle;
  for (const std::string& text : args.standing) {
    const Group& group = chooseGroup(robot, text.substr(0, text.find('=')));
    if (std::ranges::all_of(group.variables, moves)) idle.push_back(text);
  }
  return idle;
}

}  // namespace swept
