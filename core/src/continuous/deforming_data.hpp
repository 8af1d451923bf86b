// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "continuous/deforming_tree.hpp"
#include "continuous/follow_corners.hpp"
#include "continuous/meeting_pairs.hpp"
#include "continuous/surface_features.hpp"
#include "swept/core/continuous/deforming_mesh.hpp"

namespace swept {

struct DeformingMesh::Data {
  Data(std::size_t vertices, std::span<const Triangle> triangles)
      : vertexCount(vertices), surface(vertices, triangles) {}

  /// Fills in a frame; returns the area of boxes relative to that of the triangles' boxes.
  double follow(std::span<const Eigen::Vector3d> vertices, double reach,
                detail::DeformingFrame& frame);
  /// Part of follow(): vertices as numbered by the tree, and `points`.
  void copyVertices(std::span<const Eigen::Vector3d> vertices, std::size_t first, std::size_t last,
                    detail::DeformingFrame& frame);
  /// Part of follow(): the rest, once all subtrees and their `areas` are done.
  double finish(detail::DeformingFrame& frame);
  void arrange(std::span<const Eigen::Vector3d> vertices);
  void arrangeAnew();

  const detail::DeformingFrame& from() const { return still ? end : start; }

  std::size_t vertexCount;
  detail::SurfaceFeatures surface;
  detail::TreeOrder order;
  detail::DeformingFrame start, end;
  bool still = true;                       ///< the step begins where it ends, and `start` is unused
  std::vector<detail::FloatPoint> points;  ///< m, scratch: the vertices of the latest frame
  std::vector<detail::BoxAreas> areas;     ///< scratch: of the subtrees of the latest frame
  double areaRatio = 0.0, builtRatio = 0.0;
  std::size_t rebuilds = 0;
};

}  // namespace swept
