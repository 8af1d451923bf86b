// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "command_line/arguments.hpp"
#include "cover/covered.hpp"
#include "swept/robot_model/shape_model.hpp"

namespace swept {

/// Prints the table of `cover`, or its JSON.
void printCover(const Arguments& args, const Covered& covered, const ShapeModel& model,
                const std::vector<LinkSphereReport>& reports, double seconds);

}  // namespace swept
