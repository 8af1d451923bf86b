// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <stop_token>
#include <vector>

#include "swept/core/enclosing_spheres.hpp"

namespace swept::python {

///@{
/// Spheres as rows (k, 4) of x, y, z and radius (m).
std::vector<EnclosingSphere> spheresOf(const pybind11::object& value, const char* argument);
pybind11::object arrayOf(const std::vector<EnclosingSphere>& spheres);
///@}
///@{
/// A body, as piecesOf() reads it, and the list of pairs of a swept.Shape and its pose (4, 4).
std::vector<PosedShape> posedOf(const pybind11::object& shape);
pybind11::list listOf(const std::vector<PosedShape>& shapes);
///@}

inline StopQuestion questionOf(const std::stop_token& stop) {
  return [stop] { return stop.stop_requested(); };
}

}  // namespace swept::python
