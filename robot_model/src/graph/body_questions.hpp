// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "certify/workspace_data.hpp"
#include "graph/box_table.hpp"

namespace swept::detail {

/// Asks a checker about pairs of the robot and one body of its world alone, in parts of motions.
class BodyQuestions {
 public:
  /// `checker` must outlive this; the body is one of its world.
  BodyQuestions(const Checker& checker, const MotionBoxes& boxes, std::string_view body);

  /// Whether the pieces of one motion, from `from` to `to`, stay apart from the body in the parts
  /// that are named. If they do in all others, by their boxes, the whole motion does.
  Verdict ask(std::span<const double> from, std::span<const double> to,
              std::span<const TouchedPiece> touched, WorkspaceData& workspace) const;

  /// Whoever asks needs one.
  WorkspaceData workspace() const { return WorkspaceData(model_); }

 private:
  std::span<const std::uint32_t> pairsOf(std::size_t piece) const {
    return std::span(pairs_).subspan(first_[piece], first_[piece + 1] - first_[piece]);
  }

  const CheckerModel& model_;
  std::vector<std::uint32_t> pairs_;  ///< of the checker, by piece of MotionBoxes
  std::vector<std::size_t> first_;    ///< of each piece, and one more
};

}  // namespace swept::detail
