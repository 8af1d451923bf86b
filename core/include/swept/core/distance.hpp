// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>

#include "swept/core/shapes.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

/// Who answers.
enum class Backend : std::uint8_t {
  Native,  ///< our GJK: certified lower bounds
  Libccd,  ///< libccd for bounded pairs: no certified bound, `lower` is always 0; for comparison
};

/// When a query may stop, and where it starts.
struct DistanceOptions {
  /// m. Stop as soon as the distance is proven to exceed this.
  double enough = std::numeric_limits<double>::infinity();
  /// m. Stop as soon as two points at most this far apart are known.
  double contact = 0.0;
  /// m. Stop when upper - lower is at most this.
  double tolerance = tolerance::kDistance;
  /// Warm start: a direction from a to b in a's frame, such as the `normal` of a result for a pose
  /// nearby; zero if none is known. Changes the effort, not what is proven.
  Eigen::Vector3d guess = Eigen::Vector3d::Zero();
  Backend backend = Backend::Native;  ///< that answers
};

/// Euclidean distance between two solids, as an interval.
///
/// lower <= distance <= upper always holds, whichever criterion stopped the query: `lower` is
/// proven (rounding included), `upper` is witnessed by the two points. Overlap or touching gives
/// upper 0. After convergence upper - lower <= options.tolerance; on inputs so extreme that
/// rounding prevents it the interval is wider, and says so.
struct DistanceResult {
  double lower = 0.0;                                      ///< m
  double upper = std::numeric_limits<double>::infinity();  ///< m; infinity: no witness computed yet
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();        ///< m, on or in a, in a's frame
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();        ///< m, on or in b, in a's frame
  /// Unit vector in a's frame: a plane with this normal separates a (behind) from b (ahead) by
  /// `lower`. Zero when no single plane does (meshes, contact).
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  int iterations = 0;  ///< support evaluations, summed over convex pairs
};

/// Distance of `b` from `a`; pose of b in a's frame. Never throws on finite input. With a
/// non-finite pose the result is the widest interval, [0, infinity].
///
/// Here and in every query of the core a pose whose linear part R is not quite a rotation stands
/// for the rotation nearest to R (polar decomposition). One that is far from any, by more than 1e-3
/// in an entry of R^T R, is answered as a non-finite one.
DistanceResult distance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                        const DistanceOptions& options = {});

/// Whether two solids share a point: proven either way, or not known.
enum class Contact : std::uint8_t { Unknown, Separate, Touching };

/// Whether the solids share a point. `Unknown` only when they are within rounding of touching.
Contact collide(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                Backend backend = Backend::Native);

}  // namespace swept
