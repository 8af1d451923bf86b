// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gap.hpp"
#include "mesh.hpp"
#include "overlap.hpp"

namespace oracle {

/// One collision shape in its own frame: a primitive, or a mesh when `mesh` is set.
struct Piece {
  explicit Piece(const Primitive& solid);
  explicit Piece(std::shared_ptr<const Mesh> triangles);

  Primitive primitive = Sphere{0.0};
  std::shared_ptr<const Mesh> mesh;
  Vector3d boxCenter, boxHalf;  ///< m
  double radius;                ///< m, of a ball around boxCenter
  Isometry3d body_from_piece = Isometry3d::Identity();
};

struct Body {
  std::string name;
  std::vector<Piece> pieces;
};

/// Whether the solids share a point.
bool overlap(const Piece& a, const Piece& b, const Isometry3d& a_from_b);
/// Whether they share one wherever rounding has put the corners of meshes of files
/// (Mesh::rounding).
bool surelyOverlap(const Piece& a, const Piece& b, const Isometry3d& a_from_b);
/// The distance, or two values of about `enough` (m) when it is larger; with what meshes of files
/// are off (Mesh::rounding).
Gap gap(const Piece& a, const Piece& b, const Isometry3d& a_from_b, double enough);
/// m, from a point in the piece's frame; 0 inside.
double distanceTo(const Piece& piece, const Vector3d& p);

}  // namespace oracle
