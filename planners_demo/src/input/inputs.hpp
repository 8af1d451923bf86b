// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <span>

#include "command_line/arguments.hpp"
#include "io/json_value.hpp"
#include "output/text_output.hpp"

namespace swept {

/// The part of a command line that determines the robot, world, group and rules of its answers: the
/// `inputs` of a path file or a case. Names of files are relative to the folder of `file`; if
/// `file` is a symbolic link, to the folder of its target.
Json inputsJson(const Arguments& args, const std::filesystem::path& file);

/// The same for a path that is in the file itself: `states` are its ends.
Json inputsOfPath(const Arguments& args, const std::filesystem::path& file,
                  std::span<const double> from, std::span<const double> to);

/// The inverse of inputsJson(). Throws InputError, naming the value and what is allowed.
Arguments inputsOf(const JsonValue& inputs);

}  // namespace swept
