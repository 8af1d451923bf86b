// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/orientation.hpp"
#include "geometry/product_error.hpp"

/// Signs of determinants of points: first a floating-point filter, then an exact sum where nothing
/// cheaper decides (following the idea of Shewchuk 1997, "Adaptive precision floating-point
/// arithmetic and fast robust geometric predicates").
///
/// Lemma (filter). With u = 2^-53 and no overflow, ((b - a) x (c - a)) . (p - a) evaluated in
/// doubles carries at most 8 roundings along each of its 6 products of three factors: three
/// differences, two multiplications, three additions. So it is within 6 * 8.01 u * E1 E2 D of the
/// truth, where E1, E2 and D are the largest components of the three differences; 32 epsilon = 64 u
/// leaves a quarter for the rounding of the bound itself. A product that underflows is off by less
/// than 2^-1073, which the two additions of kUnderflow dominate. Where something overflows the
/// height is not finite, and the filter tells nothing.
///
/// Lemma (exact sum). Coordinates that are zero or in [kExactLeast, kExactGreatest] are multiples
/// of 2^-352, products of three of them multiples of 2^-1056 below 2^900: every part of every
/// product is a double, and so is every component of their sum.
namespace swept::detail {

inline constexpr double kExactLeast = 1e-90;
inline constexpr double kExactGreatest = 1e90;
inline constexpr double kUnderflow = 1e-290;

/// False for NaN.
inline bool withinExactRange(const Eigen::Vector3d& p) {
  for (int i = 0; i < 3; ++i) {
    const double magnitude = std::abs(p[i]);
    const bool within = magnitude >= kExactLeast && magnitude <= kExactGreatest;
    if (!within && magnitude != 0.0) return false;
  }
  return true;
}

inline double largestComponent(const Eigen::Vector3d& v) {
  return std::max(std::max(std::abs(v.x()), std::abs(v.y())), std::abs(v.z()));
}

/// Bound on the rounding of a height over a plane, for differences with these largest components.
inline double heightRounding(double first, double second, double reach) {
  return 32.0 * std::numeric_limits<double>::epsilon() * ((first * second + kUnderflow) * reach) +
         kUnderflow;
}

/// Decision of the filter for a value with this error bound.
enum class FilteredSign : int { Negative = -1, Positive = 1, Unknown = 2 };

inline FilteredSign filteredSign(double value, double bound) {
  constexpr double kOverflow = std::numeric_limits<double>::infinity();
  if (value > bound && value < kOverflow) return FilteredSign::Positive;
  if (value < -bound && value > -kOverflow) return FilteredSign::Negative;
  return FilteredSign::Unknown;
}

/// Side of p with respect to the plane through a, b, c, if doubles can decide.
inline FilteredSign filteredSideOfPlane(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                        const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const Eigen::Vector3d ap = p - a;
  return filteredSign(
      ab.cross(ac).dot(ap),
      heightRounding(largestComponent(ab), largestComponent(ac), largestComponent(ap)));
}

/// An unevaluated sum of two doubles, some 106 bits.
struct TwoDoubles {
  double high;
  double low;
};

inline TwoDoubles exactSumOf(double x, double y) {
  const double sum = x + y;
  const double virtualY = sum - x;
  return {sum, (x - (sum - virtualY)) + (y - virtualY)};
}

inline TwoDoubles operator+(const TwoDoubles& x, const TwoDoubles& y) {
  const TwoDoubles high = exactSumOf(x.high, y.high);
  return exactSumOf(high.high, high.low + (x.low + y.low));
}

inline TwoDoubles operator*(const TwoDoubles& x, const TwoDoubles& y) {
  const double high = x.high * y.high;
  const double low = productError(x.high, y.high, high);
  return exactSumOf(high, low + (x.high * y.low + x.low * y.high));
}

inline TwoDoubles operator-(const TwoDoubles& x) {
  return {-x.high, -x.low};
}

/// Second stage of sideOfPlane(): exact differences, then some 100 bits. It decides for all points
/// except those that are coplanar, or within 2^-95 of it.
///
/// Lemma. A sum of TwoDoubles is within 3 u^2 of the sum of the magnitudes, a product within 8 u^2
/// of its own, and each of the six products of three factors passes at most two products and three
/// sums: 6 * 26 u^2 E1 E2 D < 2^-98 E1 E2 D. The largest components of the rounded differences
/// stand for those of the exact ones, which costs a factor 1 + 4 u. Products below 2^-969, where
/// the error of a product is not a double, cost less than kUnderflow.
inline FilteredSign refinedSideOfPlane(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                       const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  std::array<std::array<TwoDoubles, 3>, 3> d;
  std::array<double, 3> reach{};
  const std::array<const Eigen::Vector3d*, 3> ends{&b, &c, &p};
  for (int row = 0; row < 3; ++row) {
    for (int k = 0; k < 3; ++k) {
      d[row][k] = exactSumOf((*ends[row])[k], -a[k]);
      reach[row] = std::max(reach[row], std::abs(d[row][k].high));
    }
  }
  const auto minor = [&d](int i, int j) { return d[0][i] * d[1][j] + -(d[0][j] * d[1][i]); };
  const TwoDoubles height = minor(1, 2) * d[2][0] + minor(2, 0) * d[2][1] + minor(0, 1) * d[2][2];
  return filteredSign(height.high,
                      0x1p-95 * ((reach[0] * reach[1] + kUnderflow) * reach[2]) + kUnderflow);
}

/// Whether two of the points coincide, or all are in one plane across an axis: frequent in meshes.
inline bool plainlyCoplanar(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c, const Eigen::Vector3d& p) {
  for (int k = 0; k < 3; ++k) {
    if (a[k] == b[k] && a[k] == c[k] && a[k] == p[k]) return true;
  }
  return a == p || b == p || c == p || a == b || b == c || a == c;
}

/// Sign (-1, 0, 1) of ((b - a) x (c - a)) . (p - a). Exact within the range of withinExactRange().
inline int sideOfPlane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                       const Eigen::Vector3d& p) {
  const FilteredSign filtered = filteredSideOfPlane(a, b, c, p);
  if (filtered != FilteredSign::Unknown) return static_cast<int>(filtered);
  if (plainlyCoplanar(a, b, c, p)) return 0;
  const FilteredSign refined = refinedSideOfPlane(a, b, c, p);
  if (refined != FilteredSign::Unknown) return static_cast<int>(refined);
  return exactOrientation(a, b, c, p);
}

/// Sign (-1, 0, 1) of (b - a) x (c - a) in the coordinates (i, j): counterclockwise is positive.
/// Exact within the range of withinExactRange(). Two products of two factors with 2 + 1 + 1
/// roundings each, hence 8 u times the sum of their magnitudes (4.01 u needed).
inline int sideOfLine(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                      int i, int j) {
  const double forward = (b[i] - a[i]) * (c[j] - a[j]);
  const double backward = (b[j] - a[j]) * (c[i] - a[i]);
  const double bound =
      4.0 * std::numeric_limits<double>::epsilon() * (std::abs(forward) + std::abs(backward)) +
      kUnderflow;
  const FilteredSign filtered = filteredSign(forward - backward, bound);
  if (filtered != FilteredSign::Unknown) return static_cast<int>(filtered);
  ExactSum sum;
  sum.addProduct(a[i], b[j], 1.0);
  sum.addProduct(-a[j], b[i], 1.0);
  sum.addProduct(b[i], c[j], 1.0);
  sum.addProduct(-b[j], c[i], 1.0);
  sum.addProduct(c[i], a[j], 1.0);
  sum.addProduct(-c[j], a[i], 1.0);
  return sum.sign();
}

}  // namespace swept::detail
