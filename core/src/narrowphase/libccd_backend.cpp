// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/libccd_backend.hpp"

#include <ccd/ccd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

#include "bvh/triangle_bvh.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {
namespace {

struct Triangle {
  std::array<Eigen::Vector3d, 3> corners;  ///< m
};

/// What libccd can handle in one call.
using Piece = std::variant<Sphere, Box, Cylinder, Capsule, ConvexHull, Triangle>;

double along(double direction, double size) {
  return direction < 0.0 ? -size : size;
}

template <typename Points>
Eigen::Vector3d farthestOf(const Points& points, const Eigen::Vector3d& direction) {
  return *std::max_element(points.begin(), points.end(),
                           [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
                             return a.dot(direction) < b.dot(direction);
                           });
}

/// Farthest point of a piece along a unit vector.
struct SupportAlong {
  Eigen::Vector3d direction;

  Eigen::Vector3d operator()(const Sphere& sphere) const { return sphere.radius * direction; }
  Eigen::Vector3d operator()(const Box& box) const {
    return {along(direction.x(), box.halfExtents.x()), along(direction.y(), box.halfExtents.y()),
            along(direction.z(), box.halfExtents.z())};
  }
  Eigen::Vector3d operator()(const Cylinder& cylinder) const {
    const double radial = std::hypot(direction.x(), direction.y());
    const double scale = radial > 0.0 ? cylinder.radius / radial : 0.0;
    return {scale * direction.x(), scale * direction.y(),
            along(direction.z(), cylinder.halfLength)};
  }
  Eigen::Vector3d operator()(const Capsule& capsule) const {
    return capsule.radius * direction +
           Eigen::Vector3d(0.0, 0.0, along(direction.z(), capsule.halfLength));
  }
  Eigen::Vector3d operator()(const ConvexHull& hull) const {
    return farthestOf(hull.vertices(), direction);
  }
  Eigen::Vector3d operator()(const Triangle& triangle) const {
    return farthestOf(triangle.corners, direction);
  }
};

template <typename Points>
Eigen::Vector3d meanOf(const Points& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return sum / static_cast<double>(points.size());
}

/// Of a mesh: its hull.
Piece pieceOf(const Shape& shape) {
  return std::visit(
      [](const auto& solid) -> Piece {
        if constexpr (std::is_same_v<std::decay_t<decltype(solid)>, TriangleMesh>) {
          return solid.hull();
        } else {
          return solid;
        }
      },
      shape);
}

/// A posed piece, as libccd's callbacks see it.
struct Body {
  Piece piece;
  Eigen::Isometry3d pose;  ///< in the common frame
  Eigen::Vector3d center;  ///< m, common frame
  double radius;           ///< m, of a ball around `center` that contains the piece
  double growth = 0.0;     ///< m
  mutable int evaluations = 0;

  Body(const Shape& shape, const Eigen::Isometry3d& where) : piece(pieceOf(shape)), pose(where) {
    // MPR needs a point inside; that of a bounding ball is inside only for a symmetric solid.
    const auto* hull = std::get_if<ConvexHull>(&piece);
    const Eigen::Vector3d inner =
        hull ? meanOf(hull->vertices()) : Eigen::Vector3d(Eigen::Vector3d::Zero());
    const BoundingSphere ball = boundingSphere(shape);
    center = pose * inner;
    radius = (ball.center - inner).norm() + ball.radius;
  }
  Body(const Triangle& triangle, const Eigen::Isometry3d& where) : piece(triangle), pose(where) {
    center = pose * meanOf(triangle.corners);
    radius = 0.0;
    for (const Eigen::Vector3d& p : triangle.corners) {
      radius = std::max(radius, (pose * p - center).norm());
    }
  }
};

void toCcd(const Eigen::Vector3d& from, ccd_vec3_t* to) {
  ccdVec3Set(to, from.x(), from.y(), from.z());
}

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
  const Body& body = *static_cast<const Body*>(object);
  ++body.evaluations;
  const Eigen::Vector3d unit =
      Eigen::Vector3d(direction->v[0], direction->v[1], direction->v[2]).stableNormalized();
  const Eigen::Vector3d local =
      std::visit(SupportAlong{body.pose.linear().transpose() * unit}, body.piece);
  toCcd(body.pose * local + body.growth * unit, result);
}

void center(const void* object, ccd_vec3_t* result) {
  toCcd(static_cast<const Body*>(object)->center, result);
}

/// Minkowski portal refinement. libccd's GJK stops early on round shapes: against closed forms its
/// distances were off by up to 2 mm, those of its portal refinement by the bisection's step.
bool meet(const Body& a, const Body& b) {
  constexpr unsigned long kMostIterations = 200;
  constexpr double kPortalTolerance = 1e-3 * tolerance::kLibccdDistance;
  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = support;
  ccd.support2 = support;
  ccd.center1 = center;
  ccd.center2 = center;
  ccd.max_iterations = kMostIterations;
  ccd.mpr_tolerance = kPortalTolerance;
  return ccdMPRIntersect(&a, &b, &ccd) != 0;
}

