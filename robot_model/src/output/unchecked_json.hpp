// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// What answers are not about, though they may be taken to be: `warnings` (lines),
/// `links_without_geometry` (names of links that the group moves) and `nothing_checked`.
void addUnchecked(Json& json, const Checker& checker, const std::vector<std::string>& warnings);

}  // namespace swept
