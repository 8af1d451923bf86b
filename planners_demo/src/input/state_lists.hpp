// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "command_line/arguments.hpp"
#include "input/task.hpp"
#include "swept/robot_model/input.hpp"
#include "swept/robot_model/robot.hpp"

namespace swept {

/// Whether a STATE stands for as many as a file has: `@FILE`, `-` (standard input), or the name of
/// a path file.
bool isStateList(const std::string& text);

/// What --degrees is for. Throws UsageError where there is no such state.
void requireDegreesForValues(const Arguments& args);

/// The states of `text`, of which isStateList() is so, behind those that are there. Each line of
/// `@FILE` and `-` is a state, its values between commas or blanks, or its name; what follows a `#`
/// is a remark. `reference` and `options`: as readPath() has them. Throws UsageError or InputError,
/// which names file and line.
void addStateList(const Arguments& args, const Robot& robot, const Group& group,
                  const std::optional<Eigen::VectorXd>& reference, const LoadOptions& options,
                  const std::string& text, std::vector<LabelledState>& states);

/// The first state of the command line or of the path file, which is read once more for it. Throws
/// likewise, and UsageError where it cannot be read twice.
std::vector<double> firstState(const Arguments& args, const Robot& robot, const Group& group,
                               const std::optional<Eigen::VectorXd>& reference,
                               const LoadOptions& options);

/// As a STATE of the command line, in rad and m.
std::string stateText(std::span<const double> q);

}  // namespace swept
