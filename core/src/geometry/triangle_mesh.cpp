// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/triangle_mesh.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>

#include "bvh/wide_bvh.hpp"
#include "geometry/convex_parts.hpp"
#include "geometry/mesh_components.hpp"
#include "geometry/ray_crossing.hpp"
#include "geometry/weld.hpp"
#include "simd/box_bounds.hpp"
#include "swept/core/distance.hpp"

namespace swept {
namespace {

/// Largest distance from the middle of a hull face to the mesh, over a sample of the faces.
double estimateDent(const TriangleMesh& mesh) {
  constexpr std::size_t kSamples = 256;
  const ConvexHull& hull = mesh.hull();
  const std::size_t stride = hull.faces().size() / kSamples + 1;
  DistanceOptions options;
  options.tolerance = 1e-3 * hull.extent();
  double dent = 0.0;
  for (std::size_t i = 0; i < hull.faces().size(); i += stride) {
    const Eigen::Vector3i& face = hull.faces()[i];
    Eigen::Isometry3d mesh_from_point = Eigen::Isometry3d::Identity();
    mesh_from_point.translation() =
        (hull.vertices()[face[0]] + hull.vertices()[face[1]] + hull.vertices()[face[2]]) / 3.0;
    dent = std::max(dent, distance(mesh, Sphere{0.0}, mesh_from_point, options).lower);
  }
  return dent;
}

void requireUsable(std::span<const Eigen::Vector3d> vertices,
                   std::span<const Eigen::Vector3i> triangles) {
  // Three half edges per triangle and two tree nodes have to be counted in an int.
  constexpr std::size_t kMaxCount = std::size_t{1} << 29;
  std::ostringstream message;
  if (vertices.size() > kMaxCount || triangles.size() > kMaxCount) {
    message << "mesh has " << vertices.size() << " vertices and " << triangles.size()
            << " triangles; allowed: at most " << kMaxCount << " of each";
    throw std::invalid_argument(message.str());
  }
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d& vertex = vertices[i];
    if (vertex.allFinite()) continue;
    message << "mesh vertex " << i << " is (" << vertex.x() << ", " << vertex.y() << ", "
            << vertex.z() << "); allowed: finite coordinates";
    throw std::invalid_argument(message.str());
  }
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int corner : triangles[i]) {
      if (corner >= 0 && static_cast<std::size_t>(corner) < vertices.size()) continue;
      message << "mesh triangle " << i << " has corner " << corner << "; allowed: 0 to "
              << static_cast<long long>(vertices.size()) - 1;
      throw std::invalid_argument(message.str());
    }
  }
}

/// Directions for the rays, well spread for every number taken: Roberts 2018 ("The unreasonable
/// effectiveness of quasirandom sequences"), mapped to the sphere with equal areas.
constexpr int kDirections = 32;
std::array<Eigen::Vector3d, kDirections> spreadDirections() {
  constexpr double kFirstRatio = 0.7548776662466927;  // 1 / g and 1 / g^2, g^3 = g + 1
  constexpr double kSecondRatio = 0.5698402909980532;
  std::array<Eigen::Vector3d, kDirections> directions;
  for (int i = 0; i < kDirections; ++i) {
    double whole = 0.0;
    const double z = 2.0 * std::modf(0.37 + i * kFirstRatio, &whole) - 1.0;
    const double angle = 2.0 * std::numbers::pi * std::modf(0.21 + i * kSecondRatio, &whole);
    const double radial = std::sqrt(1.0 - z * z);
    directions[i] = {radial * std::cos(angle), radial * std::sin(angle), z};
  }
  return directions;
}

