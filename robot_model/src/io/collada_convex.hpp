// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace swept::detail {

/// A COLLADA file in which each `<convex_mesh>` that is the first in its `<geometry>` is called
/// `<mesh>`: it has the same children, and a proof is about its faces, whether or not they are
/// those of a convex solid. One with `convex_hull_of` stays, as it has no faces. Lines stay where
/// they are.
std::string withConvexMeshes(std::string_view text);

}  // namespace swept::detail
