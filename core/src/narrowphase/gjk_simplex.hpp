// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/simplex.hpp"
#include "narrowphase/newton.hpp"

namespace swept::detail {

/// The simplex of a descent of GJK: up to four points of the difference B - A, the newest last,
/// with A's part of each.
///
/// The newest vertex lies beyond the others towards the origin, so the nearest feature contains it,
/// and only features with it are examined. If rounding breaks that premise, the point found is no
/// nearer than the last one, or nearer than proven. The caller sees that and calls
/// reducedCarefully().
///
/// Directions are multiples of the nearest point, of any length: the next support point needs no
/// square root and no division.
class GjkSimplex {
 public:
  using Vector3d = Eigen::Vector3d;

  /// The nearest feature once the point at the end is added.
  struct Step {
    Vector3d direction;          ///< to the nearest point, of any length
    std::array<int, 4> index{};  ///< vertices kept, ascending
    int size = 0;                ///< 4: the origin is inside
    double squared = 0.0;        ///< m^2, of the distance; only if asked for
  };

  int size() const { return size_; }
  bool contains(const Vector3d& w) const {
    for (int i = 0; i < size_; ++i) {
      if (p_[i] == w) return true;
    }
    return false;
  }
  /// Stores a point behind the simplex, where step() sees it and take() may keep it.
  void propose(const Vector3d& difference, const Vector3d& onA) {
    p_[size_] = difference;
    onA_[size_] = onA;
  }

  template <bool withDistance>
  Step step() const {
    switch (size_) {
      case 0:
        return vertex<withDistance>(0);
      case 1:
        return edge<withDistance>(0, 1);
      case 2:
        return triangle<withDistance>(0, 1, 2, (p_[0] - p_[2]).cross(p_[1] - p_[2]));
      default:
        return tetrahedron<withDistance>();
    }
  }

  void take(const Step& step) {
    size_ = step.size;
    for (int i = 0; i < size_; ++i) {
      const int from = step.index[i];
      if (from == i) continue;
      p_[i] = p_[from];
      onA_[i] = onA_[from];
    }
  }

  /// The first `count` points with the weights of the nearest point; every feature is examined.
  Simplex reducedCarefully(int count) const {
    Simplex simplex;
    simplex.size = count;
    for (int i = 0; i < count; ++i) simplex.vertices[i] = {p_[i], onA_[i], onA_[i] + p_[i], 0.0};
    simplex.reduceToNearest();
    return simplex;
  }
  void take(const Simplex& simplex) {
    size_ = simplex.size;
    for (int i = 0; i < size_; ++i) {
      p_[i] = simplex.vertices[i].difference;
      onA_[i] = simplex.vertices[i].a;
    }
  }

  /// The direction from the origin to the nearest feature of a taken simplex: of any length, and
  /// orthogonal to the feature to the last digit if the feature is near.
  Vector3d across(const Vector3d& nearest) const {
    if (size_ == 2) {
      const Vector3d edge = p_[0] - p_[1];
      return nearest - (nearest.dot(edge) / edge.squaredNorm()) * edge;
    }
    if (size_ != 3) return nearest;
    // The two shortest edges give the normal the most digits.
    std::array<Vector3d, 3> edge;
    int longest = 0;
    for (int i = 0; i < 3; ++i) {
      edge[i] = p_[(i + 1) % 3] - p_[i];
      if (edge[i].squaredNorm() > edge[longest].squaredNorm()) longest = i;
    }
    const Vector3d normal = edge[(longest + 1) % 3].cross(edge[(longest + 2) % 3]);
    const double height = normal.dot(p_[0]);
    if (height == 0.0) return nearest;
    return height < 0.0 ? Vector3d(-normal) : normal;
  }

  /// The different points of either body in the simplex, each in the body's own frame.
  std::array<Spots, 2> spots(const Eigen::Matrix3d& rotation, const Vector3d& offset) const {
    constexpr double kSame = 1e-9;  // relative: points of b come with the rounding of a sum
    std::array<Spots, 2> spots;
    for (int i = 0; i < size_; ++i) {
      const Vector3d onB = onA_[i] + p_[i];
      const double least = kSame * std::sqrt(onA_[i].squaredNorm() + onB.squaredNorm());
      spots[0].note(onA_[i], least);
      spots[1].note(rotation.transpose() * (onB - offset), least);
    }
    return spots;
  }

  /// As it stands, with the weights of the nearest point; not empty.
  Simplex weighted() const {
    Simplex simplex;
    simplex.size = size_;
    std::array<double, 4> weight{1.0, 0.0, 0.0, 0.0};
    if (size_ == 2) {
      const Vector3d e = p_[1] - p_[0];
      const double t = -p_[0].dot(e) / e.squaredNorm();
      weight = {1.0 - t, t, 0.0, 0.0};
    } else if (size_ >= 3) {
      spread(weight);
    }
    for (int i = 0; i < size_; ++i) {
      simplex.vertices[i] = {p_[i], onA_[i], onA_[i] + p_[i], weight[i]};
    }
    return simplex;
  }

