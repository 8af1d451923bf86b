// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "narrowphase/piece_findings.hpp"
#include "narrowphase/piece_motions.hpp"

namespace swept::detail {

/// Branch and bound over all pairs of pieces of two sides, not both of them convex. Adds to
/// `found`, whose hint (a's frame) is tried first; ends early in contact.
void descendPieces(const Side& a, const Side& b, const Eigen::Isometry3d& a_from_b,
                   const PieceMotions& motions, PieceFindings& found);

}  // namespace swept::detail
