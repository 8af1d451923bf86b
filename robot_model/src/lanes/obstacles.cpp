// SPDX-License-Identifier: BSD-3-Clause
#include "lanes/obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <type_traits>

#include "certify/checker_model.hpp"
#include "swept/core/distance.hpp"

namespace swept::detail {

namespace {

using Eigen::Vector3d;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

float roundedUp(double value) {
  const auto single = static_cast<float>(value);
  return static_cast<double>(single) < value ? std::nextafter(single, kInfinity) : single;
}

float roundedDown(double value) {
  return -roundedUp(-value);
}

void assign(const Vector3d& from, float (&to)[3]) {
  for (int i = 0; i < 3; ++i) to[i] = static_cast<float>(from[i]);
}

template <typename Compiled>
void assignFrame(const Eigen::Isometry3d& frame_from_world, Compiled& to) {
  for (int i = 0; i < 3; ++i) {
    assign(frame_from_world.linear().row(i), to.axes[i]);
    to.offset[i] = static_cast<float>(frame_from_world.translation()[i]);
  }
}

bool wantsField(const WorldGeometry& geometry) {
  return std::holds_alternative<TriangleMesh>(geometry.shape) ||
         std::holds_alternative<PointCloud>(geometry.shape);
}

/// Cells of one field and of all of a world.
constexpr std::size_t kMostFieldCells = std::size_t{1} << 20;
constexpr std::size_t kLeastFieldCells = std::size_t{1} << 12;
constexpr std::size_t kMostCells = std::size_t{1} << 22;

class ObstacleCompiler {
 public:
  ObstacleCompiler(const std::vector<WorldGeometry>& world, double reach, bool bounded)
      : reach_(reach), bounded_(bounded) {
    const auto fields = static_cast<std::size_t>(std::ranges::count_if(world, wantsField));
    fieldCells_ = std::clamp(kMostCells / std::max<std::size_t>(fields, 1), kLeastFieldCells,
                             kMostFieldCells);
  }

  void add(const WorldGeometry& geometry) {
    geometry_ = &geometry;
    // Lemma: a coordinate a . x + d of a point in a frame of the obstacle is computed from
    // components of a, x and d that are off by kSingle of |x| <= reach and |d| <= magnitude each,
    // in at most eight roundings; so it is off by less than 32 kSingle of their sum. Each set is
    // grown by that.
    slack_ = 32.0 * kSingle * (reach_ + geometry.magnitude);
    std::visit([&](const auto& shape) { addShape(shape); }, geometry.shape);
  }

  LaneObstacles take() { return std::move(result_); }

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

  LaneObstacle& addObstacle(ObstacleKind kind, std::size_t first, NearProof near) {
    LaneObstacle obstacle;
    obstacle.kind = kind;
    obstacle.near = near;
    obstacle.first = static_cast<std::int32_t>(first);
    result_.obstacles.push_back(obstacle);
    return result_.obstacles.back();
  }

  /// The box that contains the geometry; for a box that is the box.
  void addBox() {
    const bool isBox = std::holds_alternative<Box>(geometry_->shape);
    addBox(geometry_->box_from_world, geometry_->halfExtents,
           isBox ? NearProof::Distance : NearProof::None);
  }

  void addBox(const Eigen::Isometry3d& box_from_world, const Vector3d& halfExtents,
              NearProof near) {
    addObstacle(ObstacleKind::Box, result_.boxes.size(), near);
    LaneBox box;
    assignFrame(box_from_world, box);
    for (int i = 0; i < 3; ++i) box.half[i] = roundedUp(halfExtents[i] + slack_);
    result_.boxes.push_back(box);
  }

  /// Thin, in the triangle's own plane, along its longest side.
  void addTriangle(const Triangle& triangle);

  void addEllipsoid(const Ellipsoid& shape) {
    addObstacle(ObstacleKind::Ellipsoid, result_.ellipsoids.size(), NearProof::Inside);
    LaneEllipsoid ellipsoid;
    assignFrame(geometry_->world_from_shape.inverse(), ellipsoid);
    for (int i = 0; i < 3; ++i) {
      ellipsoid.semiAxes[i] = roundedUp(shape.semiAxes[i] + slack_);
      ellipsoid.inverse[i] = 1.0F / ellipsoid.semiAxes[i];
    }
    result_.ellipsoids.push_back(ellipsoid);
  }

