// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "task.hpp"
#include "text_output.hpp"

namespace swept {

std::string_view toString(JointType type);

/// What `info` says. `checker` is null when no group was asked for.
std::string infoText(const Arguments& args, const Model& model, const Checker* checker);
Json infoJson(const Arguments& args, const Model& model, const Checker* checker);

}  // namespace swept
