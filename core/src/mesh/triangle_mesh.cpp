// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/triangle_mesh.hpp"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "bvh/wide_bvh.hpp"
#include "geometry/point_text.hpp"
#include "geometry/weld.hpp"
#include "mesh/convex_parts.hpp"
#include "mesh/enclosing_parts.hpp"
#include "mesh/mesh_components.hpp"
#include "mesh/mesh_cracks.hpp"
#include "swept/core/distance.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {
namespace {

/// Largest distance from the middle of a hull face to the mesh, over a sample of the faces.
double estimateConcavity(const TriangleMesh& mesh) {
  constexpr std::size_t kSamples = 256;
  const ConvexHull& hull = mesh.hull();
  const std::size_t stride = hull.faces().size() / kSamples + 1;
  DistanceOptions options;
  options.tolerance = 1e-3 * hull.extent();
  double concavity = 0.0;
  for (std::size_t i = 0; i < hull.faces().size(); i += stride) {
    const Eigen::Vector3i& face = hull.faces()[i];
    Eigen::Isometry3d mesh_from_point = Eigen::Isometry3d::Identity();
    mesh_from_point.translation() =
        (hull.vertices()[face[0]] + hull.vertices()[face[1]] + hull.vertices()[face[2]]) / 3.0;
    concavity = std::max(concavity, distance(mesh, Sphere{0.0}, mesh_from_point, options).lower);
  }
  return concavity;
}

/// Value of WideBvh::spread() when the order of the hierarchy was chosen.
constexpr double kRebuildGrowth = 2.0;

void requireCounts(std::size_t vertices, std::size_t triangles) {
  // Three half edges per triangle and two tree nodes must fit into an int.
  constexpr std::size_t kMaxCount = std::size_t{1} << 29;
  if (vertices <= kMaxCount && triangles <= kMaxCount) return;
  std::ostringstream message;
  message << "mesh has " << vertices << " vertices and " << triangles
          << " triangles; allowed: at most " << kMaxCount << " of each";
  throw std::invalid_argument(message.str());
}

void requireFinite(std::span<const Eigen::Vector3d> vertices) {
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Eigen::Vector3d& vertex = vertices[i];
    if (vertex.allFinite()) continue;
    std::ostringstream message;
    message << "mesh vertex " << i << " is " << detail::pointText(vertex)
            << "; allowed: finite coordinates";
    throw std::invalid_argument(message.str());
  }
}

void requireWidth(double crackWidth) {
  if (crackWidth >= 0.0 && std::isfinite(crackWidth)) return;
  std::ostringstream message;
  message << "mesh crack width is " << crackWidth << " m; allowed: from 0";
  throw std::invalid_argument(message.str());
}

void requireCorners(std::size_t vertices, std::span<const Eigen::Vector3i> triangles) {
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int corner : triangles[i]) {
      if (corner >= 0 && static_cast<std::size_t>(corner) < vertices) continue;
      std::ostringstream message;
      message << "mesh triangle " << i << " has corner " << corner << "; allowed: 0 to "
              << static_cast<long long>(vertices) - 1;
      throw std::invalid_argument(message.str());
    }
  }
}

std::vector<Eigen::Vector3d> cornersOf(std::span<const Eigen::Vector3d> vertices,
                                       std::span<const Eigen::Vector3i> triangles) {
  std::vector<Eigen::Vector3d> corners;
  corners.reserve(triangles.size() * 3);
  for (const Eigen::Vector3i& triangle : triangles) {
    for (const int corner : triangle) corners.push_back(vertices[corner]);
  }
  return corners;
}

/// Puts the kept ones of the given vertices into their places, given by `keptAs`.
void moveKept(std::span<const Eigen::Vector3d> given, std::span<const int> keptAs,
              std::span<Eigen::Vector3d> kept) {
  constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> source(kept.size(), kNone);
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (keptAs[i] < 0) continue;
    std::size_t& from = source[keptAs[i]];
    if (from == kNone) {
      from = i;
      kept[keptAs[i]] = given[i];
    } else if (given[from] != given[i]) {
      std::ostringstream message;
      message << "mesh vertices " << from << " and " << i
              << " were equal when the mesh was built and are moved apart, to "
              << detail::pointText(given[from]) << " and " << detail::pointText(given[i])
              << "; what tears has to be built anew";
      throw std::invalid_argument(message.str());
    }
  }
}

}  // namespace

