// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdint>

#include "split_mix.hpp"
#include "triangle_oracle.hpp"

/// Measures how far the answers about two shapes are from the truth.
namespace error_table {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using oracle::real;
using oracle::Real;
using Point = oracle::Vec<Real>;

inline Real length(const Point& v) {
  return sqrt(v.dot(v));
}
inline Point unit(const Point& v) {
  return v * (1 / length(v));
}
inline Vector3d rounded(const Point& p) {
  return {p.x.convert_to<double>(), p.y.convert_to<double>(), p.z.convert_to<double>()};
}
inline Point basis(int axis) {
  return {Real(axis == 0), Real(axis == 1), Real(axis == 2)};
}

/// The turn of a pose, as the map that its doubles are: not quite a rotation.
class ExactTurn {
 public:
  explicit ExactTurn(const Matrix3d& r) {
    for (int i = 0; i < 3; ++i) {
      rows_[i] = real(Vector3d(r.row(i)));
      columns_[i] = real(Vector3d(r.col(i)));
    }
    for (int i = 0; i < 3; ++i) cofactors_[i] = columns_[(i + 1) % 3].cross(columns_[(i + 2) % 3]);
    determinant_ = columns_[0].dot(cofactors_[0]);
  }
  Point operator*(const Point& p) const {
    return {rows_[0].dot(p), rows_[1].dot(p), rows_[2].dot(p)};
  }
  Point transposed(const Point& p) const {
    return {columns_[0].dot(p), columns_[1].dot(p), columns_[2].dot(p)};
  }
  Point inverse(const Point& p) const {
    const Real scale = 1 / determinant_;
    return Point{cofactors_[0].dot(p), cofactors_[1].dot(p), cofactors_[2].dot(p)} * scale;
  }
  /// The normal of a plane, turned; of another length.
  Point normal(const Point& n) const {
    return cofactors_[0] * n.x + cofactors_[1] * n.y + cofactors_[2] * n.z;
  }

 private:
  std::array<Point, 3> rows_, columns_, cofactors_;
  Real determinant_;
};

class Random : public swept::test::SplitMix {
 public:
  using SplitMix::SplitMix;
  Vector3d across(const Vector3d& axis) {
    return (axis.cross(direction()) + 1e-3 * axis.unitOrthogonal()).normalized();
  }
};

}  // namespace error_table
