// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <concepts>
#include <string_view>

#include "swept/core/bv/aabb.hpp"
#include "swept/core/bv/bounding_volume.hpp"
#include "swept/core/bv/kdop.hpp"
#include "swept/core/bv/obb.hpp"
#include "swept/core/bv/obb_rss.hpp"
#include "swept/core/bv/rss.hpp"
#include "swept/core/bvh/bv_tree.hpp"
#include "swept/core/bvh/bvh_model.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/shapes.hpp"
#include "swept/core/traversal/mesh_distance.hpp"
#include "swept/core/traversal/mesh_pair.hpp"
#include "swept/core/traversal/traversal.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {

/// The leaf test between a triangle and the other side, which is a hierarchy of one node. In the
/// mesh's frame.
template <typename Leaf>
concept TriangleLeaf = requires(Leaf& leaf, const TriangleCorners& corners, double enough) {
  { leaf.collide(corners) } -> std::same_as<Contact>;
  /// May stop once the distance is proven to exceed `enough` (m).
  { leaf.distance(corners, enough) } -> std::same_as<DistanceResult>;
};

/// Leaf test against a shape, with the queries of distance.hpp. Keeps a reference to the shape.
class ShapeLeaf {
 public:
  /// `mesh_from_shape`: pose of the shape in the mesh's frame.
  ShapeLeaf(const Shape& shape, const Eigen::Isometry3d& mesh_from_shape);

  /// Whether a triangle (m, mesh frame) touches the shape.
  Contact collide(const TriangleCorners& corners);
  /// Distance of a triangle (m, mesh frame) from the shape; stops once it is proven to exceed
  /// `enough` (m).
  DistanceResult distance(const TriangleCorners& corners, double enough);

 private:
  const Shape& shape_;
  Eigen::Isometry3d mesh_from_shape_;
  Shape triangle_;  ///< kept, so that a leaf test does not build a variant
};

/// Corners of the shape's bounding box in the mesh's frame (m).
std::array<Eigen::Vector3d, 8> boxCorners(const Shape& shape,
                                          const Eigen::Isometry3d& mesh_from_shape);

/// A mesh and a hierarchy of one node; `volume` bounds it in the mesh's frame.
template <BoundingVolume BV>
class MeshAndOne {
 public:
  ///@{
  /// See `PairTraversal`; only the mesh is descended.
  bool isFirstLeaf(int i) const { return node(i).isLeaf(); }
  bool isSecondLeaf(int) const { return true; }
  bool firstOverSecond(int, int) const { return true; }
  std::array<int, 2> firstChildren(int i) const { return {i + 1, node(i).rightChild}; }
  std::array<int, 2> secondChildren(int) const { return {0, 0}; }
  ///@}

 protected:
  /// Throws, naming `call`, unless the mesh can be queried and has triangles.
  MeshAndOne(const BvhModel<BV>& mesh, const BV& volume, std::string_view call)
      : mesh_(mesh), volume_(volume) {
    mesh.requireTriangles(call);
  }
  ~MeshAndOne() = default;

  /// A node of the mesh.
  const typename BvTree<BV>::Node& node(int i) const { return mesh_.tree().node(i); }
  /// Calls visit(t) for the triangles of leaf i until it returns false.
  template <typename Visit>
  void forEach(int i, const Visit& visit) const {
    for (int s = node(i).first; s < node(i).first + node(i).count; ++s) {
      if (!visit(mesh_.tree().order()[s])) return;
    }
  }

  const BvhModel<BV>& mesh_;  ///< the mesh
  BV volume_;                 ///< volume of the shape, in the mesh's frame
};

/// Whether a mesh's surface touches a shape.
struct MeshShapeCollisionResult {
  /// Touching: some triangle touches the shape. Separate: none does. Unknown: some are within
  /// rounding.
  Contact contact = Contact::Unknown;
  int triangle = -1;       ///< one that touches, or is within rounding; -1: none
  TraversalEffort effort;  ///< effort of the traversal
};

