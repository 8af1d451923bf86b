// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "swept/core/bounding_sphere.hpp"
#include "swept/core/shapes.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

/// How far two moving bodies can approach along a direction during a time interval [m - h, m + h].
///
/// Write each body's velocity at the middle m as v(p) = v(c) + w x (p - c), with c the centre of a
/// ball of radius r that contains the body, and let a bound the acceleration of all its points.
/// Then every point stays within a h^2 / 2 of p(m) + s v(p) for some |s| <= h, hence along a fixed
/// unit vector n it moves by at most h |n . v(c)| + h |n x w| r + a h^2 / 2. The two bodies' first
/// terms are taken together: only their relative velocity counts. The same holds for any part of a
/// body with a centre and a size of its own; queries make use of it, and so need c besides v(c).
/// Vectors and centres are given in the first body's frame at m.
struct ApproachBound {
  double required = 0.0;   ///< m, separation to be proven besides the motion: margin and rounding
  double travel = 0.0;     ///< m, bound on the approach in any direction (may be infinity)
  double curvature = 0.0;  ///< m, (a_A + a_B) h^2 / 2
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();    ///< m, h (v_B(c_B) - v_A(c_A))
  Eigen::Vector3d spinA = Eigen::Vector3d::Zero();     ///< rad, h w_A
  Eigen::Vector3d spinB = Eigen::Vector3d::Zero();     ///< rad, h w_B
  BoundingSphere ballA{Eigen::Vector3d::Zero(), 0.0};  ///< m, a's frame
  BoundingSphere ballB{Eigen::Vector3d::Zero(), 0.0};  ///< m, a's frame

  /// m. A separation of more than this along the unit vector n at m lasts over the whole interval.
  double along(const Eigen::Vector3d& n) const {
    const double directed = std::abs(n.dot(linear)) + n.cross(spinA).norm() * ballA.radius +
                            n.cross(spinB).norm() * ballB.radius + curvature;
    return required + std::min(travel, directed);
  }
  /// m, >= along(n) for every n.
  double most() const {
    return required + std::min(travel, linear.norm() + spinA.norm() * ballA.radius +
                                           spinB.norm() * ballB.radius + curvature);
  }
};

/// What is known about two bodies during an interval.
enum class Separation : std::uint8_t {
  Unproven,   ///< neither of the two
  Separated,  ///< proven for the whole interval
  Contact,    ///< two points at most `contact` apart at the middle of the interval are known
};

/// What is to be proven, and how hard to try.
struct SeparationQuery {
  ApproachBound approach;                   ///< what the two may approach by, and have to keep
  double contact = 0.0;                     ///< m
  double tolerance = tolerance::kDistance;  ///< m, accuracy wanted where neither can be shown
  Eigen::Vector3d guess =
      Eigen::Vector3d::Zero();  ///< warm start: direction from a to b, a's frame
  /// False: give up on meshes whose hulls suggest that the interval is too long to be proven. Saves
  /// time where a failed interval is split anyway; contact is still found.
  bool thorough = true;
};

/// The answer, and what the next query may start from.
struct SeparationResult {
  Separation status = Separation::Unproven;                ///< see Separation
  double upper = std::numeric_limits<double>::infinity();  ///< m, |pointB - pointA|, if computed
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, a's frame; valid when upper is finite
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, a's frame; valid when upper is finite
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< best direction found: the next warm start
};

/// Proves that `a` and `b` stay apart over an interval, or shows that they touch at its middle.
/// Meshes are proven apart piece by piece, each piece along a direction of its own. `a_from_b` is
/// the pose at the middle. Never throws on finite input; with non-finite input the answer is
/// Unproven.
SeparationResult separate(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                          const SeparationQuery& query);

}  // namespace swept
