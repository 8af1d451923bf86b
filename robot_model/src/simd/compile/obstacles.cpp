// SPDX-License-Identifier: BSD-3-Clause
#include "simd/compile/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <type_traits>

#include "model/pair_model.hpp"
#include "rounding/error_model.hpp"
#include "simd/compile/obstacle_tree.hpp"
#include "simd/compile/single.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

/// m. Far below where squares overflow in single precision: an infinite square would count as
/// apart.
constexpr double kLargestSquared = 1e15;

class ObstacleCompiler {
 public:
  ObstacleCompiler(const std::vector<WorldGeometry>& world, double reach, double room,
                   std::span<const SimdField> known)
      : reach_(reach), fields_(world, reach, room, known) {}

  void add(const WorldGeometry& geometry) {
    geometry_ = &geometry;
    slack_ = obstacleRounding(reach_, geometry.magnitude);  // L8: each set is grown by that
    // For a box, only the part outside it is squared.
    if (!(geometry.magnitude < kLargestSquared)) return addBox();
    std::visit([&](const auto& shape) { addShape(shape); }, geometry.shape);
  }

  SimdObstacles take() { return std::move(result_); }

  /// A map has many boxes.
  void reserve(const std::vector<WorldGeometry>& world) {
    result_.obstacles.reserve(world.size());
    result_.boxes.reserve(
        static_cast<std::size_t>(std::ranges::count_if(world, [](const WorldGeometry& geometry) {
          return std::holds_alternative<Box>(geometry.shape);
        })));
  }

 private:
  template <typename S>
  void addShape(const S& shape) {
    const Eigen::Isometry3d& pose = geometry_->world_from_shape;
    if constexpr (std::is_same_v<S, Sphere>) {
      addRound(ObstacleKind::Ball, shape.radius, 0.0);
    } else if constexpr (std::is_same_v<S, Capsule>) {
      addRound(ObstacleKind::Capsule, shape.radius, shape.halfLength);
    } else if constexpr (std::is_same_v<S, Cylinder>) {
      addRound(ObstacleKind::Cylinder, shape.radius, shape.halfLength);
    } else if constexpr (std::is_same_v<S, Cone>) {
      addCone(shape);
    } else if constexpr (std::is_same_v<S, HalfSpace> || std::is_same_v<S, Plane>) {
      constexpr bool solid = std::is_same_v<S, HalfSpace>;
      const Vector3d normal = pose.linear() * shape.normal;
      addPlanes(solid ? ObstacleKind::Planes : ObstacleKind::Slab, 1, NearProof::Distance);
      addPlane(normal, shape.offset + normal.dot(pose.translation()));
    } else if constexpr (std::is_same_v<S, ConvexHull>) {
      addHull(shape);
    } else if constexpr (std::is_same_v<S, Ellipsoid>) {
      addEllipsoid(shape);
    } else if constexpr (std::is_same_v<S, Triangle>) {
      addTriangle(shape);
    } else if constexpr (std::is_same_v<S, TriangleMesh> || std::is_same_v<S, PointCloud>) {
      addField();
    } else {
      addBox();
    }
  }

  SimdObstacle& addObstacle(ObstacleKind kind, std::size_t first, NearProof near) {
    SimdObstacle obstacle;
    obstacle.kind = kind;
    obstacle.near = near;
    obstacle.first = static_cast<std::int32_t>(first);
    result_.obstacles.push_back(obstacle);
    return result_.obstacles.back();
  }

  /// The box that contains the geometry; for a box, the box itself.
  void addBox() {
    const bool isBox = std::holds_alternative<Box>(geometry_->shape);
    addBox(geometry_->box_from_world, geometry_->halfExtents,
           isBox ? NearProof::Distance : NearProof::None);
  }

  void addBox(const Eigen::Isometry3d& box_from_world, const Vector3d& halfExtents,
              NearProof near) {
    addObstacle(ObstacleKind::Box, result_.boxes.size(), near);
    SimdBox box;
    assignFrame(box_from_world, box);
    for (int i = 0; i < 3; ++i) box.half[i] = singleAbove(halfExtents[i] + slack_);
    result_.boxes.push_back(box);
  }

  /// A thin box in the triangle's own plane, along its longest side.
  void addTriangle(const Triangle& triangle);

  void addEllipsoid(const Ellipsoid& shape) {
    addObstacle(ObstacleKind::Ellipsoid, result_.ellipsoids.size(), NearProof::Inside);
    SimdEllipsoid ellipsoid;
    assignFrame(geometry_->world_from_shape.inverse(), ellipsoid);
    for (int i = 0; i < 3; ++i) {
      ellipsoid.semiAxes[i] = singleAbove(shape.semiAxes[i]);
      ellipsoid.inverse[i] = 1.0F / singleAbove(shape.semiAxes[i] + slack_);
    }
    ellipsoid.slack = singleAbove(slack_);
    result_.ellipsoids.push_back(ellipsoid);
  }

  void addField() {
    SimdField field;
    if (!fields_.compile(*geometry_, slack_, field)) return addBox();
    addObstacle(ObstacleKind::Field, result_.fields.size(), NearProof::Query);
    result_.fields.push_back(std::move(field));
  }

  SimdRound& addRound(ObstacleKind kind, double radius, double halfLength) {
    addObstacle(kind, result_.rounds.size(),
                kind == ObstacleKind::Cone ? NearProof::Inside : NearProof::Distance);
    SimdRound round;
    assign(geometry_->world_from_shape.translation(), round.center);
    assign(geometry_->world_from_shape.linear().col(2), round.axis);
    round.radius = singleAbove(radius + slack_);
    round.halfLength = singleAbove(halfLength + slack_);
    result_.rounds.push_back(round);
    return result_.rounds.back();
  }

