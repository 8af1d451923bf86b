// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/exact_sign.hpp"
#include "narrowphase/triangle_features.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {

namespace {

using detail::PointPair;
using detail::TrianglePair;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;

/// A convex polygon cut out of a triangle by up to three half-spaces: each adds at most one corner.
class Polygon {
 public:
  explicit Polygon(const Corners& corners) {
    std::copy(corners.begin(), corners.end(), points_.begin());
  }

  int size() const { return size_; }
  const Vector3d& operator[](int i) const { return points_[i]; }

  /// Keeps what has inward . (x - on) >= 0.
  void cut(const Vector3d& on, const Vector3d& inward) {
    std::array<double, kMost> height;
    bool whole = true;
    for (int i = 0; i < size_; ++i) {
      height[i] = inward.dot(points_[i] - on);
      whole = whole && height[i] >= 0.0;
    }
    if (whole) return;
    std::array<Vector3d, kMost> kept;
    int count = 0;
    for (int i = 0; i < size_; ++i) {
      const int next = i + 1 == size_ ? 0 : i + 1;
      const double hx = height[i];
      const double hy = height[next];
      if (hx >= 0.0 && count < kMost) kept[count++] = points_[i];
      // Rounding alone could make a polygon cross a plane more than twice.
      const bool crosses = (hx > 0.0 && hy < 0.0) || (hx < 0.0 && hy > 0.0);
      if (crosses && count < kMost) {
        kept[count++] = points_[i] + (hx / (hx - hy)) * (points_[next] - points_[i]);
      }
    }
    std::copy_n(kept.begin(), count, points_.begin());
    size_ = count;
  }

 private:
  static constexpr int kMost = 8;
  std::array<Vector3d, kMost> points_;
  int size_ = 3;
};

/// How a triangle passes through the prism over another one, the face: heights are along its unit
/// normal.
struct Passage {
  double least = 0.0;
  double most = 0.0;
  Vector3d lowest = Vector3d::Zero();
  Vector3d highest = Vector3d::Zero();
  Vector3d common = Vector3d::Zero();  ///< middle of what lies in the face's plane
};

/// Middle of the part of a polygon at height 0: of the points where its border passes that height,
/// or else of the corners nearest to it.
Vector3d middleAtZero(const Polygon& polygon, const std::array<double, 8>& height) {
  Vector3d sum = Vector3d::Zero();
  int count = 0;
  double nearest = std::numeric_limits<double>::infinity();
  Vector3d fallback = polygon[0];
  for (int i = 0; i < polygon.size(); ++i) {
    const int j = (i + 1) % polygon.size();
    if (std::abs(height[i]) < nearest) {
      nearest = std::abs(height[i]);
      fallback = polygon[i];
    }
    if (height[i] == 0.0) {
      sum += polygon[i];
      ++count;
    } else if ((height[i] > 0.0 && height[j] < 0.0) || (height[i] < 0.0 && height[j] > 0.0)) {
      sum += polygon[i] + (height[i] / (height[i] - height[j])) * (polygon[j] - polygon[i]);
      ++count;
    }
  }
  return count > 0 ? Vector3d(sum / count) : fallback;
}

/// False if rounding finds nothing of the triangle over the face.
bool passThrough(const Corners& triangle, const Corners& face, const Corners& faceEdges,
                 const Vector3d& normal, Passage& passage) {
  Polygon polygon(triangle);
  for (int j = 0; j < 3; ++j) {
    polygon.cut(face[j], normal.cross(faceEdges[j]));
    if (polygon.size() == 0) return false;
  }
  std::array<double, 8> height;
  passage.least = std::numeric_limits<double>::infinity();
  passage.most = -passage.least;
  for (int i = 0; i < polygon.size(); ++i) {
    height[i] = normal.dot(polygon[i] - face[0]);
    if (height[i] < passage.least) {
      passage.least = height[i];
      passage.lowest = polygon[i];
    }
    if (height[i] > passage.most) {
      passage.most = height[i];
      passage.highest = polygon[i];
    }
  }
  passage.common = middleAtZero(polygon, height);
  return true;
}

/// In the frame and unit of a TrianglePair.
struct Candidate {
  double depth = std::numeric_limits<double>::infinity();
  Vector3d p = Vector3d::Zero();
  Vector3d q = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();
};

void keepShallower(Candidate& best, double depth, const Vector3d& p, const Vector3d& q,
                   const Vector3d& normal) {
  depth = std::max(depth, 0.0);
  if (depth < best.depth) best = {depth, p, q, normal};
}

/// Squared sine of the angle between two edges above which their rounded cross product is good to a
/// few ulps.
constexpr double kWellShaped = 0.3;

/// The normal oriented by the edges, where the triangle has an area: exactly, since the direction
/// of a rounded normal says nothing about a triangle that is a segment.
bool unitNormal(const TriangleCorners& t, const Corners& edges, Vector3d& normal) {
  const Vector3d plain = edges[0].cross(edges[1]);
  const double squared = plain.squaredNorm();
  if (squared > kWellShaped * edges[0].squaredNorm() * edges[1].squaredNorm()) {
    normal = plain / std::sqrt(squared);
    return true;
  }
  using detail::sideOfLine;
  bool area = false;
  for (int i = 0; i < 3 && !area; ++i) area = sideOfLine(t[0], t[1], t[2], i, (i + 1) % 3) != 0;
  const Vector3d n = detail::faceNormal(edges);
  const double length = n.norm();
  if (!area || !(length > 0.0)) return false;
  normal = n / length;
  return true;
}

Vector3d longest(const Corners& edges) {
  return *std::max_element(edges.begin(), edges.end(), [](const Vector3d& x, const Vector3d& y) {
    return x.squaredNorm() < y.squaredNorm();
  });
}

/// A unit vector across both triangles' longest edges: what segments and points have for a normal.
Vector3d acrossBoth(const TrianglePair& pair) {
  const Vector3d e = longest(pair.e);
  const Vector3d f = longest(pair.f);
  const Vector3d n = detail::perpendicular(e, f);
  if (n.norm() > 1e-12 * e.norm() * f.norm()) return n.normalized();
  const Vector3d direction = e.squaredNorm() >= f.squaredNorm() ? e : f;
  return direction.squaredNorm() > 0.0 ? direction.unitOrthogonal() : Vector3d::UnitX();
}

}  // namespace

