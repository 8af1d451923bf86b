// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>

namespace swept::detail {

// A rotation vector v of a rotation M, M' = [w] M, has v' = J(v) w with J = 1 - [v] / 2 + c [v]^2
// and c = (1 - (f / 2) cot(f / 2)) / f^2, f = |v| (Bullo and Murray 1995). |J| is at most
// k = (f / 2) / sin(f / 2), the derivative of J along a unit vector at most
// l = 1 / 2 + c' f^2 + 2 c f, as c and c' are positive and grow with f. So with a constant w, v(m +
// s) is within l k (s |w|)^2 / 2 of v(m) + s J w; where w changes, M is off that by a rotation of
// no more than s^2 / 2 times the angular acceleration, and v by k times this. With f <= pi, k is at
// most pi / 2 and l k / 2 at most 1.03; with f <= 4, 2.2 and 2.14; with f <= 1 / 2, 1.011 and
// 0.296. v may be followed beyond f = pi: the shorter vector of the same rotation is (1 - 2 pi / f)
// v, and its components are smaller.

/// The rotation vector of a rotation, |v| <= pi.
Eigen::Vector3d rotationVectorOf(const Eigen::Matrix3d& rotation);

/// J(v) w: see above.
Eigen::Vector3d rateOfRotationVector(const Eigen::Vector3d& v, const Eigen::Vector3d& w);

}  // namespace swept::detail
