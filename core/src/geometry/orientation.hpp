// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>

#include "geometry/error_model.hpp"
#include "geometry/product_error.hpp"

/// On which side of a plane through three points a fourth one lies, exactly (Shewchuk 1997,
/// "Adaptive precision floating-point arithmetic and fast robust geometric predicates": expansions,
/// sections 2.3 and 2.4; only its first, rounded stage is kept, the other stages are one exact
/// sum).
namespace swept::detail {

/// A sum of doubles without rounding, as components that do not overlap, smallest first.
class ExactSum {
 public:
  void add(double value) {
    int kept = 0;
    for (int i = 0; i < size_; ++i) {
      const double sum = value + components_[i];
      const double virtualValue = sum - components_[i];
      const double virtualComponent = sum - virtualValue;
      const double lost = (components_[i] - virtualComponent) + (value - virtualValue);
      if (lost != 0.0) components_[kept++] = lost;
      value = sum;
    }
    if (value != 0.0) components_[kept++] = value;
    size_ = kept;
  }
  void addProduct(double x, double y, double z) {
    const double high = x * y;
    const double low = productError(x, y, high);
    addProduct(high, z);
    if (low != 0.0) addProduct(low, z);
  }
  /// -1, 0 or 1.
  int sign() const {
    if (size_ == 0) return 0;
    return components_[size_ - 1] > 0.0 ? 1 : -1;
  }

 private:
  void addProduct(double x, double y) {
    const double high = x * y;
    const double low = productError(x, y, high);
    if (low != 0.0) add(low);
    if (high != 0.0) add(high);
  }

  static constexpr int kMostTerms = 96;  // 24 products of three factors, four doubles each
  std::array<double, kMostTerms + 1> components_;
  int size_ = 0;
};

/// Adds sign * det(x, y, z).
inline void addDeterminant(ExactSum& sum, double sign, const Eigen::Vector3d& x,
                           const Eigen::Vector3d& y, const Eigen::Vector3d& z) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const int k = (i + 2) % 3;
    sum.addProduct(sign * x[i], y[j], z[k]);
    sum.addProduct(-sign * x[i], y[k], z[j]);
  }
}

/// Sign of ((b - a) x (c - a)) . (p - a). Exact for coordinates of at most 1 in magnitude whose
/// products do not underflow.
inline int exactOrientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  ExactSum sum;
  addDeterminant(sum, 1.0, b, c, p);
  addDeterminant(sum, -1.0, a, c, p);
  addDeterminant(sum, 1.0, a, b, p);
  addDeterminant(sum, -1.0, a, b, c);
  return sum.sign();
}

/// An oriented plane through three points of at most 1 in magnitude.
class OrientedPlane {
 public:
  OrientedPlane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
      : anchor_(a), normal_((b - a).cross(c - a)) {
    bound_ = kOrientationRounding * (b - a).cwiseAbs().maxCoeff() * (c - a).cwiseAbs().maxCoeff();
  }
  /// Proportional to the distance from the plane, positive ahead of it.
  double height(const Eigen::Vector3d& p) const { return normal_.dot(p - anchor_); }
  /// Heights beyond this, of either sign, have the right sign.
  double bound() const { return bound_; }
  /// Not normalised.
  const Eigen::Vector3d& normal() const { return normal_; }

 private:
  Eigen::Vector3d anchor_;
  Eigen::Vector3d normal_;
  double bound_;
};

}  // namespace swept::detail
