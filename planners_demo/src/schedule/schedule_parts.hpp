// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/robot_model/robot.hpp"

/// What the command line of `swept schedule` says of the groups.
namespace swept {

/// A group, and its trajectory or where it is to go.
struct SchedulePart {
  std::string group;
  std::string file;         ///< of its trajectory; empty: it is planned
  std::string start, goal;  ///< named states or values; of one that is planned

  bool isPlanned() const { return file.empty(); }
};

/// Those with files first, and then those to plan. Throws UsageError.
std::vector<SchedulePart> partsOf(const Arguments& args);

/// What an option says of some of the parts: by part, in the unit of the option. Throws UsageError.
std::map<std::size_t, double> numbersOf(const std::string& option,
                                        const std::vector<std::string>& texts,
                                        const std::vector<SchedulePart>& parts,
                                        const std::string& unit);

/// s: what --at says of the parts. Throws UsageError, also for one that is planned.
std::map<std::size_t, double> startsOf(const Arguments& args,
                                       const std::vector<SchedulePart>& parts);

/// A part to plan, with limits of rates. Throws UsageError for states that the group does not have,
/// and for a variable without limits.
ScheduleTask taskOf(const Arguments& args, const Model& model, const Group& group,
                    const SchedulePart& part, Warnings& warnings);

}  // namespace swept
