// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "io/collada_xml.hpp"

namespace swept::detail {

/// Takes points of a node to the file's frame, and knows how far rounding has moved them at most.
class ColladaPlace {
 public:
  /// The file's frame, in that many metres.
  explicit ColladaPlace(double unit);

  /// Goes into what `element` of a node places: <translate>, <rotate>, <scale> and <matrix>. Others
  /// change nothing. Fails for numbers that are not there or make no place.
  void enter(const tinyxml2::XMLElement& element, const InputSource& source);

  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const {
    return linear_ * point + offset_;
  }
  /// Of a point that is no farther from the node's origin; the unit of the file's frame.
  double error(double distance) const;

 private:
  Eigen::Matrix3d linear_;
  Eigen::Vector3d offset_ = Eigen::Vector3d::Zero();
  /// No point at a distance of d from the node's origin is farther from the file's than stretch_ d
  /// + reach_, nor was on its way, whatever cancels in the end.
  double stretch_, reach_ = 0.0;
  double steps_ = kStep;  ///< of that, what the transforms so far have rounded at most

  /// Of the numbers of a transform, and of its product with those before: matrices whose entries
  /// are no more than 3 times what they stretch by, and 4 roundings.
  static constexpr double kStep = 16.0 * 0x1p-53;
};

}  // namespace swept::detail
