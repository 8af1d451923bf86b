// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "narrowphase/piece_pair.hpp"
#include "point_cloud/certificate.hpp"
#include "swept/core/shapes.hpp"

namespace swept::detail {

/// Looks at balls against a shape, which it refers to: does a ball around a position (m, the
/// shape's frame) touch the shape?
class ShapeLook {
 public:
  explicit ShapeLook(const Shape& shape);

  /// `tolerance`: m, of distances to curved shapes.
  Finding at(const Eigen::Vector3d& position, double radius, double tolerance) const;

 private:
  Finding atMesh(const Eigen::Vector3d& position, double radius, double tolerance) const;
  Finding atOther(const Eigen::Vector3d& position, double radius, double tolerance) const;

  const Shape& shape_;
  const Shape point_;
  const Side shapeSide_;
  const Side pointSide_;
};

/// Is the position within `radius` (m) of the origin?
Finding lookAtBall(const Eigen::Vector3d& position, double radius);

}  // namespace swept::detail
