// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/newton.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace swept::detail {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kSteps = 5;
/// Cosine of the normal with an edge: beyond it, the edge is not the feature in contact.
constexpr double kAskew = 0.25;

Vector3d ellipsoidBend(const Convex& body, const Vector3d& n, const Vector3d& t) {
  const Vector3d squares = body.size.cwiseProduct(body.size);
  const Vector3d gradient = squares.cwiseProduct(n);
  const double value = std::sqrt(gradient.dot(n));
  if (!(value > 0.0)) return Vector3d::Zero();
  return (squares.cwiseProduct(t) - gradient * (gradient.dot(t) / (value * value))) / value -
         body.inset * t;
}

/// On the rim of a cylinder or of a cone's base.
Vector3d rimBend(const Convex& body, const Vector3d& n, const Vector3d& t) {
  const double across = support::across(n);
  if (!(across > 0.0)) return Vector3d::Zero();
  const double x = -n.y() / across;
  const double y = n.x() / across;
  const double along = (x * t.x() + y * t.y()) * body.size.x() / across;
  return {x * along, y * along, 0.0};
}

/// Second derivatives of the support function at a unit normal, times t: the movement of the
/// support point when the normal changes. Zero at corners.
Vector3d bend(const Convex& body, const Vector3d& n, const Vector3d& t) {
  switch (body.core) {
    case Convex::Core::Ellipsoid:
      return ellipsoidBend(body, n, t);
    case Convex::Core::Cylinder:
      return rimBend(body, n, t);
    case Convex::Core::Cone:
      if (2.0 * body.size.z() * n.z() > body.size.x() * support::across(n)) break;  // the apex
      return rimBend(body, n, t);
    case Convex::Core::Point:
    case Convex::Core::Segment:
    case Convex::Core::Box:
    case Convex::Core::Points:
    case Convex::Core::Plane:
    case Convex::Core::HalfSpace:
      break;
  }
  return Vector3d::Zero();
}

/// A body and the other one in its frame; normals point from the first to the other.
struct Frames {
  const Convex& first;
  const Convex& other;
  const Matrix3d rotation;
  const Vector3d offset;

  Vector3d onOther(const Vector3d& n) const {
    return rotation * other.support(-(rotation.transpose() * n)) + offset;
  }
  Vector3d otherBend(const Vector3d& n, const Vector3d& t) const {
    return rotation * bend(other, -(rotation.transpose() * n), rotation.transpose() * t);
  }
};

/// Filled in the frame of `first`, as if that were a.
bool finish(double separation, const Vector3d& n, const Vector3d& onFirst, const Vector3d& apart,
            double tolerance, CoreGap& gap) {
  const double distance = apart.norm();
  if (!(distance - separation <= tolerance)) return false;
  gap.distance = separation;
  gap.rounding = std::max(0.0, distance - separation);
  gap.normal = n;
  gap.pointA = onFirst;
  gap.pointB = onFirst + apart;
  return true;
}

/// A smooth spot on either body.
bool smooth(const Frames& f, Vector3d n, double tolerance, CoreGap& gap, int& evaluations) {
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSteps; ++i) {
    ++evaluations;
    const Vector3d onFirst = f.first.support(n);
    const Vector3d w = f.onOther(n) - onFirst;
    const double separation = n.dot(w);
    if (finish(separation, n, onFirst, w, tolerance, gap)) return true;
    const double size = w.squaredNorm() - separation * separation;
    if (!(separation > 0.0) || !(size < 0.25 * before)) return false;
    before = size;
    // In a basis of the tangent plane: the support points move by minus the curvatures times the
    // change of n, which itself moves the plane by the separation.
    const Vector3d s =
        (std::abs(n.x()) < 0.6 ? Vector3d(0.0, n.z(), -n.y()) : Vector3d(-n.z(), 0.0, n.x()))
            .normalized();
    const Vector3d t = n.cross(s);
    const Vector3d bentS = bend(f.first, n, s) + f.otherBend(n, s);
    const Vector3d bentT = bend(f.first, n, t) + f.otherBend(n, t);
    const double ss = s.dot(bentS) + separation;
    const double st = s.dot(bentT);
    const double tt = t.dot(bentT) + separation;
    const double determinant = ss * tt - st * st;
    if (!(determinant > 0.0)) return false;
    const double openS = s.dot(w);
    const double openT = t.dot(w);
    n += ((tt * openS - st * openT) / determinant) * s +
         ((ss * openT - st * openS) / determinant) * t;
    n.normalize();
  }
  return false;
}

/// A straight edge in the surface of a body: normals to it keep `lean` along `axis`.
struct Edge {
  Vector3d axis = Vector3d::UnitZ();  ///< unit
  double lean = 0.0;                  ///< sine
  double radius = 0.0;  ///< m, of the circle on which the edge's start runs around the axis
  Vector3d start = Vector3d::Zero();   ///< m, of a polytope's edge
  Vector3d vector = Vector3d::Zero();  ///< m, to its end
};

