// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>

#include "command_line/arguments.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// What --keep-upright, --keep-level, --stay-in and --stay-on ask for. `start`: of the group, where
/// --keep-level looks at what is level. Throws UsageError for text that is none of theirs, and for
/// links that the robot lacks.
TaskConstraint constraintsOf(const Arguments& args, const Checker& checker,
                             std::span<const double> start);

/// The checker itself if there are no constraints: neither of the command line nor `others`.
/// Otherwise that checker with all of them. Throws UsageError as above.
std::shared_ptr<const Checker> withConstraintsOf(const Arguments& args,
                                                 std::shared_ptr<const Checker> checker,
                                                 std::span<const double> start,
                                                 const TaskConstraint& others = {});

}  // namespace swept
