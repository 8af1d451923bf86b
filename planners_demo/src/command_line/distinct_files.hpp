// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line/arguments.hpp"

namespace swept {

/// Throws UsageError where a file that is to be written is also read, written by another option, or
/// where standard output or error go: one would be lost. The SRDF that `acm` reads is meant to be
/// replaced.
void requireDistinctFiles(const Arguments& args);

}  // namespace swept
