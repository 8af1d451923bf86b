// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/separation.hpp"

#include "geometry/nearest_rotation.hpp"
#include "narrowphase/piecewise.hpp"
#include "swept/core/floating_point_environment.hpp"

namespace swept {

SeparationResult separate(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                          const SeparationQuery& query) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return separate(a, b, a_from_b, query); });
  }
  if (!detail::isRigidPose(a_from_b)) {
    const auto rigid = detail::nearestRigidPose(a_from_b);
    return rigid ? separate(a, b, *rigid, query) : SeparationResult{};
  }
  SeparationResult result;
  detail::PieceGoal goal;
  goal.approach = &query.approach;
  goal.contact = query.contact;
  goal.tolerance = query.tolerance;
  goal.thorough = query.thorough;
  const detail::PieceResult found =
      detail::searchPieces(detail::Side::of(a), detail::Side::of(b), a_from_b, query.guess, goal);
  result.upper = found.upper;
  result.pointA = found.pointA;
  result.pointB = found.pointB;
  result.normal = found.hint;
  if (found.upper <= query.contact) {
    result.status = Separation::Contact;
  } else if (found.satisfied) {
    result.status = Separation::Separated;
  }
  return result;
}

}  // namespace swept