/// Signed crossings of one ray with each closed component whose box contains its origin. Their
/// parity is that of the number of crossings.
class CrossingCounts {
 public:
  void add(int component) {
    if (size_ < kInline)
      inline_[size_] = {component, 0};
    else
      more_.push_back({component, 0});
    ++size_;
  }
  bool empty() const { return size_ == 0; }
  void reset() {
    for (Count& count : inlined()) count.crossings = 0;
    for (Count& count : more_) count.crossings = 0;
  }
  /// Null for a component that cannot contain the origin.
  int* find(int component) {
    for (Count& count : inlined()) {
      if (count.component == component) return &count.crossings;
    }
    for (Count& count : more_) {
      if (count.component == component) return &count.crossings;
    }
    return nullptr;
  }
  template <typename Predicate>
  bool any(const Predicate& predicate) const {
    for (int i = 0; i < std::min(size_, kInline); ++i) {
      if (predicate(inline_[i].component, inline_[i].crossings)) return true;
    }
    for (const Count& count : more_) {
      if (predicate(count.component, count.crossings)) return true;
    }
    return false;
  }

 private:
  struct Count {
    int component;
    int crossings;
  };
  static constexpr int kInline = 64;
  std::span<Count> inlined() {
    return std::span(inline_).first(static_cast<std::size_t>(std::min(size_, kInline)));
  }
  std::array<Count, kInline> inline_;
  std::vector<Count> more_;
  int size_ = 0;
};

/// A ray against the triangles of one mesh.
class RayCount {
 public:
  RayCount(const TriangleMesh& mesh, std::span<const int> componentOf,
           const Eigen::Vector3d& origin, const Eigen::Vector3d& direction, CrossingCounts& counts)
      : mesh_(mesh),
        componentOf_(componentOf),
        origin_(origin),
        direction_(direction),
        counts_(counts) {}

