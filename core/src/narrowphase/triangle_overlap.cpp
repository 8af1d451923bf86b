// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "narrowphase/exact_sign.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/triangle_pair.hpp"

namespace swept {

namespace {

using detail::FilteredSign;
using detail::sideOfLine;
using detail::sideOfPlane;
using Eigen::Vector3d;
using Signs = std::array<int, 3>;

/// Heights of a triangle's corners over the plane of another one, times twice its area.
struct Heights {
  std::array<double, 3> value;
  double rounding;
};

Heights heightsOver(const TriangleCorners& plane, const TriangleCorners& corners) {
  const Vector3d first = plane[1] - plane[0];
  const Vector3d second = plane[2] - plane[0];
  const Vector3d normal = first.cross(second);
  Heights heights;
  double reach = 0.0;
  for (int i = 0; i < 3; ++i) {
    const Vector3d offset = corners[i] - plane[0];
    heights.value[i] = normal.dot(offset);
    reach = std::max(reach, detail::largestComponent(offset));
  }
  heights.rounding = detail::heightRounding(detail::largestComponent(first),
                                            detail::largestComponent(second), reach);
  return heights;
}

/// All three proven to lie strictly on one side. A corner at NaN or infinity is on no side.
bool clearsPlane(const Heights& heights) {
  const auto& [x, y, z] = heights.value;
  const double least = heights.rounding;
  constexpr double kOverflow = std::numeric_limits<double>::infinity();
  const bool above = x > least && y > least && z > least && x + y + z < kOverflow;
  const bool below = x < -least && y < -least && z < -least && x + y + z > -kOverflow;
  return above || below;
}

/// False if a sign is not proven.
bool filteredSigns(const Heights& heights, Signs& signs) {
  for (int i = 0; i < 3; ++i) {
    const FilteredSign sign = detail::filteredSign(heights.value[i], heights.rounding);
    if (sign == FilteredSign::Unknown) return false;
    signs[i] = static_cast<int>(sign);
  }
  return true;
}

bool strictlyOneSide(const Signs& s) {
  return s[0] != 0 && s[0] == s[1] && s[0] == s[2];
}

bool allZero(const Signs& s) {
  return s[0] == 0 && s[1] == 0 && s[2] == 0;
}

/// A triangle seen from the corner that the other one's plane separates from the other two.
struct Wedge {
  const Vector3d* apex;
  const Vector3d* next;
  const Vector3d* last;
  int side;  ///< side * sign is >= 0 at the apex and <= 0 at the others, and not all are 0
};

/// For corners that are neither all on one side nor all on the plane.
Wedge wedge(const TriangleCorners& corners, const Signs& signs) {
  const auto positive = std::count(signs.begin(), signs.end(), 1);
  const auto negative = std::count(signs.begin(), signs.end(), -1);
  int alone = 0;
  int side = -1;
  if (positive == 1) {
    alone = 1;
    side = 1;
  } else if (negative == 1) {
    alone = -1;
  } else if (negative == 2) {
    side = 1;
  }
  const int i = static_cast<int>(std::find(signs.begin(), signs.end(), alone) - signs.begin());
  return {&corners[i], &corners[(i + 1) % 3], &corners[(i + 2) % 3], side};
}

/// Turns two wedges so that along the line of their planes, directed suitably, the edges
/// (apex, next) meet it no later than the edges (apex, last).
///
/// Where the edge (apex1, x) meets the line at i and the edge (apex2, y) meets it at k,
/// det(x - apex1, apex2 - apex1, y - apex1) is a positive multiple of (k - i) . direction, with
/// direction = (normal of plane 1 towards apex2) x (normal of plane 2 towards apex1). So two of
/// these signs tell whether the intervals that the triangles cut out of the line share a point,
/// corners that lie on the other plane included.
void alignAlongLine(Wedge& first, Wedge& second) {
  const int sideOfFirst = first.side;
  if (second.side > 0) std::swap(first.next, first.last);
  if (sideOfFirst < 0) std::swap(second.next, second.last);
}

// The following decides every pair, given coordinates in the exact range. Triangles in one plane
// and triangles without an area rely on this: at least one of the three projections along a
// coordinate axis maps a set of points in one plane, and any subset of it, one to one. So two
// coplanar figures share a point if and only if their projections do in all three.

using Point = const Vector3d&;

bool boxesOverlap(double a, double b, double c, double d) {
  return std::max(a, b) >= std::min(c, d) && std::max(c, d) >= std::min(a, b);
}

bool projectedSegmentsTouch(Point a, Point b, Point c, Point d, int i, int j) {
  return boxesOverlap(a[i], b[i], c[i], d[i]) && boxesOverlap(a[j], b[j], c[j], d[j]) &&
         sideOfLine(a, b, c, i, j) * sideOfLine(a, b, d, i, j) <= 0 &&
         sideOfLine(c, d, a, i, j) * sideOfLine(c, d, b, i, j) <= 0;
}

/// In three dimensions.
bool segmentsTouch(Point a, Point b, Point c, Point d) {
  return projectedSegmentsTouch(a, b, c, d, 0, 1) && projectedSegmentsTouch(a, b, c, d, 1, 2) &&
         projectedSegmentsTouch(a, b, c, d, 2, 0) && sideOfPlane(a, b, c, d) == 0;
}

/// Signs alone do not show where on its line a triangle without an area ends: its box does.
bool projectedTriangleHolds(const TriangleCorners& t, Point p, int i, int j) {
  for (const int axis : {i, j}) {
    const auto [least, most] = std::minmax({t[0][axis], t[1][axis], t[2][axis]});
    if (p[axis] < least || p[axis] > most) return false;
  }
  const int first = sideOfLine(t[0], t[1], p, i, j);
  const int second = sideOfLine(t[1], t[2], p, i, j);
  const int third = sideOfLine(t[2], t[0], p, i, j);
  return (first >= 0 && second >= 0 && third >= 0) || (first <= 0 && second <= 0 && third <= 0);
}

bool segmentTouchesTriangle(Point p, Point q, const TriangleCorners& t) {
  const int sideP = sideOfPlane(t[0], t[1], t[2], p);
  const int sideQ = sideOfPlane(t[0], t[1], t[2], q);
  if (sideP * sideQ > 0) return false;
  if (sideP == 0 && sideQ == 0) {
    const bool holds = projectedTriangleHolds(t, p, 0, 1) && projectedTriangleHolds(t, p, 1, 2) &&
                       projectedTriangleHolds(t, p, 2, 0);
    return holds || segmentsTouch(p, q, t[0], t[1]) || segmentsTouch(p, q, t[1], t[2]) ||
           segmentsTouch(p, q, t[2], t[0]);
  }
  const int first = sideOfPlane(p, q, t[0], t[1]);
  const int second = sideOfPlane(p, q, t[1], t[2]);
  const int third = sideOfPlane(p, q, t[2], t[0]);
  return (first >= 0 && second >= 0 && third >= 0) || (first <= 0 && second <= 0 && third <= 0);
}

/// Any two triangles that share a point also share one on an edge, or all of their area if they
/// have none.
bool anyEdgeTouches(const TriangleCorners& a, const TriangleCorners& b) {
  for (int i = 0; i < 3; ++i) {
    if (segmentTouchesTriangle(a[i], a[(i + 1) % 3], b)) return true;
    if (segmentTouchesTriangle(b[i], b[(i + 1) % 3], a)) return true;
  }
  return false;
}

/// In one projection: whether an edge of t keeps all of other strictly outside. `turn` is the
/// orientation of t; a triangle without an area (turn 0) has its outside on both sides.
bool edgeSeparates(const TriangleCorners& t, int turn, const TriangleCorners& other, int i, int j) {
  for (int k = 0; k < 3; ++k) {
    const int side = sideOfLine(t[k], t[(k + 1) % 3], other[0], i, j);
    if (side == 0 || side == turn) continue;
    if (sideOfLine(t[k], t[(k + 1) % 3], other[1], i, j) == side &&
        sideOfLine(t[k], t[(k + 1) % 3], other[2], i, j) == side) {
      return true;
    }
  }
  return false;
}

/// Two triangles with all corners of each in the plane of the other.
bool coplanarTouch(const TriangleCorners& a, const TriangleCorners& b) {
  const Vector3d normal = (a[1] - a[0]).cross(a[2] - a[0]);
  const Vector3d size = normal.cwiseAbs();
  const int axis =
      size.x() >= size.y() ? (size.x() >= size.z() ? 0 : 2) : (size.y() >= size.z() ? 1 : 2);
  const int i = (axis + 1) % 3;
  const int j = (axis + 2) % 3;
  const int turn = sideOfLine(a[0], a[1], a[2], i, j);
  if (turn == 0) return anyEdgeTouches(a, b);  // a may be without an area, the plane unknown
  // a has an area in this projection, so the projection is one to one on the plane, and the sides
  // of the sum of a and -b are those of a and of b.
  const int turnB = sideOfLine(b[0], b[1], b[2], i, j);
  return !edgeSeparates(a, turn, b, i, j) && !edgeSeparates(b, turnB, a, i, j);
}

Signs sidesOf(const TriangleCorners& plane, const TriangleCorners& corners) {
  Signs signs;
  for (int i = 0; i < 3; ++i) signs[i] = sideOfPlane(plane[0], plane[1], plane[2], corners[i]);
  return signs;
}

bool touchExactly(const TriangleCorners& a, const TriangleCorners& b) {
  for (int i = 0; i < 3; ++i) {
    if (!detail::withinExactRange(a[i]) || !detail::withinExactRange(b[i])) return true;
  }
  const Signs signsA = sidesOf(b, a);
  if (strictlyOneSide(signsA)) return false;
  const Signs signsB = sidesOf(a, b);
  if (strictlyOneSide(signsB)) return false;
  if (allZero(signsA) && allZero(signsB)) return coplanarTouch(a, b);
  // For one triangle without an area: a segment against a triangle.
  if (allZero(signsA) || allZero(signsB)) return anyEdgeTouches(a, b);
  Wedge first = wedge(a, signsA);
  Wedge second = wedge(b, signsB);
  alignAlongLine(first, second);
  return sideOfPlane(*first.apex, *first.next, *second.apex, *second.last) >= 0 &&
         sideOfPlane(*first.apex, *first.last, *second.apex, *second.next) <= 0;
}

}  // namespace

bool trianglesTouch(const TriangleCorners& a, const TriangleCorners& b) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return trianglesTouch(a, b); });
  }
  const Heights heightsA = heightsOver(b, a);
  if (clearsPlane(heightsA)) return false;
  const Heights heightsB = heightsOver(a, b);
  if (clearsPlane(heightsB)) return false;
  Signs signsA;
  Signs signsB;
  if (!filteredSigns(heightsA, signsA) || !filteredSigns(heightsB, signsB)) {
    return touchExactly(a, b);
  }
  Wedge first = wedge(a, signsA);
  Wedge second = wedge(b, signsB);
  alignAlongLine(first, second);
  const FilteredSign firstEnds =
      detail::filteredSideOfPlane(*first.apex, *first.next, *second.apex, *second.last);
  if (firstEnds == FilteredSign::Negative) return false;
  const FilteredSign secondEnds =
      detail::filteredSideOfPlane(*first.apex, *first.last, *second.apex, *second.next);
  if (secondEnds == FilteredSign::Positive) return false;
  if (firstEnds == FilteredSign::Unknown || secondEnds == FilteredSign::Unknown) {
    return touchExactly(a, b);
  }
  return true;
}

}  // namespace swept
