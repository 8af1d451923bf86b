// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/sweep_and_prune_state.hpp"

#include <hwy/cache_control.h>
#include <algorithm>
#include <bit>

#include "broadphase/room.hpp"

namespace swept {
namespace {

using detail::PairKey;
using detail::pairKey;

/// Boxes between the request for memory and its use.
constexpr std::uint32_t kAhead = 6;

/// Without branches: whether near boxes overlap is anyone's guess.
bool overlap(const Aabb& a, const Aabb& b) {
  int meets = 1;
  for (int k = 0; k < 3; ++k) {
    meets &= static_cast<int>(a.lower[k] <= b.upper[k]);
    meets &= static_cast<int>(b.lower[k] <= a.upper[k]);
  }
  return meets != 0;
}

}  // namespace

void SweepAndPrune::State::resize() {
  const std::size_t count = handles_.end();
  boxes_.resize(count);
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

void SweepAndPrune::State::add(std::span<const Aabb> boxes, std::vector<BoxHandle>& handles) {
  left_.clear();
  for (std::size_t i = 0; i < boxes.size(); ++i) left_.push_back(handles_.take());
  handles = left_;
  resize();
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    boxes_[left_[i]] = boundedOrEverywhere(boxes[i]);
    rooms_[left_[i]] = detail::floatBox(boxes_[left_[i]]);
  }
  if (manyLeft()) return rebuild();
  toggled_.clear();
  for (const BoxHandle handle : left_) forest_.insert(handle, rooms_[handle]);
  settleLeavers();
}

void SweepAndPrune::State::remove(BoxHandle handle) {
  handles_.require(handle);
  toggled_.clear();
  for (std::span<const detail::PartnerLists::Partner> list = partners_.of(handle); !list.empty();
       list = partners_.of(handle)) {
    if (list.back().overlaps) toggled_.push_back(pairKey(handle, list.back().box));
    partners_.remove(handle, static_cast<std::uint32_t>(list.size() - 1));
  }
  forest_.erase(handle);
  forest_.tidy(rooms_);
  handles_.giveBack(handle);
  pairs_.toggle(toggled_, handleBits());
}

void SweepAndPrune::State::stage(BoxHandle handle, const Aabb& box) {
  const Aabb moved = boundedOrEverywhere(box);
  if (!rooms_[handle].contains(moved)) {
    rooms_[handle] = detail::roomFor(boxes_[handle], moved, handle);
    left_.push_back(handle);
  }
  boxes_[handle] = moved;
}

void SweepAndPrune::State::prefetch(BoxHandle handle) const {
  const auto* box = reinterpret_cast<const char*>(&boxes_[handle]);
  hwy::Prefetch(box);
  hwy::Prefetch(box + sizeof(Aabb) - 1);
}

/// Calls `act` for each handle in order, a while after it has asked for the memory of its partners:
/// these may be anywhere, and waiting for them would take most of the time.
template <typename Act>
void SweepAndPrune::State::forEach(std::span<const BoxHandle> handles, const Act& act) {
  const auto at = [&](std::size_t i, const auto& ask) {
    if (i < handles.size()) ask(handles[i]);
  };
  for (std::size_t i = 0; i < handles.size(); ++i) {
    at(i + 3 * kAhead, [&](BoxHandle handle) { partners_.prefetchPlace(handle); });
    at(i + 2 * kAhead, [&](BoxHandle handle) { partners_.prefetch(handle); });
    at(i + kAhead, [&](BoxHandle handle) {
      prefetch(handle);
      for (const detail::PartnerLists::Partner& partner : partners_.of(handle))
        prefetch(partner.box);
    });
    act(handles[i]);
  }
}

template <typename Skip>
void SweepAndPrune::State::look(BoxHandle handle, const Skip& skip) {
  const Aabb& box = boxes_[handle];
  const std::span<const detail::PartnerLists::Partner> list = partners_.of(handle);
  for (std::size_t i = 0; i < list.size(); ++i) {
    const BoxHandle other = list[i].box;
    if (skip(other)) continue;
    const bool overlaps = overlap(box, boxes_[other]);
    if (overlaps == (list[i].overlaps != 0)) continue;
    partners_.setOverlap(handle, static_cast<std::uint32_t>(i), overlaps);
    toggled_.push_back(pairKey(handle, other));
  }
}

void SweepAndPrune::State::update(std::span<const BoxHandle> handles, std::span<const Aabb> boxes) {
  handles_.require(handles, boxes);
  left_.clear();
  moved_.clear();
  for (std::size_t i = 0; i < handles.size(); ++i) {
    if (i + kAhead < handles.size()) {
      prefetch(handles[i + kAhead]);
      hwy::Prefetch(&rooms_[handles[i + kAhead]]);
    }
    stage(handles[i], boxes[i]);
    moved_.insert(handles[i]);
  }
  if (manyLeft()) return rebuild();
  toggled_.clear();
  forEach(handles, [&](BoxHandle handle) {
    look(handle, [&](BoxHandle other) { return other < handle && moved_.contains(other); });
  });
  for (const BoxHandle handle : left_) forest_.move(handle, rooms_[handle]);
  settleLeavers();
}

void SweepAndPrune::State::updateAll(std::span<const Aabb> boxes) {
  detail::Handles::requireAsMany(handles_.live(), boxes.size());
  left_.clear();
  found_.clear();
  for (BoxHandle handle = 0; handle < handles_.end(); ++handle) {
    if (!handles_.contains(handle)) continue;
    stage(handle, boxes[found_.size()]);
    found_.push_back(handle);
  }
  if (manyLeft()) return rebuild();
  toggled_.clear();
  forEach(found_, [&](BoxHandle handle) {
    look(handle, [handle](BoxHandle other) { return other < handle; });
  });
  for (const BoxHandle handle : left_) forest_.move(handle, rooms_[handle]);
  settleLeavers();
}

void SweepAndPrune::State::settleLeavers() {
  forest_.tidy(rooms_);
  // In the order of the trees, so that searches find in the cache what the last ones needed.
  near_.clear();
  for (const BoxHandle handle : left_)
    near_.push_back(PairKey{forest_.rank(handle)} << 32 | handle);
  detail::sortPairs(near_, 0, forest_.rankBits(), scratch_);
  for (std::size_t i = 0; i < near_.size(); ++i) left_[i] = static_cast<BoxHandle>(near_[i]);
  forEach(left_, [&](BoxHandle handle) { relink(handle); });
  pairs_.toggle(toggled_, handleBits());
}

void SweepAndPrune::State::link(BoxHandle a, BoxHandle b) {
  const bool overlaps = overlap(boxes_[a], boxes_[b]);
  partners_.add(a, b, overlaps);
  if (overlaps) toggled_.push_back(pairKey(a, b));
}

/// Partners out of reach do not overlap, and have been looked at: the pairs do not change with
/// them.
void SweepAndPrune::State::relink(BoxHandle handle) {
  kept_.clear();
  kept_.insert(handle);
  for (auto i = static_cast<std::uint32_t>(partners_.of(handle).size()); i-- > 0;) {
    const BoxHandle other = partners_.of(handle)[i].box;
    if (rooms_[handle].overlaps(rooms_[other]))
      kept_.insert(other);
    else
      partners_.remove(handle, i);
  }
  found_.clear();
  forest_.findOverlaps(rooms_[handle], found_);
  for (const BoxHandle other : found_)
    if (!kept_.contains(other)) link(handle, other);
}

void SweepAndPrune::State::rebuild() {
  left_.clear();
  for (BoxHandle handle = 0; handle < handles_.end(); ++handle)
    if (handles_.contains(handle)) left_.push_back(handle);
  forest_.build(left_, rooms_);
  near_.clear();
  counts_.assign(handles_.end(), 0);
  // In the order of the tree, what is needed is still in the cache.
  for (const BoxHandle handle : forest_.tree(0).owners()) {
    found_.clear();
    forest_.findOverlaps(rooms_[handle], found_);
    counts_[handle] = static_cast<std::uint32_t>(found_.size() - 1);
    for (const BoxHandle other : found_)
      if (other > handle) near_.push_back(pairKey(handle, other));
  }
  detail::sortPairs(near_, handleBits(), handleBits(), scratch_);
  partners_.clear();
  partners_.reserve(counts_);
  toggled_.clear();
  for (const PairKey key : near_)
    link(static_cast<BoxHandle>(key >> 32), static_cast<BoxHandle>(key));
  pairs_.replace(toggled_);
}

std::size_t SweepAndPrune::State::bytes() const {
  const std::size_t keys = toggled_.capacity() + near_.capacity() + scratch_.capacity();
  return sizeof(State) + handles_.bytes() + boxes_.capacity() * sizeof(Aabb) +
         rooms_.capacity() * sizeof(detail::FloatBox) + moved_.bytes() + kept_.bytes() +
         forest_.bytes() + partners_.bytes() + pairs_.bytes() + keys * sizeof(PairKey) +
         (left_.capacity() + found_.capacity() + counts_.capacity()) * sizeof(BoxHandle);
}

}  // namespace swept
