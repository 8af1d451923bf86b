// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/cloud_enclosure.hpp"

#include <algorithm>

#include "bvh/any_near.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// A capsule that contains the box, in another frame.
struct Surrounding {
  LineSegment axis;
  double radius;  ///< m
};
Surrounding surrounding(const OrientedBox& box, const Eigen::Isometry3d& frame_from_box) {
  const auto longest =
      static_cast<std::size_t>(std::ranges::max_element(box.half) - box.half.begin());
  const Vector3d half(box.half[0], box.half[1], box.half[2]);
  Vector3d others = half;
  others[static_cast<Eigen::Index>(longest)] = 0.0;
  const auto& axis = box.axes[longest];
  const Vector3d along =
      half[static_cast<Eigen::Index>(longest)] * Vector3d(axis[0], axis[1], axis[2]);
  // The axes are unit vectors and perpendicular up to the rounding of single precision.
  return {{frame_from_box * box.center, frame_from_box.linear() * along},
          others.norm() + 1e-5 * half.norm()};
}

bool contains(const OrientedBox& box, const Vector3d& point) {
  const Vector3d off = point - box.center;
  for (std::size_t j = 0; j < 3; ++j) {
    const Vector3d axis(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
    if (std::abs(axis.dot(off)) > static_cast<double>(box.half[j])) return false;
  }
  return true;
}

}  // namespace

/// What is not in the box around all triangles is not enclosed by any.
std::optional<Vector3d> enclosedPoint(const TriangleMesh& mesh, const PointCloud& cloud,
                                      const Eigen::Isometry3d& mesh_from_cloud) {
  std::optional<Vector3d> found;
  if (mesh.report().closedComponents == 0) return found;
  const OrientedBox& box = mesh.bvh().rootBox();
  const auto [axis, radius] = surrounding(box, mesh_from_cloud.inverse());
  anyNear(cloud.bvh(), axis, radius, [&](int index) {
    const Vector3d& center = cloud.points()[static_cast<std::size_t>(index)];
    const Vector3d point = mesh_from_cloud * center;
    if (contains(box, point) && mesh.encloses(point)) found = center;
    return found.has_value();
  });
  return found;
}

}  // namespace swept::detail
