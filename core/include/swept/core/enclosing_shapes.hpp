// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "swept/core/enclosing_spheres.hpp"
#include "swept/core/shapes.hpp"

/// Few capsules, boxes or convex hulls that together contain a rigid body.
namespace swept {

/// What a body is contained in.
enum class EnclosingKind { Capsule, Box, Convex };

/// Shapes that contain a body.
struct EnclosingShapes {
  /// `Capsule`, `Box` or `ConvexHull`, each a little larger than it has to be: its numbers and
  /// those of its pose may be rounded to single precision. Together they contain the body: proven.
  /// The pose of a hull is the identity.
  std::vector<PosedShape> shapes;
  /// m. No sampled point of a shape's surface is farther from the body. shapesExcess() proves more.
  double reach = 0.0;
};

/// The work of a search.
struct EnclosingShapesOptions {
  int pieces = 140;  ///< that the body is divided into before they are joined; at least 1
};

/// Searches for convex shapes that contain a body: as a solid where its meshes are closed.
///
/// The body is divided into pieces, each in the hull of a few points. Two neighbours are joined at
/// a time, those whose common shape reaches least beyond the body (agglomerative clustering). So
/// there is a tree of shapes, from one for each piece to one for all, and each reach and each
/// number of shapes is a cut through it. In the end, pieces that two shapes share are divided, and
/// the shape that reaches farther keeps what the other does not contain. Each shape is measured to
/// contain its pieces whole, rounding included.
///
/// A `stop` that is true ends a call soon, as for EnclosingSpheresSearch: SearchStopped.
///
/// One thread at a time may use a search.
class EnclosingShapesSearch {
 public:
  /// Throws std::invalid_argument for a body without shapes, planes and half-spaces, and for
  /// options out of range.
  EnclosingShapesSearch(std::span<const PosedShape> body, EnclosingKind kind,
                        const EnclosingShapesOptions& options = {}, const StopQuestion& stop = {});
  ~EnclosingShapesSearch();
  EnclosingShapesSearch(EnclosingShapesSearch&&) noexcept;
  EnclosingShapesSearch& operator=(EnclosingShapesSearch&&) noexcept;

  /// How many shapes are needed so that none reaches farther than this (m) beyond the body, by
  /// samples of their surface.
  int countFor(double reach) const;
  /// m. How far at most so many shapes reach, before shared pieces are divided. Throws
  /// std::invalid_argument for less than one, as atMost().
  double reachFor(int count) const;
  /// At most `count` shapes, with a small reach.
  EnclosingShapes atMost(int count, const StopQuestion& stop = {});
  /// Few shapes. None reaches farther than `reach` (m) beyond the body, proven by shapesExcess(),
  /// if the pieces are small enough for it. Throws std::invalid_argument unless it is above 0.
  EnclosingShapes within(double reach, const StopQuestion& stop = {});

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// As outsideSpheres(), for spheres, boxes, capsules, cylinders, hulls, and meshes that are
/// star-shaped about the mean of their vertices, such as convex ones. How far a point is outside a
/// hull or a mesh is the largest distance that it is in front of one of its faces: so all faces
/// have to move outward by `upper`. A hull or mesh whose faces rounding does not tell apart
/// contains nothing. Throws std::invalid_argument for shapes of other types.
OutsideSpheres outsideShapes(std::span<const PosedShape> body, std::span<const PosedShape> shapes,
                             const OutsideSpheresOptions& options = {});

/// As sphereExcess(), for the same shapes as outsideShapes(), each grown by `growth` (m).
SphereExcess shapesExcess(std::span<const PosedShape> body, std::span<const PosedShape> shapes,
                          double growth = 0.0, const SphereExcessOptions& options = {});

}  // namespace swept
