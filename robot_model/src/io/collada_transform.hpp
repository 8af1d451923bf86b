// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "io/collada_xml.hpp"

namespace swept::detail {

/// Maps points of a node to the file's frame, and bounds the rounding error of the map.
class ColladaPlace {
 public:
  /// Starts at the file's frame, whose unit is that many metres.
  explicit ColladaPlace(double unit);

  /// Appends the transforms in `element`, the child of a node: <translate>, <rotate>, <scale> and
  /// <matrix>. Others change nothing. Throws for numbers that are missing or make no transform.
  void enter(const tinyxml2::XMLElement& element, const InputSource& source);

  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const {
    return linear_ * point + offset_;
  }
  /// Bound on the error of points no farther than this from the node's origin, in the unit of the
  /// file's frame.
  double error(double distance) const;

 private:
  Eigen::Matrix3d linear_;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  /// A point at distance d from the node's origin is at most stretch_ d + reach_ from the file's
  /// origin. This holds for every intermediate step as well, whatever cancels in the end.
  double stretch_, reach_ = 0.0;
  double steps_ = kStep;  ///< of that, what the transforms so far have rounded at most

  /// Of the numbers of a transform, and of its product with those before: matrices whose entries
  /// are no more than 3 times what they stretch by, and 4 roundings.
  static constexpr double kStep = 16.0 * 0x1p-53;
};

}  // namespace swept::detail
