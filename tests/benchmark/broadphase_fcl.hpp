// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef SWEPT_HAS_FCL
#include <cstdint>
#include <memory>
#include <vector>

#include "broadphase_worlds.hpp"
#include "fcl_peer.hpp"

namespace swept::benchmark {

/// Placed by its box in the world, which is all that managers look at.
class FclPlacedBox : public fcl::CollisionObjectd {
 public:
  explicit FclPlacedBox(const Aabb& box)
      : fcl::CollisionObjectd(std::make_shared<fcl::Boxd>(1.0, 1.0, 1.0)) {
    place(box);
  }
  void place(const Aabb& box) {
    aabb.min_ = box.lower;
    aabb.max_ = box.upper;
  }
};

/// A manager of FCL.
template <typename Manager>
class FclBroadphase : public BroadphasePeer {
 public:
  explicit FclBroadphase(const BoxWorld& boxes) {
    for (const Aabb& box : boxes.boxes()) {
      objects_.push_back(std::make_unique<FclPlacedBox>(box));
      all_.push_back(objects_.back().get());
    }
    for (const std::uint32_t i : boxes.moving()) moving_.push_back(all_[i]);
    manager_.registerObjects(all_);
    manager_.setup();
  }

  void prepare(const BoxWorld& boxes) override {
    for (const std::uint32_t i : boxes.moving()) objects_[i]->place(boxes.boxes()[i]);
  }

  std::size_t step(const BoxWorld&) override {
    if (moving_.size() == all_.size())
      manager_.update();
    else
      manager_.update(moving_);
    std::size_t pairs = 0;
    manager_.collide(&pairs, [](fcl::CollisionObjectd* a, fcl::CollisionObjectd* b, void* count) {
      if (a->getAABB().overlap(b->getAABB())) ++*static_cast<std::size_t*>(count);
      return false;
    });
    return pairs;
  }

 private:
  std::vector<std::unique_ptr<FclPlacedBox>> objects_;
  std::vector<fcl::CollisionObjectd*> all_, moving_;
  Manager manager_;
};

using FclSweepAndPrune = FclBroadphase<fcl::SaPCollisionManagerd>;
using FclDynamicTree = FclBroadphase<fcl::DynamicAABBTreeCollisionManagerd>;

}  // namespace swept::benchmark
#endif
