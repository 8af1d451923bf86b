// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/exact_sign.hpp"
#include "narrowphase/triangle_features.hpp"
#include "swept/core/floating_point_environment.hpp"
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

/// How a triangle passes through the prism over another one, the face. Heights are along the face's
/// normal.
struct Passage {
  Vector3d normal = Vector3d::Zero();  ///< unit
  bool ofFirst = true;                 ///< the first triangle passes over the second one's face
  double least = 0.0;
  double most = 0.0;
  Vector3d lowest = Vector3d::Zero();
  Vector3d highest = Vector3d::Zero();
  Vector3d middle = Vector3d::Zero();  ///< of what lies in the face's plane
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

/// The normal of the passage is known. False if rounding finds nothing of the triangle over the
/// face.
bool passThrough(const Corners& triangle, const Corners& face, const Corners& faceEdges,
                 Passage& passage) {
  const Vector3d& normal = passage.normal;
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
  passage.middle = middleAtZero(polygon, height);
  return true;
}

/// All in the frame and unit of a TrianglePair.
struct Candidate {
  double depth = std::numeric_limits<double>::infinity();
  Vector3d p = Vector3d::Zero();
  Vector3d q = Vector3d::Zero();
  Vector3d normal = Vector3d::Zero();
};

void keepShallower(Candidate& best, const Candidate& other) {
  if (other.depth < best.depth) best = other;
}

/// Squared sine of the angle between two edges above which their rounded cross product is good to a
/// few ulps.
constexpr double kWellShaped = 0.3;

/// The normal oriented by the edges, if the triangle has an area: this is decided exactly, since
/// the direction of a rounded normal says nothing for a triangle that is a segment.
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

/// A unit vector orthogonal to both triangles' longest edges: the normal for segments and points.
Vector3d acrossBoth(const TrianglePair& pair) {
  const Vector3d e = longest(pair.e);
  const Vector3d f = longest(pair.f);
  const Vector3d n = detail::perpendicular(e, f);
  if (n.norm() > 1e-12 * e.norm() * f.norm()) return n.normalized();
  const Vector3d direction = e.squaredNorm() >= f.squaredNorm() ? e : f;
  return direction.squaredNorm() > 0.0 ? direction.unitOrthogonal() : Vector3d::UnitX();
}

/// Distance of a point from being common to both.
double offBoth(const TrianglePair& pair, const Vector3d& x) {
  return std::max((x - detail::nearestOnTriangle(x, pair.p, pair.e)).norm(),
                  (x - detail::nearestOnTriangle(x, pair.q, pair.f)).norm());
}

/// Relative to the size: a common point is off by at most this, from roundings.
constexpr double kCommon = 1e-15;

/// The triangles' common point: `middle` of the first passage that is a common point up to
/// rounding, or else the best one. If they meet in a corner or an edge, rounding may drop it from
/// the part over a face.
Vector3d commonPoint(const TrianglePair& pair, const Passage* passages, int count) {
  Vector3d best = Vector3d::Zero();
  double least = std::numeric_limits<double>::infinity();
  const auto isGood = [&](const Vector3d& point) {
    const double off = offBoth(pair, point);
    if (off < least) {
      least = off;
      best = point;
    }
    return least <= kCommon * pair.size;
  };
  for (int i = 0; i < count; ++i)
    if (isGood(passages[i].middle)) return best;
  const PointPair nearest = detail::nearestFeatures(pair);
  if (!isGood(nearest.p)) isGood(nearest.q);
  return best;
}

/// In either direction along the normal. If a passage keeps to one side, rounding has lost the
/// place where it touches the face.
void keepShallower(Candidate& best, const Passage& passage, const Vector3d& common) {
  const auto consider = [&](double height, const Vector3d& extreme, double up) {
    const double depth = up * height + 0.0;  // not -0
    const Vector3d onFace = extreme - height * passage.normal;
    // The face's triangle moves along the normal to let the other one out.
    const Vector3d normal = (passage.ofFirst ? up : -up) * passage.normal;
    if (!(depth >= 0.0))
      keepShallower(best, {0.0, common, common, normal});
    else if (passage.ofFirst)
      keepShallower(best, {depth, extreme, onFace, normal});
    else
      keepShallower(best, {depth, onFace, extreme, normal});
  };
  consider(passage.least, passage.lowest, -1.0);
  consider(passage.most, passage.highest, 1.0);
}

}  // namespace

TriangleContact triangleContact(const TriangleCorners& a, const TriangleCorners& b) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return triangleContact(a, b); });
  }
  const TrianglePair pair(a, b);
  if (!std::isfinite(pair.size)) return {a[0], a[0], a[0], Vector3d::UnitX(), 0.0};
  std::array<Passage, 2> passages;
  int count = 0;
  if (unitNormal(b, pair.f, passages[count].normal) &&
      passThrough(pair.p, pair.q, pair.f, passages[count])) {
    passages[count++].ofFirst = true;
  }
  if (unitNormal(a, pair.e, passages[count].normal) &&
      passThrough(pair.q, pair.p, pair.e, passages[count])) {
    passages[count++].ofFirst = false;
  }
  const Vector3d common = commonPoint(pair, passages.data(), count);
  Candidate best;
  for (int i = 0; i < count; ++i) keepShallower(best, passages[i], common);
  if (count == 0) best = {0.0, common, common, acrossBoth(pair)};
  const double metres = 1.0 / pair.scale;
  return {a[0] + metres * best.p, a[0] + metres * best.q, a[0] + metres * common, best.normal,
          metres * best.depth};
}

}  // namespace swept
