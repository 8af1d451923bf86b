// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "narrowphase/core_gap.hpp"

namespace swept::detail {

/// The separating axes of two boxes (Gottschalk, Lin, Manocha 1996): the normals of their faces and
/// the cross products of their edges. Boxes are apart if and only if one of these 15 separates
/// them. If they overlap, the least overlap is the penetration depth.
///
/// Lemma: the columns c_j of the pose are used as they are, orthonormal or not. b is then the
/// parallelepiped that the pose makes of its box, and the edge axes e_i x c_j are exact. Their dot
/// products round relative to their lengths, so a separation divided by that length is off by a few
/// ulps of the coordinates, however nearly parallel the edges.
class BoxAxes {
 public:
  BoxAxes(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b)
      : a_(a.size), b_(b.size), c_(a_from_b.linear()), t_(a_from_b.translation()) {}

  /// Largest separation over the axes, in m, negative if all overlap; `normal` is its unit axis,
  /// from a to b. Stops at a separation above `enough`.
  double largest(double enough, Eigen::Vector3d& normal) {
    for (int i = 0; i < 3; ++i) {
      const double reach = a_[i] + std::abs(c_(i, 0)) * b_[0] + std::abs(c_(i, 1)) * b_[1] +
                           std::abs(c_(i, 2)) * b_[2];
      consider(std::abs(t_[i]) - reach, Kind::FaceA, i);
    }
    if (best_ > enough) return finish(normal);
    for (int j = 0; j < 3; ++j) {
      const Eigen::Vector3d n = c_.col((j + 1) % 3).cross(c_.col((j + 2) % 3));
      const double reach = a_[0] * std::abs(n[0]) + a_[1] * std::abs(n[1]) +
                           a_[2] * std::abs(n[2]) + b_[j] * std::abs(n.dot(c_.col(j)));
      consider((std::abs(n.dot(t_)) - reach) / n.norm(), Kind::FaceB, j);
    }
    if (best_ > enough) return finish(normal);
    edges<0>();
    edges<1>();
    edges<2>();
    return finish(normal);
  }

  /// The deepest points of two boxes that overlap along `normal`, the axis found: a corner under
  /// the other's face, or two crossing edges. False for other placements, such as parallel faces.
  bool deepest(const Eigen::Vector3d& normal, Eigen::Vector3d& onA, Eigen::Vector3d& onB) const {
    const Eigen::Vector3d inB = c_.transpose() * normal;
    const Eigen::Vector3d cornerB = support::box(b_, -inB);
    if (kind_ == Kind::FaceA) {
      onB = c_ * cornerB + t_;
      onA = onB;
      onA[index_] = std::copysign(a_[index_], normal[index_]);
      return ((onA.cwiseAbs() - a_).array() <= 0.0).all();
    }
    const Eigen::Vector3d cornerA = support::box(a_, normal);
    if (kind_ == Kind::FaceB) {
      onA = cornerA;
      Eigen::Vector3d local = c_.transpose() * (onA - t_);
      local[index_] = std::copysign(b_[index_], -inB[index_]);
      onB = c_ * local + t_;
      return ((local.cwiseAbs() - b_).array() <= 0.0).all();
    }
    const int i = index_ / 3;
    const int j = index_ % 3;
    Eigen::Vector3d startA = cornerA;
    Eigen::Vector3d startB = cornerB;
    startA[i] = startB[j] = 0.0;  // the middles of the edges
    const Eigen::Vector3d middle = c_ * startB + t_;
    const Eigen::Vector3d w = middle - startA;
    const double cosine = c_(i, j);
    const double sine = 1.0 - cosine * cosine;  // squared
    const double alongA = w[i];
    const double alongB = w.dot(c_.col(j));
    const double u = (alongA - alongB * cosine) / sine;
    const double v = (alongA * cosine - alongB) / sine;
    onA = startA + u * Eigen::Vector3d::Unit(i);
    onB = middle + v * c_.col(j);
    return std::abs(u) <= a_[i] && std::abs(v) <= b_[j];
  }

 private:
  enum class Kind { FaceA, FaceB, Edges };

  void consider(double separation, Kind kind, int index) {
    if (!(separation > best_)) return;
    best_ = separation;
    kind_ = kind;
    index_ = index;
  }

  /// Edge axes are not unit vectors, but at most kLongest long: most are excluded before their
  /// length is known.
  template <int i>
  void edges() {
    constexpr double kLongest = 1.001;
    constexpr int p = (i + 1) % 3;
    constexpr int q = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const int k = (j + 1) % 3;
      const int l = (j + 2) % 3;
      const double dp = -c_(q, j);
      const double dq = c_(p, j);
      const double separation = std::abs(dp * t_[p] + dq * t_[q]) - a_[p] * std::abs(dp) -
                                a_[q] * std::abs(dq) -
                                b_[k] * std::abs(dp * c_(p, k) + dq * c_(q, k)) -
                                b_[l] * std::abs(dp * c_(p, l) + dq * c_(q, l));
      if (separation < (best_ < 0.0 ? kLongest * best_ : 0.0)) continue;
      const double squared = dp * dp + dq * dq;
      if (!(squared > 1e-280)) continue;
      consider(separation / std::sqrt(squared), Kind::Edges, 3 * i + j);
    }
  }

  double finish(Eigen::Vector3d& normal) const {
    if (kind_ == Kind::FaceA) {
      normal = Eigen::Vector3d::Unit(index_);
    } else if (kind_ == Kind::FaceB) {
      normal = c_.col((index_ + 1) % 3).cross(c_.col((index_ + 2) % 3)).normalized();
    } else {
      normal = Eigen::Vector3d::Unit(index_ / 3).cross(c_.col(index_ % 3)).normalized();
    }
    if (normal.dot(t_) < 0.0) normal = -normal;
    return best_;
  }

  const Eigen::Vector3d& a_;
  const Eigen::Vector3d& b_;
  const Eigen::Matrix3d c_;
  const Eigen::Vector3d t_;
  double best_ = -std::numeric_limits<double>::infinity();
  Kind kind_ = Kind::FaceA;
  int index_ = 0;
};

}  // namespace swept::detail
