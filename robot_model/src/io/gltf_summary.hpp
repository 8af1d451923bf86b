// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <string_view>

#include "io/input_source.hpp"

namespace swept::detail {

/// The number of triangles and the box that a mesh file states. The result of another reader is
/// compared with it.
struct MeshSummary {
  std::uint64_t triangles = 0;
  Eigen::AlignedBox3d box;  ///< that contains them; the file's frame and unit
};

/// Reads the summary of glTF 2.0, as text or, with `isBinary`, as .glb: what its scene shows, by
/// the counts and bounds that the file states. Throws InputError for a file that is cut off or
/// reaches beyond its buffers, refers to another file, or needs extensions that concern faces.
/// Throws it as well for skins, morph targets, sparse accessors, corners that are not in single
/// precision, and faces that the scene does not show.
MeshSummary gltfSummary(std::string_view bytes, bool isBinary, const InputSource& source);

}  // namespace swept::detail
