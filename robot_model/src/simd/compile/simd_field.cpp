// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/simd_field.hpp"

#include <algorithm>
#include <limits>

#include "model/pair_model.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/single.hpp"
#include "swept/core/clearance_grid.hpp"
#include "swept/core/segment_query.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

bool wantsField(const WorldGeometry& geometry) {
  return std::holds_alternative<TriangleMesh>(geometry.shape) ||
         std::holds_alternative<PointCloud>(geometry.shape);
}

/// Copies of a mesh or of a cloud share a field.
const void* dataOf(const Shape& shape) {
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) return &mesh->bvh();
  return &std::get<PointCloud>(shape).bvh();
}

/// Number of cells of one field, and of all fields of a world.
constexpr std::size_t kMostFieldCells = std::size_t{1} << 19;
constexpr std::size_t kLeastFieldCells = std::size_t{1} << 12;
constexpr std::size_t kMostCells = std::size_t{1} << 22;

}  // namespace

FieldCompiler::FieldCompiler(const std::vector<WorldGeometry>& world, double reach, double room,
                             std::span<const SimdField> known)
    : reach_(reach), room_(room) {
  const auto fields = static_cast<std::size_t>(std::ranges::count_if(world, wantsField));
  cells_ =
      std::clamp(kMostCells / std::max<std::size_t>(fields, 1), kLeastFieldCells, kMostFieldCells);
  for (const SimdField& lane : known)
    known_.push_back({dataOf(lane.shape), lane.window, lane.field});
}

std::shared_ptr<const ClearanceField> FieldCompiler::fieldFor(const Shape& shape, const Aabb& box,
                                                              const Aabb& window) {
  const void* data = dataOf(shape);
  for (const KnownField& known : known_) {
    if (known.data == data && known.window.lower == window.lower &&
        known.window.upper == window.upper)
      return known.field;
  }
  const bool isWanted = box.overlaps(window);
  known_.push_back(
      {data, window, isWanted ? ClearanceGrid::build(shape, {window, cells_}).field() : nullptr});
  return known_.back().field;
}

bool FieldCompiler::compile(const WorldGeometry& geometry, double slack, SimdField& lane) {
  const Eigen::Isometry3d shape_from_world = geometry.world_from_shape.inverse();
  const Aabb box = boundingBox(geometry.shape);
  const Vector3d unlimited = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Aabb window{-unlimited, unlimited};
  // If the window cuts nothing off, for any pose, the field can be shared.
  const Vector3d origin = shape_from_world.translation();
  for (int i = 0; i < 3; ++i) {
    if (origin[i] - room_ > box.lower[i]) window.lower[i] = origin[i] - room_;
    if (origin[i] + room_ < box.upper[i]) window.upper[i] = origin[i] + room_;
  }
  const std::shared_ptr<const ClearanceField> field = fieldFor(geometry.shape, box, window);
  if (!field) return false;
  Eigen::Isometry3d grid_from_world = shape_from_world;
  grid_from_world.translation() -= field->origin;
  assignFrame(grid_from_world, lane);
  for (int i = 0; i < 3; ++i) {
    constexpr double kFar = 1e30;
    lane.lower[i] = singleBelow(std::max(field->lower[i], -kFar));
    lane.upper[i] = singleAbove(std::min(field->upper[i], kFar));
    lane.blocks[i] = field->blocks[i];
  }
  lane.cell = 2.0F * field->voxel;
  lane.inverse = 1.0F / lane.cell;
  lane.step = field->step;
  lane.fineStep = field->fineStep;
  // L10 of ERROR_MODEL.md. A larger W is as good.
  const double size = reach_ + geometry.magnitude + 255.0 * static_cast<double>(field->step);
  lane.slack = singleAbove(fieldRounding(slack, size));
  lane.cells = field->cells.data();
  lane.bricks = field->bricks.data();
  lane.voxels = field->voxels.data();
  lane.field = field;
  lane.shape = geometry.shape;
  lane.shape_from_world = shape_from_world;
  lane.window = window;
  return true;
}

bool isApart(const SimdField& field, const MovingPoint& point, float radius, bool outside) {
  const LineSegment segment = {
      field.shape_from_world * Vector3d(point.x[0], point.x[1], point.x[2]),
      field.shape_from_world.linear() * Vector3d(point.g[0], point.g[1], point.g[2])};
  // The slack is more than the rounding of the pose.
  const double within = static_cast<double>(radius) + static_cast<double>(field.slack);
  if (const auto* cloud = std::get_if<PointCloud>(&field.shape))
    return isFarther(*cloud, segment, within);
  const auto& mesh = std::get<TriangleMesh>(field.shape);
  return isFarther(mesh, segment, within) && (outside || !mesh.encloses(segment.center));
}

bool reaches(const SimdField& field, const MovingPoint& point, float radius, bool outside) {
  const Vector3d middle = field.shape_from_world * Vector3d(point.x[0], point.x[1], point.x[2]);
  const auto within = static_cast<double>(radius);
  if (const auto* cloud = std::get_if<PointCloud>(&field.shape))
    return pointWithin(*cloud, middle, within).has_value();
  const auto& mesh = std::get<TriangleMesh>(field.shape);
  return pointWithin(mesh, middle, within) || (!outside && mesh.encloses(middle));
}

}  // namespace swept::detail
