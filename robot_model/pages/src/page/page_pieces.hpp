// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "output/text_output.hpp"
#include "page/page_frames.hpp"
#include "swept/robot_model/checker.hpp"

namespace swept {

/// One of the equal parts of a motion or curve, certified by itself.
struct PagePiece {
  Verdict verdict = Verdict::Undecided;
  Effort effort;
  ///@{
  /// m, proven and attained; 0 where there is a collision, infinity without pairs.
  double lower = 0.0, upper = 0.0;
  double lowerWorld = 0.0, lowerSelf = 0.0;
  ///@}
};

/// The equal parts of a motion. Their ends are Checker::interpolate's, so that each
/// begins exactly where the one before it ends.
std::vector<PagePiece> piecesOf(const Checker& checker, const PageSpan& span);

/// `lanes`: proven in single precision alone; `exact`: exact geometry was asked too; `undecided`,
/// `collision`; `violation`: a constraint does not hold somewhere in it.
std::string_view tierOf(const PagePiece& piece);

/// Arrays `tiers`, `lower` and `upper` (m; null: no pairs), a value for each piece.
Json piecesJson(const std::vector<PagePiece>& pieces);

}  // namespace swept
