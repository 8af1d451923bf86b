// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/part_approach.hpp"

#include "swept/core/tolerances.hpp"

namespace swept::detail {

using Eigen::Vector3d;

namespace {

/// m. How far a rotation moves points of the part, at most.
double reachOf(const Vector3d& spin, const PartMotion& part) {
  if (spin.isZero(0.0)) return 0.0;
  const double corner = std::sqrt(part.axes[0].squaredNorm() + part.axes[1].squaredNorm() +
                                  part.axes[2].squaredNorm());
  return spin.norm() * (part.offset.norm() + corner * (1.0 + 1e-6));
}

}  // namespace

double PartApproach::errorsMost() {
  double moved = 0.0;
  for (const ApproachError& error : whole_.errors) {
    fixed_ += tolerance::kSupportRounding * error.linear.cwiseAbs().sum();
    moved += error.linear.norm() + reachOf(error.spinA, a_) + reachOf(error.spinB, b_);
  }
  return moved;
}

double PartApproach::errorsAlong(const Vector3d& n) const {
  double sum = 0.0;
  for (const ApproachError& error : whole_.errors) {
    double atCenters = n.dot(error.linear);
    if (!error.spinA.isZero(0.0)) {
      const Vector3d turned = n.cross(error.spinA);
      atCenters -= a_.offset.dot(turned);
      for (const Vector3d& axis : a_.axes) sum += std::abs(axis.dot(turned));
    }
    if (!error.spinB.isZero(0.0)) {
      const Vector3d turned = n.cross(error.spinB);
      atCenters += b_.offset.dot(turned);
      for (const Vector3d& axis : b_.axes) sum += std::abs(axis.dot(turned));
    }
    sum += std::abs(atCenters);
  }
  return sum;
}

// Rounding: velocities, half axes and their products with a spin are sums of fewer than 20 products
// of a spin with coordinates, each within a few ulps of the coordinates' 1-norms. Those of b are
// first moved into a's frame, where they may be larger by the frames' distance.
PartMotion PartMotions::of(bool ofA, const OrientedBox& box) const {
  PartMotion part;
  if (!whole_.errors.empty()) [[unlikely]]
    place(ofA, box, part);
  if (!(ofA ? turnsA_ : turnsB_)) return part;
  const Vector3d& spin = ofA ? whole_.spinA : whole_.spinB;
  const Vector3d& about = ofA ? whole_.ballA.center : whole_.ballB.center;
  const Vector3d center = ofA ? box.center : Vector3d(a_from_b_ * box.center);
  part.linear = spin.cross(center - about);
  const double size = static_cast<double>(box.half[0]) + box.half[1] + box.half[2];
  Vector3d half;
  for (int j = 0; j < 3; ++j) {
    const Vector3d axis(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
    half[j] = box.half[j] + kBoxSkew * size;
    part.spread[j] = ofA ? Vector3d(half[j] * spin.cross(axis))
                         : Vector3d(a_from_b_.linear() * (half[j] * spinInB_.cross(axis)));
    part.most += part.spread[j].norm();
  }
  // The farthest corner of the box bounds the sum, too.
  part.most = std::min(part.most, spin.norm() * half.norm() * (1.0 + 1e-6));
  const double coordinates = box.center.cwiseAbs().sum() + size + about.cwiseAbs().sum() + offset_;
  part.rounding += tolerance::kSupportRounding * spin.cwiseAbs().sum() * coordinates;
  return part;
}

/// For errors: PartMotion::offset and axes.
void PartMotions::place(bool ofA, const OrientedBox& box, PartMotion& part) const {
  const Vector3d& about = ofA ? whole_.ballA.center : whole_.ballB.center;
  part.offset = (ofA ? box.center : Vector3d(a_from_b_ * box.center)) - about;
  const double size = static_cast<double>(box.half[0]) + box.half[1] + box.half[2];
  for (int j = 0; j < 3; ++j) {
    const Vector3d axis(box.axes[j][0], box.axes[j][1], box.axes[j][2]);
    const Vector3d half = (box.half[j] + kBoxSkew * size) * axis;
    part.axes[j] = ofA ? half : Vector3d(a_from_b_.linear() * half);
  }
  const double coordinates = box.center.cwiseAbs().sum() + size + about.cwiseAbs().sum() + offset_;
  part.rounding = tolerance::kSupportRounding * (ofA ? errorsA_ : errorsB_) * coordinates;
}

PartMotion PartMotions::ofBall(bool ofA) const {
  PartMotion part;
  const double radius = ofA ? whole_.ballA.radius : whole_.ballB.radius;
  if (!whole_.errors.empty()) [[unlikely]] {
    part.offset.setZero();
    for (int j = 0; j < 3; ++j) part.axes[j] = radius * Vector3d::Unit(j);
    part.rounding = tolerance::kSupportRounding * (ofA ? errorsA_ : errorsB_) * radius;
  }
  if (!(ofA ? turnsA_ : turnsB_)) return part;
  const Vector3d& spin = ofA ? whole_.spinA : whole_.spinB;
  for (int j = 0; j < 3; ++j) part.spread[j] = radius * spin.cross(Vector3d::Unit(j));
  part.most = spin.norm() * radius;
  part.rounding += tolerance::kSupportRounding * spin.cwiseAbs().sum() * radius;
  return part;
}

}  // namespace swept::detail
