// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "swept/core/shapes.hpp"

/// Pairs of shapes with a known signed distance. README.md has the text format.
namespace swept::test {

/// A shape as the text has it: its kind and numbers.
struct ShapeText {
  std::string kind;
  std::vector<double> numbers;

  /// With all lengths multiplied. Throws std::invalid_argument for what the format does not allow.
  Shape shape(double scale = 1.0) const;
};

struct ShapePairCase {
  std::string id;
  std::string source;  ///< who found it, as owner/repository#number
  ShapeText a, b;
  /// Affine maps, used exactly as printed; some sources print rotations that are orthonormal only
  /// to 1e-9. The translations in m.
  Eigen::Affine3d world_from_a = Eigen::Affine3d::Identity();
  Eigen::Affine3d world_from_b = Eigen::Affine3d::Identity();
  double signedDistance = 0.0;  ///< m
  double tolerance = 0.0;       ///< m
  double scale = 1.0;           ///< of the shapes' lengths; poses and distances have it already

  ShapePairCase moved(const Eigen::Isometry3d& motion) const;
  ShapePairCase scaled(double by) const;
  ShapePairCase swapped() const;
};

/// Throws std::runtime_error with file and line.
std::vector<ShapePairCase> readShapePairs(const std::string& file);

/// As it would stand in the file, with all digits; and the factor, if it is not 1.
std::string toText(const ShapePairCase& item);

/// Asks for signed distance, distance and yes or no, in both orders; reports what is off by more
/// than the tolerance and the rounding of the poses.
void expectRight(const ShapePairCase& item);

}  // namespace swept::test
