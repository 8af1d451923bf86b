// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "io/crossing_face.hpp"
#include "io/input_source.hpp"

namespace swept::detail {

/// Whether what is left of a file has the materials of its faces: no proof needs them.
enum class FaceMaterials { LeftOut, Kept };

/// What a mesh file says it holds, found by small readers of ours. Assimp leaves out in silence
/// what it does not understand, and reads faces that are not there; what it returns is held against
/// this.
struct MeshClaim {
  std::uint64_t triangles = 0;  ///< a polygon of n corners counts n - 2
  Eigen::AlignedBox3d box;      ///< of their corners; frame and unit of MeshFileContent
  double loss = 0.0;            ///< at most, of a coordinate in single precision; the same unit
  /// The file with its faces and their corners alone, which is what assimp reads: it refuses whole
  /// files for normals, colours and cameras that it does not understand, and no face needs them.
  /// Empty: it reads the file itself, where these are bytes that mean any number.
  std::optional<std::string> bare;
  CrossingFace crossing;

  /// The coordinate that a word says, and what assimp makes of it into `loss`; empty: it is no
  /// finite number.
  std::optional<double> coordinate(std::string_view word);
  /// Likewise, of one that is binary.
  std::optional<double> coordinate(double value);
};

/// One reader for each format: none of them leaves anything out that could be part of a face. They
/// throw InputError for what they do not understand and for what is not whole.
MeshClaim checkStl(std::string_view bytes, const InputSource& source);
MeshClaim checkObj(std::string_view bytes, const InputSource& source);
MeshClaim checkPly(std::string_view bytes, const InputSource& source);
MeshClaim checkCollada(std::string_view bytes, const InputSource& source);
/// As checkCollada; `bare` has the materials, too, of which nothing is judged.
MeshClaim checkColladaWithMaterials(std::string_view bytes, const InputSource& source);

}  // namespace swept::detail
