// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include <vector>

#include "swept/core/enclosing_spheres.hpp"

namespace swept::python {

///@{
/// Spheres as rows (k, 4) of x, y, z and radius (m).
std::vector<EnclosingSphere> spheresOf(const pybind11::object& value, const char* argument);
pybind11::object arrayOf(const std::vector<EnclosingSphere>& spheres);
///@}

}  // namespace swept::python
