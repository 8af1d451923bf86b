// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swept/core/sphere_cover.hpp"

namespace swept::detail {

/// A cover as bytes in this machine's form, bit for bit.
std::string toBytes(const SphereCover& cover);

/// The cover. Empty for bytes that toBytes() cannot have returned: too short or too long, with
/// children out of place or with invalid balls.
std::optional<SphereCover> coverFromBytes(std::string_view bytes);

}  // namespace swept::detail
