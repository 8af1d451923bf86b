// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

/// The folder `models` of the source tree. Only the library `models_dir` is compiled with its name,
/// so that ccache finds what was compiled for one clone when it is compiled for another.
std::string modelsDir();
