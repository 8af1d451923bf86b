// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swept/core/convex_hull.hpp"

namespace swept {

namespace detail {
class WideBvh;
struct EnclosingParts;
}  // namespace detail

/// The meaning of the closed parts of a mesh.
enum class MeshInterior : std::uint8_t {
  Solid,    ///< a point enclosed by a closed component belongs to the shape
  Surface,  ///< only the triangles count (Pan, Chitta, Manocha 2012, section III)
};

/// What build() did to its input.
struct MeshReport {
  int verticesGiven = 0;      ///< to build()
  int verticesKept = 0;       ///< after welding equal positions and dropping unused ones
  int trianglesGiven = 0;     ///< to build()
  int degenerateDropped = 0;  ///< triangles with two equal corners, whose line is another's edge
  int duplicatesDropped = 0;  ///< triangles with the corners of an earlier one, in any order
  int cracksFilled = 0;       ///< triangles that were added to close cracks
  double largestCrack = 0.0;  ///< m: no point of the added ones is farther from a given triangle
  int closedComponents = 0;   ///< every edge shared by an even number of triangles
  int openComponents = 0;     ///< the others
};

/// Triangles with a hierarchy over them. Immutable; copies share the data.
///
/// A connected component (triangles joined by shared edges) is closed if every edge has an even
/// number of triangles, nearly always two. From the rest, build() makes closed components where it
/// finds solids: without the sheets that touch them, with cracks filled, and with dividing walls
/// counted once for each side.
///
/// Under `MeshInterior::Solid` a point belongs to the shape if it lies on a triangle or inside any
/// closed component, whichever way its triangles are oriented. Cavities formed by a component
/// inside another are filled. If the triangles of a component are consistently oriented, "inside"
/// means that the winding number is not zero (so a component that overlaps itself is solid there).
/// Otherwise it means that a ray from the point crosses the component an odd number of times. Open
/// components are surfaces.
///
/// A triangle with the corners of an earlier one is dropped, except in a component that only such
/// triangles close (boxes that share a face). A triangle with two equal corners is a line, with
/// three a point. It is dropped if another triangle has that edge or corner. Otherwise it is an
/// open component of its own, and {a, b, b} or {a, a, a} among triangles().
class TriangleMesh {
 public:
  using Triangle = Eigen::Vector3i;  ///< indices into vertices()

  /// m. The default `crackWidth` of build() for these vertices: 1e-5 of the longest side of their
  /// box, as six digits leave for the corners of a solid, and at least two steps of single
  /// precision at the largest coordinate. Throws std::invalid_argument for a non-finite vertex.
  static double usualCrackWidth(std::span<const Eigen::Vector3d> vertices);

  /// Builds a mesh of triangles over `vertices` (m). Equal positions become one vertex; other
  /// positions stay apart.
  ///
  /// Openings that only separate positions leave are closed. Programs that write meshes round the
  /// corners of each triangle separately, and divide an edge on one side of it only (T-junctions).
  /// The surface of a solid then has cracks, or edges that do not pair although there is no gap.
  ///
  /// Corners of open edges within `crackWidth` (m; default usualCrackWidth(), 0: none) of each
  /// other along each axis count as one corner. A corner as near to an open edge divides it. If the
  /// edges then pair, thin triangles between them fill the opening. No vertex moves. The shape
  /// grows by the space that is then enclosed, and otherwise by at most MeshReport::largestCrack,
  /// which is at most 5 `crackWidth`. Components do not change if an edge has no partner: around a
  /// hole, and in components that would close only together with them.
  ///
  /// Throws std::invalid_argument for an index out of range, a non-finite vertex, if no triangle
  /// with three distinct corners is left, and for a `crackWidth` that is negative or not finite.
  static TriangleMesh build(std::span<const Eigen::Vector3d> vertices,
                            std::span<const Triangle> triangles,
                            MeshInterior interior = MeshInterior::Solid,
                            std::optional<double> crackWidth = std::nullopt);

  /// The same triangles with moved vertices: the next frame of a surface that deforms. `vertices`
  /// (m) has as many elements as build() got, in that order. The connectivity does not change:
  /// vertices that come to lie on each other are not joined, and triangles that lose their area are
  /// kept. Takes linear time except for the hull. The hierarchy keeps its order, or is rebuilt if
  /// deformation made its boxes large. sourceError() stays.
  ///
  /// Throws std::invalid_argument for another number of vertices, a non-finite coordinate, and
  /// vertices that were equal for build() and no longer are.
  TriangleMesh moved(std::span<const Eigen::Vector3d> vertices) const;

