// SPDX-License-Identifier: BSD-3-Clause
#include "command_line/commands.hpp"

#include <vector>

namespace swept {

std::span<const Command* const> commands() {
  static const std::vector<const Command*> all = [] {
    std::vector<const Command*> list{
        &kInfoCommand,         &kCheckCommand,  &kMotionCommand,       &kCertifyCommand,
        &kPlanCommand,         &kLineCommand,   &kRoadmapBuildCommand, &kRoadmapUpdateCommand,
        &kRoadmapQueryCommand, &kVerifyCommand, &kTrajectoryCommand,   &kScheduleCommand,
        &kAcmCommand,          &kCoverCommand,  &kReplayCommand};
    list.insert(list.end(), pageCommands().begin(), pageCommands().end());
    list.insert(list.end(), {&kBenchEdgesCommand, &kBenchPlannersCommand, &kBenchSummaryCommand,
                             &kReportCommand, &kCompletionCommand});
    return list;
  }();
  return all;
}

std::string stateNotes() {
  return "States are names from the SRDF, 'default' (zero, or the middle of the limits), or "
         "comma-separated\n"
         "values (rad, m) in the order of the group's variables, such as "
         "0.1,-0.5,0,-1.2,0,1.5,0.7.\n";
}

std::string stateListNotes() {
  return stateNotes() +
         "Many at once: @FILE has one on each line, its values between commas or blanks, with "
         "remarks behind\n"
         "a #; - is the same from standard input; a path file (.csv, .yaml, .json) its states.\n";
}

}  // namespace swept
