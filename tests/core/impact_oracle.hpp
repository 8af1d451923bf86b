// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "swept/core/continuous/impact.hpp"

/// Truths about the impact of two features; no method is the library's. Distances at one time are
/// of points that the features have, in more digits than the library's; the slow judge of a whole
/// motion divides the box of time and both parameters.
namespace swept::test {

/// A vertex and a face, or two edges: the first point or two against the others.
struct ImpactQuery {
  bool edges = false;
  std::array<LinearPath, 4> points;
  ImpactOptions options;
};

inline Impact ask(const ImpactQuery& q) {
  const auto& p = q.points;
  if (q.edges) return edgeEdgeImpact({p[0], p[1]}, {p[2], p[3]}, q.options);
  return vertexFaceImpact(p[0], {p[1], p[2], p[3]}, q.options);
}

namespace oracle {

using Digits = boost::multiprecision::cpp_bin_float_50;

template <class Real>
struct Vec3 {
  Real x, y, z;
  Vec3 operator-(const Vec3& o) const { return {x - o.x, y - o.y, z - o.z}; }
  Vec3 operator+(const Vec3& o) const { return {x + o.x, y + o.y, z + o.z}; }
  Vec3 operator*(const Real& s) const { return {x * s, y * s, z * s}; }
  Real dot(const Vec3& o) const { return x * o.x + y * o.y + z * o.z; }
  Vec3 cross(const Vec3& o) const {
    return {y * o.z - z * o.y, z * o.x - x * o.z, x * o.y - y * o.x};
  }
};

template <class Real>
Vec3<Real> convert(const Eigen::Vector3d& v) {
  return {Real(v.x()), Real(v.y()), Real(v.z())};
}

/// Of a path at t.
template <class Real>
Vec3<Real> place(const LinearPath& path, const Real& t) {
  return convert<Real>(path.start) * (Real(1) - t) + convert<Real>(path.end) * t;
}

template <class Real>
Real onlyBetween(const Real& x, const Real& most) {
  if (!(x > Real(0))) return Real(0);
  return x < most ? x : most;
}

/// Least squared distance from p to points of the segment.
template <class Real>
Real toSegment(const Vec3<Real>& p, const Vec3<Real>& a, const Vec3<Real>& b) {
  const Vec3<Real> e = b - a;
  const Real length = e.dot(e);
  const Real s = length > Real(0) ? onlyBetween<Real>((p - a).dot(e) / length, Real(1)) : Real(0);
  const Vec3<Real> d = a + e * s - p;
  return d.dot(d);
}

/// Squared distance from the origin to start + u e + v f near where it is least, over u and v in
/// [0, 1], in a triangle with u + v <= 1.
template <class Real>
Real toFace(const Vec3<Real>& start, const Vec3<Real>& e, const Vec3<Real>& f, bool triangle) {
  const Vec3<Real> n = e.cross(f);
  const Real area = n.dot(n);
  if (!(area > Real(0))) return start.dot(start);
  const Real u = onlyBetween<Real>(f.cross(start).dot(n) / area, Real(1));
  const Real most = triangle ? Real(Real(1) - u) : Real(1);
  const Real v = onlyBetween<Real>(start.cross(e).dot(n) / area, most);
  const Vec3<Real> p = start + e * u + f * v;
  return p.dot(p);
}

/// m, the distance of two points, one of each feature at t, next to the least there is: rounding
/// makes it larger, never smaller by more than its own size.
template <class Real>
Real distanceAt(const ImpactQuery& q, double t) {
  using std::sqrt;
  std::array<Vec3<Real>, 4> p;
  for (int i = 0; i < 4; ++i) p[i] = place<Real>(q.points[i], Real(t));
  Real least;
  if (q.edges) {
    least = toFace<Real>(p[0] - p[2], p[1] - p[0], p[2] - p[3], false);
    for (int i = 0; i < 2; ++i) {
      least = std::min<Real>(least, toSegment(p[i], p[2], p[3]));
      least = std::min<Real>(least, toSegment(p[2 + i], p[0], p[1]));
    }
  } else {
    least = toFace<Real>(p[1] - p[0], p[2] - p[1], p[3] - p[1], true);
    for (int i = 1; i < 4; ++i) least = std::min<Real>(least, toSegment(p[0], p[i], p[i % 3 + 1]));
  }
  return sqrt(least);
}

/// m, the largest difference of two coordinates of the features, at either end.
inline long double extent(const ImpactQuery& q) {
  const int firsts = q.edges ? 2 : 1;
  long double most = 0.0L;
  for (int i = 0; i < firsts; ++i) {
    for (int j = firsts; j < 4; ++j) {
      for (int axis = 0; axis < 3; ++axis) {
        const auto apart = [axis](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
          return std::abs(static_cast<long double>(a[axis]) - static_cast<long double>(b[axis]));
        };
        most = std::max(most, apart(q.points[i].start, q.points[j].start));
        most = std::max(most, apart(q.points[i].end, q.points[j].end));
      }
    }
  }
  return most;
}

/// m. Up to this far beyond the separation features may be said to be in contact.
inline long double slack(const ImpactQuery& q) {
  return std::max<long double>(q.options.tolerance, 1.001e-12L * extent(q));
}

/// m, most that a point of one feature moves relative to a point of the other.
inline long double relativeTravel(const ImpactQuery& q) {
  const int firsts = q.edges ? 2 : 1;
  long double most = 0.0L;
  for (int i = 0; i < firsts; ++i) {
    for (int j = firsts; j < 4; ++j) {
      using Wide = Vec3<long double>;
      const Wide a =
          convert<long double>(q.points[i].end) - convert<long double>(q.points[i].start);
      const Wide b =
          convert<long double>(q.points[j].end) - convert<long double>(q.points[j].start);
      most = std::max(most, std::sqrt((a - b).dot(a - b)));
    }
  }
  return most;
}

/// Whether points of the two features are at most so far apart at t. In 50 digits where 19 do not
/// tell.
inline bool near(const ImpactQuery& q, double t, long double most) {
  if (distanceAt<long double>(q, t) <= most) return true;
  return distanceAt<Digits>(q, t) <= Digits(most) * (1 + Digits(1e-15));
}

/// What an answer says against itself or the promises of the header; empty if nothing.
inline std::string complaint(const ImpactQuery& q, const Impact& impact) {
  const double before = q.options.before;
  switch (impact.verdict) {
    case Verdict::Undecided:
    case Verdict::Violation:
      return "undecided";
    case Verdict::Free:
      return impact.freeUntil == before && impact.contactBy == 1.0 ? "" : "free, but until when?";
    case Verdict::Collision:
      break;
  }
  if (!(0.0 <= impact.freeUntil && impact.freeUntil <= impact.contactBy))
    return "times in disorder";
  if (!(impact.contactBy <= before)) return "contact after what is of interest";
  const long double allowed = slack(q);
  const long double gap = static_cast<long double>(impact.contactBy) - impact.freeUntil;
  if (!(gap * relativeTravel(q) <= allowed * 1.001L)) return "first contact not enclosed";
  if (!near(q, impact.contactBy, q.options.separation + allowed)) return "no contact at contactBy";
  return "";
}

/// As code, to be pasted into a test.
inline std::string reproducer(const ImpactQuery& q) {
  std::ostringstream out;
  out << std::hexfloat << "ImpactQuery{" << q.edges << ", {{";
  for (const LinearPath& path : q.points) {
    out << "{{" << path.start.x() << ", " << path.start.y() << ", " << path.start.z() << "}, {"
        << path.end.x() << ", " << path.end.y() << ", " << path.end.z() << "}}, ";
  }
  out << "}}, {" << q.options.separation << ", " << q.options.tolerance << ", " << q.options.before
      << "}}";
  return out.str();
}

/// Earliest contact by division of the box of t and the two parameters u and v, all in [0, 1]: over
/// a part of it, the difference of the two points lies in the box of its values at the part's eight
/// corners, being linear in each of the three (Snyder 1992, "Interval analysis for computer
/// graphics", in idea). A part whose box keeps more than the separation from the origin is dropped.
class Subdivision {
 public:
  struct Answer {
    bool known = true;       ///< false: too many parts to look at
    bool free = false;       ///< nothing is left of the box
    double contactBy = 1.0;  ///< else: a part with a box of at most `width` m is left at this t
  };

