// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#ifdef SWEPT_HAS_BULLET
// The peer's headers are not held to our warnings.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <BulletCollision/BroadphaseCollision/btAxisSweep3.h>
#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>

#include <cstdint>
#pragma GCC diagnostic pop

#include <memory>
#include <vector>

#include "broadphase_worlds.hpp"

namespace swept::benchmark {

/// A broadphase of Bullet. Both keep pairs of larger boxes, among which the overlapping ones are
/// to be found.
class BulletBroadphase : public BroadphasePeer {
 public:
  BulletBroadphase(std::unique_ptr<btBroadphaseInterface> broadphase, const BoxWorld& boxes)
      : broadphase_(std::move(broadphase)) {
    for (const Aabb& box : boxes.boxes()) {
      proxies_.push_back(broadphase_->createProxy(vector(box.lower), vector(box.upper), 0, nullptr,
                                                  1, -1, nullptr));
      // The axis sweep does not set the box of a new proxy.
      broadphase_->setAabb(proxies_.back(), vector(box.lower), vector(box.upper), nullptr);
    }
    broadphase_->calculateOverlappingPairs(nullptr);
  }
  ~BulletBroadphase() override {
    for (btBroadphaseProxy* proxy : proxies_) broadphase_->destroyProxy(proxy, nullptr);
  }
  BulletBroadphase(const BulletBroadphase&) = delete;
  BulletBroadphase& operator=(const BulletBroadphase&) = delete;

  std::size_t step(const BoxWorld& boxes) override {
    for (const std::uint32_t i : boxes.moving()) {
      const Aabb& box = boxes.boxes()[i];
      broadphase_->setAabb(proxies_[i], vector(box.lower), vector(box.upper), nullptr);
    }
    broadphase_->calculateOverlappingPairs(nullptr);
    const btBroadphasePairArray& cached =
        broadphase_->getOverlappingPairCache()->getOverlappingPairArray();
    std::size_t pairs = 0;
    for (int i = 0; i < cached.size(); ++i) {
      const btBroadphaseProxy &a = *cached[i].m_pProxy0, &b = *cached[i].m_pProxy1;
      pairs += TestAabbAgainstAabb2(a.m_aabbMin, a.m_aabbMax, b.m_aabbMin, b.m_aabbMax) ? 1 : 0;
    }
    return pairs;
  }

 private:
  static btVector3 vector(const Eigen::Vector3d& v) {
    return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()),
            static_cast<btScalar>(v.z())};
  }

  std::unique_ptr<btBroadphaseInterface> broadphase_;
  std::vector<btBroadphaseProxy*> proxies_;
};

inline std::unique_ptr<BroadphasePeer> bulletTrees(const BoxWorld& boxes) {
  return std::make_unique<BulletBroadphase>(std::make_unique<btDbvtBroadphase>(), boxes);
}

inline std::unique_ptr<BroadphasePeer> bulletAxisSweep(const BoxWorld& boxes) {
  const auto low = static_cast<btScalar>(-2.0), high = static_cast<btScalar>(boxes.side() + 2.0);
  const auto most = static_cast<unsigned>(boxes.boxes().size() + 2);
  auto sweep = std::make_unique<bt32BitAxisSweep3>(
      btVector3(low, low, low), btVector3(high, high, high), most, nullptr, true);
  return std::make_unique<BulletBroadphase>(std::move(sweep), boxes);
}

}  // namespace swept::benchmark
#endif
