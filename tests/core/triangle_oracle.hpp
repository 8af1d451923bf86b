// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>

#include "swept/core/triangle_pair.hpp"

/// Truths about two triangles, in integer and in 50-digit arithmetic; no method is the library's.
namespace oracle {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<
    1536, 1536, boost::multiprecision::signed_magnitude, boost::multiprecision::unchecked, void>>;
using Real = boost::multiprecision::cpp_bin_float_50;
using swept::TriangleCorners;

/// A vector of a number type that Eigen need not know.
template <class T>
struct Vec {
  T x, y, z;
  Vec operator-(const Vec& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec operator+(const Vec& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec operator*(const T& s) const { return {x * s, y * s, z * s}; }
  T dot(const Vec& o) const { return x * o.x + y * o.y + z * o.z; }
  Vec cross(const Vec& o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
};

/// x * 2^shift, which has to be an integer.
inline Integer toInteger(double x, int shift) {
  int exponent = 0;
  const double mantissa = std::frexp(x, &exponent);
  Integer value = static_cast<long long>(std::ldexp(mantissa, 53));
  const int power = exponent - 53 + shift;
  if (power >= 0) return value << power;
  return value / (Integer(1) << -power);
}

inline int leastExponent(const TriangleCorners& t) {
  int least = 2000;
  for (const Eigen::Vector3d& corner : t) {
    for (int i = 0; i < 3; ++i) {
      if (corner[i] != 0.0) least = std::min(least, std::ilogb(corner[i]) - 52);
    }
  }
  return least;
}

template <class T>
int signOf(const T& x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

/// The sign s such that all of the list agree with it: 0 if some are positive and some negative, or
/// all are zero.
template <std::size_t N>
bool agree(const std::array<int, N>& signs) {
  const bool positive = std::any_of(signs.begin(), signs.end(), [](int s) { return s > 0; });
  const bool negative = std::any_of(signs.begin(), signs.end(), [](int s) { return s < 0; });
  return positive != negative;
}

/// Whether the origin is in the hull of nine points: by Caratheodory's theorem in a simplex of
/// theirs, whose barycentric coordinates are determinants.
class OriginInHull {
 public:
  explicit OriginInHull(const std::array<Vec<Integer>, 9>& points) : d_(points) {}

  bool holds() const {
    bool spansSpace = false;
    std::array<std::array<std::array<signed char, 9>, 9>, 9> det{};
    for (int i = 0; i < 9; ++i) {
      for (int j = i + 1; j < 9; ++j) {
        const Vec<Integer> cross = d_[i].cross(d_[j]);
        for (int k = j + 1; k < 9; ++k) {
          det[i][j][k] = static_cast<signed char>(signOf(cross.dot(d_[k])));
          spansSpace |= det[i][j][k] != 0;
        }
      }
    }
    if (!spansSpace) return holdsInPlane();
    for (int i = 0; i < 9; ++i)
      for (int j = i + 1; j < 9; ++j)
        for (int k = j + 1; k < 9; ++k)
          for (int l = k + 1; l < 9; ++l) {
            if (agree<4>({det[j][k][l], -det[i][k][l], det[i][j][l], -det[i][j][k]})) return true;
          }
    return false;
  }

 private:
  static Integer component(const Vec<Integer>& v, int i) {
    return i == 0 ? v.x : (i == 1 ? v.y : v.z);
  }

  /// All points are on one plane through the origin: looked at along an axis not in that plane.
  bool holdsInPlane() const {
    for (int axis = 0; axis < 3; ++axis) {
      std::array<std::array<int, 9>, 9> det{};
      bool spansPlane = false;
      for (int i = 0; i < 9; ++i) {
        for (int j = i + 1; j < 9; ++j) {
          det[i][j] = signOf(component(d_[i].cross(d_[j]), axis));
          spansPlane |= det[i][j] != 0;
        }
      }
      if (!spansPlane) continue;
      for (int i = 0; i < 9; ++i)
        for (int j = i + 1; j < 9; ++j)
          for (int k = j + 1; k < 9; ++k) {
            if (agree<3>({det[j][k], -det[i][k], det[i][j]})) return true;
          }
      return false;
    }
    return holdsOnLine();
  }

  bool holdsOnLine() const {
    for (int axis = 0; axis < 3; ++axis) {
      bool positive = false;
      bool negative = false;
      bool zero = false;
      for (const Vec<Integer>& v : d_) {
        const int sign = signOf(component(v, axis));
        positive |= sign > 0;
        negative |= sign < 0;
        zero |= sign == 0;
      }
      if (positive || negative) return zero || (positive && negative);
    }
    return true;  // all are the origin
  }

  std::array<Vec<Integer>, 9> d_;
};

/// Exact for coordinates within some 400 binary places of each other.
inline bool touch(const TriangleCorners& a, const TriangleCorners& b) {
  const int shift = -std::min(leastExponent(a), leastExponent(b));
  const auto corner = [shift](const Eigen::Vector3d& v) {
    return Vec<Integer>{toInteger(v.x(), shift), toInteger(v.y(), shift), toInteger(v.z(), shift)};
  };
  std::array<Vec<Integer>, 9> differences;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) differences[3 * i + j] = corner(b[j]) - corner(a[i]);
  }
  return OriginInHull(differences).holds();
}

inline Vec<Real> real(const Eigen::Vector3d& v) {
  return {Real(v.x()), Real(v.y()), Real(v.z())};
}

inline Real clampToUnit(const Real& t) {
  return t < 0 ? Real(0) : (t > 1 ? Real(1) : t);
}

inline Real pointSegment(const Vec<Real>& p, const Vec<Real>& a, const Vec<Real>& b) {
  const Vec<Real> d = b - a;
  const Real length = d.dot(d);
  const Real t = length > 0 ? clampToUnit((p - a).dot(d) / length) : Real(0);
  const Vec<Real> v = a + d * t - p;
  return v.dot(v);
}

inline Real segmentSegment(const Vec<Real>& a, const Vec<Real>& b, const Vec<Real>& c,
                           const Vec<Real>& d) {
  Real best = std::min(
      {pointSegment(a, c, d), pointSegment(b, c, d), pointSegment(c, a, b), pointSegment(d, a, b)});
  const Vec<Real> u = b - a;
  const Vec<Real> v = d - c;
  const Vec<Real> n = u.cross(v);
  const Real n2 = n.dot(n);
  if (n2 > 0) {
    const Vec<Real> w = c - a;
    const Real s = w.cross(v).dot(n) / n2;
    const Real t = w.cross(u).dot(n) / n2;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) best = std::min(best, Real(w.dot(n) * w.dot(n) / n2));
  }
  return best;
}

/// Squared distance to the plane of the triangle where the foot is inside, else `best`.
inline Real pointFace(const Vec<Real>& p, const std::array<Vec<Real>, 3>& t, const Real& best) {
  const Vec<Real> n = (t[1] - t[0]).cross(t[2] - t[0]);
  const Real n2 = n.dot(n);
  if (n2 <= 0) return best;
  for (int i = 0; i < 3; ++i) {
    if (n.cross(t[(i + 1) % 3] - t[i]).dot(p - t[i]) < 0) return best;
  }
  const Real h = n.dot(p - t[0]);
  return std::min(best, Real(h * h / n2));
}

/// Of triangles that do not touch.
inline Real distance(const TriangleCorners& a, const TriangleCorners& b) {
  const std::array<Vec<Real>, 3> p{real(a[0]), real(a[1]), real(a[2])};
  const std::array<Vec<Real>, 3> q{real(b[0]), real(b[1]), real(b[2])};
  Real best = segmentSegment(p[0], p[1], q[0], q[1]);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      best = std::min(best, segmentSegment(p[i], p[(i + 1) % 3], q[j], q[(j + 1) % 3]));
    }
    best = pointFace(p[i], q, best);
    best = pointFace(q[i], p, best);
  }
  return sqrt(best);
}

}  // namespace oracle
