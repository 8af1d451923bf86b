// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/broadphase/sweep_and_prune.hpp"

#include <algorithm>
#include <utility>

#include "broadphase/sweep_and_prune_state.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(Broadphase<SweepAndPrune>);

namespace {

using Candidate = BroadphaseScratch::Candidate;

constexpr std::uint64_t kIsBox = std::uint64_t{1} << 63;

/// The top of a heap is its greatest element: the nearest one here.
bool isFarther(const Candidate& a, const Candidate& b) {
  return a.distance > b.distance || (a.distance == b.distance && a.order > b.order);
}

void push(std::vector<Candidate>& heap, Candidate candidate) {
  heap.push_back(candidate);
  std::push_heap(heap.begin(), heap.end(), isFarther);
}

std::uint64_t blockOrder(std::size_t tree, std::size_t level, std::size_t block) {
  return std::uint64_t{tree} << 40 | std::uint64_t{level} << 32 | block;
}

Aabb wide(const detail::FloatBox& box) {
  Aabb result;
  for (int k = 0; k < 3; ++k) {
    result.lower[k] = static_cast<double>(box.lower[k]);
    result.upper[k] = static_cast<double>(box.upper[k]);
  }
  return result;
}

}  // namespace

SweepAndPrune::SweepAndPrune() : state_(std::make_unique<State>()) {}
SweepAndPrune::~SweepAndPrune() = default;
SweepAndPrune::SweepAndPrune(SweepAndPrune&& other) noexcept = default;
SweepAndPrune& SweepAndPrune::operator=(SweepAndPrune&& other) noexcept = default;
SweepAndPrune::SweepAndPrune(const SweepAndPrune& other)
    : state_(std::make_unique<State>(*other.state_)) {}
SweepAndPrune& SweepAndPrune::operator=(const SweepAndPrune& other) {
  // What was moved from has no state.
  if (this == &other) return *this;
  state_ = std::make_unique<State>(*other.state_);
  changes_.add();
  return *this;
}

BoxHandle SweepAndPrune::registerBox(const Aabb& box) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return registerBox(box); });
  }
  return registerBoxes({&box, 1}).front();
}

std::vector<BoxHandle> SweepAndPrune::registerBoxes(std::span<const Aabb> boxes) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, boxes] { return registerBoxes(boxes); });
  }
  changes_.add();
  return state_->add(boxes);
}

void SweepAndPrune::unregisterBox(BoxHandle handle) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, handle] { return unregisterBox(handle); });
  }
  changes_.add();
  state_->remove(handle);
}

void SweepAndPrune::update(BoxHandle handle, const Aabb& box) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, handle] { return update(handle, box); });
  }
  update({&handle, 1}, {&box, 1});
}

void SweepAndPrune::update(std::span<const BoxHandle> handles, std::span<const Aabb> boxes) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, handles, boxes] { return update(handles, boxes); });
  }
  changes_.add();
  state_->update(handles, boxes);
}

void SweepAndPrune::updateAll(std::span<const Aabb> boxes) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, boxes] { return updateAll(boxes); });
  }
  changes_.add();
  state_->updateAll(boxes);
}

std::size_t SweepAndPrune::size() const {
  return state_->handles().live();
}

bool SweepAndPrune::contains(BoxHandle handle) const {
  return state_->handles().contains(handle);
}

const Aabb& SweepAndPrune::box(BoxHandle handle) const {
  state_->handles().require(handle);
  return state_->box(handle);
}

std::size_t SweepAndPrune::bytes() const {
  return state_->bytes();
}

BoxHandle SweepAndPrune::handleEnd() const {
  return state_->handles().end();
}

SweepAndPrune::Pairs SweepAndPrune::pairs() const {
  return {state_->pairs().sorted(), state_->pairs().changed()};
}

void SweepAndPrune::findOverlapping(const Aabb& box, BroadphaseScratch& scratch) const {
  const Aabb bounded = boundedOrEverywhere(box);
  scratch.handles.clear();
  state_->forest().findOverlaps(detail::floatBox(bounded), scratch.handles);
  std::erase_if(scratch.handles,
                [&](std::uint32_t number) { return !bounded.overlaps(state_->boxAt(number)); });
  for (BoxHandle& found : scratch.handles) found = state_->handleAt(found);
  std::sort(scratch.handles.begin(), scratch.handles.end());
}

void SweepAndPrune::startNearest(std::vector<Candidate>& heap) const {
  heap.clear();
  for (std::size_t i = 0; i < detail::BoxForest::kTrees; ++i) {
    const detail::BoxTree& tree = state_->forest().tree(i);
    if (tree.live() > 0) push(heap, {0.0, blockOrder(i, tree.levels() - 1, 0)});
  }
}

bool SweepAndPrune::nextNearest(const Aabb& box, double bound, std::vector<Candidate>& heap,
                                Near& near) const {
  const Aabb bounded = boundedOrEverywhere(box);
  const auto consider = [&](const Aabb& candidate, std::uint64_t order) {
    const double distance = boxDistance(bounded, candidate);
    if (distance < bound) push(heap, {distance, order});
  };
  while (!heap.empty() && heap.front().distance < bound) {
    const Candidate next = heap.front();
    std::pop_heap(heap.begin(), heap.end(), isFarther);
    heap.pop_back();
    if ((next.order & kIsBox) != 0) {
      near = {static_cast<BoxHandle>(next.order), next.distance};
      return true;
    }
    const detail::BoxTree& tree = state_->forest().tree(next.order >> 40);
    const std::size_t level = (next.order >> 32) & 0xFF, block = next.order & 0xFFFFFFFF;
    const detail::BoxBlock& boxes = tree.level(level)[block];
    for (std::size_t lane = 0; lane < detail::BoxBlock::kLanes; ++lane) {
      const auto below = static_cast<std::uint32_t>(block * detail::BoxBlock::kLanes + lane);
      const Aabb bounds = wide(boxes.box(lane));
      if (!(bounds.lower.x() <= bounds.upper.x())) continue;  // nothing there
      if (level > 0)
        consider(bounds, blockOrder(next.order >> 40, level - 1, below));
      else
        consider(state_->boxAt(tree.owner(below)), kIsBox | state_->handleAt(tree.owner(below)));
    }
  }
  return false;
}

void SweepAndPrune::findNearestPairs(const SweepAndPrune* other,
                                     const BroadphaseScratch::Pair& after, double bound,
                                     std::size_t most,
                                     std::vector<BroadphaseScratch::Pair>& pairs) const {
  const detail::PlacedForest a = state_->placed();
  if (other == nullptr) {
    detail::findNearestPairs(a, nullptr, after, bound, most, pairs);
  } else {
    const detail::PlacedForest b = other->state_->placed();
    detail::findNearestPairs(a, &b, after, bound, most, pairs);
  }
}

}  // namespace swept
