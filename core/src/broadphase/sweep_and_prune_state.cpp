// SPDX-License-Identifier: BSD-3-Clause
#include "broadphase/sweep_and_prune_state.hpp"

#include <algorithm>
#include <bit>

#include "broadphase/room.hpp"

namespace swept {
namespace {

using detail::PairKey;
using detail::pairKey;

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
    stage(handles[i], boxes[i]);
    moved_.insert(handles[i]);
  }
  if (manyLeft()) return rebuild();
  toggled_.clear();
  for (const BoxHandle handle : handles)
    look(handle, [&](BoxHandle other) { return other < handle && moved_.contains(other); });
  for (const BoxHandle handle : left_) forest_.move(handle, rooms_[handle]);
  settleLeavers();
}

void SweepAndPrune::State::updateAll(std::span<const Aabb> boxes) {
  detail::Handles::requireAsMany(handles_.live(), boxes.size());
  left_.clear();
  std::size_t next = 0;
  for (BoxHandle handle = 0; handle < handles_.end(); ++handle)
    if (handles_.contains(handle)) stage(handle, boxes[next++]);
  if (manyLeft()) return rebuild();
  toggled_.clear();
  for (BoxHandle handle = 0; handle < handles_.end(); ++handle)
    look(handle, [handle](BoxHandle other) { return other < handle; });
  for (const BoxHandle handle : left_) forest_.move(handle, rooms_[handle]);
  settleLeavers();
}

void SweepAndPrune::State::settleLeavers() {
  forest_.tidy(rooms_);
  for (const BoxHandle handle : left_) relink(handle);
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
  detail::sortPairs(near_, handleBits(), scratch_);
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
