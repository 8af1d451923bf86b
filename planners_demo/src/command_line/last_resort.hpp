// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace swept {

/// Exceptions that escape a thread and assertions that fail, both of which happen inside OMPL's
/// planners, end the program with one message and the exit code of bad input instead of a core
/// dump.
void installLastResort();

}  // namespace swept
