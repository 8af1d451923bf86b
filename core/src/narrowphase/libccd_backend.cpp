// SPDX-License-Identifier: BSD-3-Clause
#include "narrowphase/libccd_backend.hpp"

#include <ccd/ccd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>
#include <variant>

#include "bvh/wide_bvh.hpp"
#include "swept/core/tolerances.hpp"

namespace swept::detail {
namespace {

/// The shapes that libccd can handle in one call.
using CcdSolid =
    std::variant<Sphere, Box, Cylinder, Capsule, Cone, Ellipsoid, ConvexHull, Triangle>;

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
  Eigen::Vector3d operator()(const Cone& cone) const {
    const Eigen::Vector3d apex(0.0, 0.0, cone.halfLength);
    const double radial = std::hypot(direction.x(), direction.y());
    const double scale = radial > 0.0 ? cone.radius / radial : 0.0;
    const Eigen::Vector3d rim(scale * direction.x(), scale * direction.y(), -cone.halfLength);
    return apex.dot(direction) > rim.dot(direction) ? apex : rim;
  }
  Eigen::Vector3d operator()(const Ellipsoid& ellipsoid) const {
    const Eigen::Vector3d scaled = ellipsoid.semiAxes.cwiseProduct(direction);
    const double length = scaled.norm();
    if (!(length > 0.0)) return Eigen::Vector3d::Zero();
    return ellipsoid.semiAxes.cwiseProduct(scaled) / length;
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

/// Of a mesh: its hull. Planes, half-spaces and clouds never come here.
CcdSolid pieceOf(const Shape& shape) {
  return std::visit(
      [](const auto& solid) -> CcdSolid {
        using Solid = std::decay_t<decltype(solid)>;
        if constexpr (std::is_same_v<Solid, TriangleMesh>) {
          return solid.hull();
        } else if constexpr (std::is_same_v<Solid, Plane> || std::is_same_v<Solid, HalfSpace> ||
                             std::is_same_v<Solid, PointCloud>) {
          return Sphere{0.0};
        } else {
          return solid;
        }
      },
      shape);
}

/// A posed piece.
struct Body {
  CcdSolid piece;
  Eigen::Isometry3d pose;  ///< in the common frame
  Eigen::Vector3d center;  ///< m, common frame
  double radius;           ///< m, of a ball around `center` that contains the piece
  double growth = 0.0;     ///< m

  Body(const Shape& shape, const Eigen::Isometry3d& where) : piece(pieceOf(shape)), pose(where) {
    // MPR needs a point inside; the centre of a bounding ball is inside only for a symmetric solid.
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

/// How often support points were requested, and may be. One for each call of libccd, on the stack
/// of the query: no thread sees another one's.
struct Supports {
  int taken = 0;
  int allowed = 0;
};

/// A body, as libccd's callbacks see it.
struct Asked {
  const Body& body;
  Supports& supports;
};

void toCcd(const Eigen::Vector3d& from, ccd_vec3_t* to) {
  ccdVec3Set(to, from.x(), from.y(), from.z());
}

void support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* result) {
  const auto& [body, supports] = *static_cast<const Asked*>(object);
  if (++supports.taken > supports.allowed) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    ccdVec3Set(result, kNone, kNone, kNone);
    return;
  }
  const Eigen::Vector3d unit =
      Eigen::Vector3d(direction->v[0], direction->v[1], direction->v[2]).stableNormalized();
  const Eigen::Vector3d local =
      std::visit(SupportAlong{body.pose.linear().transpose() * unit}, body.piece);
  toCcd(body.pose * local + body.growth * unit, result);
}

void center(const void* object, ccd_vec3_t* result) {
  toCcd(static_cast<const Asked*>(object)->body.center, result);
}

enum class Met : std::uint8_t { No, Yes, Unknown };

/// Minkowski portal refinement. libccd's GJK stops early on round shapes: against closed forms its
/// distances were off by up to 2 mm, those of its portal refinement by the bisection's step.
///
/// ccdMPRIntersect has no limit of its own, and loops for ever on some flat shapes. A NaN support
/// point fails each of its comparisons, which ends it.
Met ccdMeet(const Body& a, const Body& b, int& evaluations) {
  constexpr int kMostSupports = 2 * 10'000;  // of both; 200 of either are many
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
  Supports supports{0, kMostSupports};
  const Asked askedA{a, supports};
  const Asked askedB{b, supports};
  const bool met = ccdMPRIntersect(&askedA, &askedB, &ccd) != 0;
  evaluations += supports.taken;
  if (supports.taken > supports.allowed) return Met::Unknown;
  return met ? Met::Yes : Met::No;
}

/// The state of a query over all pairs of pieces.
struct CcdSearch {
  double upper;  ///< m, smallest known r for which the pieces meet
  double enough;
  double contact;
  int evaluations = 0;
  bool unknown = false;  ///< it stayed unknown for some two pieces whether they meet as they are

  bool done() const { return upper <= contact; }

  void examine(Body& a, const Body& b) {
    if ((a.center - b.center).norm() - a.radius - b.radius >= upper) return;
    a.growth = 0.0;
    const Met met = ccdMeet(a, b, evaluations);
    if (met == Met::Yes) {
      upper = 0.0;
    } else if (met == Met::Unknown) {
      unknown = true;
    } else if (upper > tolerance::kLibccdDistance) {
      bisect(a, b);
    }
  }

 private:
  void bisect(Body& a, const Body& b) {
    double apart = 0.0;
    // Grown by the distance of the centres they meet; grown by less than `upper` they may not.
    double together = std::min(upper, (a.center - b.center).norm());
    if (together == upper) {
      a.growth = std::max(0.0, upper - tolerance::kLibccdDistance);
      if (ccdMeet(a, b, evaluations) != Met::Yes) return;
      together = a.growth;
    }
    while (together - apart > tolerance::kLibccdDistance && together > contact && apart <= enough) {
      a.growth = 0.5 * (apart + together);
      // Far out, doubles are farther apart than the accuracy.
      if (!(a.growth > apart && a.growth < together)) break;
      const Met met = ccdMeet(a, b, evaluations);
      if (met == Met::Unknown) break;
      (met == Met::Yes ? together : apart) = a.growth;
    }
    upper = std::min(upper, together);
  }
};

/// m. From a point.
double distanceToBox(const OrientedBox& box, const Eigen::Vector3d& point) {
  const Eigen::Vector3d offset = point - box.center;
  double squared = 0.0;
  for (int j = 0; j < 3; ++j) {
    const auto& axis = box.axes[j];
    const double along = axis[0] * offset[0] + axis[1] * offset[1] + axis[2] * offset[2];
    const double outside = std::max(0.0, std::abs(along) - box.half[j]);
    squared += outside * outside;
  }
  return std::sqrt(squared);
}

Triangle triangleOf(const TriangleMesh& mesh, int index) {
  const Eigen::Vector3i& corners = mesh.triangles()[index];
  return {{mesh.vertices()[corners[0]], mesh.vertices()[corners[1]], mesh.vertices()[corners[2]]}};
}

/// Every triangle of `mesh` near enough to matter against `body`, both in the mesh's frame, the
/// nearest boxes first.
void examineMesh(const TriangleMesh& mesh, int index, Body& body, CcdSearch& search) {
  const WideNode& node = mesh.bvh().nodes()[index];
  std::array<std::pair<double, int>, WideNode::kLanes> order;
  for (int lane = 0; lane < node.count; ++lane) {
    const double least = distanceToBox(node.box(lane), body.center) - body.radius;
    int at = lane;
    for (; at > 0 && order[at - 1].first > least; --at) order[at] = order[at - 1];
    order[at] = {least, lane};
  }
  for (int i = 0; i < node.count && !search.done(); ++i) {
    const auto [least, lane] = order[i];
    if (least >= search.upper) break;
    const int child = node.child[lane];
    if (child >= 0) {
      examineMesh(mesh, child, body, search);
    } else {
      Body triangle(triangleOf(mesh, ~child), Eigen::Isometry3d::Identity());
      search.examine(triangle, body);
    }
  }
}

void examineMesh(const TriangleMesh& mesh, Body& body, CcdSearch& search) {
  examineMesh(mesh, 0, body, search);
}

/// `a` is a mesh.
void examineMeshPair(const TriangleMesh& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                     CcdSearch& search) {
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
                   CcdSearch& search);

/// Ball by ball: slow, but no error of a hierarchy is possible.
void examineCloud(const PointCloud& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                  CcdSearch& search) {
  Eigen::Isometry3d ball_from_b = a_from_b;
  for (std::size_t i = 0; i < a.points().size(); ++i) {
    if (search.done()) return;
    ball_from_b.translation() = a_from_b.translation() - a.points()[i];
    examineShapes(Sphere{a.radius(i)}, b, ball_from_b, search);
  }
}

void examineShapes(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                   CcdSearch& search) {
  if (const auto* cloudA = std::get_if<PointCloud>(&a)) {
    examineCloud(*cloudA, b, a_from_b, search);
  } else if (const auto* cloudB = std::get_if<PointCloud>(&b)) {
    examineCloud(*cloudB, a, a_from_b.inverse(), search);
  } else if (const auto* meshA = std::get_if<TriangleMesh>(&a)) {
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
  CcdSearch search{result.upper, options.enough, options.contact};
  examineShapes(a, b, a_from_b, search);
  result.upper = search.upper;
  result.iterations = search.evaluations;
  return result;
}

Contact libccdIntersect(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b) {
  if (!a_from_b.matrix().allFinite()) return Contact::Unknown;
  // Started at the accuracy, the search has nothing to refine: it only searches for overlap.
  CcdSearch search{tolerance::kLibccdDistance, 0.0, 0.0};
  examineShapes(a, b, a_from_b, search);
  if (search.upper <= 0.0) return Contact::Touching;
  return search.unknown ? Contact::Unknown : Contact::Separate;
}

}  // namespace swept::detail
