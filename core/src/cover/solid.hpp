// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cover/nearest.hpp"
#include "cover/pockets.hpp"
#include "mesh/closed_component.hpp"
#include "swept/core/bvh/bv_tree.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// A candidate centre of a ball.
struct Candidate {
  Eigen::Vector3d center;  ///< m
  /// m. Positive inside: the ball of this radius is part of the solid. Negative outside: some point
  /// of the shape is this near.
  double depth;
  /// The depth counts pockets as filled, and is not proven.
  bool inPocket = false;
};

/// Points that the last balls touched, to start the next search: nearby points shrink the ball as a
/// search would. The ball found is proven in any case.
struct Contacts {
  const Nearest* of = nullptr;            ///< the search that they belong to
  std::array<Eigen::Vector3d, 8> points;  ///< m
  int count = 0;
  int next = 0;
  void add(const Eigen::Vector3d& point) {
    points[next] = point;
    next = (next + 1) % static_cast<int>(points.size());
    count = std::min(count + 1, static_cast<int>(points.size()));
  }
};

/// The input of a cover: triangles (those of a mesh, or of a polyhedron that contains a convex
/// shape) or points, each grown by a radius.
///
/// Lemma (convex shapes): let the polyhedron P contain the shape S and be contained in S grown by
/// s. If a ball of radius d is in P, one of radius d - s is in S (cancel the ball of radius s on
/// both sides of B(d - s) + B(s) within S + B(s): Radstrom 1952). If a point is at distance d from
/// P, it is at most d + s from S. So depths in S are at least those in P minus `slack`.
class Solid {
 public:
  /// Throws std::invalid_argument for planes and half-spaces.
  explicit Solid(const Shape& shape);
  Solid(const Solid&) = delete;
  Solid& operator=(const Solid&) = delete;

  std::span<const Eigen::Vector3d> vertices() const;
  /// Empty for points.
  std::span<const Eigen::Vector3i> triangles() const;

  /// False for surfaces without pockets, flat shapes and points: they contain no ball.
  bool hasDepth() const { return (hasInside_ && !isFlat_) || pockets_; }
  /// Whether anything is enclosed.
  bool hasInside() const { return hasInside_; }
  /// Proven, up to the rounding that TriangleMesh::encloses() describes.
  bool encloses(const Eigen::Vector3d& p) const { return mesh_ && mesh_->encloses(p); }
  /// Proven lower bound. `near`: m, an upper bound on the distance to the surface, as far as known;
  /// it shortens the search.
  Candidate at(const Eigen::Vector3d& p,
               double near = std::numeric_limits<double>::infinity()) const;
  /// m, depth of `at()` without pockets: always proven.
  double depth(const Eigen::Vector3d& p,
               double near = std::numeric_limits<double>::infinity()) const;
  /// The result of at() for a point that is known to be enclosed.
  Candidate inside(const Eigen::Vector3d& p) const;
  /// A ball of at most `radius` (m) inside the solid, or in a pocket, that touches the surface at
  /// `foot`, a point of a triangle; none if there is no room, and for triangles in a pocket.
  std::optional<Candidate> inscribed(const Eigen::Vector3d& foot, int triangle, double radius,
                                     Contacts& contacts) const;
  /// m, proven: no point of the ball is farther than this from the shape.
  double overhang(const Candidate& candidate, double radius) const;

  double inflation() const { return inflation_; }  ///< m, radius of what is around the points
  /// m. The points or triangles, grown by inflation(), lie in the shape grown by this.
  double slack() const { return slack_; }
  /// m. Rounding of clipped points, and the error of a hull: must be added to radii.
  double pad() const { return pad_; }
  double scale() const { return scale_; }  ///< m, no coordinate is larger

 private:
  void useHull(const ConvexHull& hull, double slack);
  void usePoints(std::span<const Eigen::Vector3d> points, double radius);
  /// Triangles with a tree over them.
  struct Surface {
    Surface(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> unordered);
    std::vector<Eigen::Vector3i> triangles;  ///< in the order of the tree's leaves
    WideBvh bvh;
    Nearest nearest;

   private:
    Surface(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> unordered,
            const TreeTopology& tree);
  };
  /// One closed component of several. It is part of the solid whatever the others are inside it.
  struct Shell {
    Shell(std::span<const Eigen::Vector3d> vertices, std::span<const Eigen::Vector3i> unordered,
          const Aabb& box, bool oriented);
    Surface surface;
    ClosedComponent component;
    bool encloses(const Eigen::Vector3d& p) const { return detail::encloses(component, p); }
  };
  /// The bounds of a ball: triangles, and the component that it must stay in, if there is one.
  struct Hollow {
    const Nearest& nearest;
    const Shell* shell;
  };

  void findPockets();
  void findShells();
  /// m, depth of an enclosed point that is this far from the nearest triangle.
  double depthIn(const Eigen::Vector3d& p, double toTriangles) const;
  /// `wrongSide` receives whether there was room on that side, but outside.
  std::optional<Candidate> inscribedAlong(const Eigen::Vector3d& foot,
                                          const Eigen::Vector3d& inward, double radius,
                                          const Hollow& hollow, Contacts& contacts,
                                          bool& wrongSide) const;
  double farthestFromSurface(const Eigen::Vector3d& center, double radius, double atCenter) const;

  std::optional<TriangleMesh> mesh_;
  std::optional<PointCloud> cloud_;
  std::optional<Nearest> nearest_;
  std::optional<Pockets> pockets_;
  std::unique_ptr<const Surface> skin_;               ///< of the pockets
  std::vector<std::unique_ptr<const Shell>> shells_;  ///< the large ones; none: a single component
  std::vector<int> shellOf_;                          ///< per triangle; -1: none
  bool isFlat_ = false;
  bool hasInside_ = false;  ///< some component is closed
  double inflation_ = 0.0;
  double slack_ = 0.0;
  double pad_ = 0.0;
  double scale_ = 0.0;
};

}  // namespace swept::detail
