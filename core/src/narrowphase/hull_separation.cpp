// SPDX-License-Identifier: BSD-3-Clause
#include "swept/core/hull_separation.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <variant>

#include "geometry/nearest_rotation.hpp"
#include "narrowphase/convex.hpp"
#include "swept/core/floating_point_environment.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

namespace {

using detail::Convex;
using Eigen::Vector3d;

Convex hullOf(const Shape& shape) {
  return std::visit(
      [](const auto& body) -> Convex {
        if constexpr (std::is_same_v<decltype(body), const TriangleMesh&>) {
          return Convex::of(body.hull());
        } else if constexpr (std::is_same_v<decltype(body), const PointCloud&>) {
          Convex hull = Convex::of(body.hull());
          hull.radius = body.largestRadius();
          return hull;
        } else {
          return Convex::of(body);
        }
      },
      shape);
}

/// Two hulls of which every point moves with a velocity of its own.
///
/// Lemma: at m + s h, |s| <= 1, a point p of a body is within the curvature's share of p + s h
/// v(p), and n . h v(p) = n . h v(c) + (n x h w) . (p - c) is linear in p. So along n the farthest
/// point of a is that of the same body at m along n + s n x h w, and so is the nearest point of b.
/// The separation is a minimum of functions linear in s, so it is concave, and its least value is
/// at s = -1 or s = 1.
class MovingHulls {
 public:
  MovingHulls(const Convex& a, const Convex& b, const Eigen::Isometry3d& a_from_b,
              const ApproachBound& approach, const Vector3d& n)
      : a_(a),
        b_(b),
        a_from_b_(a_from_b),
        n_(b.isFlat() ? normalOf(b, a_from_b, n) : n.normalized()),
        turnA_(n_.cross(approach.spinA)),
        turnB_(n_.cross(approach.spinB)),
        rate_(n_.dot(approach.linear) - turnB_.dot(approach.ballB.center) +
              turnA_.dot(approach.ballA.center)) {}

  double at(double s) const {
    const Vector3d alongA = n_ + s * turnA_;
    const double farthest = alongA.dot(a_.support(alongA)) + (a_.radius + a_.error) * alongA.norm();
    return nearestOfB(s) - farthest + s * rate_;
  }

 private:
  /// The flat side that faces a. It does not move.
  static Vector3d normalOf(const Convex& flat, const Eigen::Isometry3d& a_from_b,
                           const Vector3d& n) {
    const Vector3d normal = a_from_b.linear() * flat.size;
    const bool behind = flat.core == Convex::Core::Plane && normal.dot(n) > 0.0;
    return behind ? normal : Vector3d(-normal);
  }

  double nearestOfB(double s) const {
    const Vector3d along = n_ + s * turnB_;
    const Vector3d point = b_.support(-(a_from_b_.linear().transpose() * along));
    return along.dot(a_from_b_ * point) - (b_.radius + b_.error) * along.norm();
  }

  const Convex& a_;
  const Convex& b_;
  const Eigen::Isometry3d& a_from_b_;
  const Vector3d n_;
  const Vector3d turnA_, turnB_;
  const double rate_;  ///< m, of the centres along n, less what the turns add for the origin
};

HullSeparation separationOf(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                            const ApproachBound& approach, const Vector3d& n) {
  const Convex hullA = hullOf(a), hullB = hullOf(b);
  if (hullA.isFlat() || (hullB.isFlat() && !approach.spinB.isZero(0.0))) return {};
  const MovingHulls hulls(hullA, hullB, a_from_b, approach, n);
  // Lemma: each term is a product of a direction, no longer than 1 + |spin|, and a point: fewer
  // roundings than of a support evaluation.
  const double sizes = hullA.extent + hullA.radius + hullB.extent + hullB.radius +
                       a_from_b.translation().norm() + approach.ballA.center.norm() +
                       approach.ballB.center.norm() + approach.linear.norm();
  const double rounding =
      tolerance::kSupportRounding * sizes * (1.0 + approach.spinA.norm() + approach.spinB.norm());
  HullSeparation result;
  result.atMiddle = hulls.at(0.0) - rounding;
  const double directed = std::min(hulls.at(-1.0), hulls.at(1.0)) - approach.curvature - rounding;
  result.least = std::max(directed, result.atMiddle - approach.travel);
  return result;
}

}  // namespace

HullSeparation hullSeparation(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                              const ApproachBound& approach, const Eigen::Vector3d& n) {
  if (detail::inForeignEnvironment()) {
    return inDefaultEnvironment([&] { return hullSeparation(a, b, a_from_b, approach, n); });
  }
  if (!approach.errors.empty()) return {};
  if (detail::isRigidPose(a_from_b)) return separationOf(a, b, a_from_b, approach, n);
  const auto rigid = detail::nearestRigidPose(a_from_b);
  return rigid ? separationOf(a, b, *rigid, approach, n) : HullSeparation{};
}

}  // namespace swept
