// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "swept/core/arithmetic.hpp"

namespace swept {

/// Ball that contains a shape. Its radius is infinite for planes and half-spaces.
struct BoundingSphere {
  Eigen::Vector3d center;  ///< m, in the shape's frame
  double radius;           ///< m, rounded outward
};

}  // namespace swept
