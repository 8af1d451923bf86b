// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace swept::detail {

/// The colour of a face without a material, or whose material is a texture.
inline constexpr std::uint32_t kNoColour = 0xFFFFFFFF;

/// What a mesh file holds, before it is welded.
struct MeshFileContent {
  std::vector<Eigen::Vector3d> vertices;   ///< in the file's frame and unit
  std::vector<Eigen::Vector3i> triangles;  ///< indices into vertices
  /// No point of a triangle is farther from where the file has it; the file's unit. 0: what
  /// rounding to doubles adds is part of what a proof takes for rounding anyway.
  double error = 0.0;
  /// 0xRRGGBB of each triangle, or kNoColour; empty: the file has no colours, or nobody asked.
  std::vector<std::uint32_t> colours;
};

/// A mesh file that cannot be used; what() says why, without the file's name.
struct MeshFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Throws MeshFileError for more than 20 million.
void requireFewTriangles(std::uint64_t count);

/// Drops the vertices that no triangle uses, which must not count for the size of the mesh. The
/// rest is in the order of its first use.
void keepUsedVertices(MeshFileContent& content);

}  // namespace swept::detail
