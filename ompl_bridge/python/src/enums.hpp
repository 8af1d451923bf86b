// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "swept/core/enclosing_shapes.hpp"
#include "swept/core/verdict.hpp"
#include "swept/ompl_bridge/schedule_plan.hpp"
#include "swept/proofs/task_proof.hpp"
#include "swept/robot_model/checker_results.hpp"
#include "swept/robot_model/task_constraint.hpp"
#include "swept/robot_model/tool_line.hpp"
#include "swept/robot_model/trajectory_certificate.hpp"

/// The enumerations of swept/enums.py, which have the values of C++.
namespace swept::python {

///@{
/// The member, without making an object.
pybind11::object toPython(Verdict verdict);
pybind11::object toPython(LimitKind kind);
pybind11::object toPython(ConstraintViolation::Kind kind);
pybind11::object toPython(ToolLineStop::Reason reason);
pybind11::object toPython(TaskChange::Kind kind);
pybind11::object toPython(PlannedSchedule::Status status);
///@}
///@{
/// The value of a member; throws ArgumentTypeError, naming the argument, for all else.
MotionQuery motionQueryOf(pybind11::handle value, const char* argument);
ClearanceQuery clearanceQueryOf(pybind11::handle value, const char* argument);
EnclosingKind enclosingKindOf(pybind11::handle value, const char* argument);
TaskChange::Kind changeKindOf(pybind11::handle value, const char* argument);
///@}

}  // namespace swept::python
