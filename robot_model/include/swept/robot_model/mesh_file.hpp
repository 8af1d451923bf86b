// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>

#include "swept/core/triangle_mesh.hpp"
#include "swept/robot_model/input.hpp"

namespace swept {

///@{
/// The mesh that a URDF or a scene makes from a file: `.stl`, `.obj`, `.ply`, `.dae`, `.off`,
/// `.gltf` or `.glb`, in any case. It is read whole or not at all; README.md, "Which meshes are
/// read", says what is refused. Lengths are those of the file (COLLADA's `<unit>` is applied) times
/// `scale`, one factor or one for each axis of the file: for a file in millimetres use 0.001. A
/// negative factor mirrors.
///
/// A surface that closes is a solid, with cracks of up to 1e-5 of its size filled.
/// LoadOptions::warn receives what stays open, and cracks that rounding does not explain.
///
/// The mesh is a Shape: `world.add("part", loadMesh("part.stl", 0.001), world_from_part)`. glTF is
/// read in single precision: TriangleMesh::sourceError() bounds the error of its corners, and
/// LoadOptions::childProcess says in which process it is read.
///
/// Throws InputError for a file that cannot be used, with the line in the message if there is one,
/// and std::invalid_argument for a factor that is 0 or not finite.
TriangleMesh loadMesh(const std::filesystem::path& file, double scale = 1.0,
                      const LoadOptions& options = {});
TriangleMesh loadMesh(const std::filesystem::path& file, const Eigen::Vector3d& scale,
                      const LoadOptions& options = {});
///@}

}  // namespace swept
