// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/sweep_and_prune_state.hpp"

#include <hwy/cache_control.h>

#include <algorithm>
#include <bit>

#include "broadphase/room.hpp"

namespace swept {
namespace {

using detail::PairKey;

/// Number of boxes between prefetching memory and using it.
constexpr std::size_t kAhead = 8;

/// For fewer boxes, everything is in the cache.
constexpr std::size_t kManyBoxes = 5000;

/// Like Aabb::overlaps(), for boxes without NaN and without branches. Whether near boxes overlap is
/// unpredictable; in a tree the first axis separates most boxes.
bool overlap(const Aabb& a, const Aabb& b) {
  int meets = 1;
  for (int k = 0; k < 3; ++k) {
    meets &= static_cast<int>(a.lower[k] <= b.upper[k]);
    meets &= static_cast<int>(b.lower[k] <= a.upper[k]);
  }
  return meets != 0;
}

/// It may cross two cache lines.
void prefetch(const Aabb& box) {
  hwy::Prefetch(&box);
  hwy::Prefetch(reinterpret_cast<const char*>(&box + 1) - 1);
}

}  // namespace

SweepAndPrune::State::Number SweepAndPrune::State::takeNumber(BoxHandle handle) {
  auto number = static_cast<Number>(placed_.size());
  if (free_.empty()) {
    placed_.push_back({{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}, handle});
  } else {
    number = free_.back();
    free_.pop_back();
    placed_[number].owner = handle;
  }
  numbers_.resize(handles_.end());
  numbers_[handle] = number;
  return number;
}

void SweepAndPrune::State::resize() {
  const std::size_t count = placed_.size();
  rooms_.resize(count);
  moved_.resize(count);
  kept_.resize(count);
  partners_.resize(count);
}

int SweepAndPrune::State::handleBits() const {
  return static_cast<int>(std::bit_width(handles_.end()));
}

bool SweepAndPrune::State::manyLeft() const {
  return left_.size() > 32 && left_.size() > handles_.live() / 3;
}

std::vector<BoxHandle> SweepAndPrune::State::add(std::span<const Aabb> boxes) {
  std::vector<BoxHandle> handles;
  handles.reserve(boxes.size());
  left_.clear();
  for (const Aabb& box : boxes) {
    // If it is one of our own boxes, it is the only one, and its memory may move with the number.
    const Aabb bounded = boundedOrEverywhere(box);
    handles.push_back(handles_.take());
    left_.push_back(takeNumber(handles.back()));
    placed_[left_.back()].box = bounded;
  }
  resize();
  for (const Number number : left_) rooms_[number] = detail::floatBox(placed_[number].box);
  if (manyLeft()) {
    rebuild();
  } else {
    toggled_.clear();
    for (const Number number : left_) forest_.insert(number, rooms_[number]);
    settle();
  }
  return handles;
}

void SweepAndPrune::State::remove(BoxHandle handle) {
  handles_.require(handle);
  const Number number = numbers_[handle];
  toggled_.clear();
  for (std::span<const detail::PartnerLists::Partner> list = partners_.of(number); !list.empty();
       list = partners_.of(number)) {
    if (list.back().overlaps) toggled_.push_back(key(number, list.back().box));
    partners_.remove(number, static_cast<std::uint32_t>(list.size() - 1));
  }
  forest_.erase(number);
  forest_.tidy(rooms_);
  handles_.giveBack(handle);
  placed_[number].owner = kNobody;
  free_.push_back(number);
  pairs_.toggle(toggled_, handleBits());
}

void SweepAndPrune::State::stage(Number number, const Aabb& box) {
  const Aabb moved = boundedOrEverywhere(box);
  if (!rooms_[number].contains(moved)) {
    rooms_[number] = detail::roomFor(placed_[number].box, moved, number);
    left_.push_back(number);
  }
  placed_[number].box = moved;
}

/// Calls `act` for each number in order, some time after prefetching the memory of its partners,
/// except of those to be skipped: these may be anywhere, and waiting for them would take most of
/// the time.
template <typename Skip, typename Act>
void SweepAndPrune::State::forEach(std::span<const Number> numbers, const Skip& skip,
                                   const Act& act) {
  const auto at = [&](std::size_t i, const auto& ask) {
    if (i < numbers.size()) ask(numbers[i]);
  };
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    at(i + 3 * kAhead, [&](Number number) { partners_.prefetchPlace(number); });
    at(i + 2 * kAhead, [&](Number number) { partners_.prefetch(number); });
    at(i + kAhead, [&](Number number) {
      for (const detail::PartnerLists::Partner& partner : partners_.of(number))
        if (!skip(number, partner.box)) hwy::Prefetch(&placed_[partner.box]);
    });
    act(numbers[i]);
  }
}

