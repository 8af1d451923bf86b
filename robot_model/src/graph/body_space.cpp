// SPDX-License-Identifier: BSD-3-Clause
#include "graph/body_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "rounding/error_model.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// Parts that are asked one by one.
constexpr std::size_t kFewParts = 24;
/// Cells along the longest side.
constexpr int kMostCells = 64;
/// Relative, of what is computed from a body's coordinates in single precision: 24 roundings.
constexpr float kSingleShare = 0x1p-18F;
/// Relative, in double precision: boxes of a part have fewer than 100 roundings.
constexpr double kDoubleShare = 1e-13;

Eigen::Vector3d lowerOf(const SingleBox& box) {
  return {box.lower(0), box.lower(1), box.lower(2)};
}
Eigen::Vector3d upperOf(const SingleBox& box) {
  return {box.upper(0), box.upper(1), box.upper(2)};
}

}  // namespace

void BodySpace::add(const Aabb& local, const Eigen::Isometry3d& pose, double grown) {
  const Vector3d middle = local.center();
  const Vector3d half = (local.upper - middle).cwiseMax(middle - local.lower);
  const Vector3d at = pose * middle;
  const Vector3d reach = (pose.linear().cwiseAbs() * half).array() + grown;
  const SingleBox whole = singleBox(at - reach, at + reach);
  Part part{.box = whole, .probe = BoxProbe(whole), .middle = {}, .halfExtents = {}};
  part.turned = !pose.linear().cwiseAbs().isApprox(Eigen::Matrix3d::Identity(), 1e-6);
  part.axes = pose.linear().transpose().cast<float>();
  part.middle = (pose.linear().transpose() * at).cast<float>();
  part.halfExtents = (half.array() + grown).cast<float>();
  part.slack = kSingleShare * (part.middle.cwiseAbs().sum() + part.halfExtents.sum());
  box_.extend(part.box);
  parts_.push_back(part);
}

void BodySpace::addFlat(const Eigen::Isometry3d& pose, const Vector3d& normal, double offset,
                        double grown, bool solid) {
  Flat flat{.normal = pose.linear() * normal, .thickness = grown, .solid = solid};
  flat.offset = offset + flat.normal.dot(pose.translation());
  flats_.push_back(flat);
  box_ = unboundedBox();
}

/// A number below the grid is in its first cell, one above in its last. It does not decrease, so a
/// box asks for all cells that boxes with which it shares a point are in.
int BodySpace::cellOf(int k, double x) const {
  const double within = std::clamp(x, gridLower_[k], gridUpper_[k]);
  return std::min(static_cast<int>((within - gridLower_[k]) * perCell_),
                  cells_[static_cast<std::size_t>(k)] - 1);
}

template <typename BoxOf>
void BodySpace::fillGrid(const SingleBox& all, std::size_t count, const BoxOf& boxOf) {
  gridLower_ = lowerOf(all);
  gridUpper_ = upperOf(all);
  const Vector3d sides = gridUpper_ - gridLower_;
  const double longest = sides.maxCoeff();
  if (!std::isfinite(all.upper(0)) || !std::isfinite(longest)) {
    isEverywhere_ = true;
    return;
  }
  perCell_ = longest > 0.0 ? kMostCells / longest : 0.0;
  std::size_t size = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const double cells = sides[static_cast<int>(k)] * perCell_;
    cells_[k] = std::clamp(static_cast<int>(cells) + 1, 1, kMostCells);
    stride_[k] = size;
    size *= static_cast<std::size_t>(cells_[k]) + 1;
  }
  occupied_.assign(size, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [lower, upper] = boxOf(i);
    std::array<int, 3> first{}, last{};
    for (int k = 0; k < 3; ++k) {
      first[static_cast<std::size_t>(k)] = cellOf(k, lower[k]) + 1;
      last[static_cast<std::size_t>(k)] = cellOf(k, upper[k]) + 1;
    }
    for (int z = first[2]; z <= last[2]; ++z)
      for (int y = first[1]; y <= last[1]; ++y)
        for (int x = first[0]; x <= last[0]; ++x) occupied_[place(x, y, z)] = 1;
  }
  sumUp();
}

/// From marks to the number of marks before each corner.
void BodySpace::sumUp() {
  for (int z = 1; z <= cells_[2]; ++z)
    for (int y = 1; y <= cells_[1]; ++y) {
      std::uint32_t row = 0;
      for (int x = 1; x <= cells_[0]; ++x) {
        const std::size_t at = place(x, y, z);
        row += occupied_[at];
        // Numbers before this row, in this plane, and in the plane before.
        occupied_[at] = row + occupied_[at - stride_[1]] + occupied_[at - stride_[2]] -
                        occupied_[at - stride_[1] - stride_[2]];
      }
    }
}

