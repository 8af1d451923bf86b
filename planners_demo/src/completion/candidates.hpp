// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swept {

/// What the last word of `line`, the beginning of a command line of this program, may become:
/// subcommands, options, planners, and names of the robot on the line. Those that end with `,`,
/// `=` or `:` are not at their end. Names that a shell would not leave alone are left out. Empty:
/// anything, files among others. Throws nothing on account of files.
std::vector<std::string> candidatesFor(std::string_view line);

}  // namespace swept
