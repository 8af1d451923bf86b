// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"

namespace CLI {
class App;
}

namespace swept {

/// All subcommands with their options, which write to `args`. Both have to outlive the parsing.
void describeProgram(CLI::App& program, Arguments& args);

}  // namespace swept
