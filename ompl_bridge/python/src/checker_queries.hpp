// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pybind11/pybind11.h>

#include "handles.hpp"

namespace swept::python {

/// Adds the queries about states and motions to swept.Checker.
void addQueries(pybind11::class_<CheckerHandle>& type);

}  // namespace swept::python
