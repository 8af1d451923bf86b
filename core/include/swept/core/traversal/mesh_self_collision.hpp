// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "swept/core/bv/aabb.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bv/kdop.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/obb_rss.hpp"
#include "swept/core/bv/rss.hpp"
#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/traversal/mesh_collision.hpp"
#include "swept/core/traversal/mesh_pair.hpp"

namespace swept {

/// Traversal node of one triangle model against itself. Triangles that share a vertex, by index,
/// always touch, so they are skipped.
template <BoundingVolume BV>
class MeshSelfCollisionNode : public MeshPair<BV> {
 public:
  /// Throws as selfCollideMesh does. Adds to `result`.
  MeshSelfCollisionNode(const BvhModel<BV>& model, const MeshCollisionOptions& options,
                        MeshCollisionResult& result)
      : MeshPair<BV>(model, model, Eigen::Isometry3d::Identity(), "selfCollideMesh"),
        maxPairs_(options.maxPairs),
        out_(result) {}

  ///@{
  /// See `SelfCollisionTraversal`.
  bool bvTesting(int i, int j) {
    ++out_.effort.bvTests;
    return !this->first(i).volume.overlaps(this->second(j).volume);
  }
  void leafTesting(int i, int j) {
    this->forEachPair(i, j, [&](int t, int u) {
      if (i == j && t >= u) return true;  // within a leaf: each pair once
      if (shareVertex(triangle(t), triangle(u))) return true;
      ++out_.effort.leafTests;
      if (trianglesTouch(this->a_.corners(t), this->a_.corners(u))) {
        out_.touching = true;
        if (maxPairs_ > 0) out_.pairs.push_back({std::min(t, u), std::max(t, u)});
      }
      return !canStop();
    });
  }
  bool canStop() const { return out_.touching && out_.pairs.size() >= maxPairs_; }
  ///@}

 private:
  const Eigen::Vector3i& triangle(int t) const {
    return this->a_.triangles()[static_cast<std::size_t>(t)];
  }

  std::size_t maxPairs_;
  MeshCollisionResult& out_;
};

/// Finds which triangles of a model touch each other without sharing a vertex; in each pair the
/// smaller index comes first. Throws as collideMeshes does.
template <BoundingVolume BV>
void selfCollideMesh(const BvhModel<BV>& model, const MeshCollisionOptions& options,
                     MeshCollisionResult& result) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return selfCollideMesh(model, options, result); });
  }
  result.reset();
  MeshSelfCollisionNode<BV> node(model, options, result);
  selfCollisionTraverse(node);
}

extern template void selfCollideMesh(const BvhModel<Aabb>&, const MeshCollisionOptions&,
                                     MeshCollisionResult&);
extern template void selfCollideMesh(const BvhModel<Obb>&, const MeshCollisionOptions&,
                                     MeshCollisionResult&);
extern template void selfCollideMesh(const BvhModel<Rss>&, const MeshCollisionOptions&,
                                     MeshCollisionResult&);
extern template void selfCollideMesh(const BvhModel<ObbRss>&, const MeshCollisionOptions&,
                                     MeshCollisionResult&);
extern template void selfCollideMesh(const BvhModel<KDop<16>>&, const MeshCollisionOptions&,
                                     MeshCollisionResult&);
extern template void selfCollideMesh(const BvhModel<KDop<18>>&, const MeshCollisionOptions&,
                                     MeshCollisionResult&);
extern template void selfCollideMesh(const BvhModel<KDop<24>>&, const MeshCollisionOptions&,
                                     MeshCollisionResult&);

}  // namespace swept
