// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/cloud_enclosure.hpp"

#include <array>
#include <cmath>

#include "bvh/box_bounds.hpp"
#include "bvh/box_frames.hpp"
#include "bvh/pending_boxes.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

bool contains(const OrientedBox& box, const Vector3d& point) {
  const Vector3d off = point - box.center;
  for (std::size_t j = 0; j < 3; ++j) {
    const Vector3d axis(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
    if (std::abs(axis.dot(off)) > static_cast<double>(box.half[j])) return false;
  }
  return true;
}

/// Calls `stop` with the points of a cloud whose boxes may meet another box, until it is true for
/// one.
template <typename Stop>
void anyNearBox(const PointCloud& cloud, const BoxFrames& cloud_from_box, const OrientedBox& box,
                const Stop& stop) {
  const WideBvh& bvh = cloud.bvh();
  PendingBoxes pending;
  while (!pending.isEmpty()) {
    const std::int32_t top = pending.pop().child;
    if (bvh.isBucket(top)) {
      const auto [first, last] = bvh.pointsOf(top);
      for (std::int32_t point = first; point < last; ++point) {
        if (stop(point)) return;
      }
      continue;
    }
    const WideNode& node = bvh.nodes()[static_cast<std::size_t>(top)];
    std::array<float, WideNode::kLanes> apart{};
    if (cloud_from_box.usable()) boxLowerBounds(node, cloud_from_box, box, 0.0F, apart);
    for (int lane = 0; lane < node.count; ++lane) {
      if (!(apart[lane] > 0.0F)) pending.push({0.0F, node.child[lane]});
    }
  }
}

}  // namespace

/// Points outside the box around all triangles are not enclosed by any.
std::optional<Vector3d> enclosedPoint(const TriangleMesh& mesh, const PointCloud& cloud,
                                      const Eigen::Isometry3d& mesh_from_cloud) {
  std::optional<Vector3d> found;
  if (mesh.report().closedComponents == 0) return found;
  const OrientedBox& box = mesh.bvh().rootBox();
  const BoxFrames frames(mesh_from_cloud, mesh.bvh().reach() + cloud.bvh().reach());
  anyNearBox(cloud, frames.inverse(), box, [&](int index) {
    const Vector3d& center = cloud.points()[static_cast<std::size_t>(index)];
    const Vector3d point = mesh_from_cloud * center;
    if (contains(box, point) && mesh.encloses(point)) found = center;
    return found.has_value();
  });
  return found;
}

}  // namespace swept::detail
