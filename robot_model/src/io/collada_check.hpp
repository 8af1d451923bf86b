// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace swept::detail {

/// Refuses COLLADA text whose meshes contradict themselves: arrays shorter than their count,
/// accessors past their array, indices that are no numbers or past their source. Assimp 5.2 does
/// not look: it reads beyond the arrays, takes negative indices for 0 and never ends on an index
/// that is no number. Throws MeshFileError with the line.
void checkCollada(std::string_view text);

}  // namespace swept::detail
