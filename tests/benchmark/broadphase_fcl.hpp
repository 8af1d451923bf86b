// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef SWEPT_HAS_FCL
#include <memory>
#include <vector>

#include "broadphase_worlds.hpp"
#include "fcl_peer.hpp"

namespace swept::benchmark {

/// A manager of FCL over box geometries that do not turn, whose boxes are then the given ones.
template <typename Manager>
class FclBroadphase : public BroadphasePeer {
 public:
  explicit FclBroadphase(const MovingBoxes& boxes) {
    for (std::size_t i = 0; i < boxes.boxes().size(); ++i) {
      const Eigen::Vector3d size = 2.0 * boxes.half(i);
      objects_.push_back(std::make_unique<fcl::CollisionObjectd>(
          std::make_shared<fcl::Boxd>(size), Eigen::Matrix3d::Identity(), boxes.center(i)));
      objects_.back()->computeAABB();
      all_.push_back(objects_.back().get());
    }
    for (const std::uint32_t i : boxes.moving()) moving_.push_back(all_[i]);
    manager_.registerObjects(all_);
    manager_.setup();
  }

  void prepare(const MovingBoxes& boxes) override {
    for (const std::uint32_t i : boxes.moving()) {
      objects_[i]->setTranslation(boxes.center(i));
      objects_[i]->computeAABB();
    }
  }

  std::size_t step(const MovingBoxes&) override {
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
  std::vector<std::unique_ptr<fcl::CollisionObjectd>> objects_;
  std::vector<fcl::CollisionObjectd*> all_, moving_;
  Manager manager_;
};

using FclSweepAndPrune = FclBroadphase<fcl::SaPCollisionManagerd>;
using FclDynamicTree = FclBroadphase<fcl::DynamicAABBTreeCollisionManagerd>;

}  // namespace swept::benchmark
#endif
