// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "io/input_source.hpp"
#include "io/mesh_content.hpp"

namespace swept::detail {

/// Whether the colours of the faces are wanted: no proof needs them.
enum class FaceMaterials { LeftOut, Kept };

/// One reader for each format: none of them leaves anything out that could be part of a face. They
/// throw InputError for what they do not understand and for what is not whole, and MeshFileError
/// for too many triangles. Coordinates of text are the nearest doubles. Time and memory are in
/// proportion to the size of the file and to the triangles that come of it.
MeshFileContent readStlMesh(std::string_view bytes, const InputSource& source);
MeshFileContent readObjMesh(std::string_view bytes, const InputSource& source);
MeshFileContent readPlyMesh(std::string_view bytes, const InputSource& source);
MeshFileContent readOffMesh(std::string_view bytes, const InputSource& source);
/// `<unit>` is applied, `<up_axis>` is not: robot descriptions take the coordinates as they stand
/// in the file, as RViz and MoveIt do. What is wrong with a material costs its colour, not the
/// file.
MeshFileContent readColladaFile(std::string_view bytes, const InputSource& source,
                                FaceMaterials materials);

}  // namespace swept::detail
