// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "mesh_parts.hpp"
#include "primitive.hpp"

namespace oracle {

/// Triangles with a binary tree of boxes. Closed parts are solid.
class Mesh {
 public:
  struct Node {
    Vector3d center, half;
    int left = -1, right = -1;  ///< children; none in a leaf
    int first = 0, count = 0;   ///< range of triangles
  };

  /// `crack` (m): see partsOf().
  Mesh(const std::vector<Vector3d>& vertices, const std::vector<Face>& faces, double crack = 0);
  /// All the meshes of a file in the file's own axes, lengths multiplied by `scale`. Corners that
  /// only rounding to single precision can have brought apart leave no crack.
  static Mesh read(const std::filesystem::path& file, const Vector3d& scale);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  /// m; no corner is farther than this from where its file has it.
  double rounding() const { return rounding_; }
  const std::vector<Node>& nodes() const { return nodes_; }  ///< the root is first
  /// One vertex of each part.
  const std::vector<Vector3d>& representatives() const { return representatives_; }
  int closedParts() const { return closedParts_; }
  /// Whether a closed part has p in its inside: by the winding number that a ray's crossings give
  /// where the part's triangles are consistently oriented (pieces of one part may overlap), by
  /// their parity elsewhere.
  bool encloses(const Vector3d& p) const;
  /// m; 0 inside.
  double distanceTo(const Vector3d& p) const;

 private:
  int split(int first, int last);
  /// Of a ray with the triangles of one part.
  struct Crossings {
    int all = 0;
    int winding = 0;
  };
  /// Per part. False when the ray grazes an edge.
  bool countCrossings(const Vector3d& p, const Vector3d& direction,
                      std::vector<Crossings>& found) const;

  std::vector<Triangle> triangles_;
  std::vector<int> part_;       ///< per triangle
  std::vector<char> closed_;    ///< per part
  std::vector<char> oriented_;  ///< per part
  std::vector<Vector3d> representatives_;
  std::vector<Node> nodes_;
  int closedParts_ = 0;
  double rounding_ = 0.0;
};

}  // namespace oracle
