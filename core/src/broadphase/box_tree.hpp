// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "broadphase/float_box.hpp"

namespace swept::detail {

/// Eight boxes, one per lane, in the layout that the SIMD kernels read. An empty lane holds NaN,
/// which overlaps nothing.
struct alignas(64) BoxBlock {
  static constexpr std::uint32_t kLanes = 8;
  std::array<std::array<float, kLanes>, 3> lower;  ///< m
  std::array<std::array<float, kLanes>, 3> upper;  ///< m

  FloatBox box(std::size_t lane) const;
  void set(std::size_t lane, const FloatBox& box);
  FloatBox bounds() const;  ///< of the lanes that hold a box; lower above upper if there is none
  static BoxBlock empty();
};

/// Boxes in an eight-wide tree without pointers: lane l of block b on one level bounds block
/// 8 b + l of the level below. The lowest level holds the boxes, in slots.
///
/// `build` puts near boxes of similar size side by side. Afterwards a box may move around its
/// place. If it moves farther, erase and append it; it is then behind the sorted ones until the
/// next `build`.
class BoxTree {
 public:
  using Slot = std::uint32_t;
  static constexpr std::uint32_t kNobody = 0xFFFFFFFF;
  static constexpr std::size_t kMostLevels = 11;  ///< 8^11 > 2^32

  Slot append(std::uint32_t owner, const FloatBox& box);
  void move(Slot slot, const FloatBox& box);
  void erase(Slot slot);
  void clear();
  /// Builds the tree of the boxes `boxes[owner]`, m, in slots of any order.
  void build(std::span<const std::uint32_t> owners, std::span<const FloatBox> boxes);

  void ownBySlot() { std::iota(owners_.begin(), owners_.end(), 0U); }

  /// Whether a box in this slot would keep its block small.
  bool hasRoom(Slot slot, const FloatBox& box) const;
  std::uint32_t owner(Slot slot) const { return owners_[slot]; }  ///< kNobody: an empty slot
  FloatBox box(Slot slot) const {
    return levels_[0][slot / BoxBlock::kLanes].box(slot % BoxBlock::kLanes);
  }
  std::size_t slots() const { return owners_.size(); }
  std::size_t live() const { return live_; }
  std::size_t unsorted() const { return slots() - sorted_; }

  /// 0 if the tree is empty. The topmost level has one block.
  std::size_t levels() const { return height_; }
  const std::vector<BoxBlock>& level(std::size_t i) const { return levels_[i]; }
  const std::vector<std::uint32_t>& owners() const { return owners_; }

  std::size_t bytes() const;

 private:
  struct Item {
    FloatBox box;
    std::array<float, 3> center;  ///< m
    std::uint32_t owner;
    std::uint32_t sizeClass;  ///< 0: the largest
  };
  void classify();
  void arrange(std::size_t first, std::size_t last);
  void bound();
  void refit(Slot slot);
  void makeRoomFor(std::size_t slots);

  std::array<std::vector<BoxBlock>, kMostLevels> levels_;
  std::vector<FloatBox> limits_;  ///< m, per sorted block: how far its boxes may move
  std::vector<std::uint32_t> owners_;
  std::vector<Item> items_;  // scratch of `build`
  std::size_t height_ = 0, live_ = 0, sorted_ = 0;
};

}  // namespace swept::detail
