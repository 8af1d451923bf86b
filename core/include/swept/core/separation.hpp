// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "swept/core/bounding_sphere.hpp"
#include "swept/core/shapes.hpp"
#include "swept/core/tolerances.hpp"

namespace swept {

/// A displacement of two bodies that may happen besides their motion, by any share of it from -1 to
/// 1: that of their centres, and small rotations about these. In the first body's frame.
struct ApproachError {
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();  ///< m, of b's centre minus a's
  Eigen::Vector3d spinA = Eigen::Vector3d::Zero();   ///< rad
  Eigen::Vector3d spinB = Eigen::Vector3d::Zero();   ///< rad
};

/// How far two moving bodies can approach along a direction during a time interval [m - h, m + h].
///
/// Write each body's velocity at the middle m as v(p) = v(c) + w x (p - c), where c is the centre
/// of a ball of radius r that contains the body, and let a bound the acceleration of all its
/// points. Then every point stays within a h^2 / 2 of p(m) + s v(p) for some |s| <= h. Along a
/// fixed unit vector n it therefore moves by at most h |n . v(c)| + h |n x w| r + a h^2 / 2. The
/// first terms of the two bodies are combined: only their relative velocity counts. The same holds
/// for any part of a body with its own centre and size. Queries use this, and so need c besides
/// v(c). Vectors and centres are in the first body's frame at m.
///
/// Errors, such as those of joints that are off their values, displace a point p besides, by e(c) +
/// w x (p - c) each, times a share from -1 to 1 of its own; `curvature` has what this neglects. So
/// along n each adds |n . e(c)| + |n x w| r.
struct ApproachBound {
  double required = 0.0;   ///< m, to be kept in addition to the motion: margin and rounding
  double travel = 0.0;     ///< m, bound on the approach in any direction (may be infinity)
  double curvature = 0.0;  ///< m, (a_A + a_B) h^2 / 2
  Eigen::Vector3d linear = Eigen::Vector3d::Zero();    ///< m, h (v_B(c_B) - v_A(c_A))
  Eigen::Vector3d spinA = Eigen::Vector3d::Zero();     ///< rad, h w_A
  Eigen::Vector3d spinB = Eigen::Vector3d::Zero();     ///< rad, h w_B
  BoundingSphere ballA{Eigen::Vector3d::Zero(), 0.0};  ///< m, a's frame
  BoundingSphere ballB{Eigen::Vector3d::Zero(), 0.0};  ///< m, a's frame
  std::span<const ApproachError> errors = {};          ///< must outlive the query

  /// m. A separation of more than this along the unit vector n at m holds for the whole interval.
  double along(const Eigen::Vector3d& n) const {
    double directed = std::abs(n.dot(linear)) + n.cross(spinA).norm() * ballA.radius +
                      n.cross(spinB).norm() * ballB.radius + curvature;
    for (const ApproachError& error : errors)
      directed += std::abs(n.dot(error.linear)) + n.cross(error.spinA).norm() * ballA.radius +
                  n.cross(error.spinB).norm() * ballB.radius;
    return required + std::min(travel, directed);
  }
  /// m, >= along(n) for every n.
  double most() const {
    double moved = linear.norm() + spinA.norm() * ballA.radius + spinB.norm() * ballB.radius;
    for (const ApproachError& error : errors)
      moved += error.linear.norm() + error.spinA.norm() * ballA.radius +
               error.spinB.norm() * ballB.radius;
    return required + std::min(travel, moved + curvature);
  }
};

/// What is known about two bodies during an interval.
enum class Separation : std::uint8_t {
  Unproven,   ///< neither of the other two
  Separated,  ///< proven for the whole interval
  Contact,    ///< two points at most `contact` apart are known at the middle of the interval
};

/// What to prove, and how hard to try.
struct SeparationQuery {
  ApproachBound approach;  ///< how far the two may approach, and what they must keep
  double contact = 0.0;    ///< m, two points this close are a contact
  double tolerance = tolerance::kDistance;  ///< m, accuracy wanted if neither can be shown
  Eigen::Vector3d guess =
      Eigen::Vector3d::Zero();  ///< warm start: direction from a to b, a's frame
  /// False: give up on meshes whose hulls suggest that the interval is too long to be proven. This
  /// saves time if the caller splits a failed interval anyway; contact is still found.
  bool thorough = true;
};

/// The answer, and a warm start for the next query.
struct SeparationResult {
  Separation status = Separation::Unproven;                ///< see Separation
  double upper = std::numeric_limits<double>::infinity();  ///< m, |pointB - pointA|, if computed
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, a's frame; valid when upper is finite
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, a's frame; valid when upper is finite
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< best direction found: the next warm start
};

/// Proves that `a` and `b` stay apart over an interval, or shows that they touch at its middle.
/// `a_from_b` is the pose of b in a's frame at the middle. Each piece of a mesh is proven apart
/// along its own direction. Never throws on finite input; with non-finite input the answer is
/// Unproven.
SeparationResult separate(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                          const SeparationQuery& query);

}  // namespace swept
