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
    PagePiece piece{.certificate = checker.certifyMotion(from, to, workspace), .clearance = {}};
    if (piece.certificate.verdict != Verdict::Collision)
      piece.clearance = checker.motionClearance(from, to, clearanceAccuracy(checker), workspace);
    pieces.push_back(std::move(piece));
    from = std::move(to);
  }
  return pieces;
}

std::string_view tierOf(const MotionCertificate& certificate) {
  switch (certificate.verdict) {
    case Verdict::Free:
      return certificate.effort.intervals == 0 ? "lanes" : "exact";
    case Verdict::Collision:
      return "collision";
    case Verdict::Undecided:
      break;
  }
  return "undecided";
}

Json piecesJson(const std::vector<PagePiece>& pieces) {
  Json tiers = Json::array(), lower = Json::array(), upper = Json::array();
  Json world = Json::array(), self = Json::array();
  for (const PagePiece& piece : pieces) {
    tiers.push_back(tierOf(piece.certificate));
    lower.push_back(finiteOrNull(piece.clearance.lower));
    upper.push_back(finiteOrNull(piece.clearance.upper));
    world.push_back(finiteOrNull(piece.clearance.world.lower));
    self.push_back(finiteOrNull(piece.clearance.self.lower));
  }
  return {{"tiers", std::move(tiers)},
          {"lower", std::move(lower)},
          {"upper", std::move(upper)},
          {"lower_world", std::move(world)},
          {"lower_self", std::move(self)}};
}

}  // namespace swept
