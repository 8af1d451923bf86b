// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "lanes/clearance_field.hpp"
#include "lanes/voxels.hpp"

namespace swept::detail {

/// Fills in the values of cells and bricks. `field` has its grid, and the voxels are those of it.
void measureDistances(const Voxels& voxels, ClearanceField& field);

}  // namespace swept::detail
