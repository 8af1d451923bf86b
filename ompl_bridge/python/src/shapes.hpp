// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <Eigen/Geometry>
#include <utility>
#include <vector>

#include "swept/core/shapes.hpp"

namespace swept::python {

/// swept.Shape.
struct ShapeHandle {
  Shape shape;
};

/// The pieces of a body: `shape` is a Shape, or a list of pairs of a Shape and its pose (4, 4).
/// Each pose is that in the frame of `pose`. Throws ArgumentTypeError for all else.
std::vector<std::pair<Shape, Eigen::Isometry3d>> piecesOf(const pybind11::object& shape,
                                                          const pybind11::object& pose);

}  // namespace swept::python
