// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "narrowphase/part_approach.hpp"
#include "narrowphase/piece_pair.hpp"
#include "swept/core/separation.hpp"

namespace swept::detail {

/// No motion, for a distance query.
using PieceApproach = std::optional<PartApproach>;

/// How the pieces of two sides move, where a motion bound is searched for.
class PieceMotions {
 public:
  /// `bound`: null in a distance query.
  PieceMotions(const Side& a, const Side& b, const Eigen::Isometry3d& a_from_b,
               const ApproachBound* bound)
      : a_(a), b_(b), bound_(bound) {
    if (bound != nullptr) parts_.emplace(*bound, a_from_b);
  }

  PartMotion of(bool ofA, const Piece& piece) const {
    if (!parts_) return {};
    const bool flat = piece.isWhole() && (ofA ? a_ : b_).convex.isFlat();
    return flat ? parts_->ofBall(ofA) : parts_->of(ofA, piece.box);
  }

  /// Refers to both.
  PieceApproach approach(const PartMotion& a, const PartMotion& b) const {
    if (bound_ == nullptr) return std::nullopt;
    return PartApproach(*bound_, a, b);
  }

 private:
  const Side& a_;
  const Side& b_;
  const ApproachBound* bound_;
  std::optional<PartMotions> parts_;
};

}  // namespace swept::detail
