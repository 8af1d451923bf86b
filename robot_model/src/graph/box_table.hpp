// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "graph/body_space.hpp"
#include "graph/box_rows.hpp"
#include "graph/motion_boxes.hpp"

namespace swept::detail {

/// A piece of the robot whose boxes touch a body of the world.
struct TouchedPiece {
  std::uint32_t motion = 0;
  std::uint32_t piece = 0;
  std::uint32_t parts = 0;  ///< of the motion, a bit each, the first in the lowest
};

/// The boxes of many motions, of each piece in each part, as keys and in the order in which they
/// are asked for. First the box of each piece over the whole motion, of sixteen motions side by
/// side: most are apart from a body.
class BoxTable {
 public:
  explicit BoxTable(std::size_t pieces) : pieces_(pieces) {}

  /// Boxes of motions that are not put yet hold nothing.
  void resize(std::size_t motions);
  /// As MotionBoxes::find() gives them.
  void put(std::size_t motion, std::span<const SingleBox> boxes);
  /// Of the motions from `first` on, what is not proven apart from the body; by motion.
  std::vector<TouchedPiece> touching(const BodySpace& space, std::size_t first) const;

 private:
  static_assert(MotionBoxes::kParts == BoxRows::kBoxes);

  std::size_t pieces_;
  std::size_t motions_ = 0;
  std::vector<BoxRows> whole_;  ///< sixteen motions, by group of these, then by piece
  std::vector<BoxRows> parts_;  ///< by motion, then by piece
};

}  // namespace swept::detail
