// SPDX-License-Identifier: BSD-3-Clause
#include "cover/solid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "cover/outer_polyhedron.hpp"
#include "mesh/mesh_components.hpp"

namespace swept::detail {
namespace {

using Eigen::Vector3d;

double distance(const Nearest& nearest, const Vector3d& p,
                double near = std::numeric_limits<double>::infinity()) {
  Nearest::Found found = nearest.find(p, near * (1.0 + 1e-6));
  if (found.primitive < 0) found = nearest.find(p, std::numeric_limits<double>::infinity());
  return std::sqrt(found.squared);
}

template <typename S, typename... Others>
constexpr bool kIsOneOf = (std::is_same_v<S, Others> || ...);

std::vector<Vector3d> cornersOf(std::span<const Vector3d> vertices,
                                std::span<const Eigen::Vector3i> triangles) {
  std::vector<Vector3d> corners;
  corners.reserve(3 * triangles.size());
  for (const Eigen::Vector3i& triangle : triangles) {
    for (const int corner : triangle) corners.push_back(vertices[corner]);
  }
  return corners;
}

std::vector<Eigen::Vector3i> inOrder(std::span<const Eigen::Vector3i> triangles,
                                     std::span<const int> order) {
  std::vector<Eigen::Vector3i> ordered;
  ordered.reserve(order.size());
  for (const int index : order) ordered.push_back(triangles[index]);
  return ordered;
}

[[noreturn]] void refuse(const char* name) {
  throw std::invalid_argument(std::string("no balls cover a ") + name + ", which is unbounded");
}

}  // namespace

Solid::Solid(const Shape& shape) {
  if (std::holds_alternative<Plane>(shape)) refuse("plane");
  if (std::holds_alternative<HalfSpace>(shape)) refuse("half-space");
  if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
    mesh_ = *mesh;
  } else if (const auto* cloud = std::get_if<PointCloud>(&shape)) {
    cloud_ = *cloud;
    // The points grown by the largest radius contain the shape, and lie in the shape grown by the
    // slack.
    inflation_ = cloud->largestRadius();
    slack_ = inflation_ - cloud->leastRadius();
  } else if (const auto* sphere = std::get_if<Sphere>(&shape)) {
    usePoints(std::array{Vector3d(Vector3d::Zero())}, sphere->radius);
  } else if (const auto* capsule = std::get_if<Capsule>(&shape);
             capsule != nullptr && capsule->halfLength == 0.0) {
    usePoints(std::array{Vector3d(Vector3d::Zero())}, capsule->radius);
  } else if (const auto* hull = std::get_if<ConvexHull>(&shape)) {
    useHull(*hull, 0.0);
  } else {
    std::visit(
        [&](const auto& convex) {
          using S = std::remove_cvref_t<decltype(convex)>;
          if constexpr (!kIsOneOf<S, Sphere, ConvexHull, Plane, HalfSpace, TriangleMesh,
                                  PointCloud>) {
            const OuterPoints outer = outerPoints(convex);
            useHull(ConvexHull::of(outer.points), outer.slack);
          }
        },
        shape);
  }

  if (mesh_) {
    nearest_.emplace(mesh_->vertices(), mesh_->triangles(), mesh_->bvh());
    const bool surface = mesh_->interior() == MeshInterior::Surface;
    hasInside_ = !surface && mesh_->report().closedComponents > 0;
    if (surface || !mesh_->isClosed()) findPockets();
    if (hasInside_ && !pockets_) findShells();
  } else {
    nearest_.emplace(cloud_->points(), cloud_->bvh());
  }
  for (const Vector3d& vertex : vertices())
    scale_ = std::max(scale_, vertex.lpNorm<Eigen::Infinity>());
  // A path of at most 100 cuts (Cells::canSplit) moves a corner by 8 roundings each, 1e-13 of the
  // scale; the uncertainty of points within rounding of the surface is 1e-14 of it. The corner of a
  // patch may stand for that of a box 2e-12 of the scale away along each axis.
  constexpr double kPad = 1e-11;
  pad_ += kPad * scale_;
}

void Solid::useHull(const ConvexHull& hull, double slack) {
  const ThickHull thick = thickHull(hull);
  slack_ = slack + thick.slack + hull.error() + thick.hull.error();
  pad_ = hull.error() + thick.hull.error();
  isFlat_ = thick.slack > 0.0;
  if (!thick.hull.faces().empty()) {
    mesh_ =
        TriangleMesh::build(thick.hull.vertices(), thick.hull.faces(), MeshInterior::Solid, 0.0);
    if (mesh_->isClosed()) return;
    mesh_.reset();
  }
  // One point, or too small for a polyhedron in double precision: one ball around all of it.
  const Aabb box = boundingBox(hull);
  const double reach = 0.5 * (box.upper - box.lower).lpNorm<1>();
  usePoints(std::array{box.center()}, 0.0);
  slack_ += reach;
  pad_ += reach;
}

