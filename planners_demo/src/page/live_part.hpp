// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "command_line/arguments.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

/// What makes a page prove where its sliders go: the module in the folder that the environment's
/// SWEPT_LIVE names, and the files that the answers depend on.
namespace swept {

/// Whether the page of these arguments gets one: of `check`, `motion` and `plan`, but not of a
/// planning request or of what xacro makes.
bool isLive(const Arguments& args);

/// Throws UsageError when the page gets one and the folder lacks it.
void requireLive(const Arguments& args);

/// `{"script", "code", "inputs", "files"}`: the module's two files, compressed by gzip, in base64;
/// the `inputs` of a path file; and the files that these name, in base64, by their place below the
/// folder that has all of them. Reads the inputs again. `start`: the first configuration of the
/// page. Throws as loadModel() does.
Json liveJson(const Arguments& args, const Checker& checker, std::span<const double> start);

}  // namespace swept
