// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

#include "swept/core/verdict.hpp"

namespace swept {

/// A point that moves straight, at constant speed, from t = 0 to t = 1.
struct LinearPath {
  Eigen::Vector3d start;  ///< m
  Eigen::Vector3d end;    ///< m
};

/// What counts as contact of two features, and until when.
struct ImpactOptions {
  double separation = 0.0;  ///< m, >= 0. Closer than this, or as close, is contact.
  /// m. Features that keep more than separation + tolerance are Free, and contactBy - freeUntil is
  /// at most this much relative motion. The least tolerance used is tolerance::kImpact times the
  /// largest difference of two coordinates, one of a point of each feature.
  double tolerance = 1e-6;
  double before = 1.0;  ///< in [0, 1]; only contacts up to this t are searched
};

/// First contact of two features that move linearly.
struct Impact {
  /// Free: proven for t in [0, before], rounding included. Collision: at contactBy two points, one
  /// of each feature, are at most separation + tolerance apart. Undecided: an input is not finite,
  /// or the search stopped after tolerance::kMaxImpactTests time intervals, at freeUntil.
  Verdict verdict = Verdict::Undecided;
  double freeUntil = 0.0;  ///< proven: more than the separation apart on [0, freeUntil)
  double contactBy = 1.0;  ///< a t at which they are that close; 1 unless Collision
};

/// First contact of a vertex and a face whose corners move linearly: a triangle at every t,
/// possibly a degenerate one. All positions in one frame, m.
///
/// This and edgeEdgeImpact() accept features of any shape: triangles without area, edges of length
/// zero, parallel edges, coplanar motion or none. They allocate nothing and never throw.
Impact vertexFaceImpact(const LinearPath& vertex, const std::array<LinearPath, 3>& face,
                        const ImpactOptions& options = {});
/// First contact of two edges, given by their moving ends.
Impact edgeEdgeImpact(const std::array<LinearPath, 2>& first,
                      const std::array<LinearPath, 2>& second, const ImpactOptions& options = {});

}  // namespace swept