/// Traversal node of a triangle model and one shape; it ends at the first triangle that touches.
template <BoundingVolume BV, TriangleLeaf Leaf = ShapeLeaf>
class MeshShapeCollisionNode : public MeshAndOne<BV> {
 public:
  /// Throws as collideMeshShape does.
  MeshShapeCollisionNode(const BvhModel<BV>& mesh, const BV& volume, Leaf& leaf,
                         MeshShapeCollisionResult& result)
      : MeshAndOne<BV>(mesh, volume, "collideMeshShape"), leaf_(leaf), out_(result) {
    out_.contact = Contact::Separate;
  }

  ///@{
  /// See `CollisionTraversal`.
  bool bvTesting(int i, int) {
    ++out_.effort.bvTests;
    return !this->node(i).volume.overlaps(this->volume_);
  }
  void leafTesting(int i, int) {
    this->forEach(i, [&](int t) {
      ++out_.effort.leafTests;
      const Contact contact = leaf_.collide(this->mesh_.corners(t));
      if (contact != Contact::Separate) {
        out_.contact = contact;
        out_.triangle = t;
      }
      return !canStop();
    });
  }
  bool canStop() const { return out_.contact == Contact::Touching; }
  ///@}

 private:
  Leaf& leaf_;
  MeshShapeCollisionResult& out_;
};

/// Traversal node of a triangle model and one shape: nearest points. The mesh is "a" in results, as
/// for MeshDistanceNode; triangleB is 0.
template <BoundingVolume BV, TriangleLeaf Leaf = ShapeLeaf>
class MeshShapeDistanceNode : public MeshAndOne<BV> {
 public:
  /// Throws as meshShapeDistance does.
  MeshShapeDistanceNode(const BvhModel<BV>& mesh, const BV& volume, Leaf& leaf,
                        const MeshDistanceOptions& options, MeshDistanceResult& result)
      : MeshAndOne<BV>(mesh, volume, "meshShapeDistance"),
        search_(options),
        leaf_(leaf),
        out_(result) {}

  ///@{
  /// See `DistanceTraversal`.
  double bvTesting(int i, int) {
    ++out_.effort.bvTests;
    const BV& volume = this->node(i).volume;
    const double bound = volume.distanceBound(this->volume_, Eigen::Isometry3d::Identity());
    return bound > 0.0 ? bound : rankOfOverlap(this->volume_.center(), volume.center());
  }
  void leafTesting(int i, int) {
    this->forEach(i, [&](int t) {
      ++out_.effort.leafTests;
      const DistanceResult d = leaf_.distance(this->mesh_.corners(t), out_.upper);
      search_.examined(d.lower);
      if (d.upper < out_.upper) {
        out_.upper = d.upper;
        out_.pointA = d.pointA;
        out_.pointB = d.pointB;
        out_.triangleA = t;
        out_.triangleB = 0;
      }
      return out_.upper > 0.0;
    });
  }
  bool canStop(double bound) { return search_.dismiss(std::max(0.0, bound), out_.upper); }
  ///@}
  /// Call it after the traversal.
  void finish() { out_.lower = search_.lower(out_.upper); }

 private:
  DistanceSearch search_;
  Leaf& leaf_;
  MeshDistanceResult& out_;
};

/// Whether a triangle of the mesh touches the shape; the pose is that of the shape in the mesh's
/// frame. The shape is solid as in distance.hpp; the mesh is a surface. An unbounded shape is
/// tested against every triangle. A non-finite pose gives Unknown. Throws as collideMeshes does.
template <BoundingVolume BV>
MeshShapeCollisionResult collideMeshShape(const BvhModel<BV>& mesh, const Shape& shape,
                                          const Eigen::Isometry3d& mesh_from_shape) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return collideMeshShape(mesh, shape, mesh_from_shape); });
  }
  MeshShapeCollisionResult result;
  const Eigen::Isometry3d rigid = detail::rigidPose(mesh_from_shape);
  ShapeLeaf leaf(shape, rigid);
  const BV volume = BV::fit(boxCorners(shape, rigid));
  MeshShapeCollisionNode<BV> node(mesh, volume, leaf, result);
  if (rigid.matrix().allFinite()) {
    collisionTraverse(node);
  } else {
    result.contact = Contact::Unknown;
  }
  return result;
}

