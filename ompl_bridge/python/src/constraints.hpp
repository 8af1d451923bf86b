// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "swept/robot_model/task_constraint.hpp"

namespace swept::python {

/// A frame from an argument of Python: the name of a link or an attached body, or a pair of it and
/// the frame's pose (4, 4) in it; None: the model frame. Throws ArgumentTypeError for all else.
ConstraintFrame frameOf(const pybind11::object& value, const char* argument);

}  // namespace swept::python