TriangleContact triangleContact(const TriangleCorners& a, const TriangleCorners& b) {
  const TrianglePair pair(a, b);
  if (!std::isfinite(pair.size)) return {a[0], a[0], a[0], Vector3d::UnitX(), 0.0};
  Candidate best;
  Vector3d common = Vector3d::Zero();
  Passage passage;
  Vector3d normal;
  if (unitNormal(b, pair.f, normal)) {
    if (passThrough(pair.p, pair.q, pair.f, normal, passage)) {
      common = passage.common;
      const Vector3d rise = passage.least * normal;
      keepShallower(best, -passage.least, passage.lowest, passage.lowest - rise, -normal);
      const Vector3d drop = passage.most * normal;
      keepShallower(best, passage.most, passage.highest, passage.highest - drop, normal);
    }
  }
  if (unitNormal(a, pair.e, normal)) {
    if (passThrough(pair.q, pair.p, pair.e, normal, passage)) {
      if (!std::isfinite(best.depth)) common = passage.common;
      const Vector3d rise = passage.least * normal;
      keepShallower(best, -passage.least, passage.lowest - rise, passage.lowest, normal);
      const Vector3d drop = passage.most * normal;
      keepShallower(best, passage.most, passage.highest - drop, passage.highest, -normal);
    }
  }
  if (!std::isfinite(best.depth)) {
    const PointPair nearest = detail::nearestFeatures(pair);
    common = 0.5 * (nearest.p + nearest.q);
    best = {0.0, nearest.p, nearest.q, acrossBoth(pair)};
  }
  const double metres = 1.0 / pair.scale;
  return {a[0] + metres * best.p, a[0] + metres * best.q, a[0] + metres * common, best.normal,
          metres * best.depth};
}

}  // namespace swept
