// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string_view>

#include "io/input_source.hpp"

namespace swept::detail {

/// What a mesh file says it holds. What another reader makes of it is held against this.
struct MeshSummary {
  std::uint64_t triangles = 0;
  Eigen::AlignedBox3d box;  ///< that contains them; the file's frame and unit
};

/// Of glTF 2.0, as text or, `isBinary`, as .glb: what its scene shows, by the counts and bounds
/// that the file gives itself. Throws InputError for what is cut off or reaches beyond its buffers,
/// for what is in another file, for what needs extensions that have to do with faces, and for
/// skins, morph targets, sparse accessors, corners that are not in single precision, and faces that
/// the scene does not show.
MeshSummary gltfSummary(std::string_view bytes, bool isBinary, const InputSource& source);

}  // namespace swept::detail
