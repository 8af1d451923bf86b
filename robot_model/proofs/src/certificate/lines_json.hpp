// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "output/text_output.hpp"
#include "swept/robot_model/checker.hpp"
#include "swept/robot_model/tool_line.hpp"

namespace swept {

/// `lines` of a path file: what robot_model/verify shows of a tool in the chords between the way
/// points of lines, the first of which begins at the first state, and each other where the one
/// before ends. A line without a chord is none.
Json linesJson(const Checker& checker, const ConstraintFrame& tool, std::span<const ToolLine> lines,
               const ToolLineOptions& options);

/// The way points of all lines, one line after the other. Throws std::invalid_argument for no line,
/// and for one that does not begin where the one before ends.
std::vector<std::vector<double>> statesOf(std::span<const ToolLine> lines);

}  // namespace swept
