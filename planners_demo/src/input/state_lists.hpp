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

/// Whether a STATE stands for all states of a file: `@FILE`, `-` (standard input), or the name of a
/// path file.
bool isStateList(const std::string& text);

/// Checks the use of --degrees. Throws UsageError where no state has angles in degrees.
void requireDegreesForValues(const Arguments& args);

/// Appends the states of `text`, for which isStateList() is true. Each line of `@FILE` and `-` is a
/// state: its values, separated by commas or blanks, or its name. A `#` begins a comment.
/// `reference` and `options` are as in readPath(). Throws UsageError or InputError, which names
/// file and line.
void addStateList(const Arguments& args, const Robot& robot, const Group& group,
                  const std::optional<Eigen::VectorXd>& reference, const LoadOptions& options,
                  const std::string& text, std::vector<LabelledState>& states);

/// The first state of the command line or of the path file, which is read once more for it. Throws
/// likewise, and throws UsageError for a file that cannot be read twice.
std::vector<double> firstState(const Arguments& args, const Robot& robot, const Group& group,
                               const std::optional<Eigen::VectorXd>& reference,
                               const LoadOptions& options);

/// In the form of a STATE on the command line, in rad and m.
std::string stateText(std::span<const double> q);

}  // namespace swept
