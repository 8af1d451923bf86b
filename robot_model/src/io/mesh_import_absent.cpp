// SPDX-License-Identifier: BSD-3-Clause
#include "io/mesh_import.hpp"

namespace swept::detail {

MeshFileContent importMesh(const std::string& /*name*/, std::span<const std::uint8_t> /*bytes*/) {
  throw MeshFileError("cannot be read: glTF is read by assimp, which swept was built without here");
}

}  // namespace swept::detail
