// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <limits>

#include "geometry/simplex.hpp"
#include "narrowphase/convex.hpp"
#include "narrowphase/part_approach.hpp"
#include "swept/core/distance.hpp"

namespace swept::detail {

/// The separation along n that satisfies a query: a constant, or a motion bound.
class Goal {
 public:
  explicit Goal(double constant) : constant_(constant) {}
  explicit Goal(const PartApproach& approach) : approach_(&approach) {}
  double along(const Eigen::Vector3d& n) const {
    return approach_ ? approach_->along(n) : constant_;
  }

 private:
  const PartApproach* approach_ = nullptr;
  double constant_ = 0.0;
};

/// How far a query continues once its goal is out of reach (the distance is not above the required
/// one).
enum class GjkMode : std::uint8_t {
  Exact,      ///< to convergence
  GoalOnly,   ///< only until contact is decided
  BoundOnly,  ///< not at all
};

struct GjkResult {
  bool satisfied = false;  ///< the goal is exceeded along `normal`
  double lower = 0.0;      ///< m, proven
  double upper =
      std::numeric_limits<double>::infinity();       ///< m, witnessed unless `satisfied` came first
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, a's frame
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, a's frame
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< from a to b; proves `lower`
  int iterations = 0;
};

/// Gilbert, Johnson, Keerthi (1988) on B - A, with the lower bound n . support(n) of each iteration
/// kept as the certificate. Stops when the goal is exceeded, when points at most `contact` apart
/// are found, when upper - lower <= tolerance, or when rounding allows no more progress.
/// `last`, if given, receives the simplex that holds the nearest point of the cores.
GjkResult gjk(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
              const Eigen::Vector3d& guess, const Goal& goal, double contact, double tolerance,
              GjkMode mode, Simplex* last = nullptr);

/// Whether two cores share a point, without the work that only a distance needs: the same descent
/// by signs alone. `Separate` is proven; `Unknown` if rounding or slow convergence leaves the
/// answer to gjk(). The balls around the cores are ignored.
Contact meet(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b);

}  // namespace swept::detail
