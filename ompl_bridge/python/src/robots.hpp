// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>

#include "handles.hpp"

namespace swept::python {

/// Reads a robot from its files, or composes that of a work cell, without the GIL, and warns of
/// remarks.
RobotHandle loadRobot(const Source& source);

/// A group of a robot; throws std::invalid_argument, which lists those that there are.
const Group& groupOf(const Robot& robot, const std::string& name);

///@{
/// What a pickle has of a work cell, and the cell.
pybind11::tuple stateOfCell(const WorkCell& cell);
WorkCell cellOf(const pybind11::tuple& state);
///@}

}  // namespace swept::python
