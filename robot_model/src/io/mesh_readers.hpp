// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

#include "io/input_source.hpp"
#include "io/mesh_content.hpp"

namespace swept::detail {

/// Whether to read the colours of the faces: no proof needs them.
enum class FaceMaterials { LeftOut, Kept };

/// One reader for each format. No reader leaves out anything that could be part of a face. They
/// throw InputError for what they do not understand and for incomplete files, and MeshFileError for
/// too many triangles. Coordinates in text are the nearest doubles. Time and memory are
/// proportional to the size of the file and to the number of triangles.
MeshFileContent readStlMesh(std::string_view bytes, const InputSource& source);
MeshFileContent readObjMesh(std::string_view bytes, const InputSource& source);
MeshFileContent readPlyMesh(std::string_view bytes, const InputSource& source);
MeshFileContent readOffMesh(std::string_view bytes, const InputSource& source);
/// `<unit>` is applied, `<up_axis>` is not: robot descriptions take the coordinates as they stand
/// in the file, as RViz and MoveIt do. A problem with a material drops its colour, not the file.
MeshFileContent readColladaFile(std::string_view bytes, const InputSource& source,
                                FaceMaterials materials);

}  // namespace swept::detail
