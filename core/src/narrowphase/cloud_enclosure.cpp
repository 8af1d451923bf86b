// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/cloud_enclosure.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bvh/box_bounds.hpp"
#include "bvh/box_frames.hpp"
#include "bvh/node_ball.hpp"
#include "bvh/pending_boxes.hpp"
#include "swept/core/segment_query.hpp"
#include "swept/core/tolerances.hpp"

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

/// The balls of a cloud whose centres a mesh encloses.
class EnclosedBalls {
 public:
  EnclosedBalls(const TriangleMesh& mesh, const PointCloud& cloud,
                const Eigen::Isometry3d& mesh_from_cloud)
      : mesh_(mesh),
        cloud_(cloud),
        bvh_(cloud.bvh()),
        mesh_from_cloud_(mesh_from_cloud),
        box_(mesh.bvh().rootBox()) {}

  /// The centre (m, cloud's frame) of one of them.
  std::optional<Vector3d> find() const {
    const BoxFrames frames(mesh_from_cloud_, mesh_.bvh().reach() + bvh_.reach());
    const BoxFrames cloud_from_mesh = frames.inverse();
    PendingBoxes pending;
    while (!pending.isEmpty()) {
      const std::int32_t top = pending.pop().child;
      if (bvh_.isBucket(top)) {
        if (const std::optional<Vector3d> found = findIn(top)) return found;
        continue;
      }
      const WideNode& node = bvh_.nodes()[static_cast<std::size_t>(top)];
      std::array<float, WideNode::kLanes> apart{};
      if (cloud_from_mesh.usable()) boxLowerBounds(node, cloud_from_mesh, box_, 0.0F, apart);
      for (int lane = 0; lane < node.count; ++lane) {
        if (apart[lane] > 0.0F) continue;
        if (!isOnOneSide(node, lane))
          pending.push({0.0F, node.child[lane]});
        else if (isEnclosed(node.box(lane).center))
          return anyOf(node.child[lane]);
      }
    }
    return std::nullopt;
  }

 private:
  std::optional<Vector3d> findIn(std::int32_t bucket) const {
    const auto [first, last] = bvh_.pointsOf(bucket);
    for (std::int32_t i = first; i < last; ++i) {
      const Vector3d& center = cloud_.points()[static_cast<std::size_t>(i)];
      if (isEnclosed(center)) return center;
    }
    return std::nullopt;
  }

  Vector3d anyOf(std::int32_t node) const {
    while (!bvh_.isBucket(node)) node = bvh_.nodes()[static_cast<std::size_t>(node)].child[0];
    return cloud_.points()[static_cast<std::size_t>(bvh_.pointsOf(node).first)];
  }

  /// Whether no triangle meets the ball around a box, so that the mesh encloses all of it or
  /// nothing. Where many points are in the mesh's box, this replaces a test of each.
  bool isOnOneSide(const WideNode& node, int lane) const {
    const NodeBall ball(node, lane);
    const double size = ball.center.lpNorm<1>() + mesh_from_cloud_.translation().lpNorm<1>();
    return isFarther(mesh_, {mesh_from_cloud_ * ball.center},
                     ball.radius + tolerance::kSupportRounding * size);
  }

  /// Points outside the box around all triangles are not enclosed by any.
  bool isEnclosed(const Vector3d& inCloud) const {
    const Vector3d point = mesh_from_cloud_ * inCloud;
    return contains(box_, point) && mesh_.encloses(point);
  }

  const TriangleMesh& mesh_;
  const PointCloud& cloud_;
  const WideBvh& bvh_;
  const Eigen::Isometry3d& mesh_from_cloud_;
  const OrientedBox& box_;
};

}  // namespace

std::optional<Vector3d> enclosedPoint(const TriangleMesh& mesh, const PointCloud& cloud,
                                      const Eigen::Isometry3d& mesh_from_cloud) {
  if (mesh.report().closedComponents == 0) return std::nullopt;
  return EnclosedBalls(mesh, cloud, mesh_from_cloud).find();
}

}  // namespace swept::detail
