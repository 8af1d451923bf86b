// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "input/task.hpp"
#include "output/text_output.hpp"

namespace swept {

/// One sentence for each --explain. Throws UsageError for an unknown name.
std::vector<std::string> explanations(const Arguments& args, const Checker& checker);

/// The output of `info`. `checker` is null without a group, as makeCheckerOfGroup() returns it.
std::string infoText(const Arguments& args, const Model& model, const Checker* checker);
Json infoJson(const Arguments& args, const Model& model, const Checker* checker);

}  // namespace swept
