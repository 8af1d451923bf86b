// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "swept/core/distance.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

/// One place where two shapes touch or overlap. All vectors are in a's frame.
struct ContactPoint {
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, point of a that is deepest in b
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, point of b that is deepest in a
  /// Unit vector from a to b. Moving b's piece along it by `depth` ends the overlap.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double depth = 0.0;  ///< m, >= 0; infinity if no translation separates the two
  int pieceA = -1;     ///< triangle of a mesh or point of a cloud; -1 for other shapes
  int pieceB = -1;     ///< likewise, of b
};

/// Whether two shapes touch, and whether the list of contacts is complete.
struct ContactsResult {
  /// Separate: proven. Unknown: within rounding of touching, or the pose is not finite.
  Contact status = Contact::Unknown;
  bool complete = false;  ///< the list has every pair of pieces that touches
  int effort = 0;         ///< pairs of pieces (boxes and triangles) that were tested
};

/// Finds all places where two shapes touch, up to `most`, and appends them to `contacts`.
/// `a_from_b` is the pose of b in a's frame.
///
/// Two convex shapes have one contact, with the true penetration depth. A mesh or cloud has one
/// contact for each of its triangles or balls that touches the other shape. Its depth is local:
/// that of these two pieces alone (Pan, Chitta, Manocha 2012, section IV). signedDistance() bounds
/// the true depth.
/// A mesh wholly inside a solid mesh, or around the other shape, has one contact without pieces.
/// Pairs of triangles are decided exactly, in coordinates rounded to a's frame. Never throws on
/// finite input, except what growing `contacts` may throw. A non-finite pose gives Unknown without
/// contacts.
ContactsResult findContacts(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                            std::size_t most, std::vector<ContactPoint>& contacts);

}  // namespace swept