  void addField();
  std::shared_ptr<const ClearanceField> fieldFor(const Aabb& window);

  LaneRound& addRound(ObstacleKind kind, double radius, double halfLength) {
    addObstacle(kind, result_.rounds.size(),
                kind == ObstacleKind::Cone ? NearProof::Inside : NearProof::Distance);
    LaneRound round;
    assign(geometry_->world_from_shape.translation(), round.center);
    assign(geometry_->world_from_shape.linear().col(2), round.axis);
    round.radius = roundedUp(radius + slack_);
    round.halfLength = roundedUp(halfLength + slack_);
    result_.rounds.push_back(round);
    return result_.rounds.back();
  }

  void addCone(const Cone& cone) {
    LaneRound& round = addRound(ObstacleKind::Cone, cone.radius, cone.halfLength);
    const double height = 2.0 * cone.halfLength;
    const double slant = std::hypot(cone.radius, height);
    const double across = slant > 0.0 ? height / slant : 1.0;
    const double along = slant > 0.0 ? cone.radius / slant : 0.0;
    round.across = static_cast<float>(across);
    round.along = static_cast<float>(along);
    // The side goes through the apex, at height halfLength on the axis.
    round.offset = roundedUp(along * cone.halfLength + slack_);
  }

  void addPlanes(ObstacleKind kind, int count, NearProof near) {
    addObstacle(kind, result_.planes.size(), near).count = count;
  }

  void addPlane(const Vector3d& normal, double offset) {
    LanePlane plane;
    assign(normal, plane.normal);
    plane.offset = static_cast<float>(offset);
    plane.slack = roundedUp(slack_ + 2.0 * kSingle * std::abs(offset));
    result_.planes.push_back(plane);
  }

  void addHull(const ConvexHull& hull);

  struct KnownField {
    const void* data;  ///< of the mesh or cloud
    Aabb window;       ///< m
    std::shared_ptr<const ClearanceField> field;
  };