  const std::vector<Eigen::Vector3d>& vertices() const { return data_->vertices; }  ///< m
  /// In the order of the hierarchy, not that of build().
  const std::vector<Triangle>& triangles() const { return data_->triangles; }
  /// What build() did; moved() does not change it.
  const MeshReport& report() const { return data_->report; }
  /// The meaning of closed components.
  MeshInterior interior() const { return data_->interior; }
  /// True when every component is closed.
  bool isClosed() const { return data_->report.openComponents == 0; }
  /// m. Width of the cracks that build() would have to fill to leave no component open: a
  /// `crackWidth` that is enough, at most twice one that is not. 0 if isClosed(); infinity if a
  /// tenth of the longest side of the mesh is not enough. Takes a few times as long as build().
  double opening() const;

  /// The same mesh with a known error: no point is farther than `error` (m) from its place in the
  /// source, such as a file that was read in less than double precision. Queries of core ignore it;
  /// a Checker counts it as rounding. Throws std::invalid_argument for an error that is negative or
  /// not finite.
  TriangleMesh withSourceError(double error) const;
  double sourceError() const { return sourceError_; }  ///< m; 0 unless set by withSourceError()

  /// The same mesh with at most eight convex parts that together contain it, and as many in each:
  /// separate() asks them before the triangles. A mesh that is nearly convex gets none. Takes some
  /// 20 ms for a thousand triangles, 0.15 s for forty thousand. moved() drops them.
  TriangleMesh withEnclosingParts() const;
  /// For the queries; null without parts.
  const detail::EnclosingParts* enclosingParts() const { return enclosingParts_.get(); }

  /// Whether the solid contains `point` (m, mesh frame). Always false under `Surface`, for open
  /// components, and for a non-finite point. Proven unless `point` is within rounding (about 1e-14
  /// of the largest distance from it to the mesh) of a triangle; then the answer may be either.
  /// Allocates nothing unless the boxes of more than 64 closed components contain the point.
  bool encloses(const Eigen::Vector3d& point) const;

  /// m. Estimate of how far the hull reaches beyond the mesh. It guides searches and proves
  /// nothing.
  double concavity() const { return data_->concavity; }
  /// Hull of the vertices: an outer bound of the solid.
  const ConvexHull& hull() const { return data_->hull; }
  /// A hull with few points and a matching error(), for fast queries.
  const ConvexHull& coarseHull() const { return data_->coarseHull; }
  /// One vertex of each connected component, open or closed (m).
  std::span<const Eigen::Vector3d> componentPoints() const { return data_->componentPoints; }
  /// The closed components that are convex solids; none under `Surface`. Their penetration is
  /// exact.
  std::span<const ConvexHull> convexParts() const { return data_->convexParts; }
  /// The hierarchy, for the queries.
  const detail::WideBvh& bvh() const { return *data_->bvh; }

 private:
  /// A closed component.
  struct Component {
    Eigen::Vector3d lower;  ///< m, corner of its box
    Eigen::Vector3d upper;  ///< m
    bool oriented;          ///< its winding number is defined
  };
  struct Surface {
    std::vector<Eigen::Vector3d> vertices;
    std::vector<Triangle> triangles;    ///< in the hierarchy's leaf order
    std::vector<int> componentOf;       ///< per triangle; -1 when its component is open
    std::vector<Component> components;  ///< the closed ones
    std::vector<int> componentCorners;  ///< a vertex of each component, open or closed
    std::vector<int> keptAs;            ///< per vertex given to build(): index; -1: not used
    MeshReport report;
    MeshInterior interior = MeshInterior::Solid;
    std::shared_ptr<const detail::WideBvh> bvh;
    double builtSpread = 0.0;  ///< WideBvh::spread() when the hierarchy's order was chosen
  };
  /// With what follows from it.
  struct Data : Surface {
    std::vector<Eigen::Vector3d> componentPoints;
    ConvexHull hull;
    ConvexHull coarseHull;
    std::vector<ConvexHull> convexParts;
    double concavity = 0.0;
  };
  static void arrange(Surface& surface);
  static TriangleMesh finished(Surface surface);
  explicit TriangleMesh(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
  double sourceError_ = 0.0;
  std::shared_ptr<const detail::EnclosingParts> enclosingParts_;
};

}  // namespace swept
