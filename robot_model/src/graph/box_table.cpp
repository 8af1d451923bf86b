// SPDX-License-Identifier: BSD-3-Clause
#include "graph/box_table.hpp"

#include <algorithm>
#include <bit>

namespace swept::detail {

void BoxTable::resize(std::size_t motions) {
  BoxRows nowhere;
  for (std::size_t i = 0; i < BoxRows::kBoxes; ++i) nowhere.put(i, boxKeys(emptyBox()));
  whole_.resize((motions + BoxRows::kBoxes - 1) / BoxRows::kBoxes * pieces_, nowhere);
  parts_.resize(motions * pieces_, nowhere);
  motions_ = motions;
}

void BoxTable::put(std::size_t motion, std::span<const SingleBox> boxes) {
  for (std::size_t piece = 0; piece < pieces_; ++piece) {
    SingleBox whole = emptyBox();
    for (std::size_t part = 0; part < MotionBoxes::kParts; ++part) {
      const SingleBox& box = boxes[part * pieces_ + piece];
      whole.extend(box);
      parts_[motion * pieces_ + piece].put(part, boxKeys(box));
    }
    whole_[motion / BoxRows::kBoxes * pieces_ + piece].put(motion % BoxRows::kBoxes,
                                                           boxKeys(whole));
  }
}

std::vector<TouchedPiece> BoxTable::touching(const BodySpace& space, std::size_t first) const {
  const BoxKeys body = boxKeys(space.box());
  const std::size_t firstRow = first / BoxRows::kBoxes * pieces_;
  const std::span<const BoxRows> rows = std::span(whole_).subspan(firstRow);
  std::vector<std::uint16_t> bits(rows.size());
  findOverlapping(rows, body, bits);
  std::vector<std::uint32_t> near;  // indices into parts_
  for (std::size_t begin = 0; begin < bits.size(); begin += pieces_) {
    const std::size_t group = (firstRow + begin) / pieces_ * BoxRows::kBoxes;
    std::uint32_t any = 0;
    for (std::size_t piece = 0; piece < pieces_; ++piece) any |= bits[begin + piece];
    for (; any != 0; any &= any - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(any));
      if (group + lane < first || group + lane >= motions_) continue;
      for (std::size_t piece = 0; piece < pieces_; ++piece)
        if ((bits[begin + piece] >> lane & 1U) != 0)
          near.push_back(static_cast<std::uint32_t>((group + lane) * pieces_ + piece));
    }
  }
  bits.resize(near.size());
  findOverlapping(parts_, near, body, bits);
  std::vector<TouchedPiece> touched;
  for (std::size_t i = 0; i < near.size(); ++i) {
    std::uint32_t parts = 0;
    for (std::uint32_t left = bits[i]; left != 0; left &= left - 1)
      if (space.touches(parts_[near[i]].box(static_cast<std::size_t>(std::countr_zero(left)))))
        parts |= left & (0U - left);
    if (parts != 0)
      touched.push_back({static_cast<std::uint32_t>(near[i] / pieces_),
                         static_cast<std::uint32_t>(near[i] % pieces_), parts});
  }
  return touched;
}

}  // namespace swept::detail
