// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>

#include "swept/core/shapes.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

/// The algorithm that answers a query.
enum class Backend : std::uint8_t {
  Native,  ///< our GJK: certified lower bounds
  Libccd,  ///< libccd for bounded pairs: proves nothing, `lower` is always 0; for comparison
};

/// When a distance query may stop, and where it starts.
struct DistanceOptions {
  /// m. The query stops as soon as the distance is proven to exceed this.
  double enough = std::numeric_limits<double>::infinity();
  /// m. The query stops as soon as it knows two points at most this far apart.
  double contact = 0.0;
  /// m. The query stops when upper - lower is at most this.
  double tolerance = tolerance::kDistance;
  /// Warm start: a direction from a to b in a's frame, such as the `normal` of a result for a
  /// nearby pose; zero if none is known. It changes the effort, not what is proven.
  Eigen::Vector3d guess = Eigen::Vector3d::Zero();
  Backend backend = Backend::Native;  ///< the algorithm
};

/// Euclidean distance between two solids, as an interval.
///
/// lower <= distance <= upper always holds, whichever criterion stopped the query: `lower` is
/// proven (rounding included), and the two points witness `upper`. Overlap or touching gives upper
/// 0. After convergence upper - lower <= options.tolerance; on inputs so extreme that rounding
/// prevents it, the interval is wider.
struct DistanceResult {
  double lower = 0.0;                                      ///< m
  double upper = std::numeric_limits<double>::infinity();  ///< m; infinity: no witness computed yet
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, witness point on or in a, in a's frame
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, witness point on or in b, in a's frame
  /// Unit vector in a's frame: a plane with this normal separates a (behind) from b (ahead) by
  /// `lower`. Zero when no single plane does (meshes, contact).
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  int iterations = 0;  ///< support evaluations, summed over convex pairs
};

/// Distance (m) between `a` and `b`, where `a_from_b` is the pose of b in a's frame. Never throws
/// on finite input. A non-finite pose gives the widest interval, [0, infinity].
///
/// If the linear part R of a pose is not quite a rotation, this and every other query of the core
/// uses the nearest rotation (polar decomposition). If R^T R is off by more than 1e-3 in an entry,
/// the pose counts as non-finite.
DistanceResult distance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                        const DistanceOptions& options = {});

/// Whether two solids share a point: proven either way, or unknown.
enum class Contact : std::uint8_t { Unknown, Separate, Touching };

/// Whether the solids share a point. `a_from_b` is the pose of b in a's frame. `Unknown` only if
/// they are within rounding of touching.
Contact collide(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                Backend backend = Backend::Native);

}  // namespace swept
