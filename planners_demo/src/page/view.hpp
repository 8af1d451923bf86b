// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/command.hpp"

namespace swept {

extern const Command kViewCommand;
ExitCode runView(const Arguments& args);

}  // namespace swept
