// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <ompl/base/StateSpace.h>

namespace swept {

/// Gives a space that is set up a projection onto its first two values where OMPL 1.5 has no
/// default one that works: compound spaces have none, and the one for up to two dimensions fails an
/// assertion inside OMPL. Planners that keep grids (KPIECE1, PDST, SBL, ...) need one.
void registerProjection(ompl::base::StateSpace& space);

}  // namespace swept
