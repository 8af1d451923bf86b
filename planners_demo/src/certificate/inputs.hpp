// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "command_line/arguments.hpp"
#include "output/text_output.hpp"

namespace swept {

/// What of a command line decides which robot, world, group and rules a path is for: the `inputs`
/// of a path file. Names of files are relative to the folder of that file.
Json inputsJson(const Arguments& args, const std::filesystem::path& pathFile);

/// The other way. Throws InputError, naming the file, for what inputsJson() does not write.
Arguments inputsOf(const Json& inputs, const std::filesystem::path& pathFile);

}  // namespace swept
