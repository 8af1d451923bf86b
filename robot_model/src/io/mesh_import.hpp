// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/mesh_file.hpp"

namespace swept::detail {

/// What assimp makes of a mesh file's bytes; it picks the reader by the ending of `name`. Throws
/// MeshFileError and std::bad_alloc. Assimp is not proof against hostile files: they can make it
/// crash or run without end.
MeshFileContent importMesh(const std::string& name, std::span<const std::uint8_t> bytes);

}  // namespace swept::detail
