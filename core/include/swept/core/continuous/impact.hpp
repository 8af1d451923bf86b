// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "swept/core/verdict.hpp"

namespace swept {

/// A point that goes straight, at constant speed, from t = 0 to t = 1.
struct LinearPath {
  Eigen::Vector3d start;  ///< m
  Eigen::Vector3d end;    ///< m
};

/// What counts as contact of two features, and until when.
struct ImpactOptions {
  double separation = 0.0;  ///< m, >= 0. Closer than this, or as close, is contact.
  /// m. Features that keep more than separation + tolerance are Free, and contactBy - freeUntil is
  /// at most this much relative motion. At least tolerance::kImpact of the largest difference of
  /// two coordinates, a point's of one feature and one's of the other, is taken.
  double tolerance = 1e-6;
  double before = 1.0;  ///< in [0, 1]; only contacts up to this t are of interest
};

/// First contact of two features that move linearly.
struct Impact {
  /// Free: proven for t in [0, before], rounding included. Collision: at contactBy two points, one
  /// of each, are at most separation + tolerance apart. Undecided: an input is not finite, or after
  /// tolerance::kMaxImpactTests intervals of time; then freeUntil is where that was.
  Verdict verdict = Verdict::Undecided;
  double freeUntil = 0.0;  ///< proven: more than the separation apart on [0, freeUntil)
  double contactBy = 1.0;  ///< a t at which they are that close; 1 unless Collision
};

/// Features of any shape: triangles without area, edges of no length, parallel edges, coplanar or
/// no motion. Nothing is allocated.
///
/// Corners of the face: a triangle at every t, perhaps a degenerate one.
Impact vertexFaceImpact(const LinearPath& vertex, const std::array<LinearPath, 3>& face,
                        const ImpactOptions& options = {});
/// The same for two edges, given by their ends.
Impact edgeEdgeImpact(const std::array<LinearPath, 2>& first,
                      const std::array<LinearPath, 2>& second, const ImpactOptions& options = {});

}  // namespace swept
