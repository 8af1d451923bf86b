// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "model.hpp"

namespace swept::verify {

/// A convex shape of a model that contains links: a box with rounded edges, or a ball or cylinder,
/// or a hull.
struct Container {
  /// A triangle between corners of a hull.
  struct Face {
    Eigen::Vector3d corner;  ///< m
    Eigen::Vector3d normal;  ///< m^2, of any length, outward
    double size;             ///< m^2: product of two sides; no less than the length of the normal
  };

  bool round = false;                              ///< a cylinder: across z
  Eigen::Vector3d half = Eigen::Vector3d::Zero();  ///< m; of a cylinder the radius, and half of the
                                                   ///< length (z)
  double radius = 0.0;                             ///< m, around that
  std::vector<Face> faces = {};  ///< of a hull; each of their edges is passed both ways
  double reach = 0.0;            ///< m: size of the coordinates of a hull
  Eigen::Isometry3d shape_from_link = Eigen::Isometry3d::Identity();

  /// Whether the ball of radius `around` (m) about a point of the link is in the shape. It is at
  /// least the rounding of the point and of what is computed here.
  bool contains(const Eigen::Vector3d& point, double around) const;
};

/// The `spheres` or `shapes` of a link. Throws Refusal.
std::vector<Container> containersOf(const Json& link, const std::string& where);

/// m, 0 or more. Throws Refusal.
double sizeOf(const Json& json, const char* key, const std::string& where);

}  // namespace swept::verify
