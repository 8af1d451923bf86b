// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>

#include "command_line/arguments.hpp"
#include "input/task.hpp"

/// Pages of files that hold the robot and the world that their proofs are about.
namespace swept {

/// Whether what `view` has for a robot is such a file: `.json`.
bool namesProof(const Arguments& args);

/// Verifies the proof of a task, a path or a trajectory, makes the robot and the world of what the
/// file holds, and judges its motions anew. Returns the page's text when it is called. Throws
/// InputError for a proof that does not hold, with the place, and for a file without a proof or
/// without its robot; UsageError for states and options that such files have values of.
std::function<std::string()> pageOfProof(const Arguments& args, Warnings& warnings);

}  // namespace swept
