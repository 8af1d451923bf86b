// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "swept/robot_model/attached_body.hpp"
#include "swept/robot_model/world.hpp"

/// Bodies from the arguments of Python.
namespace swept::python {

///@{
/// `shape` and `pose` as in piecesOf().
WorldBody bodyOf(const std::string& name, const pybind11::object& shape,
                 const pybind11::object& pose);
AttachedBody attachedOf(const std::string& name, const std::string& link,
                        const pybind11::object& shape, const pybind11::object& pose,
                        std::vector<std::string> touchLinks);
///@}
/// `times`: (n,), s. `poses`: as many poses (4, 4).
MovingObstacle obstacleOf(const std::string& name, const pybind11::object& shape,
                          const pybind11::object& times, const pybind11::object& poses);

}  // namespace swept::python
