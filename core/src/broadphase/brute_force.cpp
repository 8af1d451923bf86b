// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/broadphase/brute_force.hpp"

#include "broadphase/handles.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(Broadphase<BruteForce>);

void BruteForce::require(BoxHandle handle) const {
  if (!contains(handle)) detail::Handles::refuse(handle);
}

BoxHandle BruteForce::registerBox(const Aabb& box) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return registerBox(box); });
  }
  const Aabb bounded =
      boundedOrEverywhere(box);  // before its memory, if it is ours, goes elsewhere
  const auto free = std::find(boxes_.begin(), boxes_.end(), std::nullopt);
  const auto handle = static_cast<BoxHandle>(free - boxes_.begin());
  if (free == boxes_.end()) boxes_.emplace_back();
  boxes_[handle] = bounded;
  changes_.add();
  return handle;
}

std::vector<BoxHandle> BruteForce::registerBoxes(std::span<const Aabb> boxes) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, boxes] { return registerBoxes(boxes); });
  }
  std::vector<BoxHandle> handles;
  for (const Aabb& box : boxes) handles.push_back(registerBox(box));
  return handles;
}

void BruteForce::unregisterBox(BoxHandle handle) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, handle] { return unregisterBox(handle); });
  }
  require(handle);
  boxes_[handle].reset();
  changes_.add();
}

void BruteForce::update(BoxHandle handle, const Aabb& box) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, handle] { return update(handle, box); });
  }
  require(handle);
  boxes_[handle] = boundedOrEverywhere(box);
  changes_.add();
}

void BruteForce::update(std::span<const BoxHandle> handles, std::span<const Aabb> boxes) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, handles, boxes] { return update(handles, boxes); });
  }
  detail::Handles::requireAsMany(handles.size(), boxes.size());
  for (const BoxHandle handle : handles) require(handle);
  for (std::size_t i = 0; i < handles.size(); ++i) update(handles[i], boxes[i]);
}

void BruteForce::updateAll(std::span<const Aabb> boxes) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, boxes] { return updateAll(boxes); });
  }
  detail::Handles::requireAsMany(size(), boxes.size());
  std::size_t next = 0;
  for (std::optional<Aabb>& box : boxes_)
    if (box) box = boundedOrEverywhere(boxes[next++]);
  changes_.add();
}

std::size_t BruteForce::size() const {
  return static_cast<std::size_t>(
      std::count_if(boxes_.begin(), boxes_.end(), [](const auto& box) { return box.has_value(); }));
}

const Aabb& BruteForce::box(BoxHandle handle) const {
  require(handle);
  return *boxes_[handle];
}

void BruteForce::sortByDistance(const Aabb& box, BroadphaseScratch& scratch) const {
  const Aabb bounded = boundedOrEverywhere(box);
  scratch.nearest.clear();
  for (BoxHandle a = 0; a < boxes_.size(); ++a)
    if (contains(a)) scratch.nearest.push_back({boxDistance(bounded, *boxes_[a]), a});
  std::sort(scratch.nearest.begin(), scratch.nearest.end(), [](const auto& a, const auto& b) {
    return a.distance < b.distance || (a.distance == b.distance && a.order < b.order);
  });
}

}  // namespace swept