/// Distance (m) of the mesh's surface and the shape, as in meshDistance, with the accuracy of
/// `tolerance::kDistance` per triangle; points are in the mesh's frame.
template <BoundingVolume BV>
MeshDistanceResult meshShapeDistance(const BvhModel<BV>& mesh, const Shape& shape,
                                     const Eigen::Isometry3d& mesh_from_shape,
                                     const MeshDistanceOptions& options = {}) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment(
        [&] { return meshShapeDistance(mesh, shape, mesh_from_shape, options); });
  }
  MeshDistanceResult result;
  const Eigen::Isometry3d rigid = detail::rigidPose(mesh_from_shape);
  ShapeLeaf leaf(shape, rigid);
  const BV volume = BV::fit(boxCorners(shape, rigid));
  MeshShapeDistanceNode<BV> node(mesh, volume, leaf, options, result);
  if (!rigid.matrix().allFinite()) return result;
  distanceTraverse(node);
  node.finish();
  return result;
}

extern template MeshShapeCollisionResult collideMeshShape(const BvhModel<Aabb>&, const Shape&,
                                                          const Eigen::Isometry3d&);
extern template MeshDistanceResult meshShapeDistance(const BvhModel<Aabb>&, const Shape&,
                                                     const Eigen::Isometry3d&,
                                                     const MeshDistanceOptions&);
extern template MeshShapeCollisionResult collideMeshShape(const BvhModel<Obb>&, const Shape&,
                                                          const Eigen::Isometry3d&);
extern template MeshDistanceResult meshShapeDistance(const BvhModel<Obb>&, const Shape&,
                                                     const Eigen::Isometry3d&,
                                                     const MeshDistanceOptions&);
extern template MeshShapeCollisionResult collideMeshShape(const BvhModel<Rss>&, const Shape&,
                                                          const Eigen::Isometry3d&);
extern template MeshDistanceResult meshShapeDistance(const BvhModel<Rss>&, const Shape&,
                                                     const Eigen::Isometry3d&,
                                                     const MeshDistanceOptions&);
extern template MeshShapeCollisionResult collideMeshShape(const BvhModel<ObbRss>&, const Shape&,
                                                          const Eigen::Isometry3d&);
extern template MeshDistanceResult meshShapeDistance(const BvhModel<ObbRss>&, const Shape&,
                                                     const Eigen::Isometry3d&,
                                                     const MeshDistanceOptions&);
extern template MeshShapeCollisionResult collideMeshShape(const BvhModel<KDop<16>>&, const Shape&,
                                                          const Eigen::Isometry3d&);
extern template MeshDistanceResult meshShapeDistance(const BvhModel<KDop<16>>&, const Shape&,
                                                     const Eigen::Isometry3d&,
                                                     const MeshDistanceOptions&);
extern template MeshShapeCollisionResult collideMeshShape(const BvhModel<KDop<18>>&, const Shape&,
                                                          const Eigen::Isometry3d&);
extern template MeshDistanceResult meshShapeDistance(const BvhModel<KDop<18>>&, const Shape&,
                                                     const Eigen::Isometry3d&,
                                                     const MeshDistanceOptions&);
extern template MeshShapeCollisionResult collideMeshShape(const BvhModel<KDop<24>>&, const Shape&,
                                                          const Eigen::Isometry3d&);
extern template MeshDistanceResult meshShapeDistance(const BvhModel<KDop<24>>&, const Shape&,
                                                     const Eigen::Isometry3d&,
                                                     const MeshDistanceOptions&);

}  // namespace swept
