// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

/// A cover as bytes of this kind of machine, each bit as it is.
std::string toBytes(const SphereCover& cover);

/// Empty for what toBytes() does not return: too short or too long, with children out of place or
/// balls that are none.
std::optional<SphereCover> coverFromBytes(std::string_view bytes);

}  // namespace swept::detail
