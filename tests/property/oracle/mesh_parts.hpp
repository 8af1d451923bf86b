// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "primitive.hpp"

namespace oracle {

using Face = std::array<int, 3>;

/// Faces joined over edges are a part. It is closed, and so a solid, where each edge has an even
/// number of faces; a face with the corners of an earlier one counts, and stays, only where nothing
/// else closes its part and not all of it cancels.
struct MeshParts {
  std::vector<Face> faces;     ///< that stay, with corners at the same place as one
  std::vector<int> part;       ///< per face
  std::vector<char> closed;    ///< per part
  std::vector<char> oriented;  ///< per part: each edge is run through equally often both ways
};

/// Corners of open edges that are within `crack` (m) of each other along each axis count as one
/// when edges are compared, and one that is as near to an open edge divides it; they stay where
/// they are. Faces with an edge of their own, and those that have one without them, are parts of
/// their own.
MeshParts partsOf(const std::vector<Vector3d>& vertices, const std::vector<Face>& faces,
                  double crack);

}  // namespace oracle
