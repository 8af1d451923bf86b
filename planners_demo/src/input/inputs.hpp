// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "command_line/arguments.hpp"
#include "io/json_value.hpp"
#include "output/text_output.hpp"

namespace swept {

/// What of a command line decides which robot, world, group and rules its answers are for: the
/// `inputs` of a path file or a case. Names of files are relative to the folder of `file`,
/// or of the file that it leads to as a link.
Json inputsJson(const Arguments& args, const std::filesystem::path& file);

/// The other way. Throws InputError, naming the value and what is allowed.
Arguments inputsOf(const JsonValue& inputs);

}  // namespace swept
