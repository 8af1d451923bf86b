// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "swept/core/continuous/deforming_mesh.hpp"

namespace swept::detail {

/// Writes the frame that follows the end of the step into `start`, which is not needed then, with
/// at most this many threads including the caller's: bit for bit the same for any number. Returns
/// the area of boxes relative to that of the triangles' boxes. Throws std::invalid_argument for a
/// non-finite coordinate, and then has changed nothing. Allocates only for threads.
double refit(DeformingMesh::Data& data, std::span<const Eigen::Vector3d> vertices,
             unsigned threads);

/// How many of these threads (0: as many as processors) pay.
unsigned usefulThreads(unsigned threads, std::size_t triangles);

}  // namespace swept::detail