/// The edge's start and the vector to its end, for the normal `lean * axis + ... * u`.
struct Placed {
  Vector3d start;
  Vector3d vector;
};

bool edgeOfCone(const Vector3d& size, const Vector3d& n, Edge& edge) {
  const double slant = std::sqrt(size.x() * size.x() + 4.0 * size.z() * size.z());
  if (!(slant > 0.0)) return false;
  edge.axis = Vector3d::UnitZ();
  edge.lean = size.x() / slant;
  edge.radius = size.x();
  return std::abs(n.z() - edge.lean) < kAskew;
}

bool edgeOfBox(const Vector3d& n, Edge& edge) {
  int axis = 0;
  const double least = n.cwiseAbs().minCoeff(&axis);
  edge.axis = Vector3d::Unit(axis);
  return least < kAskew;
}

bool edgeOfPoints(const Vector3d& n, const Spots& spots, Edge& edge) {
  double least = kAskew;
  for (int i = 1; i < spots.count; ++i) {
    for (int j = 0; j < i; ++j) {
      const Vector3d axis = (spots.points[i] - spots.points[j]).normalized();
      if (!(std::abs(n.dot(axis)) < least)) continue;
      least = std::abs(n.dot(axis));
      edge = {axis, 0.0, 0.0, spots.points[j], spots.points[i] - spots.points[j]};
    }
  }
  return least < kAskew;
}

bool edgeAt(const Convex& body, const Vector3d& n, const Spots& spots, Edge& edge) {
  switch (body.core) {
    case Convex::Core::Cone:
      return edgeOfCone(body.size, n, edge);
    case Convex::Core::Cylinder:
    case Convex::Core::Segment:
      edge.axis = Vector3d::UnitZ();
      edge.radius = body.size.x();
      return std::abs(n.z()) < kAskew;
    case Convex::Core::Box:
      return edgeOfBox(n, edge);
    case Convex::Core::Points:
      return edgeOfPoints(n, spots, edge);
    case Convex::Core::Point:
    case Convex::Core::Ellipsoid:
    case Convex::Core::Plane:
    case Convex::Core::HalfSpace:
      break;
  }
  return false;
}

/// For a body on which edgeAt() found an edge.
Placed place(const Convex& body, const Edge& edge, const Vector3d& u) {
  const Vector3d& size = body.size;
  switch (body.core) {
    case Convex::Core::Points:
      return {edge.start, edge.vector};
    case Convex::Core::Box:
      return {support::box(size, u - edge.axis), 2.0 * size.cwiseProduct(edge.axis)};
    case Convex::Core::Cone: {
      const Vector3d onRim = size.x() * u - size.z() * edge.axis;
      return {onRim, size.z() * edge.axis - onRim};
    }
    case Convex::Core::Cylinder:
    case Convex::Core::Segment: {
      const Vector3d onRim = size.x() * u - size.z() * edge.axis;
      const Vector3d onOther = size.x() * u + size.z() * edge.axis;
      return {onRim, onOther - onRim};
    }
    case Convex::Core::Point:
    case Convex::Core::Ellipsoid:
    case Convex::Core::Plane:
    case Convex::Core::HalfSpace:
      break;
  }
  return {Vector3d::Zero(), Vector3d::Zero()};
}

/// An edge of `first` and a smooth spot of the other: the normal turns about the edge's axis.
bool edgeAndSpot(const Frames& f, const Vector3d& normal, const Spots& spots, double tolerance,
                 CoreGap& gap, int& evaluations) {
  Edge edge;
  if (!edgeAt(f.first, normal, spots, edge)) return false;
  const double spread = std::sqrt(1.0 - edge.lean * edge.lean);
  Vector3d u = normal - normal.dot(edge.axis) * edge.axis;
  double before = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kSteps; ++i) {
    ++evaluations;
    u.normalize();
    const Vector3d n = spread * u + edge.lean * edge.axis;
    const Placed placed = place(f.first, edge, u);
    const Vector3d w = f.onOther(n) - placed.start;
    const double square = placed.vector.squaredNorm();
    if (square == 0.0) return false;
    const double along = std::clamp(w.dot(placed.vector) / square, 0.0, 1.0);
    const Vector3d onEdge = along * placed.vector;
    const double separation = n.dot(w + placed.start - f.first.support(n));
    if (finish(separation, n, placed.start + onEdge, w - onEdge, tolerance, gap)) return true;
    const Vector3d t = edge.axis.cross(u);
    const double open = t.dot(w);
    if (!(open * open < 0.25 * before)) return false;
    before = open * open;
    const double slope = edge.radius + spread * t.dot(f.otherBend(n, t)) + w.dot(u);
    if (!(slope > 0.0)) return false;
    u += (open / slope) * t;
  }
  return false;
}