template <typename Skip>
void SweepAndPrune::State::look(Number number, const Skip& skip) {
  const Aabb& box = placed_[number].box;
  const std::span<const detail::PartnerLists::Partner> list = partners_.of(number);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Number other = list[i].box;
    if (skip(number, other)) continue;
    const bool overlaps = overlap(box, placed_[other].box);
    if (overlaps == (list[i].overlaps != 0)) continue;
    partners_.setOverlap(number, static_cast<std::uint32_t>(i), overlaps);
    toggled_.push_back(key(number, other));
  }
}

void SweepAndPrune::State::update(std::span<const BoxHandle> handles, std::span<const Aabb> boxes) {
  handles_.require(handles, boxes);
  // In the order of the numbers, if that saves memory; of duplicates the last one counts.
  keys_.clear();
  for (std::size_t i = 0; i < handles.size(); ++i)
    keys_.push_back(PairKey{numbers_[handles[i]]} << 32 | i);
  if (placed_.size() > kManyBoxes)
    detail::sortPairs(keys_, 0, static_cast<int>(std::bit_width(placed_.size())), scratch_);
  left_.clear();
  changed_.clear();
  moved_.clear();
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (i + kAhead < keys_.size()) {
      const auto ahead = static_cast<Number>(keys_[i + kAhead] >> 32);
      hwy::Prefetch(&placed_[ahead]);
      hwy::Prefetch(&rooms_[ahead]);
    }
    const auto number = static_cast<Number>(keys_[i] >> 32);
    stage(number, boxes[keys_[i] & 0xFFFFFFFF]);
    changed_.push_back(number);
    moved_.insert(number);
  }
  if (manyLeft()) return rebuild();
  toggled_.clear();
  const auto isSeen = [&](Number number, Number other) {
    return other < number && moved_.contains(other);
  };
  forEach(changed_, isSeen, [&](Number number) { look(number, isSeen); });
  for (const Number number : left_) forest_.move(number, rooms_[number]);
  settle();
}

void SweepAndPrune::State::updateAll(std::span<const Aabb> boxes) {
  detail::Handles::requireAsMany(handles_.live(), boxes.size());
  // Which of the boxes belongs to a handle; the handle itself if none is free, which saves a
  // look-up.
  const bool dense = handles_.live() == handles_.end();
  counts_.resize(dense ? 0 : handles_.end());
  std::uint32_t next = 0;
  for (BoxHandle handle = 0; handle < counts_.size(); ++handle)
    counts_[handle] = handles_.contains(handle) ? next++ : next;
  const auto boxOf = [&](BoxHandle handle) -> const Aabb& {
    return boxes[dense ? handle : counts_[handle]];
  };
  left_.clear();
  changed_.clear();
  for (Number number = 0; number < placed_.size(); ++number) {
    const std::size_t ahead = number + kAhead;
    if (ahead < placed_.size() && placed_[ahead].owner != kNobody)
      prefetch(boxOf(placed_[ahead].owner));
    if (placed_[number].owner == kNobody) continue;
    stage(number, boxOf(placed_[number].owner));
    changed_.push_back(number);
  }
  if (manyLeft()) return rebuild();
  toggled_.clear();
  const auto isSeen = [](Number number, Number other) { return other < number; };
  forEach(changed_, isSeen, [&](Number number) { look(number, isSeen); });
  for (const Number number : left_) forest_.move(number, rooms_[number]);
  settle();
}