  /// Queries of size 1: rounding is not counted.
  Subdivision(const ImpactQuery& q, double width) : q_(q), width_(width) {}

  Answer answer() {
    std::vector<Part> parts{{{0.0, 0.0, 0.0}, {q_.options.before, 1.0, 1.0}}};
    for (int looked = 0; !parts.empty(); ++looked) {
      if (looked == kMostParts) return {.known = false};
      const Part part = parts.back();
      parts.pop_back();
      Eigen::Array3d low;
      Eigen::Array3d high;
      if (!bounds(part, low, high)) continue;
      if ((high - low).maxCoeff() <= width_) return {.contactBy = part.from[0]};
      divide(part, parts);
    }
    return {.free = true};
  }

 private:
  /// Of features that nearly touch along a line, or in a plane, the parts do not get fewer.
  static constexpr int kMostParts = 1 << 24;

  struct Part {
    std::array<double, 3> from;
    std::array<double, 3> to;
  };

  Eigen::Vector3d difference(double t, double u, double v) const {
    std::array<Eigen::Vector3d, 4> p;
    for (int i = 0; i < 4; ++i) {
      p[i] = q_.points[i].start + t * (q_.points[i].end - q_.points[i].start);
    }
    if (q_.edges) return (p[0] + u * (p[1] - p[0])) - (p[2] + v * (p[3] - p[2]));
    // The triangle as the image of the square: (u, v) -> u ((1 - v) p2 + v p3) + (1 - u) p1.
    return p[0] - (p[1] + u * ((p[2] + v * (p[3] - p[2])) - p[1]));
  }
  /// False if the part has no contact.
  bool bounds(const Part& part, Eigen::Array3d& low, Eigen::Array3d& high) const {
    for (int corner = 0; corner < 8; ++corner) {
      const auto pick = [&](int axis) {
        return ((corner >> axis) & 1) != 0 ? part.to[axis] : part.from[axis];
      };
      const Eigen::Array3d d = difference(pick(0), pick(1), pick(2)).array();
      low = corner == 0 ? d : low.min(d).eval();
      high = corner == 0 ? d : high.max(d).eval();
    }
    const Eigen::Array3d apart = low.max(-high).max(0.0);
    return apart.matrix().norm() <= q_.options.separation;
  }
  /// Along the parameter that moves the difference most; the earlier half is the next one.
  void divide(const Part& part, std::vector<Part>& parts) const {
    int widest = 0;
    double most = -1.0;
    for (int axis = 0; axis < 3; ++axis) {
      double reach = 0.0;
      for (int corner = 0; corner < 4; ++corner) {
        std::array<double, 3> at = part.from;
        if ((corner & 1) != 0) at[(axis + 1) % 3] = part.to[(axis + 1) % 3];
        if ((corner & 2) != 0) at[(axis + 2) % 3] = part.to[(axis + 2) % 3];
        std::array<double, 3> other = at;
        other[axis] = part.to[axis];
        const Eigen::Vector3d moved =
            difference(other[0], other[1], other[2]) - difference(at[0], at[1], at[2]);
        reach = std::max(reach, moved.cwiseAbs().maxCoeff());
      }
      if (reach > most) {
        most = reach;
        widest = axis;
      }
    }
    Part early = part;
    Part late = part;
    early.to[widest] = late.from[widest] = 0.5 * (part.from[widest] + part.to[widest]);
    parts.push_back(late);
    parts.push_back(early);
  }

  const ImpactQuery& q_;
  double width_;
};

}  // namespace oracle
}  // namespace swept::test
