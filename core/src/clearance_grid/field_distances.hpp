// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "clearance_grid/voxels.hpp"
#include "swept/core/clearance_field.hpp"

namespace swept::detail {

class Crew;

// In each function, `field` has its grid, and the voxels belong to that grid. The work is done by
// layers of blocks, each on some thread of the crew.

/// Fills in the values of the cells.
void measureCells(const Voxels& voxels, Crew& crew, ClearanceField& field);
/// Fills in the bricks and the values of their voxels.
void measureBricks(const Voxels& voxels, Crew& crew, ClearanceField& field);

}  // namespace swept::detail