void Solid::usePoints(std::span<const Vector3d> points, double radius) {
  cloud_ = PointCloud::build(points, 0.0);
  inflation_ = radius;
}

std::span<const Vector3d> Solid::vertices() const {
  return mesh_ ? mesh_->vertices() : cloud_->points();
}

std::span<const Eigen::Vector3i> Solid::triangles() const {
  if (!mesh_) return {};
  return mesh_->triangles();
}

Solid::Surface::Surface(std::span<const Vector3d> vertices,
                        std::span<const Eigen::Vector3i> unordered)
    : Surface(vertices, unordered,
              TreeTopology::build({cornersOf(vertices, unordered), 3}, SurfaceAreaSplit{},
                                  WideNode::kLanes)) {}

Solid::Surface::Surface(std::span<const Vector3d> vertices,
                        std::span<const Eigen::Vector3i> unordered, const TreeTopology& tree)
    : triangles(inOrder(unordered, tree.order)),
      bvh(tree, {cornersOf(vertices, triangles), 3}),
      nearest(vertices, triangles, bvh) {}

Solid::Shell::Shell(std::span<const Vector3d> vertices, std::span<const Eigen::Vector3i> unordered,
                    const Aabb& box, bool oriented)
    : surface(vertices, unordered),
      component{vertices, surface.triangles, surface.bvh, box, oriented} {}

void Solid::findPockets() {
  pockets_.emplace(mesh_->vertices(), mesh_->triangles());
  if (pockets_->areNone()) return pockets_.reset();
  skin_ = std::make_unique<const Surface>(pockets_->skinVertices(), pockets_->skinTriangles());
}

/// Parts inside a link, or links made of overlapping parts, have triangles within the solid. These
/// bound no ball in the shell around them. Small parts are not worth the effort.
void Solid::findShells() {
  constexpr double kLarge = 0.2;
  if (mesh_->report().closedComponents < 2) return;
  const MeshComponents parts = ComponentFinder(mesh_->triangles()).result();
  if (parts.triangles.size() != mesh_->triangles().size()) return;
  std::vector<std::vector<Eigen::Vector3i>> trianglesOf(parts.oriented.size());
  for (std::size_t i = 0; i < parts.triangles.size(); ++i) {
    if (parts.componentOf[i] >= 0) trianglesOf[parts.componentOf[i]].push_back(parts.triangles[i]);
  }
  const Aabb whole = boundingBox(*mesh_);
  std::vector<int> shellOfComponent(trianglesOf.size(), -1);
  for (std::size_t i = 0; i < trianglesOf.size(); ++i) {
    Aabb box{mesh_->vertices()[trianglesOf[i][0][0]], mesh_->vertices()[trianglesOf[i][0][0]]};
    for (const Eigen::Vector3i& triangle : trianglesOf[i]) {
      for (const int corner : triangle) {
        box.lower = box.lower.cwiseMin(mesh_->vertices()[corner]);
        box.upper = box.upper.cwiseMax(mesh_->vertices()[corner]);
      }
    }
    if (box.size() < kLarge * kLarge * whole.size()) continue;
    shellOfComponent[i] = static_cast<int>(shells_.size());
    shells_.push_back(
        std::make_unique<const Shell>(mesh_->vertices(), trianglesOf[i], box, parts.oriented[i]));
  }
  for (const int component : parts.componentOf) {
    shellOf_.push_back(component < 0 ? -1 : shellOfComponent[component]);
  }
}

double Solid::depthIn(const Vector3d& p, double toTriangles) const {
  double depth = toTriangles - nearest_->error(p);
  for (const auto& shell : shells_) {
    if (!shell->encloses(p)) continue;
    depth = std::max(depth, distance(shell->surface.nearest, p) - shell->surface.nearest.error(p));
  }
  return depth - slack_;
}

Candidate Solid::at(const Vector3d& p, double near) const {
  if (pockets_ && pockets_->mayContain(p)) {
    const double toSkin = distance(skin_->nearest, p);
    if (pockets_->contain(p, toSkin)) return {p, toSkin - nearest_->error(p), true};
  }
  return {p, depth(p, near)};
}

double Solid::depth(const Vector3d& p, double near) const {
  const double found = distance(*nearest_, p, near);
  return encloses(p) ? depthIn(p, found) : -found - nearest_->error(p) - slack_;
}

Candidate Solid::inside(const Vector3d& p) const {
  return {p, depthIn(p, distance(*nearest_, p))};
}

