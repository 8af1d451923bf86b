// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"

namespace swept {

/// Whether --problems asks for more than one of them.
bool plansSeveral(const Arguments& args);

/// Throws UsageError for options of `plan` that do not go together, so that none is ignored, and
/// for ends that are missing or too many. Reads no file.
void requirePlanOptions(const Arguments& args);

}  // namespace swept