/// Finds the partners of boxes in new rooms.
void SweepAndPrune::State::settle() {
  forest_.tidy(rooms_);
  // In the order of the trees, so that a search finds in the cache what the last one needed.
  keys_.clear();
  for (const Number number : left_) keys_.push_back(PairKey{forest_.rank(number)} << 32 | number);
  if (placed_.size() > kManyBoxes) detail::sortPairs(keys_, 0, forest_.rankBits(), scratch_);
  for (std::size_t i = 0; i < keys_.size(); ++i) left_[i] = static_cast<Number>(keys_[i]);
  const auto none = [](Number, Number) { return false; };
  forEach(left_, none, [&](Number number) { relink(number); });
  pairs_.toggle(toggled_, handleBits());
}

void SweepAndPrune::State::link(Number a, Number b) {
  const bool overlaps = overlap(placed_[a].box, placed_[b].box);
  partners_.add(a, b, overlaps);
  if (overlaps) toggled_.push_back(key(a, b));
}

/// Partners out of reach do not overlap and have been tested: removing them does not change the
/// pairs.
void SweepAndPrune::State::relink(Number number) {
  kept_.clear();
  kept_.insert(number);
  for (auto i = static_cast<std::uint32_t>(partners_.of(number).size()); i-- > 0;) {
    const Number other = partners_.of(number)[i].box;
    if (rooms_[number].overlaps(rooms_[other]))
      kept_.insert(other);
    else
      partners_.remove(number, i);
  }
  found_.clear();
  forest_.findOverlaps(rooms_[number], found_);
  for (const Number other : found_)
    if (!kept_.contains(other)) link(number, other);
}

/// From then on numbers are slots of the tree.
void SweepAndPrune::State::renumber() {
  left_.clear();
  for (Number number = 0; number < placed_.size(); ++number)
    if (placed_[number].owner != kNobody) left_.push_back(number);
  forest_.build(left_, rooms_);
  const std::vector<Number>& order = forest_.tree(0).owners();
  renumbered_.clear();
  for (const Number number : order) {
    renumbered_.push_back(placed_[number]);
  }
  placed_.swap(renumbered_);
  free_.clear();
  resize();
  for (Number number = 0; number < placed_.size(); ++number) {
    numbers_[placed_[number].owner] = number;
    rooms_[number] = forest_.tree(0).box(number);
  }
  forest_.ownBySlot();
}

/// Rebuilds everything from the boxes and their rooms.
void SweepAndPrune::State::rebuild() {
  renumber();
  keys_.clear();
  counts_.assign(placed_.size(), 0);
  for (Number number = 0; number < placed_.size(); ++number) {
    found_.clear();
    forest_.findOverlaps(rooms_[number], found_);
    counts_[number] = static_cast<std::uint32_t>(found_.size() - 1);
    for (const Number other : found_)
      if (other > number) keys_.push_back(detail::pairKey(number, other));
  }
  partners_.clear();
  partners_.reserve(counts_);
  toggled_.clear();
  for (const PairKey near : keys_) link(static_cast<Number>(near >> 32), static_cast<Number>(near));
  detail::sortPairs(toggled_, handleBits(), handleBits(), scratch_);
  pairs_.replace(toggled_);
}

std::size_t SweepAndPrune::State::bytes() const {
  const std::size_t keys = toggled_.capacity() + keys_.capacity() + scratch_.capacity();
  const std::size_t numbers = numbers_.capacity() + free_.capacity() + changed_.capacity() +
                              left_.capacity() + found_.capacity() + counts_.capacity();
  return sizeof(State) + handles_.bytes() + moved_.bytes() + kept_.bytes() + forest_.bytes() +
         partners_.bytes() + pairs_.bytes() + keys * sizeof(PairKey) + numbers * sizeof(Number) +
         (placed_.capacity() + renumbered_.capacity()) * sizeof(detail::PlacedBox) +
         rooms_.capacity() * sizeof(detail::FloatBox);
}

}  // namespace swept