std::optional<Candidate> Solid::inscribed(const Vector3d& foot, int triangle, double radius,
                                          Contacts& contacts) const {
  if (pockets_ ? !pockets_->isSkin(triangle) : !hasInside_) return std::nullopt;
  const Vector3d normal = nearest_->unitNormal(triangle);
  if (normal.isZero()) return std::nullopt;
  const Shell* own = nullptr;
  if (!shells_.empty() && shellOf_[triangle] >= 0) own = shells_[shellOf_[triangle]].get();
  for (const auto& shell : shells_) {
    if (shell.get() != own && shell->encloses(foot)) return std::nullopt;
  }
  const Hollow hollow{pockets_         ? skin_->nearest
                      : own != nullptr ? own->surface.nearest
                                       : *nearest_,
                      own};
  // Normals nearly always point outward.
  bool wrongSide = false;
  auto ball = inscribedAlong(foot, -normal, radius, hollow, contacts, wrongSide);
  if (wrongSide) ball = inscribedAlong(foot, normal, radius, hollow, contacts, wrongSide);
  return ball;
}

/// Shrinking ball (Ma, Bae, Choi 2012, "3D medial axis point approximation using nearest
/// neighbors"): while something is nearer to the centre than the foot, take the ball through both.
std::optional<Candidate> Solid::inscribedAlong(const Vector3d& foot, const Vector3d& inward,
                                               double radius, const Hollow& hollow,
                                               Contacts& contacts, bool& wrongSide) const {
  constexpr int kSteps = 8;
  constexpr double kEnough = 0.98;
  wrongSide = false;
  double t = radius;
  if (contacts.of != &hollow.nearest) contacts = {&hollow.nearest, {}, 0, 0};
  for (int i = 0; i < contacts.count; ++i) {
    const Vector3d across = contacts.points[i] - foot;
    if (!((across - t * inward).squaredNorm() < kEnough * kEnough * t * t)) continue;
    const double next = across.squaredNorm() / (2.0 * across.dot(inward));
    if (next > 0.0 && next < t) t = next;
  }
  for (int step = 0; step < kSteps; ++step) {
    const Vector3d center = foot + t * inward;
    const Nearest::Found found = hollow.nearest.find(center, kEnough * t);
    if (found.primitive < 0) {
      const double depth = kEnough * t - hollow.nearest.error(center) - slack_;
      if (!(depth > 0.0)) return std::nullopt;
      const bool isRoom = pockets_                  ? pockets_->contain(center, depth)
                          : hollow.shell != nullptr ? hollow.shell->encloses(center)
                                                    : encloses(center);
      if (isRoom) return Candidate{center, depth, pockets_.has_value()};
      wrongSide = true;
      return std::nullopt;
    }
    const Vector3d across = found.point - foot;
    const double next = across.squaredNorm() / (2.0 * across.dot(inward));
    if (!(next > 0.0) || !(next < t)) return std::nullopt;
    t = next;
    contacts.add(found.point);
  }
  return std::nullopt;
}

double Solid::overhang(const Candidate& candidate, double radius) const {
  if (!candidate.inPocket) return radius - candidate.depth;
  // In a pocket the shape is all around, but only its surface counts.
  return farthestFromSurface(candidate.center, radius, distance(*nearest_, candidate.center));
}

/// Upper bound of the distance to the surface over a ball. The distance is 1-Lipschitz, so over a
/// cube it is at most the value at the centre plus half the diagonal. The cube with the largest
/// bound is split until the work is used up.
double Solid::farthestFromSurface(const Vector3d& center, double radius, double atCenter) const {
  constexpr int kEvaluations = 25;
  struct Cube {
    double bound;
    Vector3d middle;
    double half;
    double here;
    bool operator<(const Cube& other) const { return bound < other.bound; }
  };
  // Bound for any tested point: none is farther from the centre than 3 radii, in the 1-norm.
  const double error = nearest_->error(center) + 12e-6 * radius + slack_;
  std::priority_queue<Cube> cubes;
  cubes.push({atCenter + radius, center, radius, atCenter});
  for (int evaluations = 1; evaluations + 8 <= kEvaluations && !cubes.empty(); evaluations += 8) {
    const Cube top = cubes.top();
    cubes.pop();
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3d sign(corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0,
                          corner & 4 ? 1.0 : -1.0);
      const Vector3d middle = top.middle + 0.5 * top.half * sign;
      const double reach = 0.5 * top.half * std::sqrt(3.0);
      if ((middle - center).norm() > radius + reach) continue;
      const double most = (top.here + reach) * (1.0 + 1e-5) + error;
      const double found =
          hasInside_ && encloses(middle) ? 0.0 : std::sqrt(nearest_->find(middle, most).squared);
      cubes.push({std::min(found + reach, top.bound), middle, 0.5 * top.half, found});
    }
  }
  return (cubes.empty() ? atCenter + radius : cubes.top().bound) + error;
}

}  // namespace swept::detail
