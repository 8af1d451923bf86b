// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "swept/core/triangle_mesh.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

///@{
/// The mesh that a URDF or a scene makes of a file: `.stl`, `.obj`, `.ply`, `.dae`, `.off`, `.gltf`
/// or `.glb`, in letters of any size. Read whole or not at all; README.md, "Which meshes are read",
/// has what is refused.
/// Lengths are those of the file (COLLADA's `<unit>` is applied) times `scale`, which is one factor
/// or one for each axis of the file: a file in millimetres takes 0.001. A negative one mirrors.
///
/// A surface that closes is a solid, cracks of up to 1e-5 of its size filled. LoadOptions::warn is
/// told of what stays open, and of cracks that rounding does not explain.
///
/// The mesh is a Shape: `world.add("part", loadMesh("part.stl", 0.001), world_from_part)`. Of glTF,
/// which is read in single precision, TriangleMesh::sourceError() says how far its corners may be
/// off; LoadOptions::childProcess has where that is read.
///
/// Throws InputError for a file that cannot be used, with the line in the message where there is
/// one, and std::invalid_argument for a factor of 0 or one that is not finite.
TriangleMesh loadMesh(const std::filesystem::path& file, double scale = 1.0,
                      const LoadOptions& options = {});
TriangleMesh loadMesh(const std::filesystem::path& file, const Eigen::Vector3d& scale,
                      const LoadOptions& options = {});
///@}

}  // namespace swept
