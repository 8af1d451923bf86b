// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "input/task.hpp"
#include "output/text_output.hpp"
#include "swept/robot_model/checker_results.hpp"

/// How `check` prints what it knows about a state.
namespace swept {

/// A line for the state and one for each contact and each of the constraints that does not hold.
std::string reportText(const std::string& label, const StateReport& report,
                       const TaskConstraint& constraints);
Json reportJson(const LabelledState& state, const StateReport& report,
                const TaskConstraint& constraints);

}  // namespace swept
