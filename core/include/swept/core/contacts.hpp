// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "swept/core/distance.hpp"
#include "swept/core/shapes.hpp"

namespace swept {

/// One place where two shapes touch or overlap. Everything in a's frame.
struct ContactPoint {
  Eigen::Vector3d pointA = Eigen::Vector3d::Zero();  ///< m, of a, deepest in b
  Eigen::Vector3d pointB = Eigen::Vector3d::Zero();  ///< m, of b, deepest in a
  /// Unit, from a to b: moving b's piece along it by `depth` ends the overlap.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double depth = 0.0;  ///< m, >= 0; infinity where no translation separates
  int pieceA = -1;     ///< triangle of a mesh, point of a cloud; -1 for other shapes
  int pieceB = -1;     ///< likewise, of b
};

/// Whether two shapes touch, and whether all places are known.
struct ContactsResult {
  /// Separate: proven. Unknown: within rounding of touching, or a pose that is not finite.
  Contact status = Contact::Unknown;
  bool complete = false;  ///< every pair of pieces that touches is in the list
  int effort = 0;         ///< pairs of pieces (boxes and triangles) looked at
};

/// All places where two shapes touch, up to `most` of them, appended to `contacts`.
///
/// Two convex shapes have one contact, with the true penetration depth. A mesh or cloud has one for
/// each of its triangles or balls that touches the other shape; its depth is local, that of these
/// two pieces alone (Pan, Chitta, Manocha 2012, section IV); signedDistance() bounds the true one.
/// A mesh wholly inside a solid mesh, or around the other shape, has one contact without pieces.
/// Triangle pairs are decided exactly in coordinates rounded to a's frame. Never throws on finite
/// input, but for what growing `contacts` may throw; a non-finite pose is Unknown without contacts.
ContactsResult findContacts(const Shape& a, const Shape& b, const Eigen::Isometry3d& a_from_b,
                            std::size_t most, std::vector<ContactPoint>& contacts);

}  // namespace swept
