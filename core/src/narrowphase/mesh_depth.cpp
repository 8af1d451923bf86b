// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/mesh_depth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/convex_parts.hpp"
#include "narrowphase/convex_pair.hpp"
#include "narrowphase/piecewise.hpp"
#include "swept/core/signed_distance.hpp"

namespace swept::detail {

namespace {

using Eigen::Isometry3d;
using Eigen::Vector3d;

/// A ball inside a body.
struct Ball {
  Vector3d center;  ///< m, in the body's frame
  double radius;    ///< m
};

/// Cap on the parts or pairs of parts that are tested: more of them only tighten a bound.
constexpr std::size_t kMostParts = 4096;

std::size_t countOf(const Side& side) {
  if (side.cloud != nullptr) return side.cloud->points().size();
  return side.isConvex() ? 1 : side.mesh->convexParts().size();
}

/// Calls `visit` with each convex part of the solid and its pose.
template <typename Visitor>
void forEachPart(const Side& side, const Visitor& visit) {
  if (side.isConvex()) {
    visit(side.convex, Vector3d(Vector3d::Zero()));
  } else if (side.cloud != nullptr) {
    for (std::size_t i = 0; i < side.cloud->points().size(); ++i) {
      visit(Convex::of(Sphere{side.cloud->radius(i)}), side.cloud->points()[i]);
    }
  } else {
    for (const ConvexHull& part : side.mesh->convexParts()) {
      visit(Convex::of(part), Vector3d(Vector3d::Zero()));
    }
  }
}

/// Calls `visit` with balls inside the body that may reach deep into another one.
template <typename Visitor>
void forEachBall(const Side& side, const Visitor& visit) {
  if (side.mesh != nullptr) {
    for (const Vector3d& p : side.mesh->hull().vertices()) visit(Ball{p, 0.0});
    return;
  }
  if (side.cloud != nullptr) {
    for (std::size_t i = 0; i < side.cloud->points().size(); ++i) {
      visit(Ball{side.cloud->points()[i], side.cloud->radius(i)});
    }
    return;
  }
  const Convex& body = side.convex;
  switch (body.core) {
    case Convex::Core::Point:
      visit(Ball{Vector3d::Zero(), body.radius});
      break;
    case Convex::Core::Segment:
      for (const double s : {-1.0, 0.0, 1.0}) {
        visit(Ball{Vector3d(0.0, 0.0, s * body.size.z()), body.radius});
      }
      break;
    case Convex::Core::Box:
    case Convex::Core::Ellipsoid:
      visit(Ball{Vector3d::Zero(), body.size.minCoeff()});
      break;
    case Convex::Core::Cylinder:
      visit(Ball{Vector3d::Zero(), std::min(body.size.x(), body.size.z())});
      break;
    case Convex::Core::Cone:
    case Convex::Core::Points:
    case Convex::Core::Plane:
    case Convex::Core::HalfSpace:
      break;
  }
  if (body.isFlat()) return;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      visit(Ball{body.support(sign * Vector3d::Unit(axis)), 0.0});
    }
  }
}

class Depth {
 public:
  Depth(const Side& a, const Side& b, const Isometry3d& a_from_b, double tolerance)
      : a_(a), b_(b), a_from_b_(a_from_b), tolerance_(tolerance) {}

  MeshDepth run() {
    hulls();
    parts();
    if (depth_.upper - depth_.lower > tolerance_) {
      balls(b_, a_, a_from_b_, false);
      balls(a_, b_, a_from_b_.inverse(), true);
    }
    depth_.lower = std::clamp(depth_.lower, 0.0, depth_.upper);
    return depth_;
  }

 private:
  void hulls() {
    const SignedDistanceResult found =
        convexPairSigned(a_.convex, b_.convex, a_from_b_, tolerance_);
    depth_.iterations += found.iterations;
    depth_.upper = std::max(0.0, -found.lower);
    depth_.normal = found.normal;
    depth_.pointA = found.pointA;
    depth_.pointB = found.pointB;
    // The deepest point of a mesh in a half-space is one of its hull, and must come out.
    const bool halfSpace =
        a_.convex.core == Convex::Core::HalfSpace || b_.convex.core == Convex::Core::HalfSpace;
    if (halfSpace) depth_.lower = -found.upper - a_.convex.error - b_.convex.error;
  }

  /// Each part is in its body, so a translation that separates the bodies separates each pair.
  void parts() {
    if (countOf(a_) * countOf(b_) > kMostParts) return;
    // Lemma: the offset of two parts rounds by a few ulps of the coordinates whose difference it
    // is.
    const double moved = tolerance::kSupportRounding *
                         (a_.convex.extent + b_.convex.extent + a_from_b_.translation().norm());
    forEachPart(a_, [&](const Convex& partA, const Vector3d& centerA) {
      forEachPart(b_, [&](const Convex& partB, const Vector3d& centerB) {
        Isometry3d pose = a_from_b_;
        pose.translation() = a_from_b_ * centerB - centerA;
        const SignedDistanceResult found = convexPairSigned(partA, partB, pose, tolerance_);
        depth_.iterations += found.iterations;
        // The parts of a mesh are hulls, which may reach beyond it by this.
        const double depth = -found.upper - partA.error - partB.error -
                             2.0 * kConvexPart * (partA.extent + partB.extent) - moved;
        if (depth > depth_.lower) {
          depth_.lower = depth;
          depth_.pointA = found.pointA + centerA;
          depth_.pointB = found.pointB + centerA;
        }
      });
    });
  }

  /// A ball of radius r whose centre is d inside the other solid stays in contact under any
  /// translation shorter than r + d, and so does one whose centre is -d outside it.
  void balls(const Side& of, const Side& in, const Isometry3d& in_from_of, bool ofA) {
    if (in.mesh == nullptr || (of.cloud != nullptr && countOf(of) > kMostParts)) return;
    forEachBall(of, [&](const Ball& ball) {
      const Vector3d center = in_from_of * ball.center;
      const bool inside = in.mesh->encloses(center);
      if (!inside && !(ball.radius > depth_.lower)) return;
      const PieceResult surface = toSurface(in, center, ball.radius, inside);
      const double depth = ball.radius + (inside ? surface.lower : -surface.upper) -
                           tolerance::kSupportRounding * (center.norm() + ball.radius);
      if (!(depth > depth_.lower)) return;
      depth_.lower = depth;
      depth_.pointA = ofA ? Vector3d(a_from_b_ * center) : surface.pointA;
      depth_.pointB = ofA ? Vector3d(a_from_b_ * surface.pointA) : center;
    });
  }

  /// m. From a point to the triangles of a mesh, in the mesh's frame.
  PieceResult toSurface(const Side& mesh, const Vector3d& point, double radius, bool inside) {
    Side probe;
    probe.convex = Convex::of(Sphere{0.0});
    PieceGoal goal;
    goal.tolerance = tolerance_;
    goal.surfaces = true;
    if (!inside) goal.enough = radius;
    Isometry3d pose = Isometry3d::Identity();
    pose.translation() = point;
    PieceResult found = searchPieces(mesh, probe, pose, Vector3d::Zero(), goal);
    depth_.iterations += found.iterations;
    return found;
  }

  const Side& a_;
  const Side& b_;
  const Isometry3d& a_from_b_;
  const double tolerance_;
  MeshDepth depth_;
};

}  // namespace

MeshDepth meshDepth(const Side& a, const Side& b, const Isometry3d& a_from_b, double tolerance) {
  return Depth(a, b, a_from_b, tolerance).run();
}

}  // namespace swept::detail