  double reach_;
  bool bounded_;
  std::size_t fieldCells_ = 0;
  std::vector<KnownField> known_;
  double slack_ = 0.0;
  const WorldGeometry* geometry_ = nullptr;
  LaneObstacles result_;
};

constexpr std::size_t kMostPlanes = 32;

/// Directions of faces, the largest ones first, none twice.
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

/// The set is the intersection of half-spaces that touch the hull, whatever their normals.
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
  // Any orthonormal axes will do: the box is around the corners as they are in them.
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

std::shared_ptr<const ClearanceField> ObstacleCompiler::fieldFor(const Aabb& window) {
  const auto* mesh = std::get_if<TriangleMesh>(&geometry_->shape);
  const void* data = mesh != nullptr ? static_cast<const void*>(&mesh->bvh())
                                     : &std::get<PointCloud>(geometry_->shape).bvh();
  for (const KnownField& known : known_) {
    if (known.data == data && known.window.lower == window.lower &&
        known.window.upper == window.upper)
      return known.field;
  }
  known_.push_back({data, window, buildClearanceField(geometry_->shape, window, fieldCells_)});
  return known_.back().field;
}

void ObstacleCompiler::addField() {
  const Eigen::Isometry3d shape_from_world = geometry_->world_from_shape.inverse();
  const Aabb box = boundingBox(geometry_->shape);
  const Vector3d unlimited = Vector3d::Constant(std::numeric_limits<double>::infinity());
  Aabb window{-unlimited, unlimited};
  if (bounded_) {
    // Room for balls around the farthest points too. Where it cuts nothing off, whatever the pose,
    // the field can be shared.
    const Vector3d room = Vector3d::Constant(1.3 * reach_ + 0.1);
    const Vector3d origin = shape_from_world.translation();
    for (int i = 0; i < 3; ++i) {
      if (origin[i] - room[i] > box.lower[i]) window.lower[i] = origin[i] - room[i];
      if (origin[i] + room[i] < box.upper[i]) window.upper[i] = origin[i] + room[i];
    }
  }
  const std::shared_ptr<const ClearanceField> field = fieldFor(window);
  if (!field) return addBox();
  addObstacle(ObstacleKind::Field, result_.fields.size(), NearProof::Query);
  Eigen::Isometry3d grid_from_world = shape_from_world;
  grid_from_world.translation() -= field->origin;
  LaneField lane;
  assignFrame(grid_from_world, lane);
  for (int i = 0; i < 3; ++i) {
    constexpr double kFar = 1e30;
    lane.lower[i] = roundedDown(std::max(field->lower[i], -kFar));
    lane.upper[i] = roundedUp(std::min(field->upper[i], kFar));
    lane.blocks[i] = field->blocks[i];
  }
  lane.cell = 2.0F * field->voxel;
  lane.inverse = 1.0F / lane.cell;
  lane.step = field->step;
  lane.fineStep = field->fineStep;
  // Lemma: beside the coordinates, the middle of a cell, its distance and that to W are rounded, of
  // numbers below the reach and the size of all. And a larger W is as good.
  const double size = reach_ + geometry_->magnitude + 255.0 * static_cast<double>(field->step);
  lane.slack = roundedUp(2.0 * slack_ + 64.0 * kSingle * size);
  lane.cells = field->cells.data();
  lane.bricks = field->bricks.data();
  lane.voxels = field->voxels.data();
  lane.field = field;
  lane.shape = geometry_->shape;
  lane.shape_from_world = shape_from_world;
  result_.fields.push_back(std::move(lane));
}

/// Eight-wide tree of boxes along the model frame's axes.
class BoxTree {
 public:
  BoxTree(const std::vector<WorldGeometry>& world, double reach) {
    std::vector<Entry> bounded;
    std::vector<Entry> unbounded;
    for (std::size_t i = 0; i < world.size(); ++i) {
      const Entry entry = entryOf(world[i], reach, ~static_cast<std::int32_t>(i));
      (entry.half.allFinite() ? bounded : unbounded).push_back(entry);
    }
    if (world.empty()) return;
    nodes_.emplace_back();
    // Unbounded boxes would spoil the ones around them.
    std::vector<Entry> root;
    while (unbounded.size() >= kLanes) {
      std::vector<Entry> some(unbounded.end() - (kLanes - 1), unbounded.end());
      unbounded.resize(unbounded.size() - (kLanes - 1));
      unbounded.push_back(pack(some));
    }
    root = unbounded;
    if (bounded.size() + root.size() <= kLanes) {
      root.insert(root.end(), bounded.begin(), bounded.end());
    } else {
      root.push_back(pack(bounded));
    }
    fill(0, root);
  }

  std::vector<LaneWorldNode> take() { return std::move(nodes_); }

 private:
  struct Entry {
    Vector3d center;  ///< m
    Vector3d half;    ///< m
    std::int32_t child;
  };

  static Entry entryOf(const WorldGeometry& geometry, double reach, std::int32_t child) {
    const Eigen::Isometry3d world_from_box = geometry.box_from_world.inverse();
    const double slack = 32.0 * kSingle * (reach + geometry.magnitude);
    Entry entry;
    entry.child = child;
    entry.center = world_from_box.translation();
    entry.half = Vector3d::Constant(std::numeric_limits<double>::infinity());
    if (geometry.halfExtents.allFinite())
      entry.half = (world_from_box.linear().cwiseAbs() * geometry.halfExtents).array() + slack;
    return entry;
  }

  static Entry bound(std::span<const Entry> entries) {
    Vector3d lower = Vector3d::Constant(std::numeric_limits<double>::infinity());
    Vector3d upper = -lower;
    for (const Entry& entry : entries) {
      lower = lower.cwiseMin(entry.center - entry.half);
      upper = upper.cwiseMax(entry.center + entry.half);
    }
    return {0.5 * (lower + upper), 0.5 * (upper - lower), 0};
  }

