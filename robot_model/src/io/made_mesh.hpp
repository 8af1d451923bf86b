// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "io/cover_cache.hpp"
#include "io/mesh_content.hpp"
#include "swept/core/sphere_cover.hpp"
#include "swept/core/triangle_mesh.hpp"

namespace swept::detail {

/// A mesh made from a file at one scale, with remarks for messages, or the reason why there is no
/// mesh.
struct MadeMesh {
  std::optional<TriangleMesh> mesh;
  double rounding = 0.0;  ///< m: along each axis, what is nearer to another thing may be the same
  double opening = 0.0;   ///< m, TriangleMesh::opening()
  std::shared_ptr<const SphereCover> cover;  ///< null: none was asked for
  double coverSeconds = 0.0;                 ///< s, to build it
  std::string problem;         ///< that the file has; goes behind its name in a message
  std::exception_ptr failure;  ///< that the file has nothing to do with, as too little memory
};

/// The message about a file that cannot be used.
MadeMesh unusable(const MeshFileError& error);

/// Scales a file's content (a negative scale mirrors) and makes a mesh of it. Makes its cover too
/// where a cache is given for it. Throws nothing.
MadeMesh makeMesh(MeshFileContent content, const Eigen::Vector3d& scale,
                  CoverCache* covers) noexcept;

}  // namespace swept::detail
