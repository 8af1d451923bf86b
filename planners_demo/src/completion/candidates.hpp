// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace swept {

/// The completions of the last word of `line`, the beginning of a command line of this program:
/// subcommands, options, planners, and names of the robot on the line. A completion that ends with
/// `,`, `=` or `:` is not complete. Names that a shell would change are left out. Empty: anything
/// fits, files among others. Throws nothing because of files.
std::vector<std::string> candidatesFor(std::string_view line);

}  // namespace swept