/// A face of a polytope and a smooth spot of the other.
bool faceAndSpot(const Frames& f, const Vector3d& normal, const Spots& spots, double tolerance,
                 CoreGap& gap, int& evaluations) {
  if (f.first.core != Convex::Core::Points || spots.count < 3) return false;
  ++evaluations;
  const Vector3d e = spots.points[1] - spots.points[0];
  const Vector3d g = spots.points[2] - spots.points[0];
  Vector3d n = e.cross(g);
  const double area = n.norm();
  if (!(area > 1e-9 * e.norm() * g.norm())) return false;
  n /= n.dot(normal) < 0.0 ? -area : area;
  const Vector3d spot = f.onOther(n);
  const Vector3d w = spot - spots.points[0];
  const Vector3d across = e.cross(g) / (area * area);
  const double x = w.cross(g).dot(across);
  const double y = e.cross(w).dot(across);
  if (x < 0.0 || y < 0.0 || x + y > 1.0) return false;
  const double separation = n.dot(spot - f.first.support(n));
  const Vector3d foot = spots.points[0] + x * e + y * g;
  return finish(separation, n, foot, spot - foot, tolerance, gap);
}

/// Straight edges of fixed direction on both: the normal is across both.
bool edgeAndEdge(const Frames& f, const Vector3d& normal, const std::array<Spots, 2>& spots,
                 double tolerance, CoreGap& gap, int& evaluations) {
  Edge edgeA;
  Edge edgeB;
  const Vector3d normalInB = -(f.rotation.transpose() * normal);
  if (!edgeAt(f.first, normal, spots[0], edgeA) || !edgeAt(f.other, normalInB, spots[1], edgeB) ||
      edgeA.lean != 0.0 || edgeB.lean != 0.0) {
    return false;
  }
  ++evaluations;
  const Vector3d axisB = f.rotation * edgeB.axis;
  Vector3d n = edgeA.axis.cross(axisB);
  const double sine = n.norm();
  if (!(sine > 1e-3)) return false;
  n /= n.dot(normal) < 0.0 ? -sine : sine;
  const Vector3d nInB = -(f.rotation.transpose() * n);
  const Placed a = place(f.first, edgeA, n);
  const Placed b = place(f.other, edgeB, nInB);
  const Vector3d vectorB = f.rotation * b.vector;
  const Vector3d w = f.rotation * b.start + f.offset - a.start;
  // w + y vectorB - x vectorA is across both edges.
  const double aa = a.vector.squaredNorm();
  const double bb = vectorB.squaredNorm();
  const double ab = a.vector.dot(vectorB);
  const double determinant = aa * bb - ab * ab;
  if (!(determinant > 0.0)) return false;
  const double x = (w.dot(a.vector) * bb - w.dot(vectorB) * ab) / determinant;
  const double y = (w.dot(a.vector) * ab - w.dot(vectorB) * aa) / determinant;
  const Vector3d onA = std::clamp(x, 0.0, 1.0) * a.vector;
  const Vector3d apart = w + std::clamp(y, 0.0, 1.0) * vectorB - onA;
  const double separation = n.dot(f.onOther(n) - f.first.support(n));
  return finish(separation, n, a.start + onA, apart, tolerance, gap);
}

}  // namespace

bool newtonGap(const Convex& a, const Convex& b, const Matrix3d& rotation, const Vector3d& offset,
               const Vector3d& normal, const std::array<Spots, 2>& spots, double tolerance,
               CoreGap& gap, int& evaluations) {
  const Frames f{a, b, rotation, offset};
  if (smooth(f, normal, tolerance, gap, evaluations)) return true;
  if (isCurved(b) && (edgeAndSpot(f, normal, spots[0], tolerance, gap, evaluations) ||
                      faceAndSpot(f, normal, spots[0], tolerance, gap, evaluations))) {
    return true;
  }
  if (isCurved(a)) {
    const Frames swapped{b, a, f.rotation.transpose(), -(f.rotation.transpose() * f.offset)};
    const Vector3d inB = -(f.rotation.transpose() * normal);
    if (edgeAndSpot(swapped, inB, spots[1], tolerance, gap, evaluations) ||
        faceAndSpot(swapped, inB, spots[1], tolerance, gap, evaluations)) {
      gap.normal = -(f.rotation * gap.normal);
      std::swap(gap.pointA, gap.pointB);
      gap.pointA = f.rotation * gap.pointA + f.offset;
      gap.pointB = f.rotation * gap.pointB + f.offset;
      return true;
    }
  }
  return edgeAndEdge(f, normal, spots, tolerance, gap, evaluations);
}

}  // namespace swept::detail
