// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "broadphase/box_tree.hpp"

namespace swept::detail {

/// Boxes by number in two trees: most in one, and those that left their places since it was built
/// in a small one that is cheap to rebuild (the idea of log-structured merge trees: O'Neil, Cheng,
/// Gawlick, O'Neil 1996). The caller owns the boxes and passes them as `boxes`, by number.
class BoxForest {
 public:
  void insert(std::uint32_t owner, const FloatBox& box);
  void move(std::uint32_t owner, const FloatBox& box);
  void erase(std::uint32_t owner);
  /// Call it after changes: rebuilds a tree that has become slow to search.
  void tidy(std::span<const FloatBox> boxes);
  /// Of these boxes only, and in order.
  void build(std::span<const std::uint32_t> owners, std::span<const FloatBox> boxes);

  /// After `build`: each box takes the number of its slot, and there are no others.
  void ownBySlot();
  /// Near boxes mostly have near ranks. Below 2^rankBits().
  std::uint32_t rank(std::uint32_t owner) const {
    return places_[owner].slot << 1 | places_[owner].mover;
  }
  int rankBits() const {
    return 1 + static_cast<int>(std::bit_width(std::max(settled_.slots(), movers_.slots())));
  }

  void findOverlaps(const FloatBox& box, std::vector<std::uint32_t>& owners) const;
  const BoxTree& tree(std::size_t i) const { return i == 0 ? settled_ : movers_; }
  static constexpr std::size_t kTrees = 2;
  std::size_t bytes() const;

 private:
  struct Place {
    std::uint32_t mover : 1;
    std::uint32_t slot : 31;  ///< below 2^30
  };
  static constexpr std::uint32_t kSlotBits = 0x7FFFFFFF;
  BoxTree& treeOf(std::uint32_t owner) { return places_[owner].mover ? movers_ : settled_; }
  void gather(const BoxTree& tree);
  void number(const BoxTree& tree);

  BoxTree settled_, movers_;
  std::vector<Place> places_;
  std::vector<std::uint32_t> gathered_;
};

}  // namespace swept::detail