  void addCone(const Cone& cone) {
    SimdRound& round = addRound(ObstacleKind::Cone, cone.radius, cone.halfLength);
    const double height = 2.0 * cone.halfLength;
    const double slant = std::hypot(cone.radius, height);
    const double across = slant > 0.0 ? height / slant : 1.0;
    const double along = slant > 0.0 ? cone.radius / slant : 0.0;
    round.across = static_cast<float>(across);
    round.along = static_cast<float>(along);
    // The side passes through the apex, at height halfLength on the axis.
    round.offset = singleAbove(along * cone.halfLength + slack_);
  }

  void addPlanes(ObstacleKind kind, int count, NearProof near) {
    addObstacle(kind, result_.planes.size(), near).count = count;
  }

  void addPlane(const Vector3d& normal, double offset) {
    LanePlane plane;
    assign(normal, plane.normal);
    plane.offset = static_cast<float>(offset);
    plane.slack = singleAbove(slack_ + kOffsetRoundings * kSingle * std::abs(offset));
    result_.planes.push_back(plane);
  }

  void addHull(const ConvexHull& hull);

  double reach_;
  FieldCompiler fields_;
  double slack_ = 0.0;
  const WorldGeometry* geometry_ = nullptr;
  SimdObstacles result_;
};

constexpr std::size_t kMostPlanes = 32;

/// Directions of faces, the largest ones first, without duplicates.
std::vector<Vector3d> faceNormals(const ConvexHull& hull) {
  constexpr double kSame = 1.0 - 1e-6;
  std::vector<Vector3d> scaled;
  for (const Eigen::Vector3i& face : hull.faces()) {
    const Vector3d& corner = hull.vertices()[face[0]];
    scaled.push_back((hull.vertices()[face[1]] - corner).cross(hull.vertices()[face[2]] - corner));
  }
  std::ranges::stable_sort(scaled, std::greater<>(), &Vector3d::squaredNorm);
  std::vector<Vector3d> normals;
  for (const Vector3d& normal : scaled) {
    const double length = normal.norm();
    if (normals.size() == kMostPlanes || !(length > 0.0)) break;
    const Vector3d unit = normal / length;
    const bool known = std::ranges::any_of(
        normals, [&](const Vector3d& other) { return other.dot(unit) > kSame; });
    if (!known) normals.push_back(unit);
  }
  return normals;
}

/// The set is the intersection of half-spaces that touch the hull, for any normals.
void ObstacleCompiler::addHull(const ConvexHull& hull) {
  const std::vector<Vector3d> normals = faceNormals(hull);
  if (normals.size() < 4) return addBox();
  addPlanes(ObstacleKind::Planes, static_cast<int>(normals.size()),
            normals.size() < kMostPlanes ? NearProof::Inside : NearProof::None);
  const Eigen::Isometry3d& pose = geometry_->world_from_shape;
  for (const Vector3d& normal : normals) {
    double support = -std::numeric_limits<double>::infinity();
    for (const Vector3d& vertex : hull.vertices()) support = std::max(support, normal.dot(vertex));
    const Vector3d turned = pose.linear() * normal;
    addPlane(turned, support + hull.error() + turned.dot(pose.translation()));
  }
}

void ObstacleCompiler::addTriangle(const Triangle& triangle) {
  const auto& corners = triangle.corners;
  Vector3d longest = corners[1] - corners[0];
  for (int i = 1; i < 3; ++i) {
    const Vector3d side = corners[(i + 1) % 3] - corners[i];
    if (side.squaredNorm() > longest.squaredNorm()) longest = side;
  }
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  // Any orthonormal axes will do: the box is around the corners in these axes.
  const Vector3d first = longest.norm() > 0.0 ? longest.normalized() : Vector3d::UnitX();
  Vector3d third = normal - normal.dot(first) * first;
  third = third.norm() > 1e-9 * longest.squaredNorm() ? third.normalized() : first.unitOrthogonal();
  Eigen::Matrix3d axes;
  axes << first.transpose(), third.cross(first).transpose(), third.transpose();
  Vector3d lower = axes * corners[0];
  Vector3d upper = lower;
  for (const Vector3d& corner : corners) {
    lower = lower.cwiseMin(axes * corner);
    upper = upper.cwiseMax(axes * corner);
  }
  Eigen::Isometry3d box_from_shape = Eigen::Isometry3d::Identity();
  box_from_shape.linear() = axes;
  box_from_shape.translation() = -0.5 * (lower + upper);
  addBox(box_from_shape * geometry_->world_from_shape.inverse(), 0.5 * (upper - lower),
         NearProof::None);
}

}  // namespace

SimdObstacles compileObstacles(const std::vector<WorldGeometry>& world, double reach, bool bounded,
                               std::span<const float> extras, const SimdObstacles* like,
                               double farther) {
  // Room for balls around the farthest points too.
  const double room =
      bounded ? 1.3 * (reach + farther) + 0.1 : std::numeric_limits<double>::infinity();
  ObstacleCompiler compiler(
      world, reach, room, like != nullptr ? std::span(like->fields) : std::span<const SimdField>());
  compiler.reserve(world);
  for (const WorldGeometry& geometry : world) compiler.add(geometry);
  SimdObstacles result = compiler.take();
  result.nodes = buildObstacleTree(world, reach, extras);
  return result;
}

}  // namespace swept::detail
