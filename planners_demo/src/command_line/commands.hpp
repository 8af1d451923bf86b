// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "command_line/command.hpp"

/// The subcommands and what they run.
namespace swept {

extern const Command kInfoCommand;
ExitCode runInfo(const Arguments& args);

extern const Command kCheckCommand;
ExitCode runCheck(const Arguments& args);

extern const Command kMotionCommand;
ExitCode runMotion(const Arguments& args);

extern const Command kCertifyCommand;
ExitCode runCertify(const Arguments& args);

extern const Command kTrajectoryCommand;
ExitCode runTrajectory(const Arguments& args);

extern const Command kScheduleCommand;
ExitCode runSchedule(const Arguments& args);

extern const Command kPlanCommand;
ExitCode runPlan(const Arguments& args);

extern const Command kLineCommand;
ExitCode runLine(const Arguments& args);

extern const Command kRoadmapBuildCommand;
ExitCode runRoadmapBuild(const Arguments& args);

extern const Command kRoadmapUpdateCommand;
ExitCode runRoadmapUpdate(const Arguments& args);

extern const Command kRoadmapQueryCommand;
ExitCode runRoadmapQuery(const Arguments& args);

extern const Command kVerifyCommand;
ExitCode runVerify(const Arguments& args);

extern const Command kAcmCommand;
ExitCode runAcm(const Arguments& args);

extern const Command kCoverCommand;
ExitCode runCover(const Arguments& args);

extern const Command kReplayCommand;
ExitCode runReplay(const Arguments& args);

extern const Command kBenchEdgesCommand;
ExitCode runBenchEdges(const Arguments& args);

extern const Command kBenchPlannersCommand;
ExitCode runBenchPlanners(const Arguments& args);

extern const Command kBenchSummaryCommand;
ExitCode runBenchSummary(const Arguments& args);

extern const Command kReportCommand;
ExitCode runReport(const Arguments& args);

extern const Command kCompletionCommand;
ExitCode runCompletion(const Arguments& args);

/// Those that there are for pages alone: `view`, or none in a program without pages.
std::span<const Command* const> pageCommands();

}  // namespace swept
