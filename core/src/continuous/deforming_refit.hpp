// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "swept/core/continuous/deforming_mesh.hpp"

namespace swept::detail {

/// The frame that follows the end of the step, into `start`, which is not needed then, by so many
/// threads or fewer, the calling one among them: bit for bit the same on any number. Returns the
/// area of boxes in terms of that of the triangles' boxes. Throws std::invalid_argument for a
/// coordinate that is not finite, and has changed nothing then. Allocates for threads only.
double refit(DeformingMesh::Data& data, std::span<const Eigen::Vector3d> vertices,
             unsigned threads);

/// Of so many threads (0: as many as there are processors), how many pay.
unsigned usefulThreads(unsigned threads, std::size_t triangles);

}  // namespace swept::detail