TriangleMesh TriangleMesh::build(std::span<const Eigen::Vector3d> vertices,
                                 std::span<const Triangle> triangles, MeshInterior interior,
                                 std::optional<double> crackWidth) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, vertices, triangles, interior, crackWidth] {
      return build(vertices, triangles, interior, crackWidth);
    });
  }
  requireCounts(vertices.size(), triangles.size());
  requireFinite(vertices);
  if (crackWidth) requireWidth(*crackWidth);
  requireCorners(vertices.size(), triangles);
  detail::WeldedMesh welded = detail::weld(vertices, triangles);
  if (welded.triangles.empty()) {
    std::ostringstream message;
    message << "mesh has no triangle with three distinct corners (of " << triangles.size()
            << " given)";
    throw std::invalid_argument(message.str());
  }
  detail::MeshComponents parts = detail::ComponentFinder(welded.triangles).result();
  detail::CracksClosed cracks;
  if (parts.openComponents > 0) {
    const double width = crackWidth ? *crackWidth : usualCrackWidth(welded.vertices);
    cracks = detail::closeCracks(welded.vertices, width, parts);
    requireCounts(welded.vertices.size(), parts.triangles.size());
  }

  Surface surface;
  surface.interior = interior;
  surface.report.verticesGiven = static_cast<int>(vertices.size());
  surface.report.verticesKept = static_cast<int>(welded.vertices.size());
  surface.report.trianglesGiven = static_cast<int>(triangles.size());
  surface.report.degenerateDropped = welded.degenerateDropped;
  surface.report.duplicatesDropped = parts.duplicatesDropped;
  surface.report.cracksFilled = cracks.triangles;
  surface.report.largestCrack = cracks.largest;
  surface.report.closedComponents = static_cast<int>(parts.oriented.size());
  surface.report.openComponents = parts.openComponents + static_cast<int>(welded.lines.size());
  surface.vertices = std::move(welded.vertices);
  surface.keptAs = std::move(welded.keptAs);
  surface.triangles = std::move(parts.triangles);
  surface.componentOf = std::move(parts.componentOf);
  surface.componentCorners = std::move(parts.cornerOf);
  for (const bool oriented : parts.oriented)
    surface.components.push_back({Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), oriented});
  // Each is its own component: no triangle shares the edge. They are added after the search for
  // components and cracks, which expects edges between two different vertices.
  for (const Triangle& line : welded.lines) {
    surface.triangles.push_back(line);
    surface.componentOf.push_back(-1);
    surface.componentCorners.push_back(line[0]);
  }
  arrange(surface);
  return finished(std::move(surface));
}

TriangleMesh TriangleMesh::moved(std::span<const Eigen::Vector3d> vertices) const {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&, vertices] { return moved(vertices); });
  }
  if (vertices.size() != data_->keptAs.size()) {
    std::ostringstream message;
    message << "mesh of " << data_->keptAs.size() << " vertices is moved to " << vertices.size();
    throw std::invalid_argument(message.str());
  }
  requireFinite(vertices);
  Surface surface = *data_;
  moveKept(vertices, surface.keptAs, surface.vertices);
  const std::vector<Eigen::Vector3d> corners = cornersOf(surface.vertices, surface.triangles);
  surface.bvh = std::make_shared<const detail::WideBvh>(data_->bvh->refitted({corners, 3}));
  if (surface.bvh->spread() > kRebuildGrowth * surface.builtSpread) arrange(surface);
  return finished(std::move(surface)).withSourceError(sourceError_);
}

TriangleMesh TriangleMesh::withSourceError(double error) const {
  if (!(error >= 0.0) || !std::isfinite(error)) {
    std::ostringstream message;
    message << "the source error of a mesh is " << error << "; allowed: finite and not negative";
    throw std::invalid_argument(message.str());
  }
  TriangleMesh mesh = *this;
  mesh.sourceError_ = error;
  return mesh;
}

TriangleMesh TriangleMesh::withEnclosingParts() const {
  if (detail::inForeignEnvironment())
    return inDefaultEnvironment([&] { return withEnclosingParts(); });
  TriangleMesh mesh = *this;
  auto parts = std::make_shared<const detail::EnclosingParts>(detail::enclosingParts(*this));
  if (!parts->nodes.empty()) mesh.enclosingParts_ = std::move(parts);
  return mesh;
}

/// Builds the hierarchy and puts the triangles, with their data, in the order of its leaves.
void TriangleMesh::arrange(Surface& surface) {
  std::vector<Eigen::Vector3d> corners = cornersOf(surface.vertices, surface.triangles);
  const auto tree = TreeTopology::build({corners, 3}, SurfaceAreaSplit{}, detail::WideNode::kLanes);
  std::vector<Triangle> triangles(tree.order.size());
  std::vector<int> componentOf(tree.order.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    triangles[i] = surface.triangles[tree.order[i]];
    componentOf[i] = surface.componentOf[tree.order[i]];
  }
  surface.triangles = std::move(triangles);
  surface.componentOf = std::move(componentOf);
  corners = cornersOf(surface.vertices, surface.triangles);
  surface.bvh = std::make_shared<const detail::WideBvh>(tree, PrimitivePoints{corners, 3});
  surface.builtSpread = surface.bvh->spread();
}

TriangleMesh TriangleMesh::finished(Surface surface) {
  const double infinity = std::numeric_limits<double>::infinity();
  std::vector<bool> oriented;
  for (Component& component : surface.components) {
    component.lower.setConstant(infinity);
    component.upper.setConstant(-infinity);
    oriented.push_back(component.oriented);
  }
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    if (surface.componentOf[i] < 0) continue;
    Component& component = surface.components[surface.componentOf[i]];
    for (int corner : surface.triangles[i]) {
      component.lower = component.lower.cwiseMin(surface.vertices[corner]);
      component.upper = component.upper.cwiseMax(surface.vertices[corner]);
    }
  }
  std::vector<Eigen::Vector3d> points;
  for (int corner : surface.componentCorners) points.push_back(surface.vertices[corner]);
  ConvexHull hull = ConvexHull::of(surface.vertices);
  ConvexHull coarseHull = ConvexHull::coarser(hull);
  std::vector<ConvexHull> solids;
  if (surface.interior == MeshInterior::Solid) {
    solids =
        detail::convexParts(surface.vertices, surface.triangles, surface.componentOf, oriented);
  }
  auto data = std::make_shared<Data>(Data{std::move(surface), std::move(points), std::move(hull),
                                          std::move(coarseHull), std::move(solids), 0.0});
  TriangleMesh mesh(data);
  data->concavity = estimateConcavity(mesh);
  return mesh;
}

}  // namespace swept
