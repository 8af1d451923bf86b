// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "bvh/wide_bvh.hpp"
#include "swept/core/convex_hull.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept::detail {

/// Convex bodies around a mesh, in its frame, as a tree: those of the root together contain the
/// mesh, and the children of a part what the mesh has in it. Where a mesh is not convex, they say
/// far more about what is near than its hull does.
struct EnclosingParts {
  struct Part {
    ConvexHull hull;
    double radius;      ///< m. The part is the hull grown by a ball of this radius.
    double concavity;   ///< m. Estimate of how far it reaches beyond the mesh; it proves nothing.
    int children = -1;  ///< the node with its children; -1: it has none
  };
  struct Node {
    std::vector<Part> parts;  ///< at most WideNode::kLanes
    WideNode boxes;  ///< of their hulls, without the radii; children are the numbers of the parts
  };
  std::vector<Node> nodes;  ///< the first is the root. Empty: the mesh is nearly convex
};

/// The space around the mesh is divided into boxes, by planes across its axes. Each part is the
/// hull of what is in one of them (the lemma is that of Cells). One box at a time is divided, where
/// that takes the most off the volume of the parts, until that is little; and then what is in each
/// of them, while the parts are far from convex.
EnclosingParts enclosingParts(const TriangleMesh& mesh);

}  // namespace swept::detail
