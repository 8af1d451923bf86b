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
}

/// What the closed parts of a mesh mean.
enum class MeshInterior : std::uint8_t {
  Solid,    ///< a point enclosed by a closed component belongs to the shape
  Surface,  ///< only the triangles count (Pan, Chitta, Manocha 2012, section III)
};

/// What building a mesh did to its input.
struct MeshReport {
  int verticesGiven = 0;      ///< to build()
  int verticesKept = 0;       ///< after welding equal positions and dropping unused ones
  int trianglesGiven = 0;     ///< to build()
  int degenerateDropped = 0;  ///< triangles with two equal corners, a line that others have
  int duplicatesDropped = 0;  ///< triangles with the corners of an earlier one, in any order
  int cracksFilled = 0;       ///< triangles that were added to close cracks
  double largestCrack = 0.0;  ///< m: no point of those is farther from a triangle given
  int closedComponents = 0;   ///< every edge shared by an even number of triangles
  int openComponents = 0;     ///< the others
};

/// Triangles with a hierarchy over them. Immutable; copies share the data.
///
/// A connected component (triangles joined by shared edges) in which every edge has an even number
/// of triangles, nearly always two, is closed. Of what is left build() makes closed components
/// where it finds solids: without the sheets that touch them, with cracks filled, and with walls
/// that divide them, once for each side. Under `MeshInterior::Solid` a point belongs to the shape
/// when it lies on a triangle or inside any closed component, whichever way its triangles are
/// oriented; cavities formed by a component inside another are filled. Inside a component means:
/// its winding number is not zero when its triangles are consistently oriented (so where it
/// overlaps itself is inside), else a ray from the point crosses it an odd number of times. Open
/// components are surfaces. A triangle with the corners of an earlier one is dropped, except in a
/// component that only such ones close (boxes that share a face). One with two equal corners is a
/// line, with three a point: dropped where another has that edge or corner, else a component by
/// itself, open, and {a, b, b} or {a, a, a} among triangles().
class TriangleMesh {
 public:
  using Triangle = Eigen::Vector3i;  ///< indices into vertices()

  /// The `crackWidth` of build() for these vertices (m): 1e-5 of the longest side of their box, as
  /// six digits leave of the corners of a solid, and no less than two steps of single precision
  /// where coordinates are largest. Throws std::invalid_argument for a vertex that is not finite.
  static double usualCrackWidth(std::span<const Eigen::Vector3d> vertices);

  /// Equal positions become one vertex. Others stay apart, but what only they leave open is closed.
  /// Programs that write meshes round the corners of each triangle by themselves, and divide an
  /// edge on one side of it only (T-junctions): the surface of a solid has cracks then, or edges
  /// that do not pair where there is no gap.
  ///
  /// Corners of open edges that lie within `crackWidth` (m; usualCrackWidth() without one, 0: none)
  /// of each other along each axis are taken for one corner, and one that lies as near to an open
  /// edge is taken to divide it. Where the edges pair then, thin triangles between them fill what
  /// is open. No vertex moves. The shape grows by what is enclosed then, and otherwise by no more
  /// than MeshReport::largestCrack, which is at most 5 `crackWidth`. Components stay as they are
  /// where an edge has no partner: around a hole, and those that would close together with them.
  ///
  /// Throws std::invalid_argument for an index out of range, a non-finite vertex, when no triangle
  /// with three distinct corners is left, and for a `crackWidth` that is negative or not finite.
  static TriangleMesh build(std::span<const Eigen::Vector3d> vertices,
                            std::span<const Triangle> triangles,
                            MeshInterior interior = MeshInterior::Solid,
                            std::optional<double> crackWidth = std::nullopt);

  /// The same triangles with their vertices elsewhere: the next frame of a surface that deforms.
  /// `vertices` (m): as many as build() got, in that order. What is connected stays so and nothing
  /// else becomes so: vertices that come to lie on each other are not joined, triangles that lose
  /// their area are kept. Takes linear time but for the hull; the hierarchy keeps its order, or is
  /// built anew where deformation made its boxes large.
  ///
  /// Throws std::invalid_argument for another number of vertices, a coordinate that is not finite,
  /// and vertices that were equal for build() and no longer are. sourceError() stays.
  TriangleMesh moved(std::span<const Eigen::Vector3d> vertices) const;

  const std::vector<Eigen::Vector3d>& vertices() const { return data_->vertices; }  ///< m
  /// In the order of the hierarchy, not that of build().
  const std::vector<Triangle>& triangles() const { return data_->triangles; }
  /// What build() did; moved() leaves it as it was.
  const MeshReport& report() const { return data_->report; }
  /// What closed components mean.
  MeshInterior interior() const { return data_->interior; }
  /// True when every component is closed.
  bool isClosed() const { return data_->report.openComponents == 0; }
  /// m. How wide the cracks are that build() would have to fill to leave no component open: a
  /// `crackWidth` that does, no more than twice one that does not. 0 when isClosed(); infinity when
  /// a tenth of the longest side of the mesh would not do. Takes a few times as long as build().
  double opening() const;

  /// The same mesh, of which no point is farther than `error` (m) from where what it was made of
  /// has it: of a file that was read in less than double precision, say. Queries of core's answer
  /// for the mesh as it is; a Checker takes the error for rounding. Throws std::invalid_argument
  /// for one that is negative or not finite.
  TriangleMesh withSourceError(double error) const;
  double sourceError() const { return sourceError_; }  ///< m; 0 unless somebody knows better

  /// Whether the solid contains `point` (m, mesh frame). Always false under `Surface` and for open
  /// components, and for a non-finite point. Proven unless `point` is within rounding (about 1e-14
  /// of the largest distance from it to the mesh) of a triangle, where either answer may come.
  /// Allocates nothing unless the boxes of more than 64 closed components contain the point.
  bool encloses(const Eigen::Vector3d& point) const;

  /// m. Estimate of how far the hull reaches beyond the mesh; guides searches, proves nothing.
  double concavity() const { return data_->concavity; }
  /// Hull of the vertices: an outer bound of the solid.
  const ConvexHull& hull() const { return data_->hull; }
  /// The same, but of few points and with an error() to match: quick to ask.
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
};

}  // namespace swept
