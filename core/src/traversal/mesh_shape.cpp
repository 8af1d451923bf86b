// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/traversal/mesh_shape.hpp"

#include "swept/core/floating_point_environment.hpp"

namespace swept {

static_assert(TriangleLeaf<ShapeLeaf>);

ShapeLeaf::ShapeLeaf(const Shape& shape, const Eigen::Isometry3d& mesh_from_shape)
    : shape_(shape),
      mesh_from_shape_(mesh_from_shape),
      triangle_(
          Triangle{{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()}}) {}

Contact ShapeLeaf::collide(const TriangleCorners& corners) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return collide(corners); });
  }
  std::get<Triangle>(triangle_).corners = corners;
  return swept::collide(triangle_, shape_, mesh_from_shape_);
}

DistanceResult ShapeLeaf::distance(const TriangleCorners& corners, double enough) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, enough] { return distance(corners, enough); });
  }
  std::get<Triangle>(triangle_).corners = corners;
  DistanceOptions options;
  options.enough = enough;
  return swept::distance(triangle_, shape_, mesh_from_shape_, options);
}

std::array<Eigen::Vector3d, 8> boxCorners(const Shape& shape,
                                          const Eigen::Isometry3d& mesh_from_shape) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return boxCorners(shape, mesh_from_shape); });
  }
  Aabb box = boundingBox(shape);
  // Placing the corners rounds by a few epsilons of their coordinates; the box is enlarged by more
  // than that. Unbounded boxes stay unbounded.
  const double scale =
      box.lower.lpNorm<1>() + box.upper.lpNorm<1>() + mesh_from_shape.translation().lpNorm<1>();
  box = box.inflated(tolerance::kSupportRounding * scale);
  std::array<Eigen::Vector3d, 8> corners;
  for (int i = 0; i < 8; ++i) {
    corners[i] = mesh_from_shape * Eigen::Vector3d((i & 1 ? box.upper : box.lower).x(),
                                                   (i & 2 ? box.upper : box.lower).y(),
                                                   (i & 4 ? box.upper : box.lower).z());
  }
  return corners;
}

template MeshShapeCollisionResult collideMeshShape(const BvhModel<Aabb>&, const Shape&,
                                                   const Eigen::Isometry3d&);
template MeshDistanceResult meshShapeDistance(const BvhModel<Aabb>&, const Shape&,
                                              const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshShapeCollisionResult collideMeshShape(const BvhModel<Obb>&, const Shape&,
                                                   const Eigen::Isometry3d&);
template MeshDistanceResult meshShapeDistance(const BvhModel<Obb>&, const Shape&,
                                              const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshShapeCollisionResult collideMeshShape(const BvhModel<Rss>&, const Shape&,
                                                   const Eigen::Isometry3d&);
template MeshDistanceResult meshShapeDistance(const BvhModel<Rss>&, const Shape&,
                                              const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshShapeCollisionResult collideMeshShape(const BvhModel<ObbRss>&, const Shape&,
                                                   const Eigen::Isometry3d&);
template MeshDistanceResult meshShapeDistance(const BvhModel<ObbRss>&, const Shape&,
                                              const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshShapeCollisionResult collideMeshShape(const BvhModel<KDop<16>>&, const Shape&,
                                                   const Eigen::Isometry3d&);
template MeshDistanceResult meshShapeDistance(const BvhModel<KDop<16>>&, const Shape&,
                                              const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshShapeCollisionResult collideMeshShape(const BvhModel<KDop<18>>&, const Shape&,
                                                   const Eigen::Isometry3d&);
template MeshDistanceResult meshShapeDistance(const BvhModel<KDop<18>>&, const Shape&,
                                              const Eigen::Isometry3d&, const MeshDistanceOptions&);
template MeshShapeCollisionResult collideMeshShape(const BvhModel<KDop<24>>&, const Shape&,
                                                   const Eigen::Isometry3d&);
template MeshDistanceResult meshShapeDistance(const BvhModel<KDop<24>>&, const Shape&,
                                              const Eigen::Isometry3d&, const MeshDistanceOptions&);

}  // namespace swept
