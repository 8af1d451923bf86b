// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/distance.hpp"

#include "narrowphase/libccd_backend.hpp"
#include "narrowphase/piecewise.hpp"

namespace swept {

DistanceResult distance(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                        const DistanceOptions& options) {
  if (!a_from_b.matrix().allFinite()) return {};
  if (options.backend == Backend::Libccd) return detail::libccdDistance(a, b, a_from_b, options);

  detail::PieceGoal goal;
  goal.enough = options.enough;
  goal.contact = options.contact;
  goal.tolerance = options.tolerance;
  const detail::PieceResult found = detail::searchPieces(detail::Side::of(a), detail::Side::of(b),
                                                         a_from_b, Eigen::Vector3d::Zero(), goal);
  DistanceResult result;
  result.lower = found.lower;
  result.upper = found.upper;
  result.pointA = found.pointA;
  result.pointB = found.pointB;
  result.normal = found.normal;
  result.iterations = found.iterations;
  return result;
}

Contact collide(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                Backend backend) {
  if (!a_from_b.matrix().allFinite()) return Contact::Unknown;
  if (backend == Backend::Libccd) {
    return detail::libccdIntersect(a, b, a_from_b) ? Contact::Touching : Contact::Separate;
  }
  DistanceOptions options;
  options.enough = 0.0;
  const DistanceResult result = distance(a, b, a_from_b, options);
  if (result.lower > 0.0) return Contact::Separate;
  return result.upper <= 0.0 ? Contact::Touching : Contact::Unknown;
}

}  // namespace swept