  /// False when the ray passes within rounding of the border of a triangle that matters.
  bool run() {
    const detail::WideBvh& bvh = mesh_.bvh();
    // Each level leaves at most seven siblings behind.
    std::array<int, (detail::WideNode::kLanes - 1) * detail::WideBvh::kMaxDepth + 1> stack;
    int pending = 0;
    stack[pending++] = 0;
    while (pending > 0) {
      const detail::WideNode& node = bvh.nodes()[stack[--pending]];
      for (std::uint32_t hits = detail::boxesHit(node, origin_, direction_); hits != 0;
           hits &= hits - 1) {
        const int lane = std::countr_zero(hits);
        if (node.child[lane] >= 0) {
          stack[pending++] = node.child[lane];
        } else if (!count(~node.child[lane])) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  bool count(int triangle) {
    int* const crossings = counts_.find(componentOf_[triangle]);
    if (crossings == nullptr) return true;
    const Eigen::Vector3i& corners = mesh_.triangles()[triangle];
    const Eigen::Vector3d a = mesh_.vertices()[corners[0]] - origin_;
    const Eigen::Vector3d b = mesh_.vertices()[corners[1]] - origin_;
    const Eigen::Vector3d c = mesh_.vertices()[corners[2]] - origin_;
    switch (detail::rayCrossing(direction_, a, b, c)) {
      case detail::Crossing::Unsure:
        return false;
      case detail::Crossing::Miss:
        break;
      case detail::Crossing::Along:
        ++*crossings;
        break;
      case detail::Crossing::Against:
        --*crossings;
        break;
    }
    return true;
  }

  const TriangleMesh& mesh_;
  std::span<const int> componentOf_;
  const Eigen::Vector3d& origin_;
  const Eigen::Vector3d& direction_;
  CrossingCounts& counts_;
};

/// Builds the hierarchy and puts the triangles, and what goes with each, in the order of its
/// leaves.
detail::WideBvh orderByTree(std::span<const Eigen::Vector3d> vertices,
                            std::vector<TriangleMesh::Triangle>& triangles,
                            std::vector<int>& componentOf) {
  std::vector<Eigen::Vector3d> corners;
  const auto collectCorners = [&] {
    corners.clear();
    for (const TriangleMesh::Triangle& triangle : triangles) {
      for (const int corner : triangle) corners.push_back(vertices[corner]);
    }
  };
  corners.reserve(triangles.size() * 3);
  collectCorners();
  const auto tree = TreeTopology::build({corners, 3}, SurfaceAreaSplit{}, detail::WideNode::kLanes);
  std::vector<TriangleMesh::Triangle> orderedTriangles(triangles.size());
  std::vector<int> orderedComponents(triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    orderedTriangles[i] = triangles[tree.order[i]];
    orderedComponents[i] = componentOf[tree.order[i]];
  }
  triangles = std::move(orderedTriangles);
  componentOf = std::move(orderedComponents);
  collectCorners();
  return detail::WideBvh(tree, {corners, 3});
}

}  // namespace

TriangleMesh TriangleMesh::build(std::span<const Eigen::Vector3d> vertices,
                                 std::span<const Triangle> triangles, MeshInterior interior) {
  requireUsable(vertices, triangles);
  detail::WeldedMesh welded = detail::weld(vertices, triangles);
  if (welded.triangles.empty()) {
    std::ostringstream message;
    message << "mesh has no triangle with three distinct corners (of " << triangles.size()
            << " given)";
    throw std::invalid_argument(message.str());
  }
  detail::MeshComponents parts = detail::ComponentFinder(welded.triangles).result();

  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<Component> components;
  for (bool oriented : parts.oriented) {
    components.push_back(
        {Eigen::Vector3d::Constant(infinity), Eigen::Vector3d::Constant(-infinity), oriented});
  }
  for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
    if (parts.componentOf[i] < 0) continue;
    Component& component = components[parts.componentOf[i]];
    for (int corner : parts.triangles[i]) {
      component.lower = component.lower.cwiseMin(welded.vertices[corner]);
      component.upper = component.upper.cwiseMax(welded.vertices[corner]);
    }
  }

  std::vector<Eigen::Vector3d> componentPoints;
  for (int corner : parts.cornerOf) componentPoints.push_back(welded.vertices[corner]);

  MeshReport report;
  report.verticesGiven = static_cast<int>(vertices.size());
  report.verticesKept = static_cast<int>(welded.vertices.size());
  report.trianglesGiven = static_cast<int>(triangles.size());
  report.degenerateDropped = welded.degenerateDropped;
  report.duplicatesDropped = parts.duplicatesDropped;
  report.closedComponents = static_cast<int>(components.size());
  report.openComponents = parts.openComponents;

  auto bvh = std::make_shared<const detail::WideBvh>(
      orderByTree(welded.vertices, parts.triangles, parts.componentOf));
  ConvexHull hull = ConvexHull::of(welded.vertices);
  ConvexHull coarseHull = ConvexHull::coarser(hull);
  std::vector<ConvexHull> solids;
  if (interior == MeshInterior::Solid) {
    solids =
        detail::convexParts(welded.vertices, parts.triangles, parts.componentOf, parts.oriented);
  }
  auto data = std::make_shared<Data>(
      Data{std::move(welded.vertices), std::move(parts.triangles), std::move(parts.componentOf),
           std::move(components), std::move(componentPoints), report, interior, std::move(hull),
           std::move(coarseHull), std::move(solids), std::move(bvh), 0.0});
  TriangleMesh mesh(data);
  data->dent = estimateDent(mesh);
  return mesh;
}

bool TriangleMesh::encloses(const Eigen::Vector3d& point) const {
  if (data_->interior == MeshInterior::Surface) return false;
  CrossingCounts counts;
  for (std::size_t i = 0; i < data_->components.size(); ++i) {
    const Component& component = data_->components[i];
    if ((point.array() >= component.lower.array()).all() &&
        (point.array() <= component.upper.array()).all()) {
      counts.add(static_cast<int>(i));
    }
  }
  if (counts.empty()) return false;

  static const std::array<Eigen::Vector3d, kDirections> directions = spreadDirections();
  for (const Eigen::Vector3d& direction : directions) {
    counts.reset();
    if (!RayCount(*this, data_->componentOf, point, direction, counts).run()) continue;
    return counts.any([&](int component, int crossings) {
      return data_->components[component].oriented ? crossings != 0 : crossings % 2 != 0;
    });
  }
  // Only a point within rounding of a triangle leaves no direction: it touches the solid.
  return true;
}

}  // namespace swept
