// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "command_line/commands.hpp"

namespace swept {

std::span<const Command* const> commands() {
  static constexpr std::array kAll{
      &kInfoCommand,          &kCheckCommand,        &kMotionCommand,    &kPlanCommand,
      &kVerifyCommand,        &kAcmCommand,          &kReplayCommand,    &kBenchEdgesCommand,
      &kBenchPlannersCommand, &kBenchSummaryCommand, &kCompletionCommand};
  return kAll;
}

std::string stateNotes() {
  return "States are names from the SRDF or comma-separated values (rad, m) in the order of the "
         "group's\n"
         "variables, such as 0.1,-0.5,0,-1.2,0,1.5,0.7.\n";
}

}  // namespace swept
