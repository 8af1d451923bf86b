// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bv/kdop.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/obb_rss.hpp"
#include "swept/core/bv/rss.hpp"
#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/traversal/front_list.hpp"
#include "swept/core/traversal/mesh_pair.hpp"
#include "swept/core/traversal/traversal.hpp"

namespace swept {

/// Two triangles that touch, by index.
struct TrianglePair {
  int first;   ///< triangle of the first model
  int second;  ///< triangle of the second model, or of the same one
  /// Ordered by first, then by second.
  auto operator<=>(const TrianglePair&) const = default;
};

/// How many pairs to find.
struct MeshCollisionOptions {
  /// The query stops at this many touching pairs. 1, or 0 without listing a pair: yes or no.
  std::size_t maxPairs = 1;
};

/// Reuse a result to query without allocating.
struct MeshCollisionResult {
  /// Some triangles touch, or the pose is not finite. Touching is decided exactly for the triangles
  /// as they are in the first frame; placing the second model's triangles there rounds by 1e-15 of
  /// the coordinates.
  bool touching = false;
  std::vector<TrianglePair> pairs;  ///< at most maxPairs of the touching ones; each once
  TraversalEffort effort;           ///< effort of the traversal

  /// Prepares for the next query; keeps the memory.
  void reset() {
    touching = false;
    pairs.clear();
    effort = {};
  }
};

/// Traversal node of two triangle models: collects touching pairs of triangles.
template <BoundingVolume BV>
class MeshCollisionNode : public MeshPair<BV> {
 public:
  /// Throws as collideMeshes does. Adds to `result`.
  MeshCollisionNode(const BvhModel<BV>& a, const BvhModel<BV>& b, const Eigen::Isometry3d& a_from_b,
                    const MeshCollisionOptions& options, MeshCollisionResult& result)
      : MeshPair<BV>(a, b, a_from_b, "collideMeshes"), maxPairs_(options.maxPairs), out_(result) {}

  ///@{
  /// See `CollisionTraversal`.
  bool bvTesting(int i, int j) {
    ++out_.effort.bvTests;
    return !this->first(i).volume.overlaps(this->second(j).volume, this->a_from_b_);
  }
  void leafTesting(int i, int j) {
    this->forEachPair(i, j, [&](int t, int u) {
      ++out_.effort.leafTests;
      if (trianglesTouch(this->a_.corners(t), this->secondCorners(u))) {
        out_.touching = true;
        if (maxPairs_ > 0) out_.pairs.push_back({t, u});
      }
      return !canStop();
    });
  }
  bool canStop() const { return out_.touching && out_.pairs.size() >= maxPairs_; }
  ///@}

 private:
  std::size_t maxPairs_;
  MeshCollisionResult& out_;
};

/// Finds which triangles of two models touch; `a_from_b` is the pose of b in a's frame. With a
/// `front` the traversal starts where it ended last time (see FrontList). Throws BvhStateError or
/// std::invalid_argument for models that are not built or have no triangles, never for a pose: one
/// that is not finite, or far from rigid, counts as touching, without pairs.
template <BoundingVolume BV>
void collideMeshes(const BvhModel<BV>& a, const BvhModel<BV>& b, const Eigen::Isometry3d& a_from_b,
                   const MeshCollisionOptions& options, MeshCollisionResult& result,
                   FrontList* front = nullptr) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&, front] { return collideMeshes(a, b, a_from_b, options, result, front); });
  }
  result.reset();
  MeshCollisionNode<BV> node(a, b, a_from_b, options, result);
  if (!node.pose().matrix().allFinite()) {
    result.touching = true;
  } else if (front != nullptr) {
    front->belongTo(a.tree().shape(), b.tree().shape());
    collisionTraverse(node, *front);
  } else {
    collisionTraverse(node);
  }
}

extern template void collideMeshes(const BvhModel<Aabb>&, const BvhModel<Aabb>&,
                                   const Eigen::Isometry3d&, const MeshCollisionOptions&,
                                   MeshCollisionResult&, FrontList*);
extern template void collideMeshes(const BvhModel<Obb>&, const BvhModel<Obb>&,
                                   const Eigen::Isometry3d&, const MeshCollisionOptions&,
                                   MeshCollisionResult&, FrontList*);
extern template void collideMeshes(const BvhModel<Rss>&, const BvhModel<Rss>&,
                                   const Eigen::Isometry3d&, const MeshCollisionOptions&,
                                   MeshCollisionResult&, FrontList*);
extern template void collideMeshes(const BvhModel<ObbRss>&, const BvhModel<ObbRss>&,
                                   const Eigen::Isometry3d&, const MeshCollisionOptions&,
                                   MeshCollisionResult&, FrontList*);
extern template void collideMeshes(const BvhModel<KDop<16>>&, const BvhModel<KDop<16>>&,
                                   const Eigen::Isometry3d&, const MeshCollisionOptions&,
                                   MeshCollisionResult&, FrontList*);
extern template void collideMeshes(const BvhModel<KDop<18>>&, const BvhModel<KDop<18>>&,
                                   const Eigen::Isometry3d&, const MeshCollisionOptions&,
                                   MeshCollisionResult&, FrontList*);
extern template void collideMeshes(const BvhModel<KDop<24>>&, const BvhModel<KDop<24>>&,
                                   const Eigen::Isometry3d&, const MeshCollisionOptions&,
                                   MeshCollisionResult&, FrontList*);

}  // namespace swept
