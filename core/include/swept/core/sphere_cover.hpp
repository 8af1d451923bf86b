// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "swept/core/shapes.hpp"

namespace swept {

/// The resolution of a cover, and its largest size.
struct SphereCoverOptions {
  /// m. No ball of the finest level should reach farther beyond the shape than this.
  double finestOverhang = 0.0;
  /// The same, relative to the radius of the first ball. The larger of both is the aim, but at
  /// least 1e-3 of the radius, so that a cover stays finite.
  double finestRelative = 1.0 / 32.0;
  int mostBalls = 4096;     ///< a level that would exceed this number of balls is left out
  int mostInnerBalls = 16;  ///< largest size of SphereCover::inner; 0: none are searched
};

/// A ball in single precision, for SIMD kernels.
struct CoverBall {
  Eigen::Vector3f center;  ///< m, in the shape's frame
  float radius;            ///< m
};

/// Balls that contain a shape, as a tree from coarse to fine, and balls inside it.
///
/// Proven, rounding included: each point of the shape is in the ball of some leaf and in the balls
/// of all ancestors of that leaf. So any set of nodes that meets every path from the root to a leaf
/// covers the shape. A closed mesh is covered with its interior; an open one is a surface.
struct SphereCover {
  /// A ball of the tree.
  struct Node {
    CoverBall ball;  ///< contains the part of the shape that the leaves below it cover
    float overhang;  ///< m, proven: no point of the ball is farther than this from the shape
    /// m. How far the ball reaches beyond the shape with its pockets filled. Collision meshes are
    /// often open shells. No body gets into a shell without crossing it, so large balls may fill
    /// it. A pocket is a region that a grid of 48 cells along the mesh shuts off from the outside.
    /// So this is an estimate for open meshes with a pocket, and equals `overhang` otherwise.
    float beyond;
    /// m, proven: the ball of this radius around the same centre lies in the shape, within one of
    /// its closed components (or balls, for a cloud). Negative: none is known.
    float inside;
    int level;       ///< 0 at the root; children may skip levels
    int firstChild;  ///< children are consecutive nodes
    int childCount;  ///< 0: a leaf
  };
  /// Describes the set of nodes `cut(level)`.
  struct Level {
    double aimed;            ///< m, `beyond` that the level was built for
    int ballCount = 0;       ///< nodes of the cut
    double largestOverhang;  ///< m, proven. More than `aimed` only if an open mesh has a pocket,
                             ///< for a cloud by the difference of its radii, and on inputs so
                             ///< extreme that rounding or the cap on work counts
  };

  std::vector<Node> nodes;    ///< parents before children; node 0 is the root
  std::vector<Level> levels;  ///< from coarse to fine
  /// Balls wholly inside the solid, largest first. Each reaches beyond those before by half its
  /// radius. Empty for surfaces.
  std::vector<CoverBall> inner;

  /// Indices of the nodes that cover the shape at a level: the last node of each path with at most
  /// that level.
  std::vector<int> cut(int level) const;
};

/// Builds a cover in the shape's frame; the same input gives the same cover. Throws
/// std::invalid_argument, naming the shape, for planes and half-spaces, and naming the value for
/// options below 0 (`mostBalls`: 1) or NaN. Shapes smaller than 1e-15 m, or that reach farther than
/// 1e15 m, get a single ball.
SphereCover sphereCover(const Shape& shape, const SphereCoverOptions& options = {});

}  // namespace swept
