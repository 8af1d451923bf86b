// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/mesh_content.hpp"

namespace swept::detail {

/// What assimp makes of a mesh file's bytes; it picks the reader by the ending of `name`. Assimp
/// reads numbers in single precision and composes the transforms of nodes in it: the content's
/// `error` bounds what both change, of a format whose numbers assimp rounds once. Throws
/// MeshFileError and std::bad_alloc. Assimp is not proof against hostile files: they can make it
/// crash or run without end.
MeshFileContent importMesh(const std::string& name, std::span<const std::uint8_t> bytes);

}  // namespace swept::detail
