// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"
#include "input/task.hpp"

namespace swept {

/// Start and goals of --request, in the world of --scene and --cloud. What the request says of the
/// robot counts over what the scene says: joint values, and attached bodies of one name. Throws
/// InputError, and UsageError for a goal that the group cannot reach by its own joints, and for
/// bounds of a base that the group moves.
Task requestTask(const Arguments& args, const Model& model, Warnings& warnings);

}  // namespace swept