  void fill(std::size_t node, std::span<const Entry> entries) {
    for (int lane = 0; lane < kLanes; ++lane) {
      const bool used = lane < static_cast<int>(entries.size());
      for (int i = 0; i < 3; ++i) {
        // Nothing meets an empty box.
        nodes_[node].lower[i].lane[lane] =
            used ? roundedDown(entries[lane].center[i] - entries[lane].half[i]) : kInfinity;
        nodes_[node].upper[i].lane[lane] =
            used ? roundedUp(entries[lane].center[i] + entries[lane].half[i]) : -kInfinity;
      }
      nodes_[node].child[lane] = used ? entries[lane].child : 0;
    }
  }

  /// Halves along the longest side until there are eight groups.
  static void split(std::span<Entry> entries, int halvings, std::vector<std::span<Entry>>& groups) {
    if (halvings == 0 || entries.size() <= 1) {
      if (!entries.empty()) groups.push_back(entries);
      return;
    }
    Eigen::Index axis = 0;
    bound(entries).half.maxCoeff(&axis);
    const auto middle = entries.begin() + static_cast<std::ptrdiff_t>(entries.size() / 2);
    std::nth_element(entries.begin(), middle, entries.end(), [&](const Entry& a, const Entry& b) {
      return a.center[axis] != b.center[axis] ? a.center[axis] < b.center[axis] : a.child < b.child;
    });
    split({entries.begin(), middle}, halvings - 1, groups);
    split({middle, entries.end()}, halvings - 1, groups);
  }

  Entry pack(std::span<Entry> entries) {
    Entry result = bound(entries);
    const std::size_t node = nodes_.size();
    result.child = static_cast<std::int32_t>(node);
    nodes_.emplace_back();
    if (entries.size() <= kLanes) {
      fill(node, entries);
      return result;
    }
    std::vector<std::span<Entry>> groups;
    split(entries, 3, groups);
    std::vector<Entry> children;
    for (const std::span<Entry> group : groups)
      children.push_back(group.size() == 1 ? group.front() : pack(group));
    fill(node, children);
    return result;
  }

  std::vector<LaneWorldNode> nodes_;
};

}  // namespace

LaneObstacles compileObstacles(const std::vector<WorldGeometry>& world, double reach,
                               bool bounded) {
  ObstacleCompiler compiler(world, reach, bounded);
  for (const WorldGeometry& geometry : world) compiler.add(geometry);
  LaneObstacles result = compiler.take();
  result.nodes = BoxTree(world, reach).take();
  return result;
}

bool isApart(const LaneField& field, const MovingPoint& point, float radius) {
  const Vector3d x(point.x[0], point.x[1], point.x[2]);
  const Vector3d g(point.g[0], point.g[1], point.g[2]);
  const double length = g.norm();
  DistanceOptions options;
  options.enough = static_cast<double>(radius);
  options.contact = options.enough;
  Eigen::Isometry3d world_from_segment(Eigen::Translation3d{x});
  Shape segment = Sphere{0.0};
  if (length > 0.05 * options.enough) {
    segment = Capsule{0.0, length};
    world_from_segment.linear() =
        Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), g).toRotationMatrix();
  } else {
    options.enough += length;
  }
  const Eigen::Isometry3d segment_from_shape =
      (field.shape_from_world * world_from_segment).inverse();
  // More than what the poses and the length are rounded by.
  options.enough += static_cast<double>(field.slack);
  return distance(segment, field.shape, segment_from_shape, options).lower >= options.enough;
}

bool reaches(const LaneField& field, const MovingPoint& point, float radius) {
  const Vector3d x(point.x[0], point.x[1], point.x[2]);
  DistanceOptions options;
  options.contact = static_cast<double>(radius);
  options.enough = options.contact;
  const Eigen::Isometry3d point_from_shape(Eigen::Translation3d(-(field.shape_from_world * x)));
  return distance(Sphere{0.0}, field.shape, point_from_shape, options).upper <= options.contact;
}

}  // namespace swept::detail
