// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/partner_lists.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace swept::detail {
namespace {

/// Offsets have 32 bits.
void requirePlaces(std::size_t count) {
  if (count > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error(
        "SweepAndPrune: so many pairs of near boxes that their lists would take more than 2^32 "
        "places");
  }
}

}  // namespace

void PartnerLists::grow(List& list) {
  const std::uint32_t room = list.room == 0 ? kLeastRoom : 2 * list.room;
  std::vector<std::uint32_t>& pieces = free_[std::countr_zero(room)];
  std::uint32_t offset = 0;
  if (pieces.empty()) {
    requirePlaces(arena_.size() + room);
    offset = static_cast<std::uint32_t>(arena_.size());
    arena_.resize(arena_.size() + room);
  } else {
    offset = pieces.back();
    pieces.pop_back();
  }
  std::copy_n(arena_.begin() + list.offset, list.count, arena_.begin() + offset);
  if (list.room > 0) free_[std::countr_zero(list.room)].push_back(list.offset);
  list.offset = offset;
  list.room = room;
}

void PartnerLists::clear() {
  std::fill(lists_.begin(), lists_.end(), List{});
  arena_.clear();
  for (std::vector<std::uint32_t>& pieces : free_) pieces.clear();
}

void PartnerLists::reserve(std::span<const std::uint32_t> counts) {
  const auto roomFor = [](std::uint32_t count) {
    return std::max(kLeastRoom, std::bit_ceil(count));
  };
  std::size_t total = 0;
  for (const std::uint32_t count : counts) total += roomFor(count);
  requirePlaces(total);
  arena_.resize(total);
  // No list has room before there is any.
  std::uint32_t offset = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    lists_[i].offset = offset;
    lists_[i].room = roomFor(counts[i]);
    offset += lists_[i].room;
  }
}

std::size_t PartnerLists::bytes() const {
  std::size_t sum = lists_.capacity() * sizeof(List) + arena_.capacity() * sizeof(Partner);
  for (const std::vector<std::uint32_t>& pieces : free_)
    sum += pieces.capacity() * sizeof(std::uint32_t);
  return sum;
}

}  // namespace swept::detail
