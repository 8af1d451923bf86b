// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "model.hpp"

namespace swept::verify {

/// What was shown of a model that contains the links of a robot or the bodies of a scene.
struct CoverSummary {
  std::size_t links = 0;   ///< that are contained
  std::size_t shapes = 0;  ///< that contain them
  std::size_t cells = 0;   ///< that the links were divided into
};

/// Shows that each body is in the union of its shapes: with all that is inside its closed meshes.
/// Nothing of the search for the shapes is trusted or read.
///
/// `bodies`: a list, each with `name` and `shapes` as a model's bodies have them. `cover`: `links`,
/// each with `link` and `spheres` of [x, y, z, radius], or `shapes` (`sphere`, `box`, `cylinder`,
/// `capsule`, `convex`) as `swept cover` writes them; or `bodies`, each with `body`, likewise. m.
///
/// A point is in a hull if it is behind all of some triangles between the hull's vertices, of which
/// each edge is passed as often one way as the other: each triangle then turns around the point by
/// an angle of the same sign, so together they go around it, and a closed surface goes around no
/// point outside of a convex set that it lies in.
///
/// A cell is the hull of points. It is in a convex shape if all of its points are; else it is
/// halved. Triangles are halved as they are; boxes and round shapes in coordinates of their own,
/// with the corners of each part moved outward so that their hull contains it. A solid mesh is
/// divided by boxes, with its triangles clipped: what is in a box C of a solid S is in the hull of
/// the surface in C and the corners of C in S, since a linear function that is largest over S in C
/// at no point of the surface is so on the face of C through such a point, to where that face ends
/// or meets the surface. A corner whose side cannot be told counts as inside.
///
/// Throws Refusal, which names the link and a place, for what is not shown with 10 million cells.
CoverSummary checkCover(const Json& cover, const Json& bodies);

}  // namespace swept::verify