/// The state of a query over all pairs of pieces.
struct Search {
  double upper;  ///< m, smallest known r for which the pieces meet
  double enough;
  double contact;
  int evaluations = 0;

  bool done() const { return upper <= contact; }

  void examine(Body& a, Body& b) {
    if ((a.center - b.center).norm() - a.radius - b.radius >= upper) return;
    a.evaluations = b.evaluations = 0;
    a.growth = 0.0;
    if (meet(a, b)) {
      upper = 0.0;
    } else if (upper > tolerance::kLibccdDistance) {
      bisect(a, b);
    }
    evaluations += a.evaluations + b.evaluations;
  }

 private:
  void bisect(Body& a, const Body& b) {
    double apart = 0.0;
    // Grown by the distance of the centres they meet, grown by less than `upper` maybe not.
    double together = std::min(upper, (a.center - b.center).norm());
    if (together == upper) {
      a.growth = std::max(0.0, upper - tolerance::kLibccdDistance);
      if (!meet(a, b)) return;
      together = a.growth;
    }
    while (together - apart > tolerance::kLibccdDistance && together > contact && apart <= enough) {
      a.growth = 0.5 * (apart + together);
      (meet(a, b) ? together : apart) = a.growth;
    }
    upper = std::min(upper, together);
  }
};

double distanceToBox(const TriangleBvh::Node& node, const Eigen::Vector3d& point) {
  return ((point - node.center).cwiseAbs() - node.halfExtents).cwiseMax(0.0).norm();
}

Triangle triangleOf(const TriangleMesh& mesh, int index) {
  const Eigen::Vector3i& corners = mesh.triangles()[index];
  return {{mesh.vertices()[corners[0]], mesh.vertices()[corners[1]], mesh.vertices()[corners[2]]}};
}

/// Every triangle of `mesh` near enough to matter against `body`, both in the mesh's frame.
void examineMesh(const TriangleMesh& mesh, Body& body, Search& search) {
  const std::vector<TriangleBvh::Node>& nodes = mesh.bvh().nodes();
  std::array<int, TriangleBvh::kMaxDepth> stack;
  int pending = 0;
  stack[pending++] = 0;
  while (pending > 0 && !search.done()) {
    const int index = stack[--pending];
    const TriangleBvh::Node& node = nodes[index];
    if (distanceToBox(node, body.center) - body.radius >= search.upper) continue;
    if (node.rightChild >= 0) {
      int near = index + 1;
      int far = node.rightChild;
      if (distanceToBox(nodes[far], body.center) < distanceToBox(nodes[near], body.center)) {
        std::swap(near, far);
      }
      stack[pending++] = far;
      stack[pending++] = near;
      continue;
    }
    for (int i = node.firstTriangle; i < node.firstTriangle + node.triangleCount; ++i) {
      Body triangle(triangleOf(mesh, i), Eigen::Isometry3d::Identity());
      search.examine(triangle, body);
    }
  }
}

/// `a` is a mesh.
void examineMeshPair(const TriangleMesh& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                     Search& search) {
  const auto* meshB = std::get_if<TriangleMesh>(&b);
  if (meshB == nullptr) {
    Body body(b, a_from_b);
    if (a.encloses(body.center)) search.upper = 0.0;
    examineMesh(a, body, search);
    return;
  }
  for (const Eigen::Vector3d& p : meshB->componentPoints()) {
    if (a.encloses(a_from_b * p)) search.upper = 0.0;
  }
  for (const Eigen::Vector3d& p : a.componentPoints()) {
    if (meshB->encloses(a_from_b.inverse() * p)) search.upper = 0.0;
  }
  const int count = static_cast<int>(meshB->triangles().size());
  for (int i = 0; i < count && !search.done(); ++i) {
    Body body(triangleOf(*meshB, i), a_from_b);
    examineMesh(a, body, search);
  }
}

void examineShapes(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                   Search& search) {
  if (const auto* meshA = std::get_if<TriangleMesh>(&a)) {
    examineMeshPair(*meshA, b, a_from_b, search);
  } else if (const auto* meshB = std::get_if<TriangleMesh>(&b)) {
    examineMeshPair(*meshB, a, a_from_b.inverse(), search);
  } else {
    Body bodyA(a, Eigen::Isometry3d::Identity());
    Body bodyB(b, a_from_b);
    search.examine(bodyA, bodyB);
  }
}

}  // namespace

DistanceResult libccdDistance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                              const DistanceOptions& options) {
  DistanceResult result;
  if (!a_from_b.matrix().allFinite()) return result;
  Search search{result.upper, options.enough, options.contact};
  examineShapes(a, b, a_from_b, search);
  result.upper = search.upper;
  result.iterations = search.evaluations;
  return result;
}

bool libccdIntersect(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b) {
  if (!a_from_b.matrix().allFinite()) return false;
  // Started at the accuracy, the search has nothing to refine: it only looks for overlap.
  Search search{tolerance::kLibccdDistance, 0.0, 0.0};
  examineShapes(a, b, a_from_b, search);
  return search.upper <= 0.0;
}

}  // namespace swept::detail
