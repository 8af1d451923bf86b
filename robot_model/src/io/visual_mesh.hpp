// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "io/mesh_content.hpp"
#include "swept/robot_model/visual_model.hpp"

namespace swept::detail {

/// The triangles of one colour of a mesh file.
struct ColouredMesh {
  std::uint32_t colour = kNoColour;  ///< as MeshFileContent::colours
  std::shared_ptr<VisualMesh> mesh;
};

/// One for each colour, in the order in which the file has them. Corners at the same place, in
/// single precision, are one. Empty where scaling leaves no finite numbers.
std::vector<ColouredMesh> colouredMeshes(const MeshFileContent& content,
                                         const Eigen::Vector3d& scale);

/// Makes the mesh one of no more than `most` triangles: all corners within a cell of a grid become
/// their mean, and triangles that are none any more, or twice there, go. Cells are as small as that
/// allows.
void makeCoarser(VisualMesh& mesh, std::size_t most);

/// How many triangles each mesh may keep, so that all together have `inAll` at most: those with
/// fewer keep all of them.
std::size_t evenShare(std::vector<std::size_t> counts, std::size_t inAll);

}  // namespace swept::detail
