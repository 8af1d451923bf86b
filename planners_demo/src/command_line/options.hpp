// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "command_line/arguments.hpp"

/// Options that several subcommands have.
namespace swept {

CLI::Validator within(double low, double high, const std::string& what);

/// The robot's files and how they are read. `use` says what the subcommand does with the SRDF
/// besides reading it.
void addRobotOptions(CLI::App& app, Arguments& args, const std::string& use = {});
/// -v: for subcommands that load a robot.
void addVerboseOption(CLI::App& app, Arguments& args);
/// --group and what makes one, --margin and the rules.
void addRuleOptions(CLI::App& app, Arguments& args);
/// The same with --tolerance.
void addCheckerOptions(CLI::App& app, Arguments& args);
/// --scene and --cloud with what says how to read it.
void addSceneOptions(CLI::App& app, Arguments& args);
/// For subcommands that take states: the first is the state of the robot.
void addSelfFilterOption(CLI::App& app, Arguments& args);
/// The states of `check` and `motion`, and --degrees. `what` says which they are.
void addStateListOption(CLI::App& app, Arguments& args, const std::string& what);
/// `what` says what the subcommand does with a problem.
void addProblemOptions(CLI::App& app, Arguments& args, const std::string& what);
/// `what` says what is done with the peer.
void addAgainstOption(CLI::App& app, Arguments& args, const std::string& what);
/// --tracking and --controllers.
void addTrackingOptions(CLI::App& app, Arguments& args);
/// --keep-upright, --stay-in, --stay-on and, for subcommands with a first state, --keep-level.
void addConstraintOptions(CLI::App& app, Arguments& args, bool hasFirstState = true);
/// --limits.
CLI::Option* addLimitsOption(CLI::App& app, Arguments& args);
/// --max-acceleration and --speed, for `user`: the option without which nothing is timed.
void addSpeedOptions(CLI::App& app, Arguments& args, CLI::Option* user);
/// How a path is timed, likewise.
void addTimingOptions(CLI::App& app, Arguments& args, CLI::Option* user);
/// Whether the file of -o needs others to be verified.
void addEmbedOption(CLI::App& app, Arguments& args);
void addSeedOption(CLI::App& app, Arguments& args);
void addJsonOption(CLI::App& app, Arguments& args);
void addQuietOption(CLI::App& app, Arguments& args);

}  // namespace swept
