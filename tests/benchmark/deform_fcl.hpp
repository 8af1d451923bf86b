// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "fcl_peer.hpp"

#ifdef SWEPT_HAS_FCL
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#include <fcl/narrowphase/detail/traversal/collision/mesh_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision/mesh_continuous_collision_traversal_node.h>
#include <fcl/narrowphase/detail/traversal/collision_node.h>

#include <memory>
#include <vector>
#pragma GCC diagnostic pop

#include <limits>
#include <set>

#include "swept/core/traversal/mesh_collision.hpp"

/// FCL's queries for deforming meshes. Its public functions refit, but have neither self-collision
/// nor the continuous test of vertices that move: those are in its namespace `detail`.
namespace swept::benchmark {

/// Skips pairs with a common vertex, as ours does: FCL reports them all.
template <typename Node>
class FclWithoutNeighbours : public Node {
 public:
  bool skipNeighbours = false;

  void leafTesting(int i, int j) const override {
    if (skipNeighbours) {
      const fcl::Triangle& t = this->tri_indices1[this->model1->getBV(i).primitiveId()];
      const fcl::Triangle& u = this->tri_indices2[this->model2->getBV(j).primitiveId()];
      for (const int k : {0, 1, 2}) {
        if (t[k] == u[0] || t[k] == u[1] || t[k] == u[2]) return;
      }
    }
    Node::leafTesting(i, j);
  }
};

/// One deforming mesh as FCL has it: a model that follows frames, and one that follows steps.
template <typename Volume>
class FclDeforming {
 public:
  explicit FclDeforming(const Soup& soup)
      : placed_(fclModel<Volume>(soup)), moving_(fclModel<Volume>(soup)) {}

  void place(const std::vector<Eigen::Vector3d>& vertices) {
    placed_->beginReplaceModel();
    placed_->replaceSubModel(vertices);
    placed_->endReplaceModel(true, true);
  }
  void moveTo(const std::vector<Eigen::Vector3d>& vertices) {
    moving_->beginUpdateModel();
    moving_->updateSubModel(vertices);
    moving_->endUpdateModel(true, true);
  }

  /// As collide() and selfCollide(): pairs of the placed models that touch.
  std::vector<TrianglePair> touching(FclDeforming& other) {
    using Node = fcl::detail::MeshCollisionTraversalNode<Volume>;
    FclWithoutNeighbours<Node> node;
    node.skipNeighbours = this == &other;
    fcl::Transform3d here = fcl::Transform3d::Identity(), there = here;
    fcl::CollisionResultd result;
    fcl::detail::initialize(node, *placed_, here, *other.placed_, there,
                            fcl::CollisionRequestd(kAll, false), result);
    traverse(node, this == &other);
    std::vector<TrianglePair> pairs;
    for (std::size_t i = 0; i < result.numContacts(); ++i)
      pairs.push_back(
          {static_cast<int>(result.getContact(i).b1), static_cast<int>(result.getContact(i).b2)});
    return pairs;
  }

  /// As collideContinuous(): pairs that meet during the step.
  std::vector<TrianglePair> meeting(FclDeforming& other) {
    using Node = fcl::detail::MeshContinuousCollisionTraversalNode<Volume>;
    FclWithoutNeighbours<Node> node;
    node.skipNeighbours = this == &other;
    const fcl::Transform3d here = fcl::Transform3d::Identity();
    fcl::detail::initialize(node, *moving_, here, *other.moving_, here,
                            fcl::CollisionRequestd(kAll, false));
    traverse(node, this == &other);
    std::vector<TrianglePair> pairs;
    for (const auto& pair : node.pairs) pairs.push_back({pair.id1, pair.id2});
    return pairs;
  }

 private:
  static constexpr std::size_t kAll = 1000000000;

  template <typename Node>
  static void traverse(Node& node, bool itself) {
    auto* base = static_cast<fcl::detail::CollisionTraversalNodeBase<double>*>(&node);
    if (itself) {
      fcl::detail::selfCollide(base, nullptr);
    } else {
      fcl::detail::collide(base, nullptr);
    }
  }

  std::shared_ptr<fcl::BVHModel<Volume>> placed_, moving_;
};

}  // namespace swept::benchmark
#endif
