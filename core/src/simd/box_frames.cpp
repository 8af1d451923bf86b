// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "simd/box_bounds.hpp"

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Below this sine of the angle between two axes their cross product is left out.
constexpr double kLeastSine = 0.02;
constexpr double kMostSkew = 1e-4;

}  // namespace

// Lemma (rounding of box gaps). Let u = 2^-24 and M bound the 1-norm of the translation plus those
// of all points of both sides' boxes. Moving a centre into the first frame takes at most 6 u M per
// component (three products, three sums, the rounding of the rotation and of the translation), the
// difference of the centres u M more; projecting it on an axis of the second frame 17 u M in all,
// and the projected half extents and their sums 8 u M. With fused multiply-adds there is less. For
// edge axes, before division by their length, the figures are no larger. The inverse frames take
// their translation from the rounded rotation, 9 u M more. 40 u M covers the sum. A linear part
// that deviates from a rotation by s (entries of R^T R - 1) adds at most 4 s M.
BoxFrames::BoxFrames(const Eigen::Isometry3d& first_from_second, double reach) {
  const Matrix3d rotation = first_from_second.linear();
  const double skew =
      (rotation.transpose() * rotation - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const Vector3d moved = first_from_second.translation();
  const double magnitude = reach + moved.cwiseAbs().sum();
  usable_ = skew < kMostSkew && magnitude > 1e-12 && magnitude < 1e12;
  if (!usable_) return;
  rounding = static_cast<float>(1.01 * (40.0 * 0x1p-24 + 4.0 * skew) * magnitude);
  for (int i = 0; i < 3; ++i) translation[i] = static_cast<float>(moved[i]);
  finish(rotation);
}

void BoxFrames::finish(const Matrix3d& rotation) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      axes[i][j] = static_cast<float>(rotation(i, j));
      absAxes[i][j] = std::abs(axes[i][j]);
      const double sine = std::sqrt(std::max(0.0, 1.0 - rotation(i, j) * rotation(i, j)));
      edgeScale[i][j] = sine > kLeastSine ? static_cast<float>(1.0 / sine) : 0.0F;
    }
  }
}

BoxFrames BoxFrames::inverse() const {
  BoxFrames turned;
  turned.usable_ = usable_;
  turned.rounding = rounding;
  for (int i = 0; i < 3; ++i) {
    double along = 0.0;
    for (int j = 0; j < 3; ++j) {
      turned.axes[i][j] = axes[j][i];
      turned.absAxes[i][j] = absAxes[j][i];
      turned.edgeScale[i][j] = edgeScale[j][i];
      along -= static_cast<double>(axes[j][i]) * translation[j];
    }
    turned.translation[i] = static_cast<float>(along);
  }
  return turned;
}

BoxGap boxGap(const BoxF& box, const BoxFrames& frames, const BoxF& other) {
  Matrix3d rotation;
  Vector3d offset;  // from the box's centre to the other's
  Vector3d half;
  Vector3d otherHalf;
  for (int i = 0; i < 3; ++i) {
    double at = frames.translation[i];
    for (int j = 0; j < 3; ++j) {
      rotation(i, j) = frames.axes[i][j];
      at += rotation(i, j) * other.center[j];
    }
    offset[i] = at - box.center[i];
    half[i] = box.half[i];
    otherHalf[i] = other.half[i];
  }
  const Matrix3d spread = rotation.cwiseAbs();
  const Vector3d alongOther = rotation.transpose() * offset;
  const auto clamped = [&](const Vector3d& along, const Vector3d& extents) {
    const Vector3d gap =
        (along.cwiseAbs() - extents).array() - static_cast<double>(frames.rounding);
    return Vector3d(gap.cwiseMax(0.0).cwiseProduct(along.cwiseSign()));
  };
  // Gaps along the three orthogonal axes of one box add up as a vector: along its direction the two
  // boxes are apart by its length.
  const Vector3d inFirst = clamped(offset, half + spread * otherHalf);
  const Vector3d inOther = rotation * clamped(alongOther, otherHalf + spread.transpose() * half);
  const Vector3d best = inFirst.squaredNorm() >= inOther.squaredNorm() ? inFirst : inOther;
  BoxGap gap;
  gap.value = best.norm() * (1.0 - 1e-6);
  if (gap.value > 0.0) gap.direction = best.normalized();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double scale = frames.edgeScale[i][j];
      if (!(scale > 0.0)) continue;
      const Vector3d axis = Vector3d::Unit(i).cross(rotation.col(j));
      const double along = offset.dot(axis);
      const double extents =
          half.dot(axis.cwiseAbs()) + otherHalf.dot((rotation.transpose() * axis).cwiseAbs());
      const double value = (std::abs(along) - extents - frames.rounding) * scale * (1.0 - 1e-6);
      if (value > gap.value) {
        gap.value = value;
        gap.direction = (along < 0.0 ? -scale : scale) * axis;
      }
    }
  }
  if (gap.value > 0.0) gap.direction.normalize();
  return gap;
}

}  // namespace swept::detail