  /// Whether the four vertices are proven to contain the origin: each volume with the origin is
  /// certainly a share of the whole.
  ///
  /// Lemma: of coordinates up to `magnitude`, an edge's rounds by 2 ulps of it, a cross product's
  /// component is at most 8 m^2 and off by 40 ulps, and so a volume by less than 500 ulps of m^3.
  bool enclosesOrigin(double magnitude) const {
    constexpr double kTetrahedronRounding = 1e-13;
    const Vector3d e0 = p_[0] - p_[3];
    const Vector3d e1 = p_[1] - p_[3];
    const Vector3d e2 = p_[2] - p_[3];
    const Vector3d n01 = e0.cross(e1);
    const double volume = n01.dot(e2);
    const double sign = std::copysign(1.0, volume);
    const double v01 = -sign * n01.dot(p_[3]);
    const double v12 = -sign * e1.cross(e2).dot(p_[3]);
    const double v20 = -sign * e2.cross(e0).dot(p_[3]);
    const double left = sign * volume - (v01 + v12 + v20);
    return std::min(std::min(v01, v12), std::min(v20, left)) >
           kTetrahedronRounding * magnitude * magnitude * magnitude;
  }

 private:
  /// Areas or volumes opposite the vertices, as shares of their sum.
  void spread(std::array<double, 4>& weight) const {
    if (size_ == 3) {
      const Vector3d normal = (p_[0] - p_[2]).cross(p_[1] - p_[2]);
      for (int i = 0; i < 3; ++i) {
        weight[i] = normal.dot(p_[(i + 1) % 3].cross(p_[(i + 2) % 3]));
      }
    } else {
      for (int i = 0; i < 4; ++i) {
        weight[i] = std::abs(p_[(i + 1) % 4].dot(p_[(i + 2) % 4].cross(p_[(i + 3) % 4])));
      }
    }
    const double sum = weight[0] + weight[1] + weight[2] + weight[3];
    for (double& w : weight) w /= sum;
  }

  template <bool withDistance>
  Step vertex(int i) const {
    Step step;
    step.direction = p_[i];
    step.index[0] = i;
    step.size = 1;
    if constexpr (withDistance) step.squared = p_[i].squaredNorm();
    return step;
  }

  /// The foot on a near edge has lost digits along it to cancellation, and the distance is worth
  /// the correction.
  template <bool withDistance>
  Step edge(int i, int newest) const {
    const Vector3d e = p_[i] - p_[newest];
    const double along = -p_[newest].dot(e);
    const double length = e.squaredNorm();
    if (!(along > 0.0)) return vertex<withDistance>(newest);
    if (!(along < length)) return vertex<withDistance>(i);
    Step step;
    step.direction = length * p_[newest] + along * e;
    step.index[0] = i;
    step.index[1] = newest;
    step.size = 2;
    if constexpr (withDistance) {
      step.direction -= (step.direction.dot(e) / length) * e;
      step.squared = step.direction.squaredNorm() / (length * length);
    }
    return step;
  }

  /// `normal` is that of the triangle, of any length. The nearest point inside is the origin's foot
  /// on the plane: near contact its direction, along the normal, keeps the digits that a weighted
  /// sum of corners loses.
  template <bool withDistance>
  Step triangle(int i, int j, int newest, const Vector3d& normal) const {
    const Vector3d across = normal.cross(p_[newest]);
    const double areaJ = across.dot(p_[i]);
    const double areaI = -across.dot(p_[j]);
    if (areaI > 0.0 && areaJ > 0.0) {
      Step step;
      const double height = normal.dot(p_[newest]);
      step.direction = height < 0.0 ? Vector3d(-normal) : normal;
      step.index = {i, j, newest, 0};
      step.size = 3;
      if constexpr (withDistance) step.squared = height * height / normal.squaredNorm();
      return step;
    }
    if (areaI > 0.0) return edge<withDistance>(i, newest);
    if (areaJ > 0.0) return edge<withDistance>(j, newest);
    const Step one = edge<true>(i, newest);
    const Step other = edge<true>(j, newest);
    return other.squared < one.squared ? other : one;
  }

  /// The origin is inside when it is on the same side of each face as the opposite corner. The face
  /// without the newest corner was the last nearest feature, with the newest beyond it.
  template <bool withDistance>
  Step tetrahedron() const {
    const Vector3d e0 = p_[0] - p_[3];
    const Vector3d e1 = p_[1] - p_[3];
    const Vector3d e2 = p_[2] - p_[3];
    const Vector3d n01 = e0.cross(e1);
    const Vector3d n12 = e1.cross(e2);
    const Vector3d n02 = e0.cross(e2);
    const double volume = n01.dot(e2);
    const double h01 = -n01.dot(p_[3]) * volume;
    const double h12 = -n12.dot(p_[3]) * volume;
    const double h02 = n02.dot(p_[3]) * volume;
    const int outside = (h01 > 0.0 ? 0 : 1) + (h12 > 0.0 ? 0 : 2) + (h02 > 0.0 ? 0 : 4);
    switch (outside) {
      case 0: {
        Step step;
        step.size = 4;
        step.index = {0, 1, 2, 3};
        step.direction.setZero();
        return step;
      }
      case 1:
        return triangle<withDistance>(0, 1, 3, n01);
      case 2:
        return triangle<withDistance>(1, 2, 3, n12);
      case 4:
        return triangle<withDistance>(0, 2, 3, n02);
      default:
        break;
    }
    Step best;
    best.squared = std::numeric_limits<double>::infinity();
    const auto consider = [&best](const Step& step) {
      if (step.squared < best.squared) best = step;
    };
    if (outside & 1) consider(triangle<true>(0, 1, 3, n01));
    if (outside & 2) consider(triangle<true>(1, 2, 3, n12));
    if (outside & 4) consider(triangle<true>(0, 2, 3, n02));
    return best;
  }

  std::array<Vector3d, 4> p_;
  std::array<Vector3d, 4> onA_;
  int size_ = 0;
};

}  // namespace swept::detail
