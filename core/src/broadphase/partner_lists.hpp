// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <hwy/cache_control.h>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace swept::detail {

/// For each box, the list of boxes near it. Both boxes of a pair list each other and store the
/// position, so a pair is removed in constant time even if one of the two is near everything.
class PartnerLists {
 public:
  struct Partner {
    std::uint32_t box : 31;
    std::uint32_t overlaps : 1;  ///< whether the boxes themselves overlap, not only their rooms
    std::uint32_t mate;          ///< position of this box in the partner's list
  };

  /// Lists are those of boxes 0 ... count - 1; new ones are empty.
  void resize(std::size_t count) { lists_.resize(count); }
  std::span<const Partner> of(std::uint32_t box) const {
    return {arena_.data() + lists_[box].offset, lists_[box].count};
  }

  /// Prefetch memory that will be read soon: the list's header, then the list.
  void prefetchPlace(std::uint32_t box) const { hwy::Prefetch(&lists_[box]); }
  void prefetch(std::uint32_t box) const { hwy::Prefetch(arena_.data() + lists_[box].offset); }

  void add(std::uint32_t a, std::uint32_t b, bool overlap) {
    const std::uint32_t atA = lists_[a].count, atB = lists_[b].count;
    push(a, {b & kBoxBits, overlap, atB});
    push(b, {a & kBoxBits, overlap, atA});
  }
  /// The last entry of the list takes the place of the removed one.
  void remove(std::uint32_t box, std::uint32_t position) {
    const Partner gone = at(box, position);
    drop(box, position);
    drop(gone.box, gone.mate);
  }
  void setOverlap(std::uint32_t box, std::uint32_t position, bool overlap) {
    Partner& partner = at(box, position);
    partner.overlaps = overlap ? 1 : 0;
    at(partner.box, partner.mate).overlaps = partner.overlaps;
  }

  void clear();
  /// For empty lists: reserves space for this many partners of each box, side by side.
  void reserve(std::span<const std::uint32_t> counts);
  std::size_t bytes() const;

 private:
  struct List {
    std::uint32_t offset = 0, count = 0, room = 0;
  };
  static constexpr std::uint32_t kBoxBits = 0x7FFFFFFF, kLeastRoom = 4;

  Partner& at(std::uint32_t box, std::uint32_t position) {
    return arena_[lists_[box].offset + position];
  }
  void push(std::uint32_t box, Partner partner) {
    if (lists_[box].count == lists_[box].room) grow(lists_[box]);
    arena_[lists_[box].offset + lists_[box].count++] = partner;
  }
  void drop(std::uint32_t box, std::uint32_t position) {
    const std::uint32_t last = --lists_[box].count;
    if (position == last) return;
    const Partner moved = at(box, last);
    at(box, position) = moved;
    at(moved.box, moved.mate).mate = position;
  }
  void grow(List& list);

  std::vector<List> lists_;
  std::vector<Partner> arena_;
  std::array<std::vector<std::uint32_t>, 32> free_;  ///< offsets of pieces of 2^i
};

}  // namespace swept::detail