BodySpace::BodySpace(const WorldBody& body, double scale, double margin, double perMetre) {
  for (const WorldBody::Part& part : body.parts) {
    const Shape shape = scale == 1.0 ? part.shape : scaled(part.shape, scale);
    const Eigen::Isometry3d& pose = part.world_from_shape;
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    const double grown = margin + (mesh != nullptr ? mesh->sourceError() : 0.0);
    const auto roundingOf = [&](double size) {
      return (perMetre + kDoubleShare) * (size + pose.translation().norm());
    };
    if (const auto* plane = std::get_if<Plane>(&shape)) {
      addFlat(pose, plane->normal, plane->offset, grown + roundingOf(std::abs(plane->offset)),
              false);
    } else if (const auto* half = std::get_if<HalfSpace>(&shape)) {
      addFlat(pose, half->normal, half->offset, grown + roundingOf(std::abs(half->offset)), true);
    } else {
      const Aabb local = boundingBox(shape);
      const double size = local.lower.cwiseAbs().cwiseMax(local.upper.cwiseAbs()).norm();
      add(local, pose, grown + roundingOf(size));
      const auto* cloud = std::get_if<PointCloud>(&shape);
      if (cloud == nullptr || body.parts.size() > 1) continue;
      const double reach = grown + roundingOf(size);
      fillGrid(box_, cloud->points().size(), [&](std::size_t i) {
        const Vector3d at = pose * cloud->points()[i];
        const Vector3d all = Vector3d::Constant(cloud->radius(i) + reach);
        return std::pair<Vector3d, Vector3d>(at - all, at + all);
      });
      parts_.clear();
    }
  }
  if (parts_.size() <= kFewParts) return;
  SingleBox all = emptyBox();
  for (const Part& part : parts_) all.extend(part.box);
  fillGrid(all, parts_.size(), [this](std::size_t i) {
    return std::pair<Vector3d, Vector3d>(lowerOf(parts_[i].box), upperOf(parts_[i].box));
  });
  parts_.clear();
}

bool BodySpace::gridTouches(const SingleBox& box) const {
  std::array<int, 3> first{}, last{};
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (static_cast<double>(box.lower(i)) > gridUpper_[k] ||
        static_cast<double>(box.upper(i)) < gridLower_[k])
      return false;
    first[i] = cellOf(k, box.lower(i));
    last[i] = cellOf(k, box.upper(i)) + 1;
  }
  const auto before = [&](int x, int y, int z) { return occupied_[place(x, y, z)]; };
  // Of unsigned numbers, whose sum is right whatever the terms are.
  const std::uint32_t upper =
      before(last[0], last[1], last[2]) - before(first[0], last[1], last[2]) -
      before(last[0], first[1], last[2]) + before(first[0], first[1], last[2]);
  const std::uint32_t lower =
      before(last[0], last[1], first[2]) - before(first[0], last[1], first[2]) -
      before(last[0], first[1], first[2]) + before(first[0], first[1], first[2]);
  return upper != lower;
}

bool BodySpace::partTouches(const Part& part, const SingleBox& box) {
  if (!part.probe.overlaps(box)) return false;
  if (!part.turned) return true;
  const Eigen::Vector3f lower(box.sides.data()), upper(box.sides.data() + 3);
  const Eigen::Vector3f middle = 0.5F * (lower + upper), half = 0.5F * (upper - lower);
  const Eigen::Vector3f away = (part.axes * middle - part.middle).cwiseAbs();
  const Eigen::Vector3f reach = part.axes.cwiseAbs() * half + part.halfExtents;
  const float slack = part.slack + kSingleShare * (middle.cwiseAbs().sum() + half.sum());
  // NaN, of an unbounded box, counts as touching.
  return !(away.array() > reach.array() + slack).any();
}

bool BodySpace::flatTouches(const Flat& flat, const SingleBox& box) {
  const Vector3d lower = lowerOf(box), upper = upperOf(box);
  const Vector3d middle = 0.5 * (lower + upper), half = 0.5 * (upper - lower);
  const double reach = flat.normal.cwiseAbs().dot(half) + flat.thickness +
                       kDoubleShare * (middle.norm() + half.norm());
  const double away = flat.normal.dot(middle) - flat.offset;
  return !(away > reach) && (flat.solid || !(-away > reach));
}

bool BodySpace::touches(const SingleBox& box) const {
  if (!BoxProbe(box_).overlaps(box)) return false;
  for (const Part& part : parts_)
    if (partTouches(part, box)) return true;
  for (const Flat& flat : flats_)
    if (flatTouches(flat, box)) return true;
  return isEverywhere_ || (!occupied_.empty() && gridTouches(box));
}

}  // namespace swept::detail
