// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "swept/robot_model/sphere_model.hpp"

namespace swept::detail {

/// Throws UsageError for a body with a plane or a half-space, and std::invalid_argument for one
/// without shapes and for two of one name.
void requireBodies(std::span<const NamedBody> bodies);

/// Throws UsageError if the robot has more links with geometry than there are `shapes`, which are
/// called `what`.
void requireEnough(std::optional<int> shapes, const char* what, const Robot& robot,
                   std::size_t links);
/// Likewise, for bodies.
void requireEnough(std::optional<int> shapes, const char* what, std::size_t bodies);

}  // namespace swept::detail
