// SPDX-License-Identifier: BSD-3-Clause
#include "graph/body_questions.hpp"

#include <algorithm>
#include <bit>

#include "certify/model_of.hpp"
#include "certify/motion_check.hpp"
#include "simd/compile/row.hpp"

namespace swept::detail {

BodyQuestions::BodyQuestions(const Checker& checker, const MotionBoxes& boxes,
                             std::string_view body)
    : model_(modelOf(checker)), first_{0} {
  const std::vector<WorldBody>& bodies = checker.world().bodies();
  const auto index = std::ranges::find(bodies, body, &WorldBody::name) - bodies.begin();
  for (std::size_t piece = 0; piece < boxes.pieces(); ++piece) {
    const std::size_t geometry = boxes.geometryOf(piece);
    for (std::uint32_t pair = model_.firstWorldPair[geometry];
         pair < model_.firstWorldPair[geometry + 1]; ++pair)
      if (model_.worldGeometry[model_.worldPairs[pair].b].body == index) pairs_.push_back(pair);
    first_.push_back(pairs_.size());
  }
}

Verdict BodyQuestions::ask(std::span<const double> from, std::span<const double> to,
                           std::span<const TouchedPiece> touched, WorkspaceData& workspace) const {
  std::uint32_t all = 0;
  for (const TouchedPiece& piece : touched) all |= piece.parts;
  // Sub-intervals are examined in lanes: twice as long ones where parts take more of these.
  const bool joined = std::popcount(all) > kLanes;
  const std::uint32_t own = joined ? 3U : 1U;
  const double length = (joined ? 2.0 : 1.0) / static_cast<double>(MotionBoxes::kParts);
  OpenWork& open = workspace.work.open;
  open.clear();
  double begin = 0.0;
  for (std::uint32_t mask = own; begin < 1.0; mask <<= joined ? 2 : 1, begin += length) {
    const std::size_t first = open.pairs.size();
    for (const TouchedPiece& piece : touched)
      if ((piece.parts & mask) != 0) {
        const std::span<const std::uint32_t> pairs = pairsOf(piece.piece);
        open.pairs.insert(open.pairs.end(), pairs.begin(), pairs.end());
      }
    if (open.pairs.size() > first)
      open.intervals.push_back({begin, begin + length, first, open.pairs.size() - first});
  }
  if (open.intervals.empty()) return Verdict::Free;  // none of the pairs is checked
  const Verdict verdict = certifyOpen(model_, from, to, workspace);
  if (verdict != Verdict::Undecided) return verdict;
  // Near the tolerance a proof may depend on which directions are tried.
  const MotionCertificate whole =
      certifyMotion(model_, from, to, MotionQuery::VerdictOnly, workspace);
  return whole.verdict == Verdict::Free ? Verdict::Free : verdict;
}

}  // namespace swept::detail
