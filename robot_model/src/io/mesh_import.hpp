// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/mesh_content.hpp"

namespace swept::detail {

/// Reads a mesh file's bytes with assimp, which picks the reader by the ending of `name`. Assimp
/// reads numbers in single precision and composes the transforms of nodes in it. The content's
/// `error` bounds both errors, for a format whose numbers assimp rounds once. Throws MeshFileError
/// and std::bad_alloc. A hostile file can make assimp crash or run without end.
MeshFileContent importMesh(const std::string& name, std::span<const std::uint8_t> bytes);

}  // namespace swept::detail
