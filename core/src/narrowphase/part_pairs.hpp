// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "narrowphase/piece_findings.hpp"
#include "narrowphase/piece_pair.hpp"

namespace swept::detail {

/// What the convex parts around two bodies say about these.
enum class PartsAnswer : std::uint8_t {
  Open,        ///< nothing: the pieces must be asked
  Apart,       ///< each pair of parts is as far apart as the motion needs
  OutOfReach,  ///< all are apart, but some by so little that the pieces will not do better
};

/// For a motion bound. A side without parts counts as one, the convex body around it. Whatever is
/// not Open is noted in `found`: the least distance, or the direction of a pair that is too near.
PartsAnswer compareParts(const Side& a, const Side& b, const Eigen::Isometry3d& a_from_b,
                         const PieceMotions& motions, PieceFindings& found);

}  // namespace swept::detail
