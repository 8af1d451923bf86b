// SPDX-License-Identifier: BSD-3-Clause
#include "page/page_pieces.hpp"

#include <algorithm>

namespace swept {

namespace {

/// The tolerance (m): a tenth of the one that decides, but no less than this. Where two bodies stay
/// equally far apart during the whole motion, the work grows with the inverse of the tolerance.
double clearanceAccuracy(const Checker& checker) {
  return std::max(0.1 * checker.options().tolerance, 1e-5);
}

}  // namespace

std::vector<PagePiece> piecesOf(const Checker& checker, const PageSpan& span) {
  Workspace workspace(checker);
  std::vector<PagePiece> pieces;
  std::vector<double> from = span.from;
  const int count = span.steps / kFramesPerPiece;
  for (int i = 1; i <= count; ++i) {
    std::vector<double> to = span.to;
    if (i < count) checker.interpolate(span.from, span.to, static_cast<double>(i) / count, to);
    const MotionCertificate certificate = checker.certifyMotion(from, to, workspace);
    PagePiece& piece = pieces.emplace_back();
    piece.verdict = certificate.verdict;
    piece.effort = certificate.effort;
    if (piece.verdict != Verdict::Collision) {
      const MotionClearance least =
          checker.motionClearance(from, to, clearanceAccuracy(checker), workspace);
      piece.lower = least.lower;
      piece.upper = least.upper;
      piece.lowerWorld = least.world.lower;
      piece.lowerSelf = least.self.lower;
    }
    from = std::move(to);
  }
  return pieces;
}

std::string_view tierOf(const PagePiece& piece) {
  switch (piece.verdict) {
    case Verdict::Free:
      return piece.effort.intervals == 0 ? "lanes" : "exact";
    case Verdict::Collision:
      return "collision";
    case Verdict::Violation:
      return "violation";
    case Verdict::Undecided:
      break;
  }
  return "undecided";
}

Json piecesJson(const std::vector<PagePiece>& pieces) {
  Json tiers = Json::array(), lower = Json::array(), upper = Json::array();
  Json world = Json::array(), self = Json::array();
  for (const PagePiece& piece : pieces) {
    tiers.push_back(tierOf(piece));
    lower.push_back(finiteOrNull(piece.lower));
    upper.push_back(finiteOrNull(piece.upper));
    world.push_back(finiteOrNull(piece.lowerWorld));
    self.push_back(finiteOrNull(piece.lowerSelf));
  }
  return {{"tiers", std::move(tiers)},
          {"lower", std::move(lower)},
          {"upper", std::move(upper)},
          {"lower_world", std::move(world)},
          {"lower_self", std::move(self)}};
}

}  // namespace swept
