// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/enclosure.hpp"

#include <span>

#include "narrowphase/cloud_enclosure.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// Of a mesh, a point of each component; of a convex body, one of its points, which is stored in
/// `own`.
std::span<const Vector3d> representatives(const Side& side, Vector3d& own) {
  if (side.mesh != nullptr) return side.mesh->componentPoints();
  own = side.convex.support(Vector3d::UnitX());
  return {&own, 1};
}

/// In the frame of `other`.
std::optional<Vector3d> enclosedBy(const TriangleMesh& mesh, const Side& other,
                                   const Isometry3d& mesh_from_other) {
  Vector3d own;
  for (const Vector3d& point : representatives(other, own)) {
    if (mesh.encloses(mesh_from_other * point)) return point;
  }
  return std::nullopt;
}

}  // namespace

bool isInBoth(const Side& a, const Side& b, const Isometry3d& a_from_b, const Vector3d& pointInA) {
  const auto has = [](const Side& side, const Vector3d& point) {
    if (side.isConvex()) return true;
    return side.mesh != nullptr && side.mesh->encloses(point);
  };
  return has(a, pointInA) && has(b, a_from_b.inverse() * pointInA);
}

// A convex body lies wholly on one side of the mesh's surface, and so does each connected component
// of a mesh and each ball of a cloud. So one point of each decides.
std::optional<Vector3d> enclosedPoint(const Side& a, const Side& b, const Isometry3d& a_from_b) {
  const auto inA = [&](std::optional<Vector3d> inB) {
    if (inB) inB = a_from_b * *inB;
    return inB;
  };
  if (a.mesh != nullptr && b.cloud != nullptr)
    return inA(enclosedPoint(*a.mesh, *b.cloud, a_from_b));
  if (a.cloud != nullptr && b.mesh != nullptr)
    return enclosedPoint(*b.mesh, *a.cloud, a_from_b.inverse());
  if (a.mesh != nullptr) {
    if (auto point = inA(enclosedBy(*a.mesh, b, a_from_b))) return point;
  }
  if (b.mesh != nullptr) return enclosedBy(*b.mesh, a, a_from_b.inverse());
  return std::nullopt;
}

}  // namespace swept::detail
