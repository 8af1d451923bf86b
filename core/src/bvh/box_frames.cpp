// SPDX-License-Identifier: BSD-3-Clause
#include "bvh/box_frames.hpp"

#include "geometry/error_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Below this sine of the angle between two axes their cross product is left out.
constexpr double kLeastSine = 0.02;
constexpr double kMostSkew = 1e-4;
/// Of a direction's length: the squares of components that matter beside it do not underflow.
constexpr double kLeastSquaredLength = 1e-200;

/// Columns.
Matrix3d axesOf(const OrientedBox& box) {
  Matrix3d axes;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 3; ++i) axes(i, j) = box.axes[j][i];
  }
  return axes;
}

Vector3d halfOf(const OrientedBox& box) {
  return {box.half[0], box.half[1], box.half[2]};
}

double sumOf(const std::array<float, 3>& half) {
  return static_cast<double>(half[0]) + half[1] + half[2];
}

/// m, times the length of `along`: how far the box reaches from its centre.
double extentAlong(const OrientedBox& box, const Vector3d& along) {
  double extent = 0.0;
  for (int j = 0; j < 3; ++j) {
    const auto& axis = box.axes[j];
    extent += box.half[j] * std::abs(axis[0] * along[0] + axis[1] * along[1] + axis[2] * along[2]);
  }
  return extent;
}

}  // namespace

// Lemma (rounding of box gaps). Let u = 2^-24 and m = |offset|_1 + |center|_1 + |half|_1 + |half of
// the other|_1, where the offset and the centre are taken from the node's origin. The stored axes
// a_i are orthonormal up to 3 u (Gram matrix), and so are those of the other box, b_j.
//  - A box is given by |a_i . x| <= h_i; as the parallelepiped sum t_i a_i it has |t_i| <= h_i +
//    4 u |h|_1. For both boxes: 8 u m of extents.
//  - The offset from the lane's centre: one rounding of the other's centre to a float, one of the
//    difference: 2 u m in the 1-norm. Along a_i, with three products: 5 u m in all. Along b_j,
//    whose components are rounded too: 7 u m.
//  - The entries a_i . b_j are known to 5 u, which costs 5 u m of the extents; adding them up 5 u
//  m.
// Face axes: at most 27 u m. Along an edge axis n = sum w_k a_k, w = e_i x (column j): the products
// of offsets and entries 5 sqrt(2) u m each for the errors of either factor, and 3 u m for
// themselves; own extents a_m . n = w_m + 5 u; the other's, whose entries w . (column) are off by
// 16 u: with the sums 26 u m more. With the boxes' 8 u m that is 53 u m before division by the
// length, and 2 u m for the last differences. kBoxRounding covers each.
//
// Operations in double precision, before coordinates are relative to the node's origin, round by 32
// * 2^-53 of the 1-norms of all coordinates. A linear part that deviates from a rotation by s
// (entries of R^T R - 1) changes gaps by at most 8 s m, and its inverse by transposition changes
// the distance of the frames by 4 s of these 1-norms.
BoxFrames::BoxFrames(const Eigen::Isometry3d& first_from_second, double reach)
    : linear(first_from_second.linear()), translation(first_from_second.translation()) {
  const double skew = (linear.transpose() * linear - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  const double magnitude = reach + translation.cwiseAbs().sum();
  usable_ = skew < kMostSkew && magnitude > 1e-12 && magnitude < 1e12;
  rounding = (kFrameDifference + 4.0 * skew) * magnitude;
  perMetre = kBoxRounding + 8.0 * skew;
}

BoxFrames BoxFrames::inverse() const {
  BoxFrames turned = *this;
  turned.linear = linear.transpose();
  turned.translation = -(turned.linear * translation);
  return turned;
}

BoxGap boxGap(const OrientedBox& box, const BoxFrames& frames, const OrientedBox& other) {
  const Matrix3d own = axesOf(box);
  const Matrix3d rotation = own.transpose() * (frames.linear * axesOf(other));
  const Vector3d center = frames.linear * other.center + frames.translation - box.center;
  const Vector3d offset = own.transpose() * center;
  const Vector3d half = halfOf(box);
  const Vector3d otherHalf = halfOf(other);
  const double rounding =
      frames.rounding + frames.perMetre * (center.cwiseAbs().sum() + half.sum() + otherHalf.sum());
  const Matrix3d spread = rotation.cwiseAbs();
  const Vector3d alongOther = rotation.transpose() * offset;
  const auto clamped = [&](const Vector3d& along, const Vector3d& extents) {
    const Vector3d gap = (along.cwiseAbs() - extents).array() - rounding;
    return Vector3d(gap.cwiseMax(0.0).cwiseProduct(along.cwiseSign()));
  };
  // Gaps along the three orthogonal axes of one box add up as a vector: along its direction the two
  // boxes are apart by its length.
  const Vector3d inFirst = clamped(offset, half + spread * otherHalf);
  const Vector3d inOther = rotation * clamped(alongOther, otherHalf + spread.transpose() * half);
  Vector3d best = inFirst.squaredNorm() >= inOther.squaredNorm() ? inFirst : inOther;
  BoxGap gap;
  gap.value = best.norm() * (1.0 - 1e-6);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double sine = std::sqrt(std::max(0.0, 1.0 - rotation(i, j) * rotation(i, j)));
      if (!(sine > kLeastSine)) continue;
      const Vector3d axis = Vector3d::Unit(i).cross(rotation.col(j));
      const double along = offset.dot(axis);
      const double extents =
          half.dot(axis.cwiseAbs()) + otherHalf.dot((rotation.transpose() * axis).cwiseAbs());
      // The cosine is off by a few units of single precision, and the length by this at most.
      const double value = (std::abs(along) - extents - rounding) / (sine + 1e-6 / sine);
      if (value > gap.value) {
        gap.value = value;
        best = along < 0.0 ? Vector3d(-axis) : axis;
      }
    }
  }
  if (gap.value > 0.0) gap.direction = (own * best).normalized();
  return gap;
}

// Lemma (any direction). Let n be a unit vector. By the lemma above a box reaches at most
// sum (h_j + 4 u |h|_1) |n . a_j| from its centre. The |n . a_j| add up to less than 1.8, so the
// two boxes take 7.2 u m of the 96 u m. All else is done in double precision: the dot products with
// coordinates relative to each other, and `along` in the second frame, which is the transpose's
// whatever the linear part. It rounds by less than a u m, and the coordinates before they are
// relative by what BoxFrames allows for.
BoxGap boxGap(const OrientedBox& box, const BoxFrames& frames, const OrientedBox& other,
              const Vector3d& along) {
  BoxGap gap;
  const double squared = along.squaredNorm();
  if (!(squared > kLeastSquaredLength)) return gap;
  const Vector3d center = frames.linear * other.center + frames.translation - box.center;
  const double size = center.cwiseAbs().sum() + sumOf(box.half) + sumOf(other.half);
  const double inverse = 1.0 / std::sqrt(squared);
  const double apart = along.dot(center) * inverse;
  const double extents =
      (extentAlong(box, along) + extentAlong(other, frames.linear.transpose() * along)) * inverse;
  gap.value = std::abs(apart) - extents - (frames.rounding + frames.perMetre * size);
  gap.direction = std::copysign(inverse, apart) * along;
  return gap;
}

}  // namespace swept::detail
