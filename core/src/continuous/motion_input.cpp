// SPDX-License-Identifier: BSD-3-Clause
#include "continuous/motion_input.hpp"

#include <sstream>
#include <stdexcept>

#include "geometry/point_text.hpp"

namespace swept::detail {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

/// No unit. How far products of a rotation's columns may be from those of unit vectors: poses in
/// single precision, or printed with seven digits, stay within it.
constexpr double kNotARotation = 1e-6;

[[noreturn]] void refuse(std::string_view name, const std::string& what) {
  throw std::invalid_argument("motion: " + std::string(name) + ' ' + what);
}

}  // namespace

void requireFinite(const Vector3d& vector, std::string_view name) {
  if (vector.allFinite()) return;
  refuse(name, "is " + pointText(vector) + ", which is not finite");
}

// Newton's iteration for the polar decomposition squares the distance from a rotation each time.
Matrix3d checkedRotation(const Matrix3d& rotation, std::string_view name) {
  const double off = (rotation.transpose() * rotation - Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (!(off <= kNotARotation) || !(rotation.determinant() > 0.0)) {
    std::ostringstream what;
    what << "has a linear part that is no rotation: its columns' products are off by " << off
         << " (at most " << kNotARotation << " is allowed), its determinant is "
         << rotation.determinant();
    refuse(name, what.str());
  }
  Matrix3d nearest = rotation;
  for (int i = 0; i < 2; ++i) {
    nearest = 0.5 * nearest * (3.0 * Matrix3d::Identity() - nearest.transpose() * nearest).eval();
  }
  return nearest;
}

Isometry3d checkedPose(const Isometry3d& pose, std::string_view name) {
  requireFinite(pose.translation(), name);
  Isometry3d checked;
  checked.linear() = checkedRotation(pose.linear(), name);
  checked.translation() = pose.translation();
  checked.makeAffine();
  return checked;
}

}  // namespace swept::detail
